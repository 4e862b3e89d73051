// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The result of one method on one pair of scans, and its error. With the true
// pose (R, t) and the estimated pose (R', t'), both target_from_source,
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

  // The verdict's status (registered, ambiguous, degenerate, insufficient), or
  // unreadable if a scan is missing or broken.
  std::string status;

  // Not set if there is no answer.
  std::optional<Rigid3> target_from_source;

  // True pose; not set if the scans share no place or it is unknown.
  bool is_truth_known = true;
  std::optional<double> distance;   // |t| [m]
  std::optional<double> true_yaw;   // [rad], -pi .. pi
  std::optional<double> true_tilt;  // [rad], the rotation without its yaw

  // Not set without an answer or without a true pose.
  std::optional<PairError> error;

  std::optional<double>
      probability;  // The verdict's, that the pose is correct.
  long num_matches = 0;
  long num_consistent = 0;
  long num_inliers = 0;

  // The stages of the front end (voxels, features, matching) run once per pair;
  // all methods that take matches share their times.
  std::vector<StageTime> stage_times;
  double total_seconds = 0.0;

  // Returns whether there are a true pose and an answer, and the errors are
  // within these limits.
  bool IsWithin(double max_translation, double max_rotation) const {
    return error && error->translation <= max_translation &&
           error->rotation <= max_rotation;
  }
};

// CSV with a header line and one line per result: pair, set, bin, method,
// status, distance_m, true_yaw_deg, true_tilt_deg, rotation_error_deg,
// yaw_error_deg, translation_error_m, probability, matches, consistent,
// inliers, m00, m01, m02, m03, m10, ... m23 (the rows of the pose's matrix),
// total_ms, stages_ms ("voxels=1.5;features=60"). Unknown values are empty,
// except that distance_m is "unknown" if the true pose is unknown, and empty if
// the scans share no place. Reading a line recovers every number bit for bit;
// numbers must be finite. Names may contain commas and quotes, but no line
// breaks.
std::string ResultCsvHeader();
std::string FormatResultCsv(const PairResult& result);

// Parses a line without its line end. Returns nullopt with *error set, which
// names the column, if the line is invalid.
std::optional<PairResult> ParseResultCsv(const std::string& line,
                                         std::string* error);

// Reads a whole file, which starts with the header line. Returns nullopt with
// *error set, which names file, line and column, also if the last line is
// truncated.
std::optional<std::vector<PairResult>> ReadResultCsv(const std::string& path,
                                                     std::string* error);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_METRICS_PAIR_RESULT_H_
