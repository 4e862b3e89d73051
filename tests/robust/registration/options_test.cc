// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// No option is ignored: one that stands elsewhere is refused, and one that a
// method lists changes what the method does.

#include "robust/registration/options.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <iterator>
#include <map>
#include <optional>
#include <ostream>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "experiments/simulator/synthetic.h"
#include "robust/registration/methods.h"
#include "robust/registration/registration.h"
#include "tests/support/random_problems.h"

namespace quatro::options_test {
namespace {

using ::testing::HasSubstr;

// Values that stand once

template <typename Value>
using Fields = std::vector<std::pair<std::string, Value*>>;

Fields<double> NoiseBounds(RegistrationOptions* o) {
  return {{"quatro.noise_bound", &o->quatro.noise_bound},
          {"arc_consensus.noise_bound", &o->arc_consensus.noise_bound},
          {"consensus.noise_bound", &o->consensus.noise_bound},
          {"teaser.noise_bound", &o->teaser.noise_bound},
          {"fgr.noise_bound", &o->fgr.noise_bound},
          {"ransac.minimal.noise_bound", &o->ransac.minimal.noise_bound}};
}

Fields<std::uint64_t> Seeds(RegistrationOptions* o) {
  return {{"quatro.seed", &o->quatro.seed},
          {"arc_consensus.seed", &o->arc_consensus.seed},
          {"teaser.seed", &o->teaser.seed},
          {"ransac.seed", &o->ransac.seed},
          {"front_end.tuple.seed", &o->front_end.tuple.seed},
          {"verdict.rival.seed", &o->verdict.rival.seed}};
}

Fields<int> Threads(RegistrationOptions* o) {
  return {{"quatro.num_threads", &o->quatro.num_threads},
          {"arc_consensus.num_threads", &o->arc_consensus.num_threads},
          {"consensus.num_threads", &o->consensus.num_threads},
          {"teaser.num_threads", &o->teaser.num_threads},
          {"fgr.num_threads", &o->fgr.num_threads},
          {"ransac.num_threads", &o->ransac.num_threads},
          {"front_end.tuple.num_threads", &o->front_end.tuple.num_threads},
          {"verdict.rival.num_threads", &o->verdict.rival.num_threads},
          {"refinement.alignment.num_threads",
           &o->refinement.alignment.num_threads}};
}

// `top` names the value of the registration.
template <typename Value>
void ExpectOneOf(Fields<Value> (*fields)(RegistrationOptions*),
                 const std::string& top_name,
                 Value RegistrationOptions::*top,
                 Value other) {
  RegistrationOptions plain;
  for (std::size_t i = 0; i < fields(&plain).size(); ++i) {
    RegistrationOptions options;
    const auto [name, field] = fields(&options)[i];
    SCOPED_TRACE(name);
    *field = other;
    std::string error;
    EXPECT_FALSE(options.IsValid(&error));
    EXPECT_THAT(error, HasSubstr(name + " = "));
    EXPECT_THAT(error,
                HasSubstr("set " + top_name + " of the registration instead"));
    // The doors say so, too.
    const Points points = RandomPoints(10, 10.0, 1);
    PointCloud cloud;
    cloud.points = points;
    EXPECT_EQ(RegisterMatches({points, points}, options).error, error);
    EXPECT_EQ(Register(cloud, cloud, options).error, error);
    EXPECT_EQ(MatchClouds(cloud, cloud, options).error, error);
    EXPECT_EQ(RegisterMatched(MatchedClouds(), options).error, error);

    options.*top = other;
    EXPECT_TRUE(options.IsValid(&error)) << error;
  }
  // All are handed down from the top.
  plain.*top = other;
  std::string error;
  EXPECT_TRUE(plain.IsValid(&error)) << error;
  RegistrationOptions shared = WithSharedValues(plain);
  for (const auto& [name, field] : fields(&shared)) {
    EXPECT_EQ(*field, other) << name;
  }
  EXPECT_TRUE(shared.IsValid(&error)) << error;
}

TEST(RegistrationOptions, TheNoiseBoundStandsOnce) {
  ExpectOneOf(
      NoiseBounds, "noise_bound", &RegistrationOptions::noise_bound, 0.2);
}

TEST(RegistrationOptions, TheSeedStandsOnce) {
  ExpectOneOf(
      Seeds, "seed", &RegistrationOptions::seed, static_cast<uint64_t>(3));
}

TEST(RegistrationOptions, TheThreadsStandOnce) {
  ExpectOneOf(Threads, "num_threads", &RegistrationOptions::num_threads, 2);
}

TEST(RegistrationOptions, TheBoundsStandOnce) {
  for (const bool is_of_matches : {false, true}) {
    RegistrationOptions options;
    PoseBounds& bounds = is_of_matches ? options.verdict.rival.bounds
                                       : options.evidence.rival.bounds;
    bounds.max_yaw = 0.5;
    std::string error;
    EXPECT_FALSE(options.IsValid(&error));
    EXPECT_THAT(error, HasSubstr("rival.bounds"));
    EXPECT_THAT(error, HasSubstr("set bounds of the registration instead"));
    bounds = {};
    options.bounds.max_yaw = 0.5;
    EXPECT_TRUE(options.IsValid(&error)) << error;
  }
}

// The bounds' own vertical would be replaced without a word.
TEST(RegistrationOptions, TheVerticalOfTheBoundsIsThatOfTheIns) {
  RegistrationOptions options;
  std::string error;
  options.bounds.up = Eigen::Vector3d::UnitY();
  EXPECT_FALSE(options.IsValid(&error));
  EXPECT_EQ(error, "bounds.up = (0 1 0), set ins.up instead, which is (0 0 1)");
  options.ins.up = Eigen::Vector3d::UnitY();
  EXPECT_TRUE(options.IsValid(&error)) << error;
  options.bounds.up = PoseBounds().up;
  EXPECT_TRUE(options.IsValid(&error)) << error;
}

// Options of the methods

// Sets the field behind an option to the k-th other value. Returns false if
// there is none.
struct SetOther {
  std::size_t k;

