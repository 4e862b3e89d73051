// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/pose_graphs/g2o.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "experiments/pose_graphs/pose_graph_worlds.h"
#include "tests/support/run_program.h"

namespace quatro::g2o_test {
namespace {

using ::testing::HasSubstr;

constexpr char kPlanar[] =
    "# made by hand\n"
    "EDGE_SE2 7 9 1 2 0.5  4 0.1 0.2 5 0.3 6\n"
    "VERTEX_SE2 7 0 0 0\n"
    "\n"
    "VERTEX_SE2 9 1e0 -2.5 3\r\n"
    "FIX 9\n";

class G2oTest : public ProgramTest {
 protected:
  std::optional<PoseGraph> ReadText(const std::string& text) {
    return ReadG2o(Write("graph.g2o", text), &error_);
  }

  // Expects one line that names the file and contains `why`.
  void ExpectRefused(const std::string& text, const std::string& why) {
    EXPECT_FALSE(ReadText(text).has_value()) << text;
    EXPECT_THAT(error_, HasSubstr(PathOf("graph.g2o") + ": "));
    EXPECT_THAT(error_, HasSubstr(why));
    EXPECT_EQ(error_.find('\n'), std::string::npos);
  }

  std::string error_;
};

TEST_F(G2oTest, ReadsWhatIsThere) {
  const auto graph = ReadText(kPlanar);
  ASSERT_TRUE(graph.has_value()) << error_;
  EXPECT_EQ(graph->dimension, 2);
  EXPECT_EQ(graph->ids, (std::vector<std::int64_t>{7, 9}));
  EXPECT_EQ(graph->fixed, (std::vector<std::size_t>{1}));
  EXPECT_EQ(graph->world_from_pose[1].translation,
            Eigen::Vector3d(1.0, -2.5, 0.0));
  EXPECT_NEAR(Yaw(graph->world_from_pose[1].rotation), 3.0, 1e-15);
  ASSERT_EQ(graph->edges.size(), 1u);
  EXPECT_EQ(graph->edges[0].from, 0u);
  EXPECT_EQ(graph->edges[0].to, 1u);
  EXPECT_NEAR(Yaw(graph->edges[0].from_from_to.rotation), 0.5, 1e-15);
  Eigen::Matrix3d information;
  information << 4.0, 0.1, 0.2, 0.1, 5.0, 0.3, 0.2, 0.3, 6.0;
  EXPECT_EQ(graph->edges[0].information, information);
}

TEST_F(G2oTest, ReadsPosesInSpaceWithQuaternionsLastPartLast) {
  const auto graph = ReadText("VERTEX_SE3:QUAT 0 1 2 3 0 0 0.6 0.8\n");
  ASSERT_TRUE(graph.has_value()) << error_;
  EXPECT_EQ(graph->dimension, 3);
  EXPECT_NEAR(Yaw(graph->world_from_pose[0].rotation),
              2.0 * std::atan2(0.6, 0.8),
              1e-15);
  EXPECT_EQ(graph->world_from_pose[0].translation, Eigen::Vector3d(1, 2, 3));
}

TEST_F(G2oTest, FixMayNameSeveralPoses) {
  const std::string poses = "VERTEX_SE2 3 0 0 0\nVERTEX_SE2 4 1 0 0\n";
  const auto graph = ReadText("FIX 4 3 \n" + poses);
  ASSERT_TRUE(graph.has_value()) << error_;
  EXPECT_EQ(graph->fixed, (std::vector<std::size_t>{1, 0}));
  ExpectRefused(poses + "FIX 3 5\n", "line 3: there is no pose 5");
  ExpectRefused(poses + "FIX 3 x\n", "line 3: pose 'x' is not an id");
  ExpectRefused(poses + "FIX\n", "line 3: pose '' is not an id");
}

TEST_F(G2oTest, OrderOfLinesAndDirectionDoNotDecideWhatIsOdometry) {
  const std::string loop = "EDGE_SE2 0 2 5 0 0 1 0 0 1 0 1\n";
  const std::string forth =
      "EDGE_SE2 0 1 1 0 0.5 1 0 0 1 0 1\nEDGE_SE2 1 2 1 0 0 1 0 0 1 0 1\n";
  // The inverses of these edges; that of (1, 0, 0) is (-1, 0, 0).
  const std::string back =
      "EDGE_SE2 1 0 -0.8775825618903728 0.479425538604203 -0.5 1 0 0 1 0 1\n"
      "EDGE_SE2 2 1 -1 0 0 1 0 0 1 0 1\n";
  for (const std::string poses :
       {"",
        "VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 7 0 0\nVERTEX_SE2 2 8 0 0\n",
        "VERTEX_SE2 2 8 0 0\nVERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 7 0 0\n"}) {
    for (const std::string& edges :
         {forth + loop, loop + forth, loop + back, back + loop}) {
      auto graph = ReadText(poses + edges);
      ASSERT_TRUE(graph.has_value()) << error_;
      EXPECT_EQ(graph->ids, (std::vector<std::int64_t>{0, 1, 2}));
      for (const PoseEdge& edge : graph->edges) {
        EXPECT_EQ(edge.IsOdometry(), edge.from + edge.to != 2);
      }
      if (!poses.empty()) {
        EXPECT_EQ(graph->world_from_pose[1].translation.x(), 7.0);
        ChainOdometry(&*graph);
      }
      // A graph without poses has been chained by the reader.
      const Rigid3& last = graph->world_from_pose[2];
      EXPECT_NEAR(last.translation.x(), 1.0 + std::cos(0.5), 1e-12) << edges;
      EXPECT_NEAR(last.translation.y(), std::sin(0.5), 1e-12) << edges;
    }
  }
}

TEST_F(G2oTest, QuaternionsOfTwoDigitsAreNormalized) {
  const auto graph = ReadText("VERTEX_SE3:QUAT 0 1 2 3 0 0 0.71 0.71\n");
  ASSERT_TRUE(graph.has_value()) << error_;
  EXPECT_LE(
      AngleBetween(graph->world_from_pose[0].rotation, RotationZ(0.5 * M_PI)),
      1e-14);
  EXPECT_TRUE(graph->world_from_pose[0].rotation.isUnitary(1e-14));
}

TEST_F(G2oTest, WhatIsWrittenIsReadBack) {
  for (const char* name : {"manhattan", "sphere"}) {
    GraphWorldOptions options;
    options.world = name;
    options.num_poses = 60;
    options.num_loops = 10;
    const auto world = MakeGraphWorld(options, &error_);
    ASSERT_TRUE(world.has_value()) << error_;
    const PoseGraph& graph = world->graph;
    const std::string text = FormatG2o(graph);
    const auto read = ReadText(text);
    ASSERT_TRUE(read.has_value()) << error_;
    EXPECT_EQ(read->ids, graph.ids);
    EXPECT_EQ(read->fixed, graph.fixed);
    ASSERT_EQ(read->edges.size(), graph.edges.size());
    for (std::size_t i = 0; i < graph.edges.size(); ++i) {
      EXPECT_EQ(read->edges[i].from, graph.edges[i].from);
      EXPECT_EQ(read->edges[i].to, graph.edges[i].to);
      EXPECT_EQ(read->edges[i].information, graph.edges[i].information);
      EXPECT_EQ(read->edges[i].from_from_to.translation,
                graph.edges[i].from_from_to.translation);
      EXPECT_LE(AngleBetween(read->edges[i].from_from_to.rotation,
                             graph.edges[i].from_from_to.rotation),
                1e-14);
    }
  }
}

TEST_F(G2oTest, RefusesWhatItDoesNotKnow) {
  ExpectRefused("", "has no poses");
  ExpectRefused("# nothing\n\n", "has no poses");
  ExpectRefused("VERTEX_SE2 0 0 0 0\nVERTEX_XY 1 0 0\n",
                "line 2: 'VERTEX_XY' is not a known tag");
  ExpectRefused("VERTEX_SE2 a 0 0 0\n", "line 1: pose 'a' is not an id");
  ExpectRefused("VERTEX_SE2 -1 0 0 0\n", "'-1' is not an id");
  ExpectRefused("VERTEX_SE2 1.5 0 0 0\n", "'1.5' is not an id");
  ExpectRefused("VERTEX_SE2 99999999999999999999 0 0 0\n", "is not an id");
  ExpectRefused("VERTEX_SE2 0 0 0\n", "line 1: ends before number 3 of 3");
  ExpectRefused("VERTEX_SE2 0 0 0 0 0\n", "unexpected text at its end: '0'");
  ExpectRefused("VERTEX_SE2 0 0 x 0\n", "'x' is not a number");
  ExpectRefused("VERTEX_SE2 0 0 nan 0\n", "'nan' is not finite");
  ExpectRefused("VERTEX_SE2 0 inf 0 0\n", "'inf' is not finite");
  ExpectRefused("VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 0 1e300 0\n",
                "line 2: '1e300' is too large, must be within +-1e9 m or rad");
  ExpectRefused("VERTEX_SE2 0 0 0 0\nVERTEX_SE2 0 1 0 0\n",
                "line 2: pose 0 was defined before");
  ExpectRefused("VERTEX_SE2 0 0 0 0\nVERTEX_SE3:QUAT 1 0 0 0 0 0 0 1\n",
                "line 2: SE2 and SE3 in one file");
  ExpectRefused("VERTEX_SE3:QUAT 1 0 0 0 0 0 0 0\n", "quaternion has length");
  ExpectRefused("VERTEX_SE3:QUAT 1 0 0 0 0 0 0 1.03\n",
                "quaternion has length 1.030000, must be 1 to 2 %");
  ExpectRefused("VERTEX_SE2 0 0 0 0\nFIX 1\n", "line 2: there is no pose 1");
  ExpectRefused("VERTEX_SE2 0 0 0 0\nEDGE_SE2 0 1 0 0 0 1 0 0 1 0 1\n",
                "line 2: there is no pose 1");
  ExpectRefused("VERTEX_SE2 0 0 0 0\nEDGE_SE2 0 0 0 0 0 1 0 0 1 0 1\n",
                "line 2: edge from a pose to itself");
  const std::string poses = "VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 0 0 0\n";
  ExpectRefused(poses + "EDGE_SE2 0 1 0 0 0 1 0 0 1 0\n",
                "line 3: ends before number 6 of 6");
  ExpectRefused(poses + "EDGE_SE2 0 1 0 0 0 1 0 0 -1 0 1\n",
                "line 3: information is not positive semi-definite");
  ExpectRefused(poses + "EDGE_SE2 0 1 0 0 0 1e300 0 0 1 0 1\n",
                "line 3: '1e300' is too large, must be within +-1e18");
  ExpectRefused(poses + "EDGE_SE2 0 1 0 0 0 0 0 0 0 0 0\n",
                "line 3: information is zero, so the edge measures nothing");
  ExpectRefused(poses + "EDGE_SE2 0 1 0 0 0 0 0.1 0 1 0 1\n",
                "line 3: information is not positive semi-definite");
  ExpectRefused(poses + "EDGE_SE2 0 1 0 0 0 1 1.001 0 1 0 1\n",
                "line 3: information is not positive semi-definite");
}

// Edges that measure some freedoms only, and a matrix of rank one whose numbers
// are rounded to six digits.
TEST_F(G2oTest, ReadsInformationThatIsSemiDefinite) {
  for (const char* information : {"4 0 0 5 0 0",
                                  "0 0 0 0 0 6",
                                  "1 0.333333 0.142857 0.111111 0.047619 "
                                  "0.0204082"}) {
    const std::string edge = std::string("EDGE_SE2 0 1 1 2 0.5 ") + information;
    const auto graph =
        ReadText("VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 1 0 0\n" + edge + "\n");
    ASSERT_TRUE(graph.has_value()) << error_;
    EXPECT_THAT(FormatG2o(*graph), HasSubstr(information));
  }
}

TEST_F(G2oTest, MissingFileIsNamed) {
  EXPECT_FALSE(ReadG2o(PathOf("none.g2o"), &error_).has_value());
  EXPECT_THAT(error_, HasSubstr("No such file"));
}

// A file truncated anywhere gives a graph or a one-line error.
TEST_F(G2oTest, CutAnywhereDoesNotCrash) {
  const std::string text = kPlanar;
  for (std::size_t length = 0; length < text.size(); ++length) {
    const auto graph = ReadText(text.substr(0, length));
    EXPECT_TRUE(graph.has_value() || !error_.empty());
  }
}

}  // namespace
}  // namespace quatro::g2o_test
