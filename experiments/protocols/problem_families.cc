// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/protocols/problem_families.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>

#include "experiments/simulator/synthetic.h"
#include "features/base/random.h"

namespace quatro {
namespace {

constexpr double kHardRatio = 0.95;
constexpr Eigen::Index kUsualNumber = 1000;

// One step of a family: generates the problem for a seed.
struct Bin {
  std::string name;
  std::function<MatchedProblem(std::uint64_t seed)> draw;
};

std::string Metres(double value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.3g m", value);
  return text;
}

std::vector<Bin> OutlierBins(double noise_bound) {
  std::vector<Bin> bins;
  for (const int percent : {50, 80, 90, 95, 98, 99}) {
    bins.push_back({std::to_string(percent) + " % outliers",
                    [percent, noise_bound](std::uint64_t seed) {
                      return MakeOutlierProblem(
                          kUsualNumber, percent / 100.0, noise_bound / 3, seed);
                    }});
  }
  return bins;
}

std::vector<Bin> NoiseBins(double noise_bound) {
  std::vector<Bin> bins;
  for (const double share : {1.0 / 12, 1.0 / 6, 1.0 / 3, 2.0 / 3}) {
    const double sigma = share * noise_bound;
    bins.push_back({Metres(sigma) + " noise", [sigma](std::uint64_t seed) {
                      return MakeOutlierProblem(
                          kUsualNumber, kHardRatio, sigma, seed);
                    }});
  }
  return bins;
}

std::vector<Bin> NumberBins(double noise_bound) {
  std::vector<Bin> bins;
  for (const Eigen::Index number : {100, 300, 1000, 3000, 10000}) {
    bins.push_back({std::to_string(number) + " matches",
                    [number, noise_bound](std::uint64_t seed) {
                      return MakeOutlierProblem(
                          number, kHardRatio, noise_bound / 3, seed);
                    }});
  }
  return bins;
}

std::vector<Bin> DegeneracyBins(double noise_bound) {
  std::vector<Bin> bins;
  for (const Eigen::Index num_true : {1, 2, 3, 5, 10}) {
    bins.push_back(
        {std::to_string(num_true) + " of 50 true",
         [num_true, noise_bound](std::uint64_t seed) {
           return MakeDegenerateProblem(
               50, num_true, noise_bound / 3, 2.0 * noise_bound, seed);
         }});
  }
  return bins;
}

std::vector<Bin> QuasiInlierBins(double noise_bound) {
  std::vector<Bin> bins;
  for (const Eigen::Index num_quasi : {20, 60, 180}) {
    bins.push_back({std::to_string(num_quasi) + " quasi-inliers",
                    [num_quasi, noise_bound](std::uint64_t seed) {
                      return MakeQuasiInlierProblem(
                          500, 20, num_quasi, noise_bound / 3, seed);
                    }});
  }
  return bins;
}

struct Family {
  const char* name;
  std::vector<Bin> (*make_bins)(double noise_bound);
};

constexpr Family kFamilies[] = {{"outliers", OutlierBins},
                                {"noise", NoiseBins},
                                {"matches", NumberBins},
                                {"degeneracy", DegeneracyBins},
                                {"quasi_inliers", QuasiInlierBins}};

}  // namespace

std::vector<std::string> FamilyNames() {
  std::vector<std::string> names;
  for (const Family& family : kFamilies) names.emplace_back(family.name);
  return names;
}

bool FamilyOptions::IsValid(std::string* error) const {
  const std::vector<std::string> known = FamilyNames();
  error->clear();
  for (const std::string& name : families) {
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      *error = "there is no family " + name + ", only";
      for (const std::string& other : known) *error += " " + other;
    } else if (std::count(families.begin(), families.end(), name) > 1) {
      *error = "family " + name + " is listed twice";
    }
  }
  if (!error->empty()) return false;
  if (families.empty()) {
    *error = "there is no family";
  } else if (num_problems < 1) {
    *error =
        "num_problems = " + std::to_string(num_problems) + ", must be >= 1";
  } else if (!(std::isfinite(noise_bound) && noise_bound > 0.0)) {
    *error = "noise_bound = " + std::to_string(noise_bound) + ", must be > 0";
  }
  return error->empty();
}

std::optional<PairSelection> SelectProblems(const FamilyOptions& options,
                                            std::string* error) {
  if (!options.IsValid(error)) return std::nullopt;
  PairSelection selection;
  for (const std::string& name : options.families) {
    const Family* const family = std::find_if(
        std::begin(kFamilies), std::end(kFamilies), [&](const Family& known) {
          return name == known.name;
        });
    for (const Bin& bin : family->make_bins(options.noise_bound)) {
      for (int i = 0; i < options.num_problems; ++i) {
        // One seed for all bins, so that bins differ only in the varied
        // parameter.
        const std::uint64_t seed =
            Mix(options.seed) + static_cast<std::uint64_t>(i);
        PairTask task;
        task.name = name + "/" + bin.name + "/" + std::to_string(i);
        task.set = name;
        task.bin = bin.name;
        task.make_problem = [draw = bin.draw, seed] { return draw(seed); };
        task.true_target_from_source =
            task.make_problem().true_target_from_source;
        selection.tasks.push_back(std::move(task));
      }
    }
  }
  return selection;
}

}  // namespace quatro
