// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "robust/verdict/contact.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "features/kd_tree.h"
#include "robust/verdict/overlap.h"
#include "solvers/closed_form/gravity.h"
#include "tests/support/described_clouds.h"
#include "tests/support/random_problems.h"

namespace quatro::contact_test {
namespace {

constexpr double kMaxDistance = 0.8;

class ContactTest : public ::testing::Test {
 protected:
  ContactTest() { source_normals_.col(7).setZero(); }

  static Points RandomNormals(std::uint64_t seed) {
    return RandomPoints(400, 1.0, seed).colwise().normalized();
  }

  DescribedCloud source() const {
    return MakeDescribedCloud(source_tree_.points(), source_normals_);
  }
  DescribedCloud target() const {
    return MakeDescribedCloud(target_tree_.points(), target_normals_);
  }

  const Rigid3 pose_{RotationZ(0.5), {0.3, -0.2, 0.1}};
  const KdTree source_tree_{RandomPoints(400, 3.0, 1)};
  const KdTree target_tree_{RandomPoints(400, 3.0, 2)};
  Points source_normals_ = RandomNormals(3);
  Points target_normals_ = RandomNormals(4);
};

TEST_F(ContactTest, IsTheNearestPointIfItIsNear) {
  for (const int num_threads : {1, 2}) {
    const Contacts contacts =
        FindContacts(source(), target(), pose_, kMaxDistance, num_threads);
    ASSERT_EQ(contacts.size(), 400u);
    int num_near = 0;
    for (Eigen::Index i = 0; i < 400; ++i) {
      const Eigen::Vector3d point =
          pose_ * Eigen::Vector3d(source_tree_.points().col(i));
      Eigen::Index nearest = 0;
      const double distance = (target_tree_.points().colwise() - point)
                                  .colwise()
                                  .norm()
                                  .minCoeff(&nearest);
      const bool is_near = distance <= kMaxDistance && i != 7;
      num_near += is_near;
      EXPECT_EQ(contacts[static_cast<std::size_t>(i)],
                is_near ? static_cast<std::int32_t>(nearest) : kNoContact)
          << "point " << i << ", " << distance << " m";
    }
    EXPECT_GT(num_near, 50);
    EXPECT_LT(num_near, 350);
  }
}

TEST_F(ContactTest, OfTheTargetAreThoseOfTheInverse) {
  const MutualContacts contacts =
      FindMutualContacts(source(), target(), pose_, kMaxDistance, 1);
  EXPECT_EQ(contacts.of_source,
            FindContacts(source(), target(), pose_, kMaxDistance, 1));
  EXPECT_EQ(contacts.of_target,
            FindContacts(target(), source(), Inverse(pose_), kMaxDistance, 1));
}

TEST_F(ContactTest, OfCloudsWithoutPointsAreNone) {
  const DescribedCloud empty = MakeDescribedCloud(Points(3, 0), Points(3, 0));
  EXPECT_TRUE(FindContacts(empty, target(), pose_, kMaxDistance, 1).empty());
  EXPECT_EQ(FindContacts(source(), empty, pose_, kMaxDistance, 1),
            Contacts(400, kNoContact));
}

// The evidence and the surface observability use the same contacts.
TEST_F(ContactTest, AtHandGiveTheSameStructure) {
  const auto found = FindStructure(source(), target(), pose_, kMaxDistance, 1);
  const auto given =
      FindStructure(source(),
                    target(),
                    pose_,
                    FindContacts(source(), target(), pose_, kMaxDistance, 1));
  ASSERT_EQ(found.size(), given.size());
  int num_overlapping = 0;
  for (std::size_t k = 0; k < found.size(); ++k) {
    EXPECT_EQ(found[k].index, given[k].index);
    EXPECT_EQ(found[k].nearest, given[k].nearest);
    EXPECT_EQ(found[k].is_near, given[k].is_near);
    EXPECT_EQ(found[k].is_overlapping, given[k].is_overlapping);
    num_overlapping += found[k].is_overlapping;
  }
  EXPECT_GT(num_overlapping, 10);
}

TEST(AreNormalsAligned, WithinTheAngleOrOfOpposites) {
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  const auto tilted = [](double degrees) {
    const double angle = degrees * M_PI / 180.0;
    return Eigen::Vector3d(std::sin(angle), 0.0, std::cos(angle));
  };
  EXPECT_TRUE(AreNormalsAligned(up, tilted(36.0)));
  EXPECT_FALSE(AreNormalsAligned(up, tilted(38.0)));
  EXPECT_TRUE(AreNormalsAligned(up, -tilted(36.0)));
  EXPECT_FALSE(AreNormalsAligned(up, Eigen::Vector3d::Zero()));
}

}  // namespace
}  // namespace quatro::contact_test
