// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "features/tuple_test.h"

#include <atomic>
#include <cstddef>
#include <sstream>

#include "features/base/parallel.h"
#include "features/base/random.h"

namespace quatro {

bool TupleTestOptions::IsValid(std::string* error) const {
  std::ostringstream problem;
  if (!(scale > 0.0 && scale < 1.0)) {
    problem << "tuple_test.scale = " << scale << ", must be in (0, 1)";
  } else if (num_triples_per_match < 1) {
    problem << "tuple_test.num_triples_per_match = " << num_triples_per_match
            << ", must be >= 1";
  } else if (max_num_triples < 0) {
    problem << "tuple_test.max_num_triples = " << max_num_triples
            << ", must be >= 0";
  } else if (num_threads < 0) {
    problem << "tuple_test.num_threads = " << num_threads << ", must be >= 0";
  }
  *error = problem.str();
  return error->empty();
}

std::vector<Match> FilterByTupleTest(const std::vector<Match>& matches,
                                     const PointsRef& source,
                                     const PointsRef& target,
                                     const TupleTestOptions& options) {
  const std::size_t n = matches.size();
  if (n < 3) return matches;
  const double s2 = options.scale * options.scale;
  // The two points of a match are adjacent in memory, because access is random.
  struct Ends {
    Eigen::Vector3d source, target;
  };
  std::vector<Ends> ends;
  ends.reserve(n);
  for (const Match& match : matches) {
    ends.push_back({source.col(match.source), target.col(match.target)});
  }
  const auto sides_agree = [&](std::size_t a, std::size_t b) {
    // Equation (1), squared.
    const double p2 = (ends[a].source - ends[b].source).squaredNorm();
    const double q2 = (ends[a].target - ends[b].target).squaredNorm();
    // Avoids a branch, which would be unpredictable.
    return static_cast<bool>((s2 * q2 < p2) & (s2 * p2 < q2));
  };

  // Flags are only ever set, so the order does not matter.
  std::vector<std::atomic<bool>> passes(n);
  const auto has_passed = [&](std::size_t i) {
    return passes[i].load(std::memory_order_relaxed);
  };
  const bool is_counted = options.max_num_triples > 0;
  const auto test = [&](Eigen::Index begin, Eigen::Index end) {
    Random random(options.seed);
    random.Skip(3 * static_cast<std::uint64_t>(begin));
    std::int64_t num_passed = 0;
    for (Eigen::Index triple = begin; triple < end; ++triple) {
      const std::size_t a = random.Below(n);
      const std::size_t b = random.Below(n);
      const std::size_t c = random.Below(n);
      // All three have passed already, so the triple could only add to the
      // count.
      if (!is_counted && has_passed(a) && has_passed(b) && has_passed(c)) {
        continue;
      }
      if (sides_agree(a, b) && sides_agree(b, c) && sides_agree(c, a)) {
        for (const std::size_t i : {a, b, c}) {
          passes[i].store(true, std::memory_order_relaxed);
        }
        if (++num_passed == options.max_num_triples) break;
      }
    }
  };
  const auto num_triples =
      static_cast<Eigen::Index>(n) *
      static_cast<Eigen::Index>(options.num_triples_per_match);
  constexpr Eigen::Index kPiece = 4096;
  ParallelFor(options.num_threads,
              num_triples,
              is_counted ? num_triples : kPiece,
              test);

  std::vector<Match> kept;
  for (std::size_t i = 0; i < n; ++i) {
    if (has_passed(i)) kept.push_back(matches[i]);
  }
  return kept;
}

}  // namespace quatro
