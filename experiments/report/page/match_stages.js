// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// What becomes of a match, stage by stage:
//
//   1  all          every match
//   2  clique       kept: in the consistent set
//   3  GNC          of these, by the weight that the rotation gave them
//   4  translation  kept: agrees with the pose; regained: agrees, though the
//                   clique had left it out

import {INLIER, CONSISTENT} from './view_data.js';

export const STAGES = [
  {key: 1, name: 'all matches', count: 'matches'},
  {key: 2, name: 'after the clique', count: 'consistent'},
  {key: 3, name: 'after GNC, by weight', count: 'weighted'},
  {key: 4, name: 'after translation', count: 'inliers'},
];

// Whether the method has such a stage.
export function hasStage(stages, stage) {
  if (!stages) return false;
  if (stage === 2) return stages.counts.consistent > 0;
  if (stage === 3) return stages.weight !== null;
  return true;
}

// {role, weight} of match i: 'all', 'kept', 'regained', 'rejected' (at this
// stage), 'gone' (before it).
export function roleOf(stages, stage, i) {
  const isConsistent = (stages.fate[i] & CONSISTENT) !== 0;
  const isAgreeing = (stages.fate[i] & INLIER) !== 0;
  switch (stage) {
    case 1:
      return {role: 'all', weight: 1};
    case 2:
      return {role: isConsistent ? 'kept' : 'rejected', weight: 1};
    case 3:
      return {role: isConsistent ? 'weighted' : 'gone', weight: stages.weight[i] / 255};
    default:
      if (isAgreeing) return {role: isConsistent || !hasStage(stages, 2) ? 'kept' : 'regained', weight: 1};
      return {role: isConsistent || !hasStage(stages, 2) ? 'rejected' : 'gone', weight: 1};
  }
}
