// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The Python module. Input that the library rejects raises ValueError with the
// library's text. Other Python threads run during the computation.

#include <pybind11/pybind11.h>
#include <quatro/version.h>

#include <optional>
#include <string>
#include <utility>

#include "features/base/stopwatch.h"
#include "features/io/cloud_io.h"
#include "python/arrays.h"
#include "python/methods.h"
#include "python/options.h"
#include "python/summaries.h"
#include "robust/registration/presets.h"
#include "robust/verdict/summary_covariance.h"
#include "solvers/local/gicp.h"
#include "solvers/local/icp.h"
#include "solvers/local/vgicp.h"

namespace quatro {
namespace {

namespace py = pybind11;

// Rejects an attitude without a mode, which would be ignored, and a mode
// without attitudes.
void CheckIns(const py::dict& options, InsMode mode) {
  for (const char* name : {"source_rpy", "target_rpy"}) {
    if (options.contains(name) == (mode != InsMode::kNone)) continue;
    throw py::value_error(std::string(name) +
                          (mode == InsMode::kNone
                               ? " is given, but ins_mode is none"
                               : " is missing, but ins_mode needs it"));
  }
}

void Append(OptionList more, OptionList* list) {
  list->insert(list->end(), more.begin(), more.end());
}

// The input of solve() and register() except for points.
struct Given {
  EstimatorOptions estimator;
  RegistrationOptions registration;

  // The options for matched points and, with clouds, those of the front end.
  OptionList Options(const Method& method, bool has_clouds) {
    QuatroOptions& common = estimator.quatro;
    OptionList list = {
        MakeOption("noise_bound",
                   "[m], > 0, largest error of an inlier.",
                   &common.noise_bound),
        MakeOption("seed", ">= 0, random seed.", &common.seed),
        MakeOption("num_threads",
                   "0: one per core. Does not affect the result.",
                   &common.num_threads),
        MakeOption("min_probability",
                   "In [0, 1], of a registered pose.",
                   &registration.verdict.min_probability)};
    if (has_clouds) {
      Append(OptionsOf(&registration.front_end), &list);
      Append(OptionsOf(&registration.refinement), &list);
    }
    Append(method.options(&estimator), &list);
    if (method.takes_ins) Append(OptionsOf(&registration.ins), &list);
    return list;
  }

  void Set(const RegistrationOptions& preset) {
    registration = preset;
    estimator.quatro = preset.quatro;
    estimator.quatro.num_threads = 0;
  }

  void Read(const Method& method,
            bool has_clouds,
            const py::dict& options,
            const std::string& function) {
    Apply(options,
          Options(method, has_clouds),
          function + "(method=\"" + method.name + "\")");
    CheckIns(options, registration.ins.mode);
    estimator.ShareCommon();
    registration.quatro = estimator.quatro;
    registration.seed = estimator.quatro.seed;
    registration.num_threads = estimator.quatro.num_threads;
    std::string error;
    if (!method.is_valid(estimator, &error) || !registration.IsValid(&error)) {
      throw py::value_error(error);
    }
  }
};

RegistrationOptions FindPreset(const std::string& name,
                               const char* further_name) {
  const auto preset = MakePreset(name);
  if (preset) return *preset;
  std::string error = "preset = \"" + name + "\", must be one of ";
  for (const std::string& known : PresetNames()) error += known + ", ";
  if (further_name == nullptr) error.resize(error.size() - 2);
  throw py::value_error(error + (further_name ? further_name : ""));
}

Registration RegisterClouds(const py::object& source,
                            const py::object& target,
                            const std::string& preset,
                            const std::string& method_name,
                            const py::kwargs& options) {
  const Method& method = FindMethod(method_name);
  const PointsArgument source_points(source, "source");
  const PointsArgument target_points(target, "target");
  PointCloud source_cloud;
  PointCloud target_cloud;
  RegistrationOptions chosen;
  if (preset != "auto") chosen = FindPreset(preset, "auto");
  {
    const py::gil_scoped_release release;
    source_cloud = MakeCloud(source_points);
    target_cloud = MakeCloud(target_points);
    if (preset == "auto") chosen = MakeAutoOptions(source_cloud, target_cloud);
  }
  Given given;
  given.Set(chosen);
  given.Read(method, true, options, "register");
  given.registration.solver = method.make(given.estimator);

  Registration answer;
  answer.method = method.name;
  answer.num_source_dropped = source_cloud.num_dropped;
  answer.num_target_dropped = target_cloud.num_dropped;
  {
    const py::gil_scoped_release release;
    answer.summary = Register(source_cloud, target_cloud, given.registration);
  }
  if (!answer.summary.error.empty()) {
    throw py::value_error(answer.summary.error);
  }
  if (answer.summary.solution.termination == PoseTermination::kInvalidInput) {
    throw py::value_error(answer.summary.solution.message);
  }
  return answer;
}

Solution SolveMatches(const py::object& source_points,
                      const py::object& target_points,
                      const std::string& method_name,
                      const std::string& preset,
                      const py::kwargs& options) {
  const Method& method = FindMethod(method_name);
  const PointsArgument source_argument(source_points, "source_points");
  const PointsArgument target_argument(target_points, "target_points");
  const auto source = source_argument.View();
  const auto target = target_argument.View();
  if (source.cols() != target.cols()) {
    throw py::value_error("source_points has " + std::to_string(source.cols()) +
                          " rows and target_points " +
                          std::to_string(target.cols()) +
                          ", but row i of one must match row i of the other");
  }
  Given given;
  given.Set(FindPreset(preset, nullptr));
  given.Read(method, false, options, "solve");
  const PoseSolver solver = method.make(given.estimator);
  const RegistrationOptions& all = given.registration;
  const double noise_bound = all.quatro.noise_bound;
  VerdictOptions verdict = all.verdict;
  verdict.rival.seed = all.seed;
  verdict.rival.num_threads = all.num_threads;
  verdict.rival.up_in_target = all.ins.up;

  Solution answer;
  answer.method = method.name;
  {
    const py::gil_scoped_release release;
    Stopwatch stopwatch;
    answer.solution =
        SolveWithIns(source, target, solver, noise_bound, all.ins);
    if (answer.solution.termination != PoseTermination::kInvalidInput) {
      AddCovariance(
          source, target, noise_bound, all.covariance, &answer.solution);
      answer.verdict = Judge(source,
                             target,
                             answer.solution,
                             noise_bound,
                             /*geometry=*/std::nullopt,
                             verdict);
    }
    answer.total_seconds = stopwatch.Lap();
  }
  if (answer.solution.termination == PoseTermination::kInvalidInput) {
    throw py::value_error(answer.solution.message);
  }
  return answer;
}

// The input of align() except for clouds; each method reads its own options.
struct GivenAlignment {
  VgicpOptions vgicp;

