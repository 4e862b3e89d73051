// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Builds the page from its data.

import {recallCurves} from './curves.js';
import {el} from './dom.js';
import {bytes} from './numbers.js';
import {PairPanel} from './pair_panel.js';
import {pairRows, pairTable} from './pairs.js';
import {mainSummary, runTable} from './run_tables.js';
import {followSystem, switchTheme} from './theme.js';

const MAX_OPEN_FLAGS = 16;

function section(title, ...content) {
  return el('section', {}, el('h2', {}, title), content);
}

function header(data) {
  const {version, commit, compiler, start_time, seed, machine, data: scans} = data.manifest;
  const parts = [`quatro ${version}`, `commit ${commit}`, compiler, `seed ${seed}`, start_time,
                 `${machine.cpu}, ${machine.cores} cores`];
  if (scans && scans.files > 0) {
    parts.push(`${scans.files} scans, ${bytes(scans.bytes)}, checksum ${scans.checksum}`);
  }
  const flags = Object.entries({...data.manifest.flags, ...data.manifest.other_flags})
      .filter(([, value]) => value !== '');
  const theme = el('button', {class: 'theme', title: 'Switch between light and dark', onclick: switchTheme}, '◐');
  return el('header', {}, theme, el('h1', {}, data.title), el('p', {class: 'facts'}, parts.join(' · ')),
            el('details', {class: 'flags', open: flags.length <= MAX_OPEN_FLAGS}, el('summary', {}, 'parameters'),
               flags.map(([name, value]) => el('code', {}, `${name}=${value}`))),
            data.notes.map((note) => el('p', {class: 'note'}, note)));
}

function tables(data) {
  const table = (name) => data.tables.find((candidate) => candidate.name === name);
  const parts = [];
  if (table('summary')) parts.push(section('Summary', mainSummary(table('summary')),
      el('p', {class: 'hint'}, 'Small numbers: 95 % intervals (Wilson for shares, bootstrap for averages and medians).')));
  if (table('recall')) {
    parts.push(section('Recall', el('div', {class: 'pair-of-figures'}, recallCurves(table('recall'), data.limits))));
  }
  const others = data.tables.filter(({name, rows}) => !['recall', 'tilt'].includes(name) && rows.length > 0);
  if (others.length > 0) {
    parts.push(section('More tables', others.map((other) =>
        el('details', {}, el('summary', {}, other.caption), runTable(other)))));
  }
  return parts;
}

function figures(data) {
  if (data.figures.length === 0) return null;
  return section('Figures', el('div', {class: 'pair-of-figures'}, data.figures.map(({name, png}) =>
      el('figure', {}, el('img', {src: `data:image/png;base64,${png}`, alt: name, loading: 'lazy'}),
         el('figcaption', {}, name)))));
}

function pairs(data) {
  const rows = pairRows(data);
  const hasView = (row) => Object.hasOwn(data.views, row.pair);
  const rowOf = new Map(rows.map((row) => [JSON.stringify([row.pair, row.method]), row]));
  let opened = null;
  const panel = new PairPanel((pair, method) => rowOf.get(JSON.stringify([pair, method])), open);
  const table = pairTable(rows, hasView, (row) => {
    open(row);
    panel.element.scrollIntoView({block: 'start', behavior: 'smooth'});
  });

  function open(row) {
    if (opened) opened.isOpen = false;
    opened = row;
    row.isOpen = true;
    panel.open(row, data.views[row.pair]);
    table.refresh();
  }

  const isAlone = Object.keys(data.views).length === 1 && rows.length <= 1;
  const hint = Object.keys(data.views).length === 0 ? 'No pair has a 3D view.'
      : 'Click a pair marked ◆ to open it in 3D. Click a column name to sort.';
  const element = section(isAlone ? 'Pair' : 'Pairs', panel.element, isAlone ? '' : [el('p', {class: 'hint'}, hint), table.element]);
  return {element, openFirst: () => { if (isAlone) open(rows[0]); }};
}

followSystem();
const data = JSON.parse(document.getElementById('data').textContent);
const pairSection = pairs(data);
document.body.append(header(data), el('main', {}, tables(data), pairSection.element, figures(data) ?? ''));
pairSection.openFirst();
document.documentElement.dataset.ready = 'true';
