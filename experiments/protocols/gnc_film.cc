// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/protocols/gnc_film.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>

#include "experiments/simulator/synthetic.h"
#include "features/base/degree.h"
#include "robust/gnc/gnc.h"
#include "robust/gnc/quasi_so3.h"
#include "solvers/closed_form/exact_yaw.h"

namespace quatro {
namespace {

struct Fit {
  double yaw = 0.0;
  Weights weights;
};

// A QuasiSo3 that records the weights it receives.
struct FilmedQuasiSo3 : QuasiSo3 {
  std::vector<Fit>* fits = nullptr;

  std::optional<Estimate> Solve(const WeightsRef& weights) const {
    const auto estimate = QuasiSo3::Solve(weights);
    if (estimate) fits->push_back({estimate->target_from_source, weights});
    return estimate;
  }
};

template <typename Loss>
Eigen::VectorXd CurveOf(const QuasiSo3& problem,
                        const std::vector<double>& yaws,
                        const Loss& loss) {
  Eigen::VectorXd curve(static_cast<Eigen::Index>(yaws.size()));
  for (std::size_t i = 0; i < yaws.size(); ++i) {
    YawEstimate yaw;
    yaw.target_from_source = yaws[i];
    curve[static_cast<Eigen::Index>(i)] =
        problem.SquaredResiduals(yaw).unaryExpr(loss).sum();
  }
  return curve;
}

std::string Text(double value) {
  std::ostringstream text;
  text.precision(10);
  text << value;
  return text.str();
}

}  // namespace

bool FilmOptions::IsValid(std::string* error) const {
  std::ostringstream problem;
  if (num_tims < 2) {
    problem << "num_tims = " << num_tims << ", must be >= 2";
  } else if (!(outlier_ratio >= 0.0 && outlier_ratio < 1.0)) {
    problem << "outlier_ratio = " << outlier_ratio << ", must be in [0, 1)";
  } else if (!(noise_bound > 0.0 && std::isfinite(noise_bound))) {
    problem << "noise_bound = " << noise_bound << ", must be > 0 and finite";
  } else if (num_yaws < 2) {
    problem << "num_yaws = " << num_yaws << ", must be >= 2";
  }
  *error = problem.str();
  return error->empty();
}

GncFilm FilmGnc(const FilmOptions& options) {
  const double bound = options.noise_bound;
  const MatchedProblem matches = MakeTimProblem(
      options.num_tims, options.outlier_ratio, bound / 3.0, options.seed);
  GncFilm film;
  film.true_yaw = Yaw(matches.true_target_from_source.rotation);
  for (int i = 0; i < options.num_yaws; ++i) {
    film.yaws.push_back(-M_PI + 2.0 * M_PI * i / (options.num_yaws - 1));
  }

  std::vector<Fit> fits;
  FilmedQuasiSo3 problem;
  problem.source = matches.source;
  problem.target = matches.target;
  problem.noise_bound = bound;
  problem.fits = &fits;
  const auto gnc = SolveGnc<TruncatedLeastSquares>(problem, GncOptions{});
  // The plain fit is first, followed by one fit per iteration.
  for (std::size_t i = 0; i < fits.size(); ++i) {
    FilmFrame& frame = film.frames.emplace_back();
    frame.yaw = fits[i].yaw;
    frame.weights = fits[i].weights;
    if (i == 0) {
      frame.curve = CurveOf(problem, film.yaws, [](double r2) { return r2; });
      continue;
    }
    const double mu = gnc.iterations[i - 1].mu;
    frame.mu = mu;
    frame.curve = CurveOf(problem, film.yaws, [mu](double r2) {
      return TruncatedLeastSquares::Loss(r2, mu);
    });
  }
  film.truncated_curve =
      CurveOf(problem, film.yaws, [](double r2) { return std::min(r2, 1.0); });

  const Weights ones = Weights::Ones(options.num_tims);
  const Weights bounds = Weights::Constant(options.num_tims, bound);
  const auto exact =
      EstimateExactYaw(matches.source, matches.target, ones, bounds);
  if (exact) {
    film.exact_yaw = exact->target_from_source;
    film.exact_cost = exact->cost;
  }
  if (!fits.empty()) {
    film.gnc_yaw = fits.back().yaw;
    film.gnc_cost = TruncatedYawCost(
        matches.source, matches.target, ones, bounds, film.gnc_yaw);
  }
  YawEstimate truth;
  truth.target_from_source = film.true_yaw;
  const Eigen::VectorXd r2 = problem.SquaredResiduals(truth);
  for (Eigen::Index k = 0; k < r2.size(); ++k) {
    film.is_true.push_back(r2[k] <= 1.0);
  }
  return film;
}

Table TabulateFilm(const GncFilm& film) {
  Table table{{"kind", "iteration", "mu", "x", "y"}, {}};
  const auto add = [&](const std::string& kind,
                       const std::string& iteration,
                       const std::string& mu,
                       double x,
                       double y) {
    table.rows.push_back({kind, iteration, mu, Text(x), Text(y)});
  };
  const auto truncated_at = [&](double yaw) {
    const double step = film.yaws[1] - film.yaws[0];
    const auto i = static_cast<Eigen::Index>(
        std::lround((yaw - film.yaws.front()) / step));
    return film.truncated_curve[std::clamp<Eigen::Index>(
        i, 0, film.truncated_curve.size() - 1)];
  };
  for (std::size_t i = 0; i < film.frames.size(); ++i) {
    const FilmFrame& frame = film.frames[i];
    const std::string iteration = std::to_string(i);
    const std::string mu = Text(frame.mu);
    for (Eigen::Index k = 0; k < frame.weights.size(); ++k) {
      add("weight", iteration, mu, static_cast<double>(k), frame.weights[k]);
    }
    for (std::size_t j = 0; j < film.yaws.size(); ++j) {
      add("curve",
          iteration,
          mu,
          film.yaws[j] / kDegree,
          frame.curve[static_cast<Eigen::Index>(j)]);
    }
    add("yaw", iteration, mu, frame.yaw / kDegree, truncated_at(frame.yaw));
  }
  for (std::size_t j = 0; j < film.yaws.size(); ++j) {
    add("truncated",
        "",
        "",
        film.yaws[j] / kDegree,
        film.truncated_curve[static_cast<Eigen::Index>(j)]);
  }
  for (std::size_t k = 0; k < film.is_true.size(); ++k) {
    add("is_true", "", "", static_cast<double>(k), film.is_true[k] ? 1.0 : 0.0);
  }
  add("gnc", "", "", film.gnc_yaw / kDegree, film.gnc_cost);
  add("exact", "", "", film.exact_yaw / kDegree, film.exact_cost);
  add("truth", "", "", film.true_yaw / kDegree, truncated_at(film.true_yaw));
  return table;
}

}  // namespace quatro
