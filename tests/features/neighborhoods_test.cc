// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "features/neighborhoods.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <thread>
#include <utility>

namespace quatro::neighborhoods_test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

// Row i has indices i, i + 1, .. and half of these as distances.
void Write(Eigen::Index i,
           std::size_t size,
           NeighborhoodsBuilder::Writer* writer) {
  const auto room = writer->MakeRoom(size + 10);
  for (std::size_t k = 0; k < size; ++k) {
    room.index[k] = static_cast<std::int32_t>(i + static_cast<Eigen::Index>(k));
    room.squared_distance[k] = 0.5f * static_cast<float>(room.index[k]);
  }
  writer->Add(i, size);
}

TEST(Neighborhoods, OfNoPointsAreNone) {
  EXPECT_EQ(Neighborhoods().size(), 0);
  EXPECT_EQ(NeighborhoodsBuilder(0).Finish().num_neighbors(), 0u);
}

TEST(Neighborhoods, RowsAreWhatWasWritten) {
  NeighborhoodsBuilder builder(5);
  {
    NeighborhoodsBuilder::Writer writer(&builder);
    Write(3, 2, &writer);
    Write(0, 3, &writer);
    Write(4, 0, &writer);
  }
  const Neighborhoods rows = std::move(builder).Finish();
  ASSERT_EQ(rows.size(), 5);
  EXPECT_EQ(rows.num_neighbors(), 5u);
  EXPECT_THAT(rows.row(0).index, ElementsAre(0, 1, 2));
  EXPECT_THAT(rows.row(0).squared_distance, ElementsAre(0.0f, 0.5f, 1.0f));
  EXPECT_THAT(rows.row(3).index, ElementsAre(3, 4));
  EXPECT_THAT(rows.row(1).index, IsEmpty());
  EXPECT_THAT(rows.row(4).index, IsEmpty());
}

TEST(Neighborhoods, RowsOfManyBlocksAndThreadsStayWhereTheyAre) {
  // Rows longer than the rest of a block, and one longer than any block.
  constexpr Eigen::Index kNum = 3000;
  const auto size_of = [](Eigen::Index i) {
    return i == 1500 ? std::size_t{600000} : static_cast<std::size_t>(i % 997);
  };
  NeighborhoodsBuilder builder(kNum);
  const auto write = [&](Eigen::Index first) {
    for (Eigen::Index i = first; i < kNum; i += 20) {
      NeighborhoodsBuilder::Writer writer(&builder);
      for (Eigen::Index k = i; k < std::min(i + 10, kNum); ++k) {
        Write(k, size_of(k), &writer);
      }
    }
  };
  std::thread other(write, 10);
  write(0);
  other.join();
  const Neighborhoods rows = std::move(builder).Finish();
  std::size_t sum = 0;
  for (Eigen::Index i = 0; i < kNum; ++i) {
    const Neighborhoods::Row& row = rows.row(i);
    ASSERT_EQ(row.size(), size_of(i)) << "row " << i;
    sum += row.size();
    for (std::size_t k = 0; k < row.size(); ++k) {
      ASSERT_EQ(row.index[k], i + static_cast<Eigen::Index>(k)) << "row " << i;
      ASSERT_EQ(row.squared_distance[k],
                0.5f * static_cast<float>(row.index[k]));
    }
  }
  EXPECT_EQ(rows.num_neighbors(), sum);
}

}  // namespace
}  // namespace quatro::neighborhoods_test
