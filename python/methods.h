// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The estimators of the library by name, each with its own options. An option
// that the estimator does not use is an error and not ignored.

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

  // Copies noise bound, seed and threads of `quatro` to the others.
  void ShareCommon();
};

struct Method {
  std::string name;
  std::string text;
  bool takes_ins;  // The others estimate roll and pitch themselves.
  OptionList (*options)(EstimatorOptions* options);
  bool (*is_valid)(const EstimatorOptions& options, std::string* error);
  PoseSolver (*make)(const EstimatorOptions& options);
};

const std::vector<Method>& Methods();

// Throws ValueError for an unknown name.
const Method& FindMethod(const std::string& name);

}  // namespace quatro

#endif  // QUATRO_PYTHON_METHODS_H_
