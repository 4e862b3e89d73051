// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/registration/option_list.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "robust/registration/methods.h"

namespace quatro::option_list_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

class OptionListTest : public ::testing::Test {
 protected:
  // The option of this name among those of quatro or of another method.
  Option Named(const std::string& name, const std::string& method = "quatro") {
    std::string error;
    const Method* found = FindMethod(method, &error);
    EXPECT_TRUE(found) << error;
    for (const Option& option : OptionsOf(*found, true, &options_)) {
      if (option.name == name) return option;
    }
    ADD_FAILURE() << "no option " << name;
    return {};
  }

  static void Accept(const Option& option, const std::string& text) {
    std::string error;
    EXPECT_TRUE(option.Parse(text, &error)) << error;
    EXPECT_EQ(error, "");
  }

  // Refused texts leave the field as it was; none of `field` may be NaN.
  template <typename Field>
  static void Refuse(const Option& option,
                     const std::vector<std::string>& texts,
                     const std::string& wanted,
                     const Field& field) {
    const Field before = field;
    for (const std::string& text : texts) {
      std::string error;
      EXPECT_FALSE(option.Parse(text, &error)) << text;
      EXPECT_EQ(error, option.name + " = " + text + ", must be " + wanted);
      EXPECT_TRUE(field == before) << text;
    }
  }

  RegistrationOptions options_;
};

TEST_F(OptionListTest, Switches) {
  const Option option = Named("polish");
  Accept(option, "off");
  EXPECT_FALSE(options_.quatro.polish);
  Accept(option, "on");
  EXPECT_TRUE(options_.quatro.polish);
  Refuse(option,
         {"", "true", "1", "On", "on "},
         "on or off",
         options_.quatro.polish);
}

TEST_F(OptionListTest, Numbers) {
  const Option option = Named("noise_bound");
  Accept(option, "0.25");
  EXPECT_EQ(options_.noise_bound, 0.25);
  Accept(option, "1e-3");
  EXPECT_EQ(options_.noise_bound, 1e-3);
  // Ranges are the library's to check.
  Accept(option, "-1");
  std::string error;
  EXPECT_FALSE(options_.IsValid(&error));
  EXPECT_THAT(error, HasSubstr("noise_bound = -1"));
  Refuse(option,
         {"", "a", "0.3 m", " 0.3", "0,3", "1e999", "0.1.2"},
         "a number",
         options_.noise_bound);
}

