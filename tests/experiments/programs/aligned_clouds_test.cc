// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/programs/aligned_clouds.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "features/io/cloud_io.h"
#include "tests/support/random_problems.h"
#include "tests/support/run_program.h"

namespace quatro::aligned_clouds_test {
namespace {

using ::testing::HasSubstr;

class AlignedCloudsTest : public ProgramTest {
 protected:
  AlignedCloudsTest() {
    source_.points = RandomPoints(7, 10.0, 1);
    source_.intensity = Eigen::VectorXf::LinSpaced(7, 0.1F, 0.7F);
    target_.points = RandomPoints(5, 10.0, 2);
  }

  PointCloud Written(const std::string& name, const std::string& clouds) {
    std::string error;
    const AlignedOutput output{PathOf(name), clouds};
    EXPECT_TRUE(output.IsValid(&error)) << error;
    const auto bytes = output.Format(source_, target_, pose_, &error);
    EXPECT_TRUE(bytes) << error;
    const auto cloud = ReadCloud(Write(name, bytes.value_or("")), &error);
    EXPECT_TRUE(cloud) << error;
    return cloud.value_or(PointCloud());
  }

  std::string Problem(const AlignedOutput& output) {
    std::string error;
    EXPECT_FALSE(output.IsValid(&error));
    return error;
  }

  PointCloud source_, target_;
  const Rigid3 pose_ = {RandomRotation(3), {1.0, -2.0, 0.5}};
};

TEST_F(AlignedCloudsTest, TheSourceIsMovedAndKeepsItsIntensity) {
  for (const char* name : {"a.ply", "a.pcd", "a.bin"}) {
    const PointCloud cloud = Written(name, "source");
    EXPECT_TRUE(cloud.points.isApprox(pose_.Apply(source_.points), 1e-6));
    EXPECT_TRUE(cloud.intensity.isApprox(source_.intensity, 1e-6F)) << name;
  }
}

TEST_F(AlignedCloudsTest, BothAreToldApartByIntensity) {
  const PointCloud cloud = Written("a.ply", "both");
  ASSERT_EQ(cloud.points.cols(), 12);
  EXPECT_TRUE(cloud.points.leftCols(7).isApprox(pose_.Apply(source_.points)));
  EXPECT_TRUE(cloud.points.rightCols(5).isApprox(target_.points));
  EXPECT_EQ(cloud.intensity.head(7), Eigen::VectorXf::Zero(7));
  EXPECT_EQ(cloud.intensity.tail(5), Eigen::VectorXf::Ones(5));
}

TEST_F(AlignedCloudsTest, WhatCannotBeWrittenIsToldBeforehand) {
  EXPECT_THAT(Problem({"a.txt", "source"}),
              HasSubstr("--output=a.txt: ending '.txt'"));
  EXPECT_THAT(Problem({"-", "source"}),
              HasSubstr("a cloud cannot go to standard output"));
  EXPECT_THAT(Problem({"a.ply", "target"}),
              HasSubstr("--output_clouds=target, must be source or both"));
  EXPECT_THAT(Problem({"", "both"}), HasSubstr("has no effect"));
}

}  // namespace
}  // namespace quatro::aligned_clouds_test
