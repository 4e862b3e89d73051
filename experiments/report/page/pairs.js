// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// A row per pair and method, which can be sorted, filtered, and opened in 3D.

import {el} from './dom.js';
import {fixed} from './numbers.js';
import {sortableTable} from './sortable_table.js';

// Rows as objects; `succeeded` is null if there is no true pose.
export function pairRows(data) {
  const limit = data.limits[0];
  return data.pairs.rows.map((cells) => {
    const row = Object.fromEntries(data.pairs.columns.map((name, i) => [name, cells[i]]));
    row.hasTruth = row.distance_m !== null;
    row.succeeded = !row.hasTruth || !limit ? null
        : row.t_m !== null && row.t_m <= limit.translation_m && row.r_deg <= limit.rotation_deg;
    const isApart = !row.hasTruth && row.is_truth_known;
    row.isWrong = row.status === 'registered' && (row.succeeded === false || isApart);
    return row;
  });
}

function select(name, values, onchange) {
  const element = el('select', {'aria-label': name, onchange},
                     el('option', {value: ''}, `any ${name}`),
                     values.map((value) => el('option', {value}, value)));
  return element;
}

const distinct = (rows, key) => [...new Set(rows.map((row) => row[key]))];

function columnsOf(rows, hasView) {
  const number = (name, key, digits, title) =>
      ({name, title, isNumber: true, value: (row) => row[key], text: (row) => fixed(row[key], digits)});
  const text = (name, key) => ({name, value: (row) => row[key]});
  const columns = [
    {name: '3D', title: 'has a 3D view', value: (row) => hasView(row) ? 0 : 1,
     text: (row) => hasView(row) ? '◆' : ' '},
    text('pair', 'pair'), text('set', 'set'), text('bin', 'bin'), text('method', 'method'), text('status', 'status'),
    number('t error\nm', 't_m', 3), number('r error\ndeg', 'r_deg', 2),
    number('distance\nm', 'distance_m', 1, 'translation of the true pose'),
    number('probability', 'probability', 2, 'that the pose is correct, by the verdict'),
    number('matches', 'matches', 0), number('clique', 'consistent', 0), number('inliers', 'inliers', 0),
    number('total\nms', 'ms', 1),
  ];
  const key = {set: 'set', bin: 'bin', method: 'method'};
  return columns.filter(({name}) => !key[name] || distinct(rows, key[name]).length > 1);
}

// open(row) is called for a row with a view; hasView(row) returns whether a row
// has one.
export function pairTable(rows, hasView, open) {
  const table = sortableTable(columnsOf(rows, hasView), rows, {
    onopen: (row) => { if (hasView(row)) open(row); },
    mark: (row) => [hasView(row) ? 'has-view' : '', row.isWrong ? 'wrong' : row.succeeded === false ? 'failed' : '',
                    row.isOpen ? 'open' : ''].join(' '),
  });
  const shown = el('span', {class: 'shown'});
  const name = el('input', {type: 'search', placeholder: 'pair', 'aria-label': 'name of the pair', oninput: refilter});
  const outcome = el('select', {'aria-label': 'outcome', onchange: refilter},
                     [['', 'all outcomes'], ['failed', 'failed'], ['wrong', 'false registration'],
                      ['succeeded', 'succeeded'], ['view', 'with a 3D view']]
                         .map(([value, text]) => el('option', {value}, text)));
  const choices = ['method', 'set', 'bin', 'status']
      .map((key) => [key, distinct(rows, key)])
      .filter(([, values]) => values.length > 1)
      .map(([key, values]) => ({key, element: select(key, values, refilter)}));

  function refilter() {
    const wanted = {
      '': () => true, failed: (row) => row.succeeded === false, wrong: (row) => row.isWrong,
      succeeded: (row) => row.succeeded === true, view: hasView,
    }[outcome.value];
    table.filter((row) => wanted(row) && row.pair.toLowerCase().includes(name.value.toLowerCase()) &&
                 choices.every(({key, element}) => element.value === '' || row[key] === element.value));
    tell();
  }

  function tell() {
    shown.textContent = `${table.rows().length} of ${rows.length} rows`;
  }

  tell();
  return {
    element: el('div', {}, el('div', {class: 'filters'}, name, outcome, choices.map(({element}) => element), shown),
                table.element),
    rows: table.rows,
    refresh: table.refresh,
  };
}
