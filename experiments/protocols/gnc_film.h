// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Records the iterations of GNC on one problem of TIMs: the weight of each TIM
// in each iteration, and the surrogate cost over all yaws,
//
//   f_mu(yaw) = sum_k rho_mu(r_k(yaw)^2 / c^2),                            (1)
//
// together with the truncated cost, whose global minimum is known
// (solvers/closed_form/exact_yaw.h). Input of
// experiments/scripts/draw_gnc_film.py.

#ifndef QUATRO_EXPERIMENTS_PROTOCOLS_GNC_FILM_H_
#define QUATRO_EXPERIMENTS_PROTOCOLS_GNC_FILM_H_

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "experiments/tables/table.h"
#include "features/base/types.h"

namespace quatro {

struct FilmFrame {
  double mu = 0.0;   // 0 for the unweighted fit.
  double yaw = 0.0;  // Fitted with the weights below [rad].
  Weights weights;
  Eigen::VectorXd curve;  // (1) over GncFilm::yaws.
};

struct GncFilm {
  std::vector<FilmFrame> frames;
  double true_yaw = 0.0;   // [rad]
  double gnc_yaw = 0.0;    // Result of GNC [rad].
  double exact_yaw = 0.0;  // [rad]
  double gnc_cost = 0.0;   // Truncated cost.
  double exact_cost = 0.0;
  std::vector<double> yaws;         // -pi .. pi [rad]
  Eigen::VectorXd truncated_curve;  // mu -> inf
  std::vector<bool> is_true;        // Per TIM: an inlier.
};

struct FilmOptions {
  Eigen::Index num_tims = 300;
  double outlier_ratio = 0.9;  // In [0, 1).
  double noise_bound = 0.3;    // c [m]
  int num_yaws = 721;
  std::uint64_t seed = 1;

  // Returns false and says why in *error if a value is out of range.
  bool IsValid(std::string* error) const;
};

// `options` must be valid.
GncFilm FilmGnc(const FilmOptions& options);

// Rows of kind, iteration, mu, x, y. Each iteration has "weight" (x: index of
// the TIM), "curve" (x: yaw [deg]) and "yaw" (x: yaw [deg], y: truncated cost).
// Rows without an iteration are "truncated" (x: yaw [deg]), "is_true" (x: index
// of the TIM, y: 0 or 1), and "gnc", "exact" and "truth", which are like "yaw".
Table TabulateFilm(const GncFilm& film);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_PROTOCOLS_GNC_FILM_H_