TEST_F(OptionListTest, Integers) {
  const Option threads = Named("num_threads");
  Accept(threads, "3");
  EXPECT_EQ(options_.num_threads, 3);
  Accept(threads, "-1");
  EXPECT_EQ(options_.num_threads, -1);
  const std::vector<std::string> bad = {"", "a", "1.5", "1 ", "1e3"};
  Refuse(threads, bad, "an integer", options_.num_threads);
  Refuse(threads, {"3000000000"}, "an integer", options_.num_threads);

  // Of 64 bits, without a sign or with.
  const Option seed = Named("seed");
  Accept(seed, "18446744073709551615");
  EXPECT_EQ(options_.seed, ~std::uint64_t{0});
  Refuse(seed, bad, "an integer", options_.seed);
  Refuse(seed, {"-1", "18446744073709551616"}, "an integer", options_.seed);
  const Option samples = Named("max_iterations", "ransac");
  Accept(samples, "3000000000");
  EXPECT_EQ(options_.ransac.max_iterations, 3'000'000'000);
  Refuse(samples, bad, "an integer", options_.ransac.max_iterations);
}

TEST_F(OptionListTest, Choices) {
  const Option option = Named("pruning");
  const struct {
    const char* name;
    Pruning pruning;
  } all[] = {{"clique_heuristic", Pruning::kCliqueHeuristic},
             {"exact_clique", Pruning::kExactClique},
             {"max_core", Pruning::kMaxCore},
             {"none", Pruning::kNone}};
  for (const auto& [name, pruning] : all) {
    Accept(option, name);
    EXPECT_EQ(options_.quatro.pruning, pruning);
  }
  Refuse(option,
         {"", "None", "clique", "0"},
         "one of clique_heuristic, exact_clique, max_core, none",
         options_.quatro.pruning);
}

// Each name is accepted, sets a value of its own, and is the one told.
TEST_F(OptionListTest, EveryNameOfEveryChoiceIsOfOneValue) {
  int num_choices = 0;
  for (const Method& method : Methods()) {
    for (const Option& option : OptionsOf(method, true, &options_)) {
      const auto* choice = std::get_if<Choice>(&option.field);
      if (choice == nullptr) continue;
      ++num_choices;
      EXPECT_LT(choice->get(), choice->names.size()) << option.name;
      for (std::size_t i = 0; i < choice->names.size(); ++i) {
        Accept(option, choice->names[i]);
        EXPECT_EQ(choice->get(), i) << option.name;
        EXPECT_THAT(option.Describe(), HasSubstr(choice->names[i]));
      }
    }
  }
  EXPECT_GE(num_choices, 40);
}

TEST_F(OptionListTest, Vectors) {
  const Option option = Named("up");
  Accept(option, "1,0,-0.5");
  EXPECT_EQ(options_.ins.up, Eigen::Vector3d(1.0, 0.0, -0.5));
  Refuse(
      option,
      {"", "1", "1,0", "1,0,0,0", "1,,0", "1,0,", "1;0;0", "x,y,z", "1, 0,0"},
      "three numbers, x,y,z",
      options_.ins.up);
}

TEST_F(OptionListTest, Poses) {
  const Option option = Named("guess");
  const std::string rows = "0,-1,0,5,1,0,0,6,0,0,1,7";
  Eigen::Matrix4d expected;
  expected << 0, -1, 0, 5, 1, 0, 0, 6, 0, 0, 1, 7, 0, 0, 0, 1;
  for (const std::string& text : {rows, rows + ",0,0,0,1"}) {
    options_.bounds.guess = {};
    Accept(option, text);
    EXPECT_EQ(options_.bounds.guess.ToMatrix(), expected);
  }
  const Eigen::Matrix4d before = options_.bounds.guess.ToMatrix();
  for (const std::string& text :
       {std::string(), std::string("1,2,3"), rows + ",0", rows + ",a,0,0,1"}) {
    std::string error;
    EXPECT_FALSE(option.Parse(text, &error)) << text;
    EXPECT_EQ(error, "guess = " + text + ", must be 12 or 16 numbers");
    EXPECT_EQ(options_.bounds.guess.ToMatrix(), before);
  }
}

TEST_F(OptionListTest, Attitudes) {
  const Option option = Named("source_rpy");
  Accept(option, "0.1,-0.2,0.3");
  const Attitude& attitude = options_.ins.source_attitude;
  EXPECT_THAT((std::vector{attitude.roll, attitude.pitch, attitude.yaw}),
              ElementsAre(0.1, -0.2, 0.3));
  for (const char* text : {"", "0.1", "0.1,0.2", "0.1,0.2,0.3,0.4", "a,b,c"}) {
    std::string error;
    EXPECT_FALSE(option.Parse(text, &error)) << text;
    EXPECT_EQ(error,
              "source_rpy = " + std::string(text) +
                  ", must be three numbers, roll,pitch,yaw");
    EXPECT_EQ(attitude.pitch, -0.2);
  }
}

TEST_F(OptionListTest, DegreesAreRadiansInTheField) {
  const Option option = Named("max_yaw_deg");
  Accept(option, "90");
  EXPECT_NEAR(options_.bounds.max_yaw, M_PI / 2, 1e-15);
  Refuse(option, {"", "north", "90 deg"}, "a number", options_.bounds.max_yaw);
  // The range that is told is that which is checked.
  Accept(option, "180");
  std::string error;
  EXPECT_TRUE(options_.IsValid(&error)) << error;
  Accept(option, "181");
  EXPECT_FALSE(options_.IsValid(&error));
}

TEST_F(OptionListTest, TheyAreDescribedWithTheirRange) {
  EXPECT_EQ(Named("voxel_size").Describe(), "[m], > 0: edge of a voxel");
  EXPECT_EQ(Named("polish").Describe(),
            "estimate roll and pitch on the inliers");
  EXPECT_EQ(Named("refine").Describe(),
            "local registration from the pose found: none, icp, gicp, vgicp");
  for (const Method& method : Methods()) {
    std::set<std::string> names;
    for (const Option& option : OptionsOf(method, true, &options_)) {
      const std::string all = option.Describe();
      EXPECT_THAT(all, StartsWith(option.range)) << option.name;
      EXPECT_THAT(all, HasSubstr(option.text)) << option.name;
      EXPECT_FALSE(option.text.empty()) << option.name;
      EXPECT_NE(option.text.back(), '.') << option.name;
      EXPECT_TRUE(names.insert(option.name).second)
          << method.name << " has two options " << option.name;
    }
  }
}

TEST_F(OptionListTest, LocalAlignmentHasItsOwn) {
  LocalAlignmentOptions alignment;
  std::string error;
  for (const Option& option : LocalAlignmentOptionList(&alignment)) {
    if (option.name == "kernel") Accept(option, "huber");
    if (option.name == "max_num_iterations") Accept(option, "7");
  }
  EXPECT_EQ(alignment.kernel.type, RobustKernelType::kHuber);
  EXPECT_EQ(alignment.max_num_iterations, 7);
}

}  // namespace
}  // namespace quatro::option_list_test
