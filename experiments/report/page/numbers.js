// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Formats numbers for people.

export function fixed(value, digits) {
  return value === null || value === undefined ? '–' : value.toFixed(digits);
}

export function count(value) {
  return value === null || value === undefined ? '–' : value.toLocaleString('en');
}

export function percent(part, whole) {
  return whole > 0 ? `${(100 * part / whole).toFixed(1)} %` : '–';
}

export function bytes(value) {
  if (value >= 1e9) return `${(value / 1e9).toFixed(2)} GB`;
  return value >= 1e6 ? `${(value / 1e6).toFixed(1)} MB` : `${Math.round(value / 1e3)} kB`;
}
