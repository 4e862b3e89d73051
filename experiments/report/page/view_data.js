// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Decodes the data of a pair from experiments/report/pair_view.h. Everything is
// drawn relative to the target's origin, so that map coordinates keep their
// digits in single precision.

function decodeBytes(base64) {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return bytes;
}

// Three columns of int16, times the step [m], without the origin.
function decodePoints(base64, step) {
  const bytes = decodeBytes(base64);
  const view = new DataView(bytes.buffer);
  const points = new Float32Array(bytes.length / 2);
  for (let i = 0; i < points.length; ++i) points[i] = step * view.getInt16(2 * i, true);
  return points;
}

function decodeStages(stages) {
  if (!stages) return null;
  return {
    ...stages,
    fate: decodeBytes(stages.fate),
    weight: stages.weight === null ? null : decodeBytes(stages.weight),
  };
}

export const CONSISTENT = 1;  // Bits of a match's fate.
export const INLIER = 2;

export function decodeView(view) {
  return {
    ...view,
    source: {...view.source, xyz: decodePoints(view.source.xyz, view.source.step)},
    target: {...view.target, xyz: decodePoints(view.target.xyz, view.target.step)},
    matchedSource: decodePoints(view.matches.source, view.source.step),
    matchedTarget: decodePoints(view.matches.target, view.target.step),
    methods: view.methods.map((method) => ({...method, stages: decodeStages(method.stages)})),
  };
}

const IDENTITY = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]];

// The pose from source points without their origin to target points without
// theirs, as 3 x 4 rows. Without a pose, the clouds stay as scanned.
export function drawnPose(view, pose) {
  const rows = pose ?? IDENTITY;
  return [0, 1, 2].map((i) => {
    const moved = rows[i][3] - view.target.origin[i];
    const origin = view.source.origin;
    return [...rows[i].slice(0, 3),
            rows[i][0] * origin[0] + rows[i][1] * origin[1] + rows[i][2] * origin[2] + moved];
  });
}
