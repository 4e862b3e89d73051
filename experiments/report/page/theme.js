// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Light or dark, as in the system settings until the reader switches.

const root = document.documentElement;
const system = matchMedia('(prefers-color-scheme: dark)');
const callbacks = [];

function apply(theme) {
  root.dataset.theme = theme;
  callbacks.forEach((callback) => callback());
}

export function followSystem() {
  const follow = () => apply(system.matches ? 'dark' : 'light');
  system.addEventListener('change', follow);
  follow();
}

export function switchTheme() {
  apply(root.dataset.theme === 'dark' ? 'light' : 'dark');
}

export function onTheme(callback) {
  callbacks.push(callback);
}
