// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The tables of a run (experiments/tables/run_tables.h). "x", "x low" and "x
// high" become one column, "x" with its 95 % interval.

import {el} from './dom.js';
import {sortableTable} from './sortable_table.js';

// Converts text that is a number to a number.
function parse(text) {
  return text !== '' && Number.isFinite(Number(text)) ? Number(text) : text;
}

// Splits "success % / 2 m 10 deg" into two lines.
function shortName(name) {
  return name.replace(' / ', '\n');
}

function columnsOf(table) {
  const columns = [];
  for (let i = 0; i < table.columns.length; ++i) {
    const name = table.columns[i];
    if (table.rows.every((row) => row[i] === '')) continue;
    const hasInterval = table.columns[i + 1] === `${name} low` && table.columns[i + 2] === `${name} high`;
    const at = i;
    columns.push({
      name: shortName(name),
      value: (row) => parse(row[at]),
      isNumber: table.rows.some((row) => typeof parse(row[at]) === 'number'),
      node: hasInterval ? (row) => withInterval(row, at) : null,
    });
    if (hasInterval) i += 2;
  }
  return columns;
}

function withInterval(row, at) {
  if (row[at] === '') return '';
  if (row[at + 1] === '') return row[at];
  return el('span', {}, row[at], el('small', {class: 'interval'}, ` ${row[at + 1]}–${row[at + 2]}`));
}

export function runTable(table) {
  return sortableTable(columnsOf(table), table.rows).element;
}

// The main columns of the table "summary", with one row per method over all
// sets.
export function mainSummary(table) {
  const set = table.columns.indexOf('set');
  const hasAll = table.rows.some((row) => row[set] === 'all');
  const isWanted = (name) => /^(method|pairs|answers|registered|false registrations)$/.test(name) ||
      /^success % |^successes \/ (t|r) median/.test(name);
  const kept = table.columns.map((name, i) => i)
      .filter((i) => isWanted(table.columns[i].replace(/ (low|high)$/, '')));
  return runTable({
    columns: kept.map((i) => table.columns[i]),
    rows: table.rows.filter((row) => !hasAll || row[set] === 'all').map((row) => kept.map((i) => row[i])),
  });
}