  OptionList Options(const std::string& method) {
    OptionList list = OptionsOf(&vgicp.alignment);
    list.push_back(MakeOption("num_threads",
                              "0: one per core. Does not affect the result.",
                              &vgicp.alignment.num_threads));
    if (method == "icp") return list;
    list.push_back(MakeOption("epsilon",
                              "In (0, 1), variance perpendicular to surfaces.",
                              &vgicp.epsilon));
    list.push_back(MakeOption("num_neighbors",
                              "Number of neighbors for normals.",
                              &vgicp.num_neighbors));
    if (method == "gicp") return list;
    list.push_back(MakeOption("voxel_size", "[m], > 0.", &vgicp.voxel_size));
    return list;
  }

  AlignmentSummary Align(const std::string& method,
                         const Points& source,
                         const Points& target,
                         const Rigid3& initial) const {
    if (method == "icp") {
      return SolveIcp(source, target, initial, vgicp.alignment);
    }
    if (method == "vgicp") return SolveVgicp(source, target, initial, vgicp);
    GicpOptions gicp;
    gicp.alignment = vgicp.alignment;
    gicp.epsilon = vgicp.epsilon;
    gicp.num_neighbors = vgicp.num_neighbors;
    return SolveGicp(source, target, initial, gicp);
  }
};

Alignment AlignClouds(const py::object& source,
                      const py::object& target,
                      const std::string& method,
                      const py::object& initial,
                      const py::kwargs& options) {
  if (method != "icp" && method != "gicp" && method != "vgicp") {
    throw py::value_error("method = \"" + method +
                          "\", must be one of icp, gicp, vgicp");
  }
  const Points source_points = PointsArgument(source, "source").View();
  const Points target_points = PointsArgument(target, "target").View();
  const Rigid3 start =
      initial.is_none() ? Rigid3()
                        : PoseArgument(initial, "initial_target_from_source");
  GivenAlignment given;
  given.vgicp.alignment.num_threads = 0;
  Apply(options, given.Options(method), "align(method=\"" + method + "\")");
  Alignment answer;
  answer.method = method;
  {
    const py::gil_scoped_release release;
    answer.summary = given.Align(method, source_points, target_points, start);
  }
  if (answer.summary.termination == AlignmentTermination::kInvalidInput) {
    throw py::value_error(answer.summary.message);
  }
  return answer;
}

py::array ReadPoints(const py::object& path) {
  const auto name =
      py::module_::import("os").attr("fsencode")(path).cast<std::string>();
  if (name.find('\0') != std::string::npos) {
    throw py::value_error("embedded null byte");
  }
  std::string error;
  std::optional<PointCloud> cloud;
  {
    const py::gil_scoped_release release;
    cloud = ReadCloud(name, &error);
  }
  if (!cloud) throw py::value_error(error);
  return TakePoints(std::move(cloud->points));
}

py::tuple PresetTuple() {
  py::list names;
  for (const std::string& name : PresetNames()) names.append(name);
  names.append("auto");
  return py::tuple(names);
}

py::dict MethodDict() {
  py::dict methods;
  for (const Method& method : Methods()) {
    methods[py::str(method.name)] = method.text;
  }
  return methods;
}

// The options of every method.
std::string DescribeMethods(bool has_clouds) {
  std::string text;
  for (const Method& method : Methods()) {
    Given given;
    text += "\nmethod=\"" + method.name + "\"  " + method.text + "\n" +
            Describe(given.Options(method, has_clouds));
  }
  return text;
}

constexpr char kRegister[] =
    R"(register(source, target, preset="kitti", *, method="quatro", **options)
--

Estimates the pose between two scans of the same place, far apart or not.

source, target: (N, 3) arrays of points [m] or Open3D point clouds; x ahead, z
  up, the sensor at the origin. Points that are not finite are left out.
preset: kitti (64 beams outdoors), paper, kitti_paper or reference (as
  published), indoor (16 beams), or auto (from the clouds).
method: the estimator, a key of quatro.methods().

Returns a Registration; target_from_source moves points of the source onto the
target, and is_registered says whether the pose is reliable. Raises ValueError,
with the library's text, for points and values that the library rejects, and
TypeError for options that the method does not have. Other Python threads run
meanwhile: do not change the arrays.

Options; the preset sets all others:
)";

constexpr char kSolve[] =
    R"(solve(source_points, target_points, method="quatro", preset="kitti", **options)
--

Estimates the pose between matched points that are mostly outliers.

source_points, target_points: (N, 3) arrays [m]; row i of one matches row i of
  the other. Row-major float64 is used in place, everything else is copied.
method: the estimator, a key of quatro.methods().
preset: as in register(), except auto.

Returns a Solution. Raises ValueError and TypeError like register(). Other Python
threads run meanwhile.

Options; the preset sets all others:
)";

