// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// A table that is sorted by clicking a column name: numbers by value, empty
// cells last in either direction. Long tables are shown in parts.

import {el} from './dom.js';

const PART = 200;

function compare(a, b) {
  if (typeof a === 'number' && typeof b === 'number') return a - b;
  return String(a).localeCompare(String(b), 'en', {numeric: true});
}

function isEmpty(value) {
  return value === null || value === undefined || value === '' || Number.isNaN(value);
}

// columns: {name, value(row) to sort by, text(row) or node(row) to show,
//           isNumber, title}
// onopen(row) makes the rows clickable; mark(row) returns their class.
export function sortableTable(columns, allRows, {onopen, mark, caption} = {}) {
  let rows = allRows.slice();
  let sortedBy = null;
  let direction = 1;
  let numShown = PART;
  const body = el('tbody');
  const more = el('button', {class: 'more', onclick: () => { numShown += 5 * PART; show(); }});
  const heads = columns.map((column) => {
    const button = el('button', {title: column.title, onclick: () => sortBy(column)}, column.name);
    return el('th', {scope: 'col', class: column.isNumber ? 'number' : null}, button);
  });

  function cell(column, row) {
    const content = column.node ? column.node(row) : (column.text ? column.text(row) : column.value(row));
    return el('td', {class: column.isNumber ? 'number' : null}, isEmpty(content) ? '–' : content);
  }

  function line(row) {
    const attributes = {class: mark ? mark(row) : null};
    if (onopen) {
      attributes.tabindex = 0;
      attributes.onclick = () => onopen(row);
      attributes.onkeydown = (event) => { if (event.key === 'Enter') onopen(row); };
    }
    return el('tr', attributes, columns.map((column) => cell(column, row)));
  }

  function show() {
    body.replaceChildren(...rows.slice(0, numShown).map(line));
    more.hidden = rows.length <= numShown;
    more.textContent = `show more (${numShown} of ${rows.length})`;
  }

  function sort() {
    if (!sortedBy) return;
    rows.sort((a, b) => {
      const [x, y] = [sortedBy.value(a), sortedBy.value(b)];
      if (isEmpty(x) || isEmpty(y)) return isEmpty(x) - isEmpty(y);
      return direction * compare(x, y);
    });
  }

  function sortBy(column) {
    direction = sortedBy === column ? -direction : 1;
    sortedBy = column;
    heads.forEach((head, i) => {
      if (columns[i] === column) {
        head.setAttribute('aria-sort', direction > 0 ? 'ascending' : 'descending');
      } else {
        head.removeAttribute('aria-sort');
      }
    });
    sort();
    show();
  }

  show();
  const table = el('table', {}, caption ? el('caption', {}, caption) : null,
                   el('thead', {}, el('tr', {}, heads)), body);
  const element = el('div', {class: 'table'}, table, more);
  return {
    element,
    // The rows in the current order.
    rows: () => rows,
    // Shows the rows for which keep(row) is true.
    filter(keep) {
      rows = allRows.filter(keep);
      numShown = PART;
      sort();
      show();
    },
    refresh: show,
  };
}
