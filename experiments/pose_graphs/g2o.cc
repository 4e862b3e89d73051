// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/pose_graphs/g2o.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "experiments/pose_graphs/information.h"
#include "features/base/cloud_text.h"
#include "features/base/file.h"

namespace quatro {
namespace {

constexpr double kUnitTolerance = 0.02;  // Quaternions of two digits.

// Larger numbers make infinite costs.
constexpr double kMaxPoseValue = 1e9;  // [m] or [rad]
constexpr double kMaxInformation = 1e18;

int NumPoseValues(int dimension) { return dimension == 2 ? 3 : 7; }
int NumFreedoms(int dimension) { return dimension == 2 ? 3 : 6; }

// Reads the words of one line. The first problem is kept and stops further
// reading.
class LineReader {
 public:
  LineReader(std::string_view line, std::string* problem)
      : line_(line), problem_(problem) {}

  std::int64_t Id(const char* name) {
    const std::string_view word = TakeWord(&line_);
    const auto id = ParseCount(word);
    if (!id || *id > INT64_MAX) {
      Refuse(std::string(name) + " " + Quoted(word) + " is not an id");
      return 0;
    }
    return static_cast<std::int64_t>(*id);
  }

  bool HasMore() const { return !Trim(line_).empty(); }

  Eigen::VectorXd Numbers(int count, double largest) {
    Eigen::VectorXd numbers = Eigen::VectorXd::Zero(count);
    for (int i = 0; i < count && problem_->empty(); ++i) {
      const std::string_view word = TakeWord(&line_);
      const auto number = ParseNumber(word);
      if (word.empty()) {
        Refuse("ends before number " + std::to_string(i + 1) + " of " +
               std::to_string(count));
      } else if (!number || !std::isfinite(*number)) {
        Refuse(Quoted(word) + (number ? " is not finite" : " is not a number"));
      } else if (std::abs(*number) > largest) {
        Refuse(Quoted(word) + " is too large, must be within " +
               (largest == kMaxPoseValue ? "+-1e9 m or rad" : "+-1e18"));
      } else {
        numbers[i] = *number;
      }
    }
    return numbers;
  }

  Rigid3 Pose(int dimension) {
    const Eigen::VectorXd v = Numbers(NumPoseValues(dimension), kMaxPoseValue);
    if (!problem_->empty()) return {};
    if (dimension == 2) return {RotationZ(v[2]), {v[0], v[1], 0.0}};
    Eigen::Quaterniond q(v[6], v[3], v[4], v[5]);
    if (std::abs(q.norm() - 1.0) > kUnitTolerance) {
      Refuse("quaternion has length " + std::to_string(q.norm()) +
             ", must be 1 to 2 %");
      return {};
    }
    q.normalize();
    return {q.toRotationMatrix(), v.head<3>()};
  }

  Eigen::MatrixXd Information(int dimension) {
    const int n = NumFreedoms(dimension);
    const Eigen::VectorXd v = Numbers(n * (n + 1) / 2, kMaxInformation);
    Eigen::MatrixXd information(n, n);
    for (int row = 0, k = 0; row < n; ++row) {
      for (int column = row; column < n; ++column, ++k) {
        information(row, column) = information(column, row) = v[k];
      }
    }
    if (!problem_->empty()) return information;
    if (information.isZero(0)) {
      Refuse("information is zero, so the edge measures nothing; remove it");
    } else if (!RootOfInformation(information)) {
      Refuse("information is not positive semi-definite");
    }
    return information;
  }

  void End() {
    const std::string_view word = TakeWord(&line_);
    if (!word.empty())
      Refuse("has unexpected text at its end: " + Quoted(word));
  }

  void Refuse(const std::string& why) {
    if (problem_->empty()) *problem_ = why;
  }

 private:
  std::string_view line_;
  std::string* problem_;
};

// The ids that a line names, resolved once all poses are known.
struct Reference {
  int line_number;
  std::int64_t from, to;
};

class G2oReader {
 public:
  std::optional<PoseGraph> Read(std::string_view text, std::string* error) {
    int line_number = 0;
    while (!text.empty()) {
      ++line_number;
      ReadLine(TakeLine(&text), line_number);
      if (!problem_.empty()) {
        *error = "line " + std::to_string(line_number) + ": " + problem_;
        return std::nullopt;
      }
    }
    const bool has_only_edges = graph_.ids.empty();
    if (has_only_edges) AddPosesOfEdges();
    if (graph_.ids.empty()) {
      *error = "has no poses";
      return std::nullopt;
    }
    SortPoses();
    for (std::size_t i = 0; i < ends_.size(); ++i) {
      PoseEdge& edge = graph_.edges[i];
      if (!Find(ends_[i].from, ends_[i].line_number, &edge.from, error) ||
          !Find(ends_[i].to, ends_[i].line_number, &edge.to, error)) {
        return std::nullopt;
      }
    }
    for (const Reference& fix : fixed_) {
      graph_.fixed.emplace_back();
      if (!Find(fix.from, fix.line_number, &graph_.fixed.back(), error)) {
        return std::nullopt;
      }
    }
    if (has_only_edges) ChainOdometry(&graph_);
    return std::move(graph_);
  }

