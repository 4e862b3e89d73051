// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Two clouds and the lines between their matched points in 3D. Drawn only after
// a change.

import {BufferAttribute, BufferGeometry, Color, LineBasicMaterial, LineSegments, Matrix4, PerspectiveCamera, Points,
        PointsMaterial, Scene, Vector3, WebGLRenderer} from 'three';
import {OrbitControls} from 'three/addons/controls/OrbitControls.js';

import {color} from './dom.js';

const FEW_POINTS = 8000;  // Drawn larger.
const HEAD_ROOM = 0.2;  // For a source above the target, relative to the radius.

// The central 90 % of each axis: {center, radius}.
function extent(xyz) {
  const bounds = [0, 1, 2].map((axis) => {
    const values = xyz.filter((_, i) => i % 3 === axis).sort();
    const at = (share) => values.length ? values[Math.floor(share * (values.length - 1))] : 0;
    return [at(0.05), at(0.95)];
  });
  const center = new Vector3(...bounds.map(([low, high]) => (low + high) / 2));
  const radius = 0.5 * Math.hypot(...bounds.map(([low, high]) => high - low));
  return {center, radius: Math.max(radius, 1)};
}

// Brightness increases with height, so that the ground is recognizable.
function shades(xyz, base) {
  const heights = xyz.filter((_, i) => i % 3 === 2).sort();
  const low = heights[Math.floor(0.02 * heights.length)] ?? 0;
  const high = heights[Math.floor(0.98 * heights.length)] ?? 1;
  const colors = new Float32Array(xyz.length);
  for (let i = 0; i < xyz.length; i += 3) {
    const height = Math.min(1, Math.max(0, (xyz[i + 2] - low) / Math.max(high - low, 1e-6)));
    const shade = 0.72 + 0.28 * height;
    colors.set([base.r * shade, base.g * shade, base.b * shade], i);
  }
  return colors;
}

export class PairScene {
  constructor(canvas) {
    this.canvas = canvas;
    this.renderer = new WebGLRenderer({canvas, antialias: true, alpha: true});
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.scene = new Scene();
    this.camera = new PerspectiveCamera(40, 1, 0.1, 5000);
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.zoomToCursor = true;
    this.controls.addEventListener('change', () => this.draw());
    const material = () => new PointsMaterial({sizeAttenuation: false, vertexColors: true});
    this.source = new Points(new BufferGeometry(), material());
    this.target = new Points(new BufferGeometry(), material());
    this.lines = new LineSegments(new BufferGeometry(), new LineBasicMaterial(
        {vertexColors: true, transparent: true, depthTest: false}));
    for (const object of [this.source, this.target, this.lines]) {
      object.frustumCulled = false;
      this.scene.add(object);
    }
    this.source.matrixAutoUpdate = false;
    this.pose = new Matrix4();
    new ResizeObserver(() => this.resize()).observe(canvas);
  }

  // `pair` comes from view_data.js.
  setPair(pair) {
    this.pair = pair;
    this.extent = extent(pair.target.xyz);
    for (const [object, cloud] of [[this.source, pair.source], [this.target, pair.target]]) {
      object.geometry.dispose();
      object.geometry = new BufferGeometry();
      object.geometry.setAttribute('position', new BufferAttribute(cloud.xyz, 3));
      object.material.size = cloud.xyz.length < 3 * FEW_POINTS ? 2.6 : 1.8;
    }
    this.recolor();
    this.look('aslant');
  }

  recolor() {
    for (const [object, cloud, name] of [[this.source, this.pair.source, '--source'],
                                         [this.target, this.pair.target, '--target']]) {
      object.geometry.setAttribute('color', new BufferAttribute(shades(cloud.xyz, new Color(color(name))), 3));
    }
  }

  // `from` is the viewpoint: 'aslant' or 'above'.
  look(from) {
    const {center, radius} = this.extent;
    const direction = from === 'above' ? new Vector3(0, -0.001, 1) : new Vector3(-0.55, -0.75, 0.62).normalize();
    this.controls.target.copy(center);
    this.controls.target.z += HEAD_ROOM * radius;
    this.camera.position.copy(this.controls.target).addScaledVector(direction, 2.9 * radius);
    this.controls.update();
    this.draw();
  }

  // The lines: matches by number, each with a color and an opacity.
  setMatches(matches) {
    this.matches = matches;
    const positions = new BufferAttribute(new Float32Array(6 * matches.length), 3);
    const colors = new Float32Array(8 * matches.length);
    matches.forEach(({color: {r, g, b}, opacity}, k) => colors.set([r, g, b, opacity, r, g, b, opacity], 8 * k));
    this.lines.geometry.dispose();
    this.lines.geometry = new BufferGeometry();
    this.lines.geometry.setAttribute('position', positions);
    this.lines.geometry.setAttribute('color', new BufferAttribute(colors, 4));
    this.moveLines();
  }

  // `pose` is a Matrix4 for the source, including the lift of the view.
  setPose(pose) {
    this.pose.copy(pose);
    this.source.matrix.copy(pose);
    this.source.matrixWorldNeedsUpdate = true;
    this.moveLines();
  }

  moveLines() {
    if (!this.matches) return;
    const position = this.lines.geometry.getAttribute('position');
    const point = new Vector3();
    const {matchedSource, matchedTarget} = this.pair;
    this.matches.forEach(({index}, k) => {
      point.fromArray(matchedSource, 3 * index).applyMatrix4(this.pose);
      position.setXYZ(2 * k, point.x, point.y, point.z);
      point.fromArray(matchedTarget, 3 * index);
      position.setXYZ(2 * k + 1, point.x, point.y, point.z);
    });
    position.needsUpdate = true;
    this.draw();
  }

  resize() {
    const {clientWidth, clientHeight} = this.canvas;
    if (clientWidth === 0 || clientHeight === 0) return;
    this.renderer.setSize(clientWidth, clientHeight, false);
    this.camera.aspect = clientWidth / clientHeight;
    this.camera.updateProjectionMatrix();
    this.draw();
  }

  draw() {
    if (this.isWaiting) return;
    this.isWaiting = true;
    requestAnimationFrame(() => {
      this.isWaiting = false;
      this.renderer.render(this.scene, this.camera);
    });
  }
}
