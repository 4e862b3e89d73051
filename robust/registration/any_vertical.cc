// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/registration/any_vertical.h"

#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "features/base/degree.h"
#include "robust/registration/gravity.h"
#include "robust/registration/methods.h"

namespace quatro {
namespace {

// Verticals that differ by less than 3 deg count as the same.
const double kSameVertical = std::cos(3.0 * kDegree);

class AnyVertical {
 public:
  AnyVertical(const MatchedClouds& clouds, const Prepared& prepared)
      : clouds_(clouds), prepared_(prepared) {}

  RegistrationSummary Register() {
    const InsOptions& ins = prepared_.options.ins;
    const LevelFrames given = MakeLevelFrames(ins);
    if (ins.gravity != Gravity::kNone) Try(given, "given", prepared_);
    if (!IsDone()) {
      // These frames already contain the tilt, so rung 0 suffices.
      Prepared one_rung = prepared_;
      one_rung.options.search.max_rung = 0;
      std::string ignored;
      const Method* teaser = FindMethod("teaser", &ignored);
      TryOther(LevelByMatches(clouds_, teaser->make(prepared_.options)),
               "matches",
               one_rung);
    }
    Prepared any_side = prepared_;
    any_side.options.search.allows_upside_down = true;
    if (!IsDone()) TryOther(LevelByNormals(clouds_), "normals", any_side);
    if (!best_) Try(given, "given", any_side);  // No other frames.
    best_->total_seconds += other_seconds_;
    return *std::move(best_);
  }

 private:
  bool IsDone() const {
    return best_ && (best_->verdict.IsRegistered() ||
                     best_->total_seconds + other_seconds_ >
                         prepared_.options.search.time_limit_seconds);
  }

  // Tries other frames, unless they have the verticals of the given frames and
  // these were tried before.
  void TryOther(const std::optional<LevelFrames>& frames,
                const char* leveled_by,
                const Prepared& prepared) {
    if (!frames) return;
    const auto up = [](const Eigen::Matrix3d& level_from_cloud) {
      return level_from_cloud.row(2).transpose();
    };
    const LevelFrames given = MakeLevelFrames(prepared.options.ins);
    const bool is_given =
        up(frames->level_from_source).dot(up(given.level_from_source)) >
            kSameVertical &&
        up(frames->level_from_target).dot(up(given.level_from_target)) >
            kSameVertical;
    if (is_given && prepared.options.ins.gravity != Gravity::kNone) return;
    Prepared later = prepared;
    later.options.search.is_first_try =
        prepared.options.search.is_first_try && !best_;
    Try(*frames, leveled_by, later);
  }

  void Try(const LevelFrames& frames,
           const char* leveled_by,
           const Prepared& prepared) {
    RegistrationSummary summary = RegisterIn(frames, clouds_, prepared);
    summary.leveled_by = leveled_by;
    if (!best_) {
      best_ = std::move(summary);
      return;
    }
    if (IsBetter(summary, *best_)) std::swap(summary, *best_);
    other_seconds_ += summary.total_seconds;
    for (const StageTime& time : clouds_.stage_times) {
      other_seconds_ -= time.seconds;  // Matched only once.
    }
  }

  const MatchedClouds& clouds_;
  const Prepared& prepared_;
  std::optional<RegistrationSummary> best_;
  double other_seconds_ = 0.0;
};

}  // namespace

bool MayLevelByScans(const RegistrationOptions& options) {
  return options.ins.gravity != Gravity::kGiven &&
         options.ins.mode == InsMode::kNone && !options.bounds.IsActive() &&
         options.search.max_rung > 0;
}

RegistrationSummary RegisterByAnyVertical(const MatchedClouds& clouds,
                                          const Prepared& prepared) {
  return AnyVertical(clouds, prepared).Register();
}

}  // namespace quatro
