// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Recall over the allowed error, with a line per method. The pointer or the
// arrow keys show the value of every method at a position.

import {el, svg} from './dom.js';

const WIDTH = 560;
const HEIGHT = 300;
const LEFT = 44;
const RIGHT = 12;
const TOP = 12;
const BOTTOM = 40;

// Eight colors, then again with dashes, so that lines are distinct without
// colors too.
export function lineStyle(index) {
  return {color: `var(--line-${index % 8})`, dash: ['', '7 3', '2 3'][Math.floor(index / 8) % 3]};
}

function niceStep(range) {
  const power = 10 ** Math.floor(Math.log10(range / 4));
  return [1, 2, 5, 10].map((factor) => factor * power).find((step) => range / step <= 6);
}

// {title, unit, grid: [x], methods: [{name, recall: [%]}], marks: [x]}
export function recallCurve({title, unit, grid, methods, marks}) {
  const last = grid[grid.length - 1];
  const x = (value) => LEFT + (WIDTH - LEFT - RIGHT) * value / last;
  const y = (value) => HEIGHT - BOTTOM - (HEIGHT - TOP - BOTTOM) * value / 100;
  const plot = svg('svg', {viewBox: `0 0 ${WIDTH} ${HEIGHT}`, class: 'curve', tabindex: 0, role: 'img',
                           'aria-label': `${title}: recall over the allowed error`});
  for (let value = 0; value <= 100; value += 20) {
    plot.append(svg('line', {x1: x(0), x2: x(last), y1: y(value), y2: y(value), class: 'grid'}),
                svg('text', {x: LEFT - 6, y: y(value) + 4, class: 'end'}, String(value)));
  }
  const step = niceStep(last);
  for (let value = 0; value <= last + 1e-9; value += step) {
    plot.append(svg('text', {x: x(value), y: HEIGHT - BOTTOM + 16, class: 'middle'},
                    String(Number(value.toPrecision(4)))));
  }
  for (const mark of marks.filter((value) => value <= last)) {
    plot.append(svg('line', {x1: x(mark), x2: x(mark), y1: y(0), y2: y(100), class: 'mark'}));
  }
  plot.append(svg('text', {x: x(last / 2), y: HEIGHT - 4, class: 'middle'}, `allowed ${title} [${unit}]`));
  methods.forEach((method, index) => {
    const points = method.recall.map((value, i) => `${x(grid[i]).toFixed(1)},${y(value).toFixed(1)}`);
    const style = lineStyle(index);
    plot.append(svg('polyline', {points: points.join(' '), class: 'line', stroke: style.color,
                                 'stroke-dasharray': style.dash}));
  });
  const cursor = svg('line', {y1: y(0), y2: y(100), class: 'cursor', visibility: 'hidden'});
  const dots = methods.map((method, index) =>
      svg('circle', {r: 3.5, fill: lineStyle(index).color, visibility: 'hidden'}));
  plot.append(cursor, ...dots);

  const place = el('span', {class: 'place'});
  const values = methods.map(() => el('b'));
  const legend = el('div', {class: 'legend'}, place, methods.map((method, index) => {
    const style = lineStyle(index);
    return el('span', {class: 'item'},
              svg('svg', {width: 26, height: 10}, svg('line', {x1: 1, x2: 25, y1: 5, y2: 5, class: 'line',
                          stroke: style.color, 'stroke-dasharray': style.dash})),
              method.name, ' ', values[index]);
  }));

  let at = grid.length - 1;
  function show(i) {
    at = Math.max(0, Math.min(grid.length - 1, i));
    place.textContent = `at ${Number(grid[at].toFixed(4))} ${unit}: `;
    cursor.setAttribute('x1', x(grid[at]));
    cursor.setAttribute('x2', x(grid[at]));
    cursor.setAttribute('visibility', 'visible');
    methods.forEach((method, index) => {
      values[index].textContent = `${method.recall[at].toFixed(1)} %`;
      dots[index].setAttribute('cx', x(grid[at]));
      dots[index].setAttribute('cy', y(method.recall[at]));
      dots[index].setAttribute('visibility', 'visible');
    });
  }
  plot.addEventListener('pointermove', (event) => {
    const box = plot.getBoundingClientRect();
    const value = ((event.clientX - box.left) / box.width * WIDTH - LEFT) / (WIDTH - LEFT - RIGHT) * last;
    const spacing = last / (grid.length - 1);
    show(Math.round(value / spacing));
  });
  plot.addEventListener('keydown', (event) => {
    if (event.key !== 'ArrowLeft' && event.key !== 'ArrowRight') return;
    show(at + (event.key === 'ArrowLeft' ? -1 : 1));
    event.preventDefault();
  });
  return el('figure', {class: 'recall'}, plot, legend);
}

// Both curves of the table "recall" (experiments/tables/curve_tables.h).
export function recallCurves(table, limits) {
  const of = (prefix) => {
    const rows = table.rows.filter((row) => row[0] === prefix);
    return {
      grid: rows.map((row) => Number(row[1])),
      methods: table.columns.slice(2).map((name, i) => ({name, recall: rows.map((row) => Number(row[i + 2]))})),
    };
  };
  const marks = (key) => [...new Set(limits.map((limit) => limit[key]))];
  return [
    recallCurve({title: 'translation error', unit: 'm', marks: marks('translation_m'), ...of('translation m')}),
    recallCurve({title: 'rotation error', unit: 'deg', marks: marks('rotation_deg'), ...of('rotation deg')}),
  ];
}
