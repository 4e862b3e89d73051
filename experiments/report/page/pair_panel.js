// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The open pair: its 3D view, and the result of each method. The data of a pair
// is decoded when it is opened.

import {el} from './dom.js';
import {count, fixed, percent} from './numbers.js';
import {sortableTable} from './sortable_table.js';
import {decodeView} from './view_data.js';
import {Viewer} from './viewer.js';
import {STAGES, hasStage} from './match_stages.js';

function readView(index) {
  return decodeView(JSON.parse(document.getElementById(`view-${index}`).textContent));
}

function matrixText(rows) {
  return rows.map((row) => row.map((value) => value.toFixed(4).padStart(11)).join('')).join('\n');
}

function facts(row, view, method) {
  const list = [['source', view.files[0]], ['target', view.files[1]], ['verdict', row.status], ['reason', method.reason]];
  if (row.probability !== null) list.push(['probability of a correct pose', fixed(row.probability, 3)]);
  if (row.t_m !== null) list.push(['error', `${fixed(row.t_m, 3)} m, ${fixed(row.r_deg, 2)} deg`]);
  if (row.distance_m !== null) list.push(['true distance', `${fixed(row.distance_m, 2)} m`]);
  if (row.ms !== null) list.push(['time', `${fixed(row.ms, 1)} ms`]);
  return el('dl', {}, list.map(([name, text]) => [el('dt', {}, name), el('dd', {}, text)]));
}

function stageTable(stages) {
  const {counts, right} = stages;
  const number = (text) => el('td', {class: 'number'}, text);
  const rows = STAGES.filter(({key}) => hasStage(stages, key)).map(({name, count: key}) =>
      el('tr', {}, el('td', {}, name), number(count(counts[key])),
         right ? number(percent(right[key], counts[key])) : null));
  const heads = ['stage', 'matches', ...(right ? ['correct'] : [])];
  return el('table', {class: 'plain'}, el('thead', {}, el('tr', {}, heads.map((name) => el('th', {}, name)))),
            el('tbody', {}, rows));
}

// Shows [name, value] entries as a table of two columns.
function valueTable(title, entries) {
  if (entries.length === 0) return null;
  return el('details', {}, el('summary', {}, title), sortableTable(
      [{name: 'name', value: (row) => row[0]},
       {name: 'value', isNumber: true, value: (row) => row[1],
        text: (row) => typeof row[1] === 'number' ? String(Number(row[1].toPrecision(5))) : row[1]}],
      entries).element);
}

// Why this pose: what the search found, the best first.
function candidateTable(method) {
  if (method.candidates.length === 0) return null;
  const number = (name, key, digits, title) => ({
    name, title, isNumber: true, value: (row) => row[key],
    text: (row) => row[key] === null ? '' : fixed(row[key], digits),
  });
  return el('details', {open: method.rung > 0},
            el('summary', {}, `candidates of the search (the answer is from rung ${method.rung})`),
            sortableTable(
                [{name: 'from', value: (row) => row.origin},
                 number('score', 'score', 2, 'overlap, lowered by contradicted structure, times the surprise of the matches'),
                 number('overlap', 'overlap', 2, 'share of the structure that overlaps'),
                 number('contradicted', 'contradicted', 2, 'share of structure in the free space of the other scan'),
                 number('log ratio', 'likelihood', 1, 'how much better than chance its matches are explained'),
                 number('shift [m]', 'shift_m', 2, 'from the answer'),
                 number('turn [deg]', 'turn_deg', 1, 'from the answer')],
                method.candidates).element);
}

export class PairPanel {
  // rowOf(pair, method) returns the row in the table of pairs.
  constructor(rowOf, onopen) {
    this.rowOf = rowOf;
    this.onopen = onopen;
    this.viewer = new Viewer();
    this.title = el('h3');
    this.methods = el('span', {class: 'group'});
    this.notes = el('div', {class: 'notes'});
    this.element = el('div', {class: 'panel', hidden: true},
                      el('div', {class: 'head'}, this.title, this.methods),
                      el('div', {class: 'columns'}, this.viewer.element, this.notes));
  }

  open(row, viewIndex) {
    this.element.hidden = false;
    if (this.viewIndex !== viewIndex) this.view = readView(viewIndex);
    this.viewIndex = viewIndex;
    const method = this.view.methods.find(({name}) => name === row.method);
    this.title.textContent = row.pair;
    this.methods.replaceChildren(...this.view.methods.map(({name}) =>
        el('button', {'aria-pressed': String(name === row.method),
                      onclick: () => this.onopen(this.rowOf(row.pair, name))}, name)));
    this.methods.hidden = this.view.methods.length < 2;
    this.viewer.open(this.view, method);
    this.notes.replaceChildren(
        facts(row, this.view, method),
        method.stages ? stageTable(method.stages) : '',
        method.pose ? el('details', {open: true}, el('summary', {}, 'target from source'),
                         el('pre', {}, matrixText(method.pose))) : '',
        candidateTable(method) ?? '',
        valueTable('times [ms]', row.stages ?? []) ?? '',
        valueTable('features of the probability', Object.entries(method.features)) ?? '',
        valueTable('notes by stage', method.notes) ?? '');
  }
}
