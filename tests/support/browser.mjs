// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// A page in headless Chromium, by its devtools protocol over a pipe: messages
// are JSON, a zero byte ends each. WebGL is drawn by the CPU.

import {spawn} from 'node:child_process';
import {mkdtempSync, rmSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join} from 'node:path';

const FLAGS = ['--headless=new', '--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader',
               '--enable-unsafe-swiftshader', '--no-first-run', '--disable-background-networking',
               '--disable-component-update', '--disable-sync', '--disable-extensions', '--disable-dev-shm-usage',
               '--window-size=1100,800', '--remote-debugging-pipe'];
const TIMEOUT_MS = 30000;

export class Browser {
  // complaints: console messages, exceptions, and addresses beyond file: and
  // data:, as texts.
  static async open(program, url, flags = []) {
    const browser = new Browser();
    browser.complaints = [];
    browser.profile = mkdtempSync(join(tmpdir(), 'quatro-browser-'));
    browser.process = spawn(program, [...FLAGS, ...flags, `--user-data-dir=${browser.profile}`, 'about:blank'],
                            {stdio: ['ignore', 'ignore', 'ignore', 'pipe', 'pipe']});
    browser.exited = new Promise((resolve) => browser.process.on('exit', resolve));
    browser.replies = new Map();
    browser.numSent = 0;
    browser.listen(browser.process.stdio[4]);
    const {targetInfos} = await browser.send('Target.getTargets');
    const page = targetInfos.find(({type}) => type === 'page');
    const {sessionId} = await browser.send('Target.attachToTarget', {targetId: page.targetId, flatten: true});
    browser.sessionId = sessionId;
    for (const domain of ['Runtime', 'Log', 'Page', 'Network']) await browser.send(`${domain}.enable`);
    await browser.send('Page.navigate', {url});
    await browser.until('document.documentElement?.dataset.ready === "true"');
    return browser;
  }

  listen(pipe) {
    let pending = '';
    pipe.setEncoding('utf8');
    pipe.on('data', (text) => {
      const messages = (pending + text).split('\0');
      pending = messages.pop();
      messages.forEach((message) => this.receive(JSON.parse(message)));
    });
  }

  receive({id, result, error, method, params}) {
    if (id !== undefined) {
      const {resolve, reject} = this.replies.get(id);
      this.replies.delete(id);
      if (error) reject(new Error(error.message));
      else resolve(result);
      return;
    }
    if (method === 'Runtime.consoleAPICalled') {
      this.complaints.push(`${params.type}: ${params.args.map(({value, description}) => value ?? description).join(' ')}`);
    } else if (method === 'Runtime.exceptionThrown') {
      this.complaints.push(params.exceptionDetails.exception?.description ?? params.exceptionDetails.text);
    } else if (method === 'Log.entryAdded') {
      this.complaints.push(`${params.entry.level}: ${params.entry.text}`);
    } else if (method === 'Network.requestWillBeSent' && !/^(file|data):/.test(params.request.url)) {
      this.complaints.push(`asks for ${params.request.url}`);
    }
  }

  send(method, params = {}) {
    const id = ++this.numSent;
    return new Promise((resolve, reject) => {
      const timer = setTimeout(() => reject(new Error(`${method}: no reply`)), TIMEOUT_MS);
      const done = (call) => (value) => { clearTimeout(timer); call(value); };
      this.replies.set(id, {resolve: done(resolve), reject: done(reject)});
      this.process.stdio[3].write(JSON.stringify({id, method, params, sessionId: this.sessionId}) + '\0');
    });
  }

  // The value of an expression in the page; promises are waited for.
  async evaluate(expression) {
    const {result, exceptionDetails} =
        await this.send('Runtime.evaluate', {expression, returnByValue: true, awaitPromise: true});
    if (exceptionDetails) throw new Error(`${expression}: ${exceptionDetails.exception?.description}`);
    return result.value;
  }

  async until(expression) {
    const deadline = Date.now() + TIMEOUT_MS;
    while (!await this.evaluate(expression)) {
      if (Date.now() > deadline) throw new Error(`never: ${expression}; ${this.complaints.join('\n')}`);
      await new Promise((resolve) => setTimeout(resolve, 30));
    }
  }

  // Where the element is in the window: {x, y, width, height}.
  box(selector) {
    return this.evaluate(`(() => {
      const element = document.querySelector(${JSON.stringify(selector)});
      element.scrollIntoView({block: 'center', behavior: 'instant'});
      const {x, y, width, height} = element.getBoundingClientRect();
      return {x, y, width, height};
    })()`);
  }

  mouse(type, x, y, button = 'left') {
    return this.send('Input.dispatchMouseEvent',
                     {type, x, y, button: type === 'mouseMoved' && !this.isDown ? 'none' : button,
                      buttons: this.isDown ? 1 : 0, clickCount: 1});
  }

  async drag(from, to) {
    await this.mouse('mouseMoved', from.x, from.y);
    this.isDown = true;
    await this.mouse('mousePressed', from.x, from.y);
    for (let i = 1; i <= 5; ++i) {
      await this.mouse('mouseMoved', from.x + (to.x - from.x) * i / 5, from.y + (to.y - from.y) * i / 5);
    }
    this.isDown = false;
    await this.mouse('mouseReleased', to.x, to.y);
  }

  async key(key) {
    const text = key.length === 1 ? key : undefined;
    await this.send('Input.dispatchKeyEvent', {type: 'keyDown', key, text});
    await this.send('Input.dispatchKeyEvent', {type: 'keyUp', key});
  }

  // A PNG, in base64, of the element or of the window.
  async picture(selector) {
    const clip = selector ? {...await this.box(selector), scale: 1} : undefined;
    if (clip) {
      const scroll = await this.evaluate('[scrollX, scrollY]');
      clip.x += scroll[0];
      clip.y += scroll[1];
    }
    // What was asked for is drawn in the next frames.
    await this.evaluate('new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))');
    return (await this.send('Page.captureScreenshot', {format: 'png', clip})).data;
  }

  // How many colours a picture has.
  countColors(png) {
    return this.evaluate(`(async () => {
      const image = new Image();
      image.src = 'data:image/png;base64,${png}';
      await image.decode();
      const canvas = document.createElement('canvas');
      [canvas.width, canvas.height] = [image.width, image.height];
      const context = canvas.getContext('2d');
      context.drawImage(image, 0, 0);
      const pixels = new Uint32Array(context.getImageData(0, 0, image.width, image.height).data.buffer);
      return new Set(pixels).size;
    })()`);
  }

  async close() {
    try {
      this.sessionId = undefined;
      await this.send('Browser.close');
    } catch {
      this.process.kill();
    }
    await this.exited;
    rmSync(this.profile, {recursive: true, force: true, maxRetries: 5});
  }
}