 private:
  void AddPosesOfEdges() {
    for (const Reference& edge : ends_) {
      for (const std::int64_t id : {edge.from, edge.to}) {
        if (index_.emplace(id, graph_.ids.size()).second) {
          graph_.ids.push_back(id);
        }
      }
    }
    graph_.world_from_pose.resize(graph_.ids.size());
  }

  // By id, so that the order of lines does not decide what is odometry.
  void SortPoses() {
    std::sort(graph_.ids.begin(), graph_.ids.end());
    std::vector<Rigid3> poses;
    for (std::size_t i = 0; i < graph_.ids.size(); ++i) {
      std::size_t& index = index_.at(graph_.ids[i]);
      poses.push_back(graph_.world_from_pose[index]);
      index = i;
    }
    graph_.world_from_pose = std::move(poses);
  }

  void ReadLine(std::string_view line, int line_number) {
    const std::string_view tag = TakeWord(&line);
    LineReader reader(line, &problem_);
    if (tag.empty() || tag.starts_with('#')) return;
    if (tag == "FIX") {
      do {
        fixed_.push_back({line_number, reader.Id("pose"), 0});
      } while (problem_.empty() && reader.HasMore());
    } else if (tag == "VERTEX_SE2" || tag == "VERTEX_SE3:QUAT") {
      TakeDimension(tag == "VERTEX_SE2" ? 2 : 3, &reader);
      const std::int64_t id = reader.Id("pose");
      const Rigid3 pose = reader.Pose(graph_.dimension);
      if (!index_.emplace(id, graph_.ids.size()).second) {
        reader.Refuse("pose " + std::to_string(id) + " was defined before");
      }
      graph_.ids.push_back(id);
      graph_.world_from_pose.push_back(pose);
    } else if (tag == "EDGE_SE2" || tag == "EDGE_SE3:QUAT") {
      TakeDimension(tag == "EDGE_SE2" ? 2 : 3, &reader);
      const std::int64_t from = reader.Id("from");
      const std::int64_t to = reader.Id("to");
      if (from == to) reader.Refuse("edge from a pose to itself");
      ends_.push_back({line_number, from, to});
      PoseEdge edge;
      edge.from_from_to = reader.Pose(graph_.dimension);
      edge.information = reader.Information(graph_.dimension);
      graph_.edges.push_back(std::move(edge));
    } else {
      reader.Refuse(Quoted(tag) + " is not a known tag");
    }
    reader.End();
  }

  void TakeDimension(int dimension, LineReader* reader) {
    if (has_dimension_ && dimension != graph_.dimension) {
      reader->Refuse("SE2 and SE3 in one file");
    }
    graph_.dimension = dimension;
    has_dimension_ = true;
  }

  bool Find(std::int64_t id,
            int line_number,
            std::size_t* index,
            std::string* error) const {
    const auto found = index_.find(id);
    if (found == index_.end()) {
      *error = "line " + std::to_string(line_number) + ": there is no pose " +
               std::to_string(id);
      return false;
    }
    *index = found->second;
    return true;
  }

  std::string problem_;
  PoseGraph graph_;
  bool has_dimension_ = false;
  std::unordered_map<std::int64_t, std::size_t> index_;
  std::vector<Reference> ends_;
  std::vector<Reference> fixed_;
};

void Append(double value, std::string* text) {
  std::array<char, 32> number;
  const auto end =
      std::to_chars(number.data(), number.data() + number.size(), value);
  *text += ' ';
  text->append(number.data(), end.ptr);
}

void AppendPose(const Rigid3& pose, int dimension, std::string* text) {
  for (int i = 0; i < dimension; ++i) Append(pose.translation[i], text);
  if (dimension == 2) {
    Append(Yaw(pose.rotation), text);
    return;
  }
  const Eigen::Quaterniond q(pose.rotation);
  for (const double x : {q.x(), q.y(), q.z(), q.w()}) Append(x, text);
}

}  // namespace

std::optional<PoseGraph> ReadG2o(const std::string& path, std::string* error) {
  const std::optional<std::string> text = ReadTextFile(path, error);
  if (!text) return std::nullopt;
  auto graph = G2oReader().Read(*text, error);
  if (!graph) *error = path + ": " + *error;
  return graph;
}

std::string FormatG2o(const PoseGraph& graph) {
  const bool is_planar = graph.dimension == 2;
  std::string text;
  for (std::size_t i = 0; i < graph.ids.size(); ++i) {
    text += (is_planar ? "VERTEX_SE2 " : "VERTEX_SE3:QUAT ") +
            std::to_string(graph.ids[i]);
    AppendPose(graph.world_from_pose[i], graph.dimension, &text);
    text += '\n';
  }
  for (const std::size_t i : graph.fixed) {
    text += "FIX " + std::to_string(graph.ids[i]) + "\n";
  }
  for (const PoseEdge& edge : graph.edges) {
    text += (is_planar ? "EDGE_SE2 " : "EDGE_SE3:QUAT ") +
            std::to_string(graph.ids[edge.from]) + " " +
            std::to_string(graph.ids[edge.to]);
    AppendPose(edge.from_from_to, graph.dimension, &text);
    for (Eigen::Index row = 0; row < edge.information.rows(); ++row) {
      for (Eigen::Index column = row; column < edge.information.cols();
           ++column) {
        Append(edge.information(row, column), &text);
      }
    }
    text += '\n';
  }
  return text;
}

}  // namespace quatro
