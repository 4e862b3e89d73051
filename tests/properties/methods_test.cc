// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "experiments/programs/methods.h"
#include "robust/estimators/quatro.h"
#include "tests/properties/lattice.h"

namespace quatro::methods_test {
namespace {

bool AreColumns(const std::vector<Eigen::Index>& columns, Eigen::Index n) {
  return std::is_sorted(columns.begin(), columns.end()) &&
         std::adjacent_find(columns.begin(), columns.end()) == columns.end() &&
         (columns.empty() || (columns.front() >= 0 && columns.back() < n));
}

// Matches of a lattice: some right by a quarter turn and a shift, the others
// anything, copies among them.
void DrawMatches(Points* source, Points* target) {
  const auto num_right = *NumUpTo(0, 6);
  const auto num_wrong = *NumUpTo(0, 6);
  const Points right = LatticePoints(num_right);
  const Points moved = TurnedByQuarters(right, *Whole(0, 3)).colwise() +
                       Eigen::Vector3d(3, -2, 1);
  source->resize(3, static_cast<Eigen::Index>(num_right + num_wrong));
  target->resize(3, source->cols());
  *source << right, LatticePoints(num_wrong);
  *target << moved, LatticePoints(num_wrong);
}

RC_GTEST_PROP(MethodsProperty, WhatTheySayHoldsTogether, ()) {
  Points source, target;
  DrawMatches(&source, &target);
  for (const std::string& name : ExperimentMethodNames(MethodInput::kMatches)) {
    if (NeedsIns(name)) continue;
    std::string error;
    const MatchSolver solve = FindMatchSolver(name, {}, &error);
    RC_ASSERT(static_cast<bool>(solve));
    const RegistrationSummary registration = solve({source, target}, {});
    RC_ASSERT(registration.error.empty());
    const PoseSummary& summary = registration.solution;
    RC_LOG() << name << ": " << summary.message << "\n";
    const auto& pose = summary.target_from_source;
    RC_ASSERT(pose.has_value() ==
              (summary.termination == PoseTermination::kSolved));
    RC_ASSERT(!summary.message.empty());
    RC_ASSERT(AreColumns(summary.consistent, source.cols()));
    RC_ASSERT(AreColumns(summary.translation_inliers, source.cols()));
    RC_ASSERT(summary.num_matches <= source.cols());
    if (!pose) continue;
    RC_ASSERT(pose->translation.allFinite());
    RC_ASSERT((pose->rotation * pose->rotation.transpose()).isIdentity(1e-9));
    RC_ASSERT(pose->rotation.determinant() > 0.0);
  }
}

// Columns of a match and all its copies, wherever they went.
RC_GTEST_PROP(MethodsProperty, OrderDoesNotMatterAmongTies, ()) {
  Points source, target;
  DrawMatches(&source, &target);
  const Points last_first_source = source.rowwise().reverse();
  const Points last_first_target = target.rowwise().reverse();
  const PoseSummary a = SolveQuatro(source, target, {});
  const PoseSummary b = SolveQuatro(last_first_source, last_first_target, {});
  RC_ASSERT(a.termination == b.termination);
  if (!a.target_from_source) return;
  RC_ASSERT(a.target_from_source->ToMatrix() ==
            b.target_from_source->ToMatrix());
}

}  // namespace
}  // namespace quatro::methods_test
