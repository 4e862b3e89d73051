// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Animates the motion from one pose to another, with the shorter rotation.

import {Matrix4, Quaternion, Vector3} from 'three';

const DURATION_MS = 600;

export function matrixOf(rows, lift) {
  return new Matrix4().set(...rows[0], ...rows[1], rows[2][0], rows[2][1], rows[2][2], rows[2][3] + lift, 0, 0, 0, 1);
}

export class Motion {
  // apply(matrix) is called with each intermediate pose and the last one.
  constructor(apply) {
    this.apply = apply;
    this.now = new Matrix4();
  }

  jump(matrix) {
    cancelAnimationFrame(this.frame);
    this.now.copy(matrix);
    this.apply(this.now);
  }

  glide(matrix) {
    if (matchMedia('(prefers-reduced-motion: reduce)').matches) {
      this.jump(matrix);
      return;
    }
    cancelAnimationFrame(this.frame);
    const [from, to] = [this.now, matrix].map((pose) => {
      const parts = {place: new Vector3(), turn: new Quaternion(), scale: new Vector3()};
      pose.decompose(parts.place, parts.turn, parts.scale);
      return parts;
    });
    const start = performance.now();
    const step = (time) => {
      const share = Math.min(1, Math.max(0, (time - start) / DURATION_MS));
      const eased = share * share * (3 - 2 * share);
      if (share === 1) {
        this.now.copy(matrix);
      } else {
        this.now.compose(from.place.clone().lerp(to.place, eased), from.turn.clone().slerp(to.turn, eased),
                         from.scale.clone().lerp(to.scale, eased));
        this.frame = requestAnimationFrame(step);
      }
      this.apply(this.now);
    };
    this.frame = requestAnimationFrame(step);
  }
}
