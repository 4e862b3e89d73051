// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Bundles page/ and three.js into one file without data; report_page.h fills in
// the data.
//   node build_template.mjs OUTPUT

import {build} from 'esbuild';
import {readFileSync, writeFileSync} from 'node:fs';
import {dirname, join} from 'node:path';
import {fileURLToPath} from 'node:url';

const page = join(dirname(fileURLToPath(import.meta.url)), 'page');

async function bundle(name) {
  const result = await build({
    entryPoints: [join(page, name)],
    bundle: true,
    minify: true,
    write: false,
    format: 'iife',
    target: 'es2022',
    charset: 'utf8',
    legalComments: 'inline',
    logLevel: 'warning',
  });
  return result.outputFiles[0].text;
}

// A function as replacement, because "$&" in a replacement string would be
// interpreted.
let text = readFileSync(join(page, 'report.html'), 'utf8');
for (const [mark, name] of [['@@QUATRO_STYLE@@', 'report.css'], ['@@QUATRO_SCRIPT@@', 'main.js']]) {
  const content = await bundle(name);
  text = text.replace(mark, () => content);
}
writeFileSync(process.argv[2], text);
