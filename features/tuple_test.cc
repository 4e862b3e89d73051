// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "features/tuple_test.h"

#include <sstream>

#include "features/random.h"

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
  // Side by side, since they are looked up at random.
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
    return s2 * q2 < p2 && s2 * p2 < q2;
  };

  std::vector<bool> passes(n, false);
  std::int64_t num_passed = 0;
  Random random(options.seed);
  const std::size_t num_triples =
      n * static_cast<std::size_t>(options.num_triples_per_match);
  for (std::size_t triple = 0; triple < num_triples; ++triple) {
    const std::size_t a = random.Below(n);
    const std::size_t b = random.Below(n);
    const std::size_t c = random.Below(n);
    // Nothing new, but to the count.
    if (options.max_num_triples == 0 && passes[a] && passes[b] && passes[c]) {
      continue;
    }
    if (sides_agree(a, b) && sides_agree(b, c) && sides_agree(c, a)) {
      passes[a] = passes[b] = passes[c] = true;
      if (++num_passed == options.max_num_triples) break;
    }
  }
  std::vector<Match> kept;
  for (std::size_t i = 0; i < n; ++i) {
    if (passes[i]) kept.push_back(matches[i]);
  }
  return kept;
}

}  // namespace quatro
