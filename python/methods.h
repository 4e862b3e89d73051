// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The estimators of the library by name, each with the options that it takes:
// one that it has no use for is an error, not ignored.

#ifndef QUATRO_PYTHON_METHODS_H_
#define QUATRO_PYTHON_METHODS_H_

#include <functional>
#include <string>
#include <vector>

#include "python/options.h"
#include "robust/estimators/pose_summary.h"
#include "robust/registration/registration.h"

namespace quatro {

// The options of every estimator; a method reads its own.
struct EstimatorOptions {
  QuatroOptions quatro;
  ArcConsensusOptions arc_consensus;
  TeaserOptions teaser;
  FgrOptions fgr;
  RansacOptions ransac;

  // Noise bound, seed and threads of `quatro` for the others, too.
  void ShareCommon();
};

struct Method {
  std::string name;
  std::string text;
  bool takes_ins;  // The others find roll and pitch by themselves.
  OptionList (*options)(EstimatorOptions* options);
  bool (*is_valid)(const EstimatorOptions& options, std::string* error);
  PoseSolver (*make)(const EstimatorOptions& options);
};

const std::vector<Method>& Methods();

// Throws ValueError for a name that is not known.
const Method& FindMethod(const std::string& name);

}  // namespace quatro

#endif  // QUATRO_PYTHON_METHODS_H_
