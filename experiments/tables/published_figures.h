// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Results published by others, shown next to the results of a run and never
// mixed with them. All are on KITTI and from the authors' own programs.

#ifndef QUATRO_EXPERIMENTS_TABLES_PUBLISHED_FIGURES_H_
#define QUATRO_EXPERIMENTS_TABLES_PUBLISHED_FIGURES_H_

#include <string>
#include <vector>

namespace quatro {

struct PublishedRate {
  std::string method;
  std::string set;
  double percent = 0.0;
};

struct PublishedErrors {
  std::string method;
  std::string bin;
  double translation = 0.0;   // t_avg [m]
  double rotation_deg = 0.0;  // r_avg
};

struct PublishedDrift {
  std::string method;
  int interval = 1;
  double translation_percent = 0.0;
  double rotation_deg_per_100m = 0.0;
};

// Figures of Lim et al., "A Single Correspondence Is Enough: Robust Global
// Registration to Avoid Degeneracy in Urban Environments", ICRA 2022:

// Table I: success within 2 m and 10 deg, loop pairs 9-12 m apart; sets are the
// sequences "00", "02", "05", "06", "07", "08".
std::vector<PublishedRate> PublishedTableOne();

// Table II: drift on 00 at frame intervals 1, 3, 5. The paper quotes LO-Net,
// DMLO and StickyPillars from their own papers.
std::vector<PublishedDrift> PublishedTableTwo();

// Table III: loop pairs on 06; bins are "0-2 m", "4-6 m" and "8-10 m".
std::vector<PublishedErrors> PublishedTableThree();

// Success within 2 m and 5 deg on the list kitti_lc of real scans. Sets are its
// bins "0-10 m", "10-20 m" and "20-30 m", from the documents of G3Reg, and
// "all" distances, from the papers of G3Reg, KISS-Matcher and PARTE.
std::vector<PublishedRate> PublishedKittiLc();

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_TABLES_PUBLISHED_FIGURES_H_