constexpr char kAlign[] =
    R"(align(source, target, method="gicp", initial_target_from_source=None, **options)
--

Local alignment, from a pose that is nearly correct.

source, target: (N, 3) arrays of points [m] or Open3D point clouds, all finite.
method: icp (point to point), gicp (plane to plane) or vgicp (plane to voxels).
initial_target_from_source: (4, 4), or None for the identity.

Returns an Alignment. Raises ValueError and TypeError like register(). Other Python
threads run meanwhile.

Options (epsilon and num_neighbors not for icp, voxel_size only for vgicp):
)";

void BindFunctions(py::module_* module) {
  py::options docs;
  docs.disable_function_signatures();
  GivenAlignment alignment;
  const std::string register_doc = kRegister + DescribeMethods(true);
  const std::string solve_doc = kSolve + DescribeMethods(false);
  const std::string align_doc = kAlign + Describe(alignment.Options("vgicp"));
  module->def("register",
              &RegisterClouds,
              py::arg("source"),
              py::arg("target"),
              py::arg("preset") = "kitti",
              py::kw_only(),
              py::arg("method") = "quatro",
              register_doc.c_str());
  module->def("solve",
              &SolveMatches,
              py::arg("source_points"),
              py::arg("target_points"),
              py::arg("method") = "quatro",
              py::arg("preset") = "kitti",
              solve_doc.c_str());
  module->def("align",
              &AlignClouds,
              py::arg("source"),
              py::arg("target"),
              py::arg("method") = "gicp",
              py::arg("initial_target_from_source") = py::none(),
              align_doc.c_str());
  module->def(
      "read_cloud",
      &ReadPoints,
      py::arg("path"),
      "read_cloud(path)\n--\n\n"
      "(N, 3) float64 from a .bin (KITTI), .ply or .pcd file [m]; points "
      "that are\nnot finite are left out. Raises ValueError if the file "
      "is invalid.");
  module->def("methods",
              &MethodDict,
              "methods()\n--\n\n"
              "dict: estimators for matched points, and their descriptions.");
  module->def("presets",
              &PresetTuple,
              "presets()\n--\n\n"
              "tuple of str: the names of the presets.");
}

}  // namespace
}  // namespace quatro

PYBIND11_MODULE(_quatro, module) {
  module.attr("__version__") = QUATRO_VERSION;
  quatro::BindSummaries(&module);
  quatro::BindFunctions(&module);
}
