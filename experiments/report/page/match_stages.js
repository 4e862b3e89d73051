// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The fate of a match, stage by stage:
//
//   1  all          every match
//   2  clique       kept: in the consistent set
//   3  GNC          consistent matches by their weight in the rotation
//   4  translation  kept: inliers of the pose; regained: inliers that are not
//                   in the clique

import {INLIER, CONSISTENT} from './view_data.js';

export const STAGES = [
  {key: 1, name: 'all matches', count: 'matches'},
  {key: 2, name: 'after the clique', count: 'consistent'},
  {key: 3, name: 'after GNC, by weight', count: 'weighted'},
  {key: 4, name: 'after translation', count: 'inliers'},
];

// Returns whether the method has this stage.
export function hasStage(stages, stage) {
  if (!stages) return false;
  if (stage === 2) return stages.counts.consistent > 0;
  if (stage === 3) return stages.weight !== null;
  return true;
}

// Returns {role, weight} of match i. The role is 'all', 'kept', 'regained',
// 'rejected' (at this stage), or 'gone' (rejected earlier).
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
