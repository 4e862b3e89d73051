// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// One pair in 3D with buttons and keys: before and after, stage by stage.

import {Color} from 'three';

import {color, el} from './dom.js';
import {STAGES, hasStage, roleOf} from './match_stages.js';
import {Motion, matrixOf} from './motion.js';
import {count, percent} from './numbers.js';
import {PairScene} from './scene.js';
import {onTheme} from './theme.js';
import {drawnPose} from './view_data.js';

const LIFT = 0.45;  // Of the source above the target, relative to the radius.

const ROLES = {
  all: {color: '--match', opacity: 0.5, text: 'match'},
  kept: {color: '--kept', opacity: 0.8, text: 'kept'},
  regained: {color: '--regained', opacity: 0.9, text: 'regained: inlier of the pose, not in the clique'},
  rejected: {color: '--rejected', opacity: 0.22, text: 'rejected here'},
};

export class Viewer {
  constructor() {
    this.canvas = el('canvas', {tabindex: 0, 'aria-label': '3D view of the pair; drag to rotate'});
    this.state = {pose: 'before', stage: 1, lifted: true, rejected: true};
    this.poseButtons = ['before', 'after', 'truth'].map((name) =>
        el('button', {'data-pose': name, onclick: () => this.set({pose: name})}, name));
    this.stageButtons = STAGES.map(({key, name}) =>
        el('button', {'data-stage': key, onclick: () => this.set({stage: key})}, `${key} ${name}`));
    const box = (name, text) => {
      const input = el('input', {type: 'checkbox', onchange: () => this.set({[name]: input.checked})});
      return el('label', {title: name}, input, text);
    };
    this.boxes = {lifted: box('lifted', 'lift the source'), rejected: box('rejected', 'show rejected')};
    this.legend = el('div', {class: 'legend'});
    this.element = el('div', {class: 'viewer'},
        el('div', {class: 'buttons'},
           el('span', {class: 'group'}, this.poseButtons),
           el('span', {class: 'group'}, this.stageButtons),
           el('span', {class: 'group'}, el('button', {onclick: () => this.scene.look('oblique')}, 'aslant'),
              el('button', {onclick: () => this.scene.look('above')}, 'top')),
           this.boxes.lifted, this.boxes.rejected),
        this.canvas, this.legend,
        el('p', {class: 'keys'}, 'Drag to rotate, wheel to zoom, right button to pan. Keys: 1–4 stages, space before ' +
           'or after, L lift, R rejected, T top view.'));
    this.element.addEventListener('keydown', (event) => this.key(event));
    onTheme(() => this.scene && (this.scene.recolor(), this.showMatches()));
  }

  // `pair` comes from view_data.js, `method` is one of its methods.
  open(pair, method) {
    const isOther = this.pair !== pair;
    this.pair = pair;
    this.method = method;
    if (!this.scene && !this.start()) return;
    if (isOther) {
      this.scene.matches = null;
      this.scene.setPair(pair);
      this.state = {...this.state, pose: 'before', stage: 1, lifted: true};
    }
    if (!this.hasPose(this.state.pose)) this.state.pose = 'before';
    if (!hasStage(method.stages, this.state.stage)) this.state.stage = 1;
    this.update();
    this.motion.jump(this.matrix());
  }

  // Returns whether a 3D view is available.
  start() {
    try {
      this.scene = new PairScene(this.canvas);
    } catch {
      this.element.replaceChildren(el('p', {class: 'note'}, 'This browser has no WebGL, so there is no 3D view.'));
      return false;
    }
    this.motion = new Motion((matrix) => this.scene.setPose(matrix));
    return true;
  }

  hasPose(name) {
    if (name === 'truth') return this.pair.truth !== null;
    return name === 'before' || this.method.pose !== null;
  }

  matrix() {
    const pose = {before: null, after: this.method.pose, truth: this.pair.truth}[this.state.pose];
    const lift = this.state.lifted ? LIFT * this.scene.extent.radius : 0;
    return matrixOf(drawnPose(this.pair, pose), lift);
  }

  set(change) {
    if (change.pose && !this.hasPose(change.pose)) return;
    if (change.stage && !hasStage(this.method.stages, change.stage)) return;
    Object.assign(this.state, change);
    this.update();
    if ('pose' in change || 'lifted' in change) this.motion.glide(this.matrix());
  }

  key(event) {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    const {pose, lifted, rejected} = this.state;
    if (/^[1-4]$/.test(event.key)) this.set({stage: Number(event.key)});
    else if (event.key === ' ') this.set({pose: pose === 'before' ? 'after' : 'before'});
    else if (event.key === 'l') this.set({lifted: !lifted});
    else if (event.key === 'r') this.set({rejected: !rejected});
    else if (event.key === 't') this.scene.look('above');
    else return;
    event.preventDefault();
  }

  update() {
    for (const button of this.poseButtons) {
      button.disabled = !this.hasPose(button.dataset.pose);
      button.setAttribute('aria-pressed', button.dataset.pose === this.state.pose);
    }
    for (const button of this.stageButtons) {
      const stage = Number(button.dataset.stage);
      button.disabled = !hasStage(this.method.stages, stage);
      button.setAttribute('aria-pressed', stage === this.state.stage && this.method.stages !== null);
    }
    for (const [name, label] of Object.entries(this.boxes)) label.firstChild.checked = this.state[name];
    this.showMatches();
  }

  showMatches() {
    const {stages} = this.method;
    const matches = [];
    const drawn = new Set();
    if (stages) {
      const colors = Object.fromEntries(Object.entries(ROLES).map(([role, style]) =>
          [role, new Color(color(style.color))]));
      for (let i = 0; i < stages.fate.length; ++i) {
        const {role, weight} = roleOf(stages, this.state.stage, i);
        if (role === 'gone' || (role === 'rejected' && !this.state.rejected)) continue;
        drawn.add(role);
        matches.push(role === 'weighted'
            ? {index: i, opacity: 0.15 + 0.7 * weight, color: colors.rejected.clone().lerp(colors.kept, weight)}
            : {index: i, opacity: ROLES[role].opacity, color: colors[role]});
      }
    }
    this.scene.setMatches(matches);
    this.showLegend(drawn, matches.length);
  }

  showLegend(drawn, numDrawn) {
    const {stages} = this.method;
    const swatch = (name, text) =>
        el('span', {class: 'item'}, el('i', {style: `background: var(${name})`}), text);
    const items = [swatch('--source', `source, ${count(this.pair.source.points)} voxels`),
                   swatch('--target', `target, ${count(this.pair.target.points)} voxels`)];
    for (const [role, style] of Object.entries(ROLES)) {
      if (drawn.has(role)) items.push(swatch(style.color, style.text));
    }
    if (drawn.has('weighted')) {
      items.push(el('span', {class: 'item'}, 'weight 0 ', el('i', {class: 'ramp'}), ' 1'));
    }
    if (stages) {
      const {count: name} = STAGES[this.state.stage - 1];
      const number = stages.counts[name];
      const right = stages.right ? `, ${percent(stages.right[name], number)} correct` : '';
      const what = {weighted: 'with weight 0.5 or more', consistent: 'in the clique', matches: 'matches in total',
                    inliers: 'inliers of the pose'}[name];
      items.push(el('strong', {}, `${count(number)} ${what}${right}`), ` (${count(numDrawn)} lines)`);
    } else {
      items.push('This method has no matches, or other matches than the first method.');
    }
    this.legend.replaceChildren(...items);
  }
}
