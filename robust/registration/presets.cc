// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/registration/presets.h"

#include "robust/registration/auto_voxel_size.h"

namespace quatro {
namespace {

RegistrationOptions InProportionTo(double voxel_size) {
  RegistrationOptions options =
      ScaledBy(voxel_size / RegistrationOptions().front_end.voxel_size,
               RegistrationOptions());
  options.front_end.voxel_size = voxel_size;
  options.front_end.normal_radius = 3.0 * voxel_size;
  options.front_end.fpfh_radius = 5.0 * voxel_size;
  options.noise_bound = voxel_size;
  return options;
}

// Options without the extensions that the paper and its code do not have.
RegistrationOptions WithoutExtensions() {
  RegistrationOptions options;
  options.front_end.voxel_size = 0.3;
  options.front_end.normal_radius = 0.5;
  options.quatro.replace_missed_optimum = false;
  options.quatro.recover_translation = false;
  options.quatro.polish = false;
  options.search.max_rung = 0;
  return options;
}

RegistrationOptions MakePaper() {
  RegistrationOptions options = WithoutExtensions();
  options.front_end.fpfh_radius = 0.65;
  options.noise_bound = 0.15;
  options.quatro.tim_bound_factor = 1.0;
  options.quatro.gnc.start = GncStart::kIdentity;
  return options;
}

RegistrationOptions MakeReference() {
  RegistrationOptions options = WithoutExtensions();
  options.front_end.fpfh_radius = 0.75;
  options.noise_bound = 0.3;
  options.quatro.tim_bound_factor = 2.0;
  options.quatro.gnc.start = GncStart::kPlainFit;
  return options;
}

}  // namespace

std::vector<std::string> PresetNames() {
  return {"kitti", "paper", "kitti_paper", "reference", "indoor"};
}

std::optional<RegistrationOptions> MakePreset(const std::string& name) {
  if (name == "kitti") return InProportionTo(0.3);
  if (name == "paper" || name == "kitti_paper") return MakePaper();
  if (name == "reference") return MakeReference();
  if (name == "indoor") return InProportionTo(0.1);
  return std::nullopt;
}

RegistrationOptions MakeAutoOptions(const PointCloud& source,
                                    const PointCloud& target) {
  // The front end refuses clouds that have none.
  const auto voxel_size = AutoVoxelSize(source.points, target.points);
  return MakeAutoOptions(voxel_size.value_or(0.3));
}

RegistrationOptions MakeAutoOptions(double voxel_size) {
  RegistrationOptions options = InProportionTo(voxel_size);
  options.search.scale_factors = {1.0, 2.0, 3.5};
  options.search.max_rung = 1;  // A larger scale finds more than rung 2.
  options.ins.gravity = Gravity::kScans;
  options.refinement.method = RefinementMethod::kVgicp;
  return options;
}

}  // namespace quatro