  bool operator()(bool* field) const {
    *field = !*field;
    return k == 0;
  }
  template <typename Integer>
  bool operator()(Integer* field) const {
    const std::array<Integer, 3> values = {
        static_cast<Integer>(*field + 1), static_cast<Integer>(*field / 2), 1};
    if (k >= values.size()) return false;
    *field = values[k];
    return true;
  }
  bool operator()(double* field) const {
    const double factors[] = {0.9, 0.1, 10.0, 1e-3, 1e3, 1e-6, 1e12};
    if (k == std::size(factors)) {
      *field = 1.0;
    } else if (k > std::size(factors)) {
      return false;
    } else if (*field == 0.0 || !std::isfinite(*field)) {
      *field = factors[k];
    } else {
      *field *= factors[k];
    }
    return true;
  }
  bool operator()(Eigen::Vector3d* field) const {
    *field = Eigen::Vector3d::UnitX();
    return k == 0;
  }
  bool operator()(Rigid3* field) const {
    field->translation.x() += 1.0;
    return k == 0;
  }
  bool operator()(const AttitudeField& field) const {
    field.attitude->roll += 0.05;
    return k == 0;
  }
  bool operator()(const DegreesField& field) const {
    return (*this)(field.radians);
  }
  bool operator()(const Choice& choice) const {
    const std::size_t num = choice.names.size();
    choice.set((choice.get() + k + 1) % num);
    return k + 1 < num;
  }
};

// The problems: two scans of a street corner, and matches with many outliers.
const Rigid3& TrueMotion() {
  static const Rigid3 motion{RotationZ(0.1), {0.4, -0.2, 0.05}};
  return motion;
}

struct TwoScans {
  PointCloud source;
  PointCloud target;
};

const TwoScans& Scans() {
  static const TwoScans scans = [] {
    TwoScans two;
    two.source.points =
        Inverse(TrueMotion()).Apply(RandomStreet(3000, 0.02, 1));
    two.target.points = RandomStreet(3000, 0.02, 2);
    return two;
  }();
  return scans;
}

const MatchedProblem& HardMatches() {
  static const MatchedProblem problem = MakeOutlierProblem(150, 0.8, 0.1, 5);
  return problem;
}

// Matches of which GNC without pruning misses the best yaw.
const MatchedProblem& MissedMatches() {
  static const MatchedProblem problem = [] {
    QuatroOptions options;
    options.pruning = Pruning::kNone;
    options.tim_layout = TimLayout::kRandom;
    for (std::uint64_t seed = 0;; ++seed) {
      const MatchedProblem drawn = MakeOutlierProblem(300, 0.94, 0.1, seed);
      const auto certificate =
          SolveQuatro(drawn.source, drawn.target, options).certificate;
      if (seed == 20) ADD_FAILURE() << "too easy";
      if (seed == 20 || (certificate && certificate->gap.value_or(0.0) > 0.1)) {
        return drawn;
      }
    }
  }();
  return problem;
}

// Few draws, which are enough here.
RegistrationOptions BaseOptions(const Method& method) {
  RegistrationOptions options;
  options.method = method.name;
  options.arc_consensus.num_pairs = 20'000;
  options.verdict.rival.num_pairs = 2'000;
  options.bounds.guess = TrueMotion();
  options.bounds.guess.rotation *=
      RotationZ(0.03) *
      Eigen::AngleAxisd(0.05, Eigen::Vector3d::UnitX()).toRotationMatrix();
  options.bounds.guess.translation.y() += 0.1;
  if (method.ins == InsUse::kNeeded) options.ins.mode = InsMode::kLeveled;
  return options;
}

void Write(const std::optional<Rigid3>& pose, std::ostream* out) {
  if (pose) *out << pose->ToMatrix() << "\n";
}

// All that a registration tells except for times.
std::string ToText(const RegistrationSummary& summary) {
  std::ostringstream out;
  out.precision(17);
  const Verdict& verdict = summary.verdict;
  out << summary.error << "\n"
      << StatusName(verdict.status) << " " << verdict.reason << " "
      << verdict.probability << " " << verdict.num_inliers << "\n";
  if (verdict.rival) out << "rival " << verdict.rival->num_inliers << "\n";
  if (verdict.geometry) out << verdict.geometry->structure_overlap << "\n";
  const PoseSummary& solution = summary.solution;
  out << solution.message << " " << solution.scale << " "
      << solution.num_matches << " " << solution.num_consistent << " "
      << solution.num_tims << " " << solution.num_rotation_inliers << " "
      << solution.num_translation_inliers << " "
      << solution.crosscheck.has_value() << " " << solution.vertical.has_value()
      << "\n";
  Write(solution.target_from_source, &out);
  Write(solution.unpolished_target_from_source, &out);
  for (const Eigen::Index i : solution.translation_inliers) out << i << " ";
  for (const double weight : solution.match_weights) out << weight << " ";
  for (const StageNote& note : solution.notes) out << note.text << "\n";
  if (solution.covariance && solution.covariance->covariance) {
    out << *solution.covariance->covariance << "\n";
  }
  out << "rung " << summary.rung << "\n";
  for (const PoseCandidate& candidate : summary.candidates) {
    out << candidate.origin << " " << candidate.Score() << "\n";
  }
  if (!summary.refinement) return out.str();
  out << RefinementName(summary.refinement->method) << " "
      << summary.refinement->message << "\n";
  Write(summary.refinement->unrefined_target_from_source, &out);
  return out.str();
}

std::string ToText(const MatchedClouds& clouds) {
  std::ostringstream out;
  out.precision(17);
  out << clouds.error << clouds.mutual_matches.size() << "\n"
      << clouds.matched_source << "\n"
      << clouds.matched_target;
  return out.str();
}

// The runs in which an option may show, the fastest first. Each is empty for a
// method that it does not suit.
using RunOf = std::string (*)(const Method&, const RegistrationOptions&);

std::string RunMatches(const Method& method,
                       const RegistrationOptions& options) {
  if (method.input != MethodInput::kMatches ||
      options.refinement.method != RefinementMethod::kNone) {
    return {};
  }
  const MatchedProblem& problem = options.quatro.pruning == Pruning::kNone
                                      ? MissedMatches()
                                      : HardMatches();
  return ToText(RegisterMatches({problem.source, problem.target}, options));
}

std::string RunFrontEnd(const Method& method,
                        const RegistrationOptions& options) {
  if (method.input == MethodInput::kClouds) return {};
  return ToText(MatchClouds(Scans().source, Scans().target, options));
}

std::string RunScans(const Method& method, const RegistrationOptions& options) {
  if (method.input == MethodInput::kClouds) {
    return ToText(Register(Scans().source, Scans().target, options));
  }
  static const MatchedClouds clouds =
      MatchClouds(Scans().source, Scans().target, RegistrationOptions());
  return ToText(RegisterMatched(clouds, options));
}

// What must be set, too, for an option to have an effect: "name=value".
const std::multimap<std::string, std::string>& Needed() {
  static const std::multimap<std::string, std::string> needed = {
      {"quatro.max_tilt", "consistency_test=planar_and_height"},
      {"num_random_tims", "tim_layout=random"},
      {"num_scale_tims", "estimate_scale=on"},
      {"replace_missed_optimum", "pruning=none"},
      {"replace_missed_optimum", "tim_layout=random"},
      {"certificate_tolerance", "pruning=none"},
      {"certificate_tolerance", "tim_layout=random"},
      {"edge_test", "local_optimization=off"},
      {"edge_test", "noise_bound=3"},
      {"edge_test", "max_iterations=3"},
      {"quatro.consistency_test", "max_rung=0"},
      {"quatro.max_tilt", "max_rung=0"},
      {"max_rung", "min_probability=1"},
      {"max_num_proposals", "min_probability=1"},
      {"num_aligned", "min_probability=1"},
      {"search_max_tilt", "min_probability=1"},
      {"bound_factor", "min_probability=1"},
      {"consensus", "min_probability=1"},
      {"cliques", "min_probability=1"},
      {"segments", "min_probability=1"},
      {"geometric_choice", "min_probability=1"},
      {"guided_matching", "min_probability=1"},
      {"refine_max_translation", "refine=gicp"},
      {"refine_max_rotation", "refine=gicp"},
      {"ins_mode", "source_rpy=0.01,0.02,0"},
      {"source_rpy", "ins_mode=leveled"},
      {"target_rpy", "ins_mode=leveled"},
      {"attitude_std", "ins_mode=fused"},
      {"match_std", "ins_mode=fused"},
      {"guess", "max_translation=0.3"},
      {"max_tilt_deg", "max_translation=0.5"}};
  return needed;
}

// Options that change nothing here, and why.
struct Exception {
  std::string option;
  std::vector<std::string> methods;  // Empty: all.
  std::string reason;
};

const std::vector<Exception>& Exceptions() {
  static const std::vector<Exception> exceptions = {
      {"num_threads", {}, "never changes the answer, see below"},
      {"clique_time_limit_seconds", {}, "a clique of so few takes no time"},
      {"search_time_limit_seconds", {}, "see ladder_test.cc"},
      {"max_tilt", {"ransac"}, "rejects samples, see minimal_pose_test.cc"},
      {"replace_missed_optimum", {"quatro_c2f"}, "as quatro's"},
      {"certificate_tolerance", {"quatro_c2f"}, "as quatro's"}};
  return exceptions;
}

bool IsExcepted(const Method& method, const std::string& option) {
  for (const Exception& exception : Exceptions()) {
    if (exception.option != option) continue;
    if (exception.methods.empty()) return true;
    for (const std::string& name : exception.methods) {
      if (name == method.name) return true;
    }
  }
  return false;
}

void Set(const Method& method,
         const std::string& name_and_value,
         RegistrationOptions* options) {
  const std::size_t equals = name_and_value.find('=');
  bool is_set = false;
  for (const Option& option : OptionsOf(method, true, options)) {
    if (option.name != name_and_value.substr(0, equals)) continue;
    std::string error;
    EXPECT_TRUE(option.Parse(name_and_value.substr(equals + 1), &error))
        << error;
    is_set = true;
  }
  // quatro_c2f defines its refinement, and quatro_single does not search.
  EXPECT_TRUE(is_set || method.input == MethodInput::kMatchedClouds ||
              !method.searches)
      << method.name << " has no " << name_and_value;
}

void SetNeeded(const Method& method,
               const std::string& name,
               RegistrationOptions* options) {
  std::string family = method.name;
  if (method.options == QuatroOptionList ||
      method.options == QuatroExactOptionList) {
    family = "quatro";
  }
  for (const std::string& key : {name, family + "." + name}) {
    const auto [begin, end] = Needed().equal_range(key);
    for (auto it = begin; it != end; ++it) Set(method, it->second, options);
  }
}

// What an error calls the option: the name of its field.
std::string FieldName(std::string_view name) {
  for (const std::string_view prefix :
       {"refine_", "gnc_", "clique_", "search_"}) {
    if (name.starts_with(prefix)) name.remove_prefix(prefix.size());
  }
  if (name == "tuple_scale") return "tuple_test.scale";
  if (name.ends_with("_deg")) name.remove_suffix(4);
  return std::string(name);
}

class MethodOptions : public ::testing::TestWithParam<std::string> {
 protected:
  MethodOptions() {
    std::string error;
    method_ = FindMethod(GetParam(), &error);
  }

