// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The picture of a registration: both clouds from above, before and after, with
// inliers in green and the other matches in red.

#ifndef QUATRO_EXPERIMENTS_PROGRAMS_PICTURE_H_
#define QUATRO_EXPERIMENTS_PROGRAMS_PICTURE_H_

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "features/base/rigid3.h"
#include "features/base/types.h"

namespace quatro {

struct RegistrationPicture {
  Points source;  // [m], drawn thinned.
  Points target;
  Points matched_source;
  Points matched_target;
  std::vector<Eigen::Index> inliers;  // Columns of the matches.
  std::optional<Rigid3> target_from_source;
  std::string title;
};

// Returns whether pictures can be drawn on this machine; if not, *error says
// what to install.
bool CanDrawPictures(std::string* error);

// The picture as a PNG file's bytes, drawn by
// experiments/scripts/draw_registration.py and matplotlib.
std::optional<std::string> DrawRegistration(const RegistrationPicture& picture,
                                            std::string* error);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_PROGRAMS_PICTURE_H_
