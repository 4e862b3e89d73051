// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// What one method made of one pair of scans, and how far off it is. With the
// true pose (R, t) and the estimated one (R', t'), both target_from_source,
//
//   rotation error  = angle of R^T R',   yaw error = |yaw of R' - yaw of R|,
//   translation error = |t' - t|.                                          (1)

#ifndef QUATRO_EXPERIMENTS_METRICS_PAIR_RESULT_H_
#define QUATRO_EXPERIMENTS_METRICS_PAIR_RESULT_H_

#include <optional>
#include <string>
#include <vector>

#include "features/base/rigid3.h"
#include "features/base/stopwatch.h"

namespace quatro {

struct PairError {
  double rotation = 0.0;     // [rad], 0 .. pi
  double yaw = 0.0;          // [rad], 0 .. pi
  double translation = 0.0;  // [m]
};

PairError MeasureError(const Rigid3& true_target_from_source,
                       const Rigid3& estimated_target_from_source);

struct PairResult {
  std::string pair;  // PairTask::name
  std::string set;
  std::string bin;
  std::string method;

  // registered, ambiguous, degenerate, insufficient (the verdict's), or
  // unreadable: a scan that is missing or broken.
  std::string status;

  // Nullopt without an answer.
  std::optional<Rigid3> target_from_source;

  // Of the true pose; nullopt if the scans share no place.
  std::optional<double> distance;   // |t| [m]
  std::optional<double> true_yaw;   // [rad], -pi .. pi
  std::optional<double> true_tilt;  // [rad], what is left without the yaw

  // Nullopt without an answer or without truth.
  std::optional<PairError> error;

  std::optional<double> probability;  // Of being right; the verdict's.
  long num_matches = 0;
  long num_consistent = 0;
  long num_inliers = 0;

  // The front end's (voxels, features, matching) are those of the pair and the
  // same for all methods from matches.
  std::vector<StageTime> stage_times;
  double total_seconds = 0.0;

  // Has truth and an answer within these of it.
  bool IsWithin(double max_translation, double max_rotation) const {
    return error && error->translation <= max_translation &&
           error->rotation <= max_rotation;
  }
};

// A line of CSV each, under a line of names: pair, set, bin, method, status,
// distance_m, true_yaw_deg, true_tilt_deg, rotation_error_deg, yaw_error_deg,
// translation_error_m, probability, matches, consistent, inliers, m00, m01,
// m02, m03, m10, ... m23 (the rows of the pose's matrix), total_ms, stages_ms
// ("voxels=1.5;features=60"). What is not known is empty. Numbers are written
// so that reading them gives the same ones bit for bit; they must be finite.
// Names may hold commas and quotes, not line breaks.
std::string ResultCsvHeader();
std::string FormatResultCsv(const PairResult& result);

// Nullopt with *error set, which names the column, if it is not such a line.
// Neither has the line's end.
std::optional<PairResult> ParseResultCsv(const std::string& line,
                                         std::string* error);

// All of a file, which starts with the line of names. Nullopt with *error set,
// which names file, line and column; also if the last line is cut off.
std::optional<std::vector<PairResult>> ReadResultCsv(const std::string& path,
                                                     std::string* error);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_METRICS_PAIR_RESULT_H_
