// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/gnc/gnc_roles.h"

#include <vector>

#include "robust/gnc/chi_square.h"

namespace quatro {
namespace {

using Id = ceres::ResidualBlockId;

// The roles of all blocks from the lists of `options`. Returns nullopt and sets
// *error if these contradict each other or the problem.
std::optional<GncBlocks> AssignRoles(const std::vector<Id>& ids,
                                     const CeresGncOptions& options,
                                     std::string* error) {
  const GncRole others =
      options.candidates ? GncRole::kKnownInlier : GncRole::kCandidate;
  GncBlocks blocks;
  for (const Id id : ids) blocks[id].role = others;

  std::unordered_map<Id, const char*> named;
  const auto assign =
      [&](const std::vector<Id>& list, GncRole role, const char* name) {
        for (std::size_t i = 0; i < list.size(); ++i) {
          const std::string where =
              std::string(name) + "[" + std::to_string(i) + "]";
          const auto block = blocks.find(list[i]);
          if (block == blocks.end()) {
            *error = where + " is not a residual block of the problem";
            return false;
          }
          const auto [earlier, is_new] = named.emplace(list[i], name);
          if (!is_new) {
            *error = where + " is already among " + earlier->second;
            return false;
          }
          block->second.role = role;
        }
        return true;
      };
  const bool is_consistent =
      assign(options.known_inliers, GncRole::kKnownInlier, "known_inliers") &&
      assign(
          options.known_outliers, GncRole::kKnownOutlier, "known_outliers") &&
      (!options.candidates ||
       assign(*options.candidates, GncRole::kCandidate, "candidates"));
  if (!is_consistent) return std::nullopt;
  return blocks;
}

// Sets c_i of the candidates. Returns false and sets *error if a bound is for a
// block that is not a candidate, or if a candidate's loss never reaches its
// bound.
bool AssignBounds(const ceres::Problem& problem,
                  const CeresGncOptions& options,
                  GncBlocks* blocks,
                  std::string* error) {
  for (const auto& [id, bound] : options.bounds) {
    const auto block = blocks->find(id);
    if (block == blocks->end()) {
      *error = "bounds names a block that is not in the problem";
      return false;
    }
    if (block->second.role != GncRole::kCandidate) {
      *error = "bounds names a block that is no candidate";
      return false;
    }
    block->second.bound = bound;
  }
  std::unordered_map<int, double> by_dimension;
  for (auto& [id, block] : *blocks) {
    if (block.role != GncRole::kCandidate) continue;
    if (block.bound == 0.0 && options.bound) block.bound = *options.bound;
    if (block.bound == 0.0) {
      const int n =
          problem.GetCostFunctionForResidualBlock(id)->num_residuals();
      double& bound = by_dimension[n];
      if (bound == 0.0) bound = ChiSquareBound(options.inlier_probability, n);
      block.bound = bound;
    }
    const auto* loss = problem.GetLossFunctionForResidualBlock(id);
    if (loss == nullptr) continue;
    constexpr double kLargeSquare = 1e100;
    double rho[3];
    loss->Evaluate(kLargeSquare, rho);
    if (!(rho[0] > block.bound * block.bound)) {
      *error = "a candidate's own loss never reaches its bound of " +
               std::to_string(block.bound);
      return false;
    }
  }
  return true;
}

}  // namespace

std::optional<GncBlocks> AssignGncRoles(const ceres::Problem& problem,
                                        const CeresGncOptions& options,
                                        std::string* error) {
  std::vector<Id> ids;
  problem.GetResidualBlocks(&ids);
  auto blocks = AssignRoles(ids, options, error);
  if (!blocks || !AssignBounds(problem, options, &*blocks, error)) {
    return std::nullopt;
  }
  return blocks;
}

}  // namespace quatro
