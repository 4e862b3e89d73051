// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Reports of a run and of a pair, written by the programs and tested in
// headless Chromium.
//   node report_browser_test.mjs BIN_FOLDER CHROMIUM

import assert from 'node:assert/strict';
import {spawnSync} from 'node:child_process';
import {mkdtempSync, readFileSync, rmSync, writeFileSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join} from 'node:path';
import {pathToFileURL} from 'node:url';

import {matrixOf} from '../../../experiments/report/page/motion.js';
import {roleOf} from '../../../experiments/report/page/match_stages.js';
import {INLIER, CONSISTENT, decodeView, drawnPose} from '../../../experiments/report/page/view_data.js';
import {Browser} from '../../support/browser.mjs';

const [bin, chromium] = process.argv.slice(2);
const folder = mkdtempSync(join(tmpdir(), 'quatro-report-'));
// The name of a set and a file, which would be an element and a script if
// interpreted as HTML.
const EVIL = `<img src=x onerror=document.title='evil'>&"'`;

// Uniform in [0, 1), with a fixed sequence.
let state = 1;
function uniform() {
  state = (state * 48271) % 2147483647;
  return state / 2147483647;
}

// Floor and walls of a room of 24 x 16 x 6 m, not centered at the origin.
function room() {
  return Array.from({length: 3000}, (_, i) => {
    const point = [24 * uniform() - 12, 16 * uniform() - 8, 6 * uniform() - 3];
    if (i % 3 === 0) point[2] = -3;
    if (i % 3 === 1) point[0] = Math.sign(point[0]) * 12;
    if (i % 3 === 2) point[1] = Math.sign(point[1]) * 8;
    return [point[0] + 2, point[1] + 1, point[2]];
  });
}

function writeCloud(name, points) {
  writeFileSync(join(folder, name), Buffer.from(new Float32Array(points.flatMap((p) => [...p, 0])).buffer));
}

// Scans of the room from (0.8, -0.5, 0.1), rotated by 0.4 rad, and from the
// origin.
function writePairs() {
  const target = room();
  const [c, s] = [Math.cos(0.4), Math.sin(0.4)];
  writeCloud('target.bin', target);
  const source = target.map(([x, y, z]) => [x - 0.8, y + 0.5, z - 0.1])
                       .map(([x, y, z]) => [c * x + s * y, -s * x + c * y, z]);
  writeCloud('source.bin', source);
  writeCloud(EVIL.replaceAll('/', '') + '.bin', source);
  const quoted = (text) => `"${text.replaceAll('"', '""')}"`;
  const pose = `0.8,-0.5,0.1,0,0,${Math.sin(0.2)},${Math.cos(0.2)}`;
  const wrong = `5,-0.5,0.1,0,0,${Math.sin(0.2)},${Math.cos(0.2)}`;
  writeFileSync(join(folder, 'pairs.csv'), [
    'set,source,target,tx,ty,tz,qx,qy,qz,qw',
    `even,source.bin,target.bin,${pose}`,
    `${quoted(EVIL)},${quoted(EVIL + '.bin')},target.bin,${pose}`,
    `odd,source.bin,target.bin,${wrong}`,
    `odd,target.bin,target.bin,0,0,0,0,0,0,1`,
  ].join('\n') + '\n');
}

function run(program, args, codes = [0]) {
  const {status, stderr} = spawnSync(join(bin, program), args, {encoding: 'utf8'});
  assert.ok(codes.includes(status), `${program}: exit code ${status}\n${stderr}`);
}

// The stages that each match passes; 102 of 255 is a weight of 0.4.
function checkStages() {
  const stages = {fate: [0, CONSISTENT, CONSISTENT | INLIER, INLIER], weight: [0, 102, 255, 0],
                  counts: {consistent: 2}};
  const roles = (stage) => stages.fate.map((_, i) => roleOf(stages, stage, i).role);
  assert.deepEqual(roles(1), ['all', 'all', 'all', 'all']);
  assert.deepEqual(roles(2), ['rejected', 'kept', 'kept', 'rejected']);
  assert.deepEqual(roles(3), ['gone', 'weighted', 'weighted', 'gone']);
  assert.deepEqual(roles(4), ['gone', 'rejected', 'kept', 'regained']);
  assert.equal(roleOf(stages, 3, 1).weight, 0.4);
}

