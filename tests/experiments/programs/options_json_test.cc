// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/programs/options_json.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "robust/registration/methods.h"

namespace quatro::options_json_test {
namespace {

TEST(OptionsJson, HasEveryOptionOfEveryMethodButTheThreads) {
  int num_options = 0;
  for (const Method& method : Methods()) {
    for (const bool has_clouds : {false, true}) {
      RegistrationOptions options;
      const Json json = DescribeOptions(method.name, has_clouds, options);
      const OptionList list = OptionsOf(method, has_clouds, &options);
      for (const Option& option : list) {
        EXPECT_EQ(json.contains(option.name), option.name != "num_threads")
            << option.name << " of " << method.name;
        ++num_options;
      }
      EXPECT_EQ(json.size() + 1, list.size()) << method.name;
    }
  }
  EXPECT_GT(num_options, 200);
}

TEST(OptionsJson, ValuesAreThoseOfTheFields) {
  RegistrationOptions options;
  options.noise_bound = 0.15;
  options.seed = std::numeric_limits<std::uint64_t>::max();
  options.quatro.gnc.start = GncStart::kIdentity;
  options.quatro.polish = false;
  options.front_end.normal_radius = 0.5;
  options.ins.source_attitude = {0.1, -0.2, 0.3};
  options.bounds.guess.translation = {4.0, 5.0, 6.0};
  options.bounds.max_yaw = 0.5 * M_PI;
  const Json json = DescribeOptions("quatro", /*has_clouds=*/true, options);
  EXPECT_EQ(json["noise_bound"], 0.15);
  EXPECT_EQ(json["seed"], std::numeric_limits<std::uint64_t>::max());
  EXPECT_EQ(json["gnc_start"], "identity");
  EXPECT_EQ(json["gnc_max_num_iterations"], 100);
  EXPECT_EQ(json["polish"], false);
  EXPECT_EQ(json["normal_radius"], 0.5);
  EXPECT_EQ(json["source_rpy"], Json({0.1, -0.2, 0.3}));
  EXPECT_EQ(json["up"], Json({0.0, 0.0, 1.0}));
  EXPECT_EQ(json["guess"][1][3], 5.0);
  EXPECT_EQ(json["guess"][3][3], 1.0);
  EXPECT_EQ(json["max_yaw_deg"], 90.0);
  EXPECT_TRUE(json["max_translation"].is_null());
}

TEST(OptionsJson, OptionsThatDefineTheMethodAreSet) {
  RegistrationOptions options;
  options.refinement.method = RefinementMethod::kNone;
  EXPECT_FALSE(DescribeOptions("icp", true, options).contains("noise_bound"));
  EXPECT_EQ(DescribeOptions("quatro", true, options)["refine"], "none");
}

TEST(OptionsJson, OfAnotherLibrarysMethodAreTheCommonOnes) {
  const Json clouds = DescribeOptions("other", true, RegistrationOptions());
  EXPECT_TRUE(clouds.contains("voxel_size"));
  EXPECT_TRUE(clouds.contains("noise_bound"));
  EXPECT_TRUE(clouds.contains("ins_mode"));
  const Json matches = DescribeOptions("other", false, RegistrationOptions());
  EXPECT_FALSE(matches.contains("voxel_size"));
}

}  // namespace
}  // namespace quatro::options_json_test