  // Whether any other value of the i-th option shows in the run.
  bool Shows(RunOf run, std::size_t i, const RegistrationOptions& base) {
    std::string before;
    for (std::size_t k = 0;; ++k) {
      RegistrationOptions options = base;
      const Option option = OptionsOf(*method_, true, &options)[i];
      if (!std::visit(SetOther{k}, option.field)) return false;
      std::string error;
      if (!options.IsValid(&error)) {
        EXPECT_THAT(error, HasSubstr(FieldName(option.name)));
        continue;
      }
      if (k == 0 || before.empty()) before = run(*method_, base);
      if (before.empty()) return false;  // Does not suit the method.
      const std::string after = run(*method_, options);
      if (!after.empty() && after != before) return true;
    }
  }

  const Method* method_ = nullptr;
};

TEST_P(MethodOptions, NoneIsIgnored) {
  RegistrationOptions named;
  const OptionList list = OptionsOf(*method_, true, &named);
  int num_checked = 0;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const std::string& name = list[i].name;
    if (IsExcepted(*method_, name)) continue;
    ++num_checked;
    RegistrationOptions base = BaseOptions(*method_);
    SetNeeded(*method_, name, &base);
    std::string error;
    ASSERT_TRUE(base.IsValid(&error)) << error;
    EXPECT_TRUE(Shows(RunMatches, i, base) || Shows(RunScans, i, base) ||
                Shows(RunFrontEnd, i, base))
        << "option " << name << " of " << GetParam() << " changes nothing";
  }
  EXPECT_GE(num_checked, 5);
}

TEST_P(MethodOptions, TheNumberOfThreadsChangesNothing) {
  const RegistrationOptions one = BaseOptions(*method_);
  RegistrationOptions two = one;
  two.num_threads = 2;
  for (const RunOf run : {RunMatches, RunScans, RunFrontEnd}) {
    EXPECT_EQ(run(*method_, one), run(*method_, two));
  }
}

std::vector<std::string> AllMethodNames() {
  std::vector<std::string> names;
  for (const Method& method : Methods()) names.emplace_back(method.name);
  return names;
}

INSTANTIATE_TEST_SUITE_P(Registry,
                         MethodOptions,
                         ::testing::ValuesIn(AllMethodNames()),
                         [](const auto& method) { return method.param; });

}  // namespace
}  // namespace quatro::options_test