// The drawn pose aligns the inliers of the page's pair.
function checkPose(page) {
  const json = readFileSync(page, 'utf8').match(/id="view-0">(.*?)<\/script>/s)[1];
  const view = decodeView(JSON.parse(json));
  const {pose, stages} = view.methods[0];
  const farthest = (matrix) => Math.max(...Array.from(stages.fate, (fate, i) => {
    if (!(fate & INLIER)) return 0;
    const [x, y, z] = view.matchedSource.slice(3 * i, 3 * i + 3);
    const m = matrix.elements;  // Column by column.
    return Math.max(...[0, 1, 2].map((axis) => Math.abs(
        m[axis] * x + m[4 + axis] * y + m[8 + axis] * z + m[12 + axis] - view.matchedTarget[3 * i + axis])));
  }));
  assert.ok(farthest(matrixOf(drawnPose(view, pose), 0)) <= 0.11, 'beyond the noise bound');
  assert.ok(farthest(matrixOf(drawnPose(view, null), 0)) > 1);
}

async function lookAtRun(browser) {
  const rowsOf = (table) => browser.evaluate(
      `[...document.querySelectorAll('${table} tbody tr')].map((row) => [...row.cells].map((c) => c.textContent))`);
  await browser.evaluate(`document.querySelectorAll('section').forEach((section) => {
    section.id = section.querySelector('h2').textContent.toLowerCase().replaceAll(' ', '-');
  })`);

  // Text is not interpreted as HTML.
  assert.notEqual(await browser.evaluate('document.title'), 'evil');
  assert.ok((await browser.evaluate('document.body.textContent')).includes(EVIL));
  assert.equal(await browser.evaluate(`document.querySelectorAll('img[src="x"]').length`), 0);

  // The summary has both methods. A click sorts the pairs, a second click
  // reverses the order.
  assert.ok((await rowsOf('#summary')).some(([method]) => method === 'ransac1k'));
  const headers = await browser.evaluate(`[...document.querySelectorAll('#pairs thead th')].map((h) => h.innerText)`);
  const column = headers.findIndex((name) => name.startsWith('t error'));
  const errors = async () => (await rowsOf('#pairs .table')).map((row) => Number(row[column]));
  const click = `document.querySelectorAll('#pairs .table thead button')[${column}].click()`;
  const unsorted = await errors();
  assert.equal(unsorted.length, 8);
  await browser.evaluate(click);
  const ascending = unsorted.toSorted?.((a, b) => a - b) ?? [...unsorted].sort((a, b) => a - b);
  assert.deepEqual(await errors(), ascending);
  assert.notDeepEqual(unsorted, ascending);
  await browser.evaluate(click);
  assert.deepEqual(await errors(), [...ascending].reverse());

  // The failed rows belong to the pair with another true pose.
  await browser.evaluate(`(() => {
    const outcome = document.querySelector('select[aria-label="outcome"]');
    outcome.value = 'failed';
    outcome.dispatchEvent(new Event('change'));
  })()`);
  const failed = await errors();
  assert.equal(failed.length, 2);
  assert.ok(failed.every((error) => error > 2));
  await browser.evaluate(`(() => {
    const outcome = document.querySelector('select[aria-label="outcome"]');
    outcome.value = '';
    outcome.dispatchEvent(new Event('change'));
  })()`);

  // The pointer over a curve shows a value for each method.
  const curve = await browser.box('.curve');
  await browser.mouse('mouseMoved', curve.x + 0.7 * curve.width, curve.y + 0.5 * curve.height);
  await browser.until(`/at [\\d.]+ m: .*quatro [\\d.]+ %.*ransac1k [\\d.]+ %/s.test(
      document.querySelector('.recall .legend').textContent)`);

  // There is no 3D view until a pair is opened, and a pair without a view
  // cannot be opened.
  assert.equal(await browser.evaluate(`document.querySelector('.panel').hidden`), true);
  assert.equal(await browser.evaluate(`document.querySelectorAll('tr.has-view').length`), 6);
  await browser.evaluate(`document.querySelector('#pairs .table tbody tr:not(.has-view)').click()`);
  assert.equal(await browser.evaluate(`document.querySelector('.panel').hidden`), true);
  await browser.evaluate(`[...document.querySelectorAll('tr.has-view')]
      .find((row) => row.textContent.includes('even') && !row.textContent.includes('ransac')).click()`);
  assert.equal(await browser.evaluate(`document.querySelector('.panel').hidden`), false);
}

