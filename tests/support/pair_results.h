// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Results of pairs with chosen errors, for tests of metrics and tables.

#ifndef QUATRO_TESTS_SUPPORT_PAIR_RESULTS_H_
#define QUATRO_TESTS_SUPPORT_PAIR_RESULTS_H_

#include <cmath>
#include <string>

#include "experiments/metrics/pair_result.h"

namespace quatro {

// Registered, off by so much.
inline PairResult ResultOff(const std::string& method,
                            const std::string& pair,
                            double translation_error,
                            double rotation_error_deg) {
  const double degree = M_PI / 180.0;
  PairResult result;
  result.pair = pair;
  result.set = "00";
  result.bin = "9-12 m";
  result.method = method;
  result.status = "registered";
  result.distance = 10.0;
  result.true_yaw = 0.5;
  result.true_tilt = 0.01;
  result.target_from_source = Rigid3{};
  result.error = PairError{rotation_error_deg * degree,
                           0.5 * rotation_error_deg * degree,
                           translation_error};
  return result;
}

inline PairResult ResultWithoutAnswer(const std::string& method,
                                      const std::string& pair) {
  PairResult result = ResultOff(method, pair, 0.0, 0.0);
  result.status = "insufficient";
  result.target_from_source.reset();
  result.error.reset();
  return result;
}

inline PairResult UnreadableResult(const std::string& method,
                                   const std::string& pair) {
  PairResult result = ResultWithoutAnswer(method, pair);
  result.status = "unreadable";
  return result;
}

// Of scans that share no place.
inline PairResult ResultApart(const std::string& method,
                              const std::string& pair,
                              const std::string& status) {
  PairResult result = ResultOff(method, pair, 0.0, 0.0);
  result.status = status;
  result.distance.reset();
  result.true_yaw.reset();
  result.true_tilt.reset();
  result.error.reset();
  return result;
}

// Whose true pose nobody knows.
inline PairResult ResultWithoutTruth(const std::string& method,
                                     const std::string& pair) {
  PairResult result = ResultApart(method, pair, "registered");
  result.is_truth_known = false;
  return result;
}

}  // namespace quatro

#endif  // QUATRO_TESTS_SUPPORT_PAIR_RESULTS_H_