// The view draws, rotates, and shows each stage and pose differently.
async function lookAtView(browser) {
  // Waits until the view stops moving.
  const still = async () => {
    let last = null;
    for (let i = 0; i < 40; ++i) {
      const picture = await browser.picture('.viewer canvas');
      if (picture === last) return picture;
      last = picture;
    }
    throw new Error('the view never comes to rest');
  };
  const first = await still();
  assert.ok(await browser.countColors(first) > 50, 'the view is blank');

  const {x, y, width, height} = await browser.box('.viewer canvas');
  const middle = {x: x + width / 2, y: y + height / 2};
  await browser.drag(middle, {x: middle.x + 150, y: middle.y + 40});
  assert.ok(await still() !== first, 'dragging does not turn the view');

  await browser.evaluate(`document.querySelector('.viewer canvas').focus()`);
  const pictures = new Map();
  const legends = [];
  for (const stage of ['1', '2', '3', '4']) {
    await browser.key(stage);
    const picture = await still();
    assert.ok(!pictures.has(picture), `stage ${stage} looks like ${pictures.get(picture)}`);
    pictures.set(picture, `stage ${stage}`);
    legends.push(await browser.evaluate(`document.querySelector('.viewer .legend').textContent`));
  }
  assert.match(legends[0], /matches in total/);
  assert.match(legends[1], /kept.*rejected.*in the clique/);
  assert.match(legends[2], /weight 0/);
  assert.match(legends[3], /kept.*inliers of the pose/);
  await browser.key(' ');
  assert.ok(!pictures.has(await still()), 'after looks like before');
  assert.equal(await browser.evaluate(`document.querySelector('[data-pose=after]').ariaPressed`), 'true');
}

async function look(page, ...looks) {
  const begin = Date.now();
  const browser = await Browser.open(chromium, pathToFileURL(page).href);
  try {
    for (const lookAt of looks) await lookAt(browser);
    assert.deepEqual(browser.complaints, []);
  } finally {
    await browser.close();
  }
  console.log(`${page.split('/').pop()}: ${Date.now() - begin} ms`);
}

// Without WebGL everything except the view is shown.
async function lookWithoutWebgl(page) {
  const browser = await Browser.open(chromium, pathToFileURL(page).href, ['--disable-3d-apis']);
  try {
    assert.match(await browser.evaluate(`document.querySelector('.viewer').textContent`), /has no WebGL/);
    assert.match(await browser.evaluate(`document.querySelector('.notes').textContent`), /registered/);
  } finally {
    await browser.close();
  }
}

try {
  writePairs();
  run('quatro_experiment', ['--protocol=pairs', `--pairs=${join(folder, 'pairs.csv')}`, '--preset=indoor',
                            '--methods=quatro,ransac1k', '--report_views=3', `--output=${join(folder, 'run')}`]);
  run('quatro_register', [`--source=${join(folder, 'source.bin')}`, `--target=${join(folder, 'target.bin')}`,
                          '--preset=indoor', `--report=${join(folder, 'pair.html')}`, `--json=${join(folder, 'a.json')}`]);
  checkStages();
  checkPose(join(folder, 'pair.html'));
  await look(join(folder, 'run/report.html'), lookAtRun, lookAtView);
  await look(join(folder, 'pair.html'), lookAtView);
  await lookWithoutWebgl(join(folder, 'pair.html'));
} finally {
  rmSync(folder, {recursive: true, force: true});
}
