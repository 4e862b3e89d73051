// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The Python module. What the library refuses raises ValueError with its text;
// while it works, other Python threads run.

#include <pybind11/pybind11.h>
#include <quatro/version.h>
#include <cmath>

#include <optional>
#include <string>
#include <utility>

#include "features/io/cloud_io.h"
#include "python/arguments.h"
#include "python/arrays.h"
#include "python/options.h"
#include "python/summaries.h"
#include "robust/registration/any_vertical.h"
#include "robust/registration/methods.h"
#include "robust/registration/presets.h"
#include "robust/registration/registration.h"
#include "solvers/local/gicp.h"
#include "solvers/local/icp.h"
#include "solvers/local/vgicp.h"

namespace quatro {
namespace {

namespace py = pybind11;

// An attitude without a mode would be ignored, and a mode without attitudes has
// nothing to use.
void CheckIns(const py::dict& options, InsMode mode) {
  for (const char* name : {"source_rpy", "target_rpy"}) {
    if (options.contains(name) == (mode != InsMode::kNone)) continue;
    throw py::value_error(std::string(name) +
                          (mode == InsMode::kNone
                               ? " is given, but ins_mode is none"
                               : " is missing, but ins_mode needs it"));
  }
}

// A guess or a tilt without bounds would be ignored, and bounds are on a rigid
// motion. Local registration starts from the guess.
void CheckBounds(const py::dict& given,
                 const Method& method,
                 const RegistrationOptions& options) {
  const PoseBounds& bounds = options.bounds;
  const char* ignored = nullptr;
  if (given.contains("guess") && method.input != MethodInput::kClouds) {
    ignored = "guess";
  } else if (given.contains("max_tilt_deg")) {
    ignored = "max_tilt_deg";
  }
  if (ignored && !bounds.IsActive()) {
    throw py::value_error(
        std::string(ignored) +
        " has no effect without other bounds: give max_translation or "
        "max_yaw_deg");
  }
  if (bounds.IsActive() && options.teaser.estimate_scale) {
    throw py::value_error(
        "estimate_scale does not go with max_translation or max_yaw_deg");
  }
}

std::string NameArgument(const py::object& given, const char* argument) {
  if (py::isinstance<py::str>(given)) return given.cast<std::string>();
  throw py::type_error(std::string(argument) + " = " + Shown(given) +
                       ", must be a str");
}

// Runs after each stage of a call that released the GIL: a signal such as
// Ctrl-C ends the call.
void RaiseSignals(const StageTime& /*stage*/) {
  const py::gil_scoped_acquire acquire;
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

const Method& MethodOf(const std::string& name) {
  std::string names;
  for (const Method& method : Methods()) {
    if (name == method.name) return method;
    names += (names.empty() ? "" : ", ") + std::string(method.name);
  }
  throw py::value_error(
      "method = \"" + name + "\", must be one of " + names +
      (MakePreset(name) ? "; it is a preset: preset=..." : ""));
}

// Sets the options that are given, and checks all.
void Read(const Method& method,
          bool has_clouds,
          const py::dict& given,
          const std::string& function,
          RegistrationOptions* options) {
  options->method = method.name;
  Apply(given,
        OptionsOf(method, has_clouds, options),
        function + "(method=\"" + method.name + "\")");
  CheckIns(given, options->ins.mode);
  CheckBounds(given, method, *options);
  std::string error;
  if (!CanUseIns(method, options->ins, &error) || !options->IsValid(&error)) {
    throw py::value_error(error);
  }
  if (given.contains("gravity") && options->ins.gravity == Gravity::kScans &&
      !(has_clouds && method.searches && MayLevelByScans(*options))) {
    throw py::value_error(
        "gravity = \"scans\" has no effect here: it needs two clouds, a method "
        "that searches other poses, such as quatro, max_rung > 0, and neither "
        "an INS nor bounds on the pose");
  }
}

RegistrationOptions FindPreset(const std::string& name,
                               const char* further_name) {
  auto preset = MakePreset(name);
  if (preset) {
    preset->num_threads = 0;
    return *preset;
  }
  std::string error = "preset = \"" + name + "\", must be one of ";
  for (const std::string& known : PresetNames()) error += known + ", ";
  if (further_name == nullptr) error.resize(error.size() - 2);
  if (further_name != nullptr) error += further_name;
  std::string ignored;
  if (name != "auto" && FindMethod(name, &ignored)) {
    error += "; it is a method: method=...";
  }
  throw py::value_error(error);
}

Registration RegisterClouds(const py::object& source,
                            const py::object& target,
                            const py::object& preset_name,
                            const py::object& method_name,
                            const py::dict& given) {
  const std::string name = NameArgument(method_name, "method");
  const Method& method = MethodOf(name);
  const std::string preset = NameArgument(preset_name, "preset");
  const PointsArgument source_points(source, "source");
  const PointsArgument target_points(target, "target");
  PointCloud source_cloud;
  PointCloud target_cloud;
  double voxel_size = 0.0;
  if (given.contains("voxel_size") &&
      PyNumber_Check(given["voxel_size"].ptr())) {
    const double value = PyFloat_AsDouble(given["voxel_size"].ptr());
    if (PyErr_Occurred()) PyErr_Clear();  // Read() refuses it.
    if (value > 0.0 && std::isfinite(value)) voxel_size = value;
  }
  RegistrationOptions options;
  if (preset != "auto") {
    options = FindPreset(preset, "auto");
  } else if (voxel_size > 0.0) {
    options = MakeAutoOptions(voxel_size);
  }
  {
    const py::gil_scoped_release release;
    source_cloud = MakeCloud(source_points);
    target_cloud = MakeCloud(target_points);
    if (preset == "auto" && voxel_size == 0.0) {
      options = MakeAutoOptions(source_cloud, target_cloud);
    }
  }
  options.num_threads = 0;
  options.progress = RaiseSignals;
  Read(method, true, given, "register", &options);

  Registration answer;
  answer.method = method.name;
  answer.num_source_dropped = source_cloud.num_dropped;
  answer.num_target_dropped = target_cloud.num_dropped;
  {
    const py::gil_scoped_release release;
    answer.summary = Register(source_cloud, target_cloud, options);
  }
  if (!answer.summary.error.empty()) {
    throw py::value_error(answer.summary.error);
  }
  return answer;
}

Solution SolveMatches(const py::object& source_points,
                      const py::object& target_points,
                      const py::object& method_name,
                      const py::object& preset_name,
                      const py::dict& given) {
  const std::string name = NameArgument(method_name, "method");
  const Method& method = MethodOf(name);
  const std::string preset = NameArgument(preset_name, "preset");
  const PointsArgument source_argument(source_points, "source_points");
  const PointsArgument target_argument(target_points, "target_points");
  const auto source = source_argument.View();
  const auto target = target_argument.View();
  if (source.cols() != target.cols()) {
    throw py::value_error(
        "source_points has " + std::to_string(source.cols()) +
        " rows and target_points " + std::to_string(target.cols()) +
        ", row i of one must be matched with row i of the other");
  }
  RegistrationOptions options = FindPreset(preset, nullptr);
  options.progress = RaiseSignals;
  Read(method, false, given, "solve", &options);

  Solution answer;
  answer.method = method.name;
  {
    const py::gil_scoped_release release;
    answer.summary = RegisterMatches({source, target}, options);
  }
  if (!answer.summary.error.empty()) {
    throw py::value_error(answer.summary.error);
  }
  return answer;
}

// The arguments of align() beside the clouds; each method reads its own.
struct GivenAlignment {
  VgicpOptions vgicp;

  OptionList Options(const std::string& method) {
    OptionList list = LocalAlignmentOptionList(&vgicp.alignment);
    list.push_back({"num_threads",
                    ">= 0",
                    "0: one per core; never changes the answer",
                    &vgicp.alignment.num_threads});
    if (method == "icp") return list;
    list.push_back(
        {"epsilon", "in (0, 1)", "variance across surfaces", &vgicp.epsilon});
    list.push_back({"num_neighbors",
                    ">= 3",
                    "points that a normal is estimated from",
                    &vgicp.num_neighbors});
    if (method == "gicp") return list;
    list.push_back(
        {"voxel_size", "[m], > 0", "edge of a voxel", &vgicp.voxel_size});
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
                      const py::object& method_name,
                      const py::object& initial,
                      const py::dict& options) {
  const std::string method = NameArgument(method_name, "method");
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

py::array ReadPoints(const py::object& path, const py::object& given_floats) {
  if (!IsPath(path)) {
    throw py::type_error("path = " + Shown(path) +
                         ", must be a str, bytes or os.PathLike");
  }
  int point_floats = 0;
  py::dict options;
  options["point_floats"] = given_floats;
  Apply(options,
        {{"point_floats",
          "0 or in [3, 64]",
          "numbers of a point",
          &point_floats}},
        "read_cloud");
  const auto name =
      py::module_::import("os").attr("fsencode")(path).cast<std::string>();
  if (name.find('\0') != std::string::npos) {
    throw py::value_error("embedded null byte");
  }
  std::string error;
  std::optional<PointCloud> cloud;
  {
    const py::gil_scoped_release release;
    cloud = ReadCloud(name, {point_floats}, &error);
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
    methods[py::str(method.name)] = method.description;
  }
  return methods;
}

// One paragraph per method.
std::string DescribeMethods(bool has_clouds) {
  std::string text;
  for (const Method& method : Methods()) {
    if (!has_clouds && method.input != MethodInput::kMatches) continue;
    RegistrationOptions options;
    text += std::string("\nmethod=\"") + method.name + "\"  " +
            method.description + "\n" +
            Describe(OptionsOf(method, has_clouds, &options));
  }
  return text;
}

constexpr char kRegister[] =
    R"(register(source, target, preset="auto", *, method="quatro", **options)
--

Finds the pose between two scans of one place, far apart or not.

source, target: (N, 3) arrays of points [m] or Open3D point clouds; x ahead, z
  up, the sensor at the origin. Points that are not finite or exactly at
  the origin are left out.
preset: auto (all lengths from the clouds), kitti (64 beams outdoors), paper,
  kitti_paper or reference (as published), or indoor (16 beams). With auto, a
  given voxel_size decides the other lengths.
method: a key of quatro.methods(). Local registration by icp, gicp or vgicp starts
  from guess=..., and is at best ambiguous.

Returns a Registration; target_from_source moves points of the source onto the
target, and is_registered says if it can be relied on. Raises ValueError for
points and values that the library rejects, with its message, and TypeError for
options that the method does not have. Other Python threads run during the call:
do not change the arrays. Ctrl-C ends the call when the current stage is done.

Options; the preset decides the others:
)";

constexpr char kSolve[] =
    R"(solve(source_points, target_points, method="quatro", preset="kitti", **options)
--

Finds the pose between matched points, most of which may be outliers.

source_points, target_points: (N, 3) arrays [m], row i of one matched with row i
  of the other. Rows of float64 are read without a copy.
method: a key of quatro.methods() that works on matches.
preset: as for register(), except auto.

Returns a Solution. Raises ValueError and TypeError as register() does. Other
Python threads run during the call.

Options; the preset decides the others:
)";

constexpr char kAlign[] =
    R"(align(source, target, method="gicp", initial_target_from_source=None, **options)
--

Local alignment, from a pose that is nearly correct.

source, target: (N, 3) arrays of points [m] or Open3D point clouds, all finite.
method: icp (point to point), gicp (plane to plane) or vgicp (plane to planes of
  voxels).
initial_target_from_source: (4, 4) or (3, 4), its rotation to 1e-3, or None for
  no motion.

Returns an Alignment. Raises ValueError and TypeError as register() does. Other
Python threads run during the call.

Options (epsilon and num_neighbors only for gicp and vgicp, voxel_size only for
vgicp):
)";

constexpr char kReadCloud[] =
    "read_cloud(path, point_floats=0)\n--\n\n"
    "(N, 3) float64 [m] of a .bin, .ply, .pcd, .npy, .xyz, .txt or .csv "
    "file, or of\none of these with .gz. Points that are not finite and "
    "points at the origin are\nleft out. A point of a .bin has "
    "`point_floats` numbers, x, y, z first; 0 infers\nhow many. Raises "
    "ValueError with what is wrong with the file.";

constexpr char kMethods[] =
    "methods()\n--\n\n"
    "dict: the methods and what each does. Those that work on clouds are\nfor "
    "register() only.";

constexpr char kPresets[] =
    "presets()\n--\n\n"
    "tuple of str: sets of options that belong together.";

void BindRegistration(py::module_* module) {
  const std::string register_doc = kRegister + DescribeMethods(true);
  const std::string solve_doc = kSolve + DescribeMethods(false);
  module->def(
      "register",
      [](const py::args& args, const py::kwargs& named) {
        py::dict options;
        const auto given = TakeArguments(kRegister,
                                         {{"source", {}},
                                          {"target", {}},
                                          {"preset", py::str("auto")},
                                          {"method", py::str("quatro")}},
                                         3,
                                         args,
                                         named,
                                         &options);
        return RegisterClouds(given[0], given[1], given[2], given[3], options);
      },
      register_doc.c_str());
  module->def(
      "solve",
      [](const py::args& args, const py::kwargs& named) {
        py::dict options;
        const auto given = TakeArguments(kSolve,
                                         {{"source_points", {}},
                                          {"target_points", {}},
                                          {"method", py::str("quatro")},
                                          {"preset", py::str("kitti")}},
                                         4,
                                         args,
                                         named,
                                         &options);
        return SolveMatches(given[0], given[1], given[2], given[3], options);
      },
      solve_doc.c_str());
}

void BindFunctions(py::module_* module) {
  py::options docs;
  docs.disable_function_signatures();
  BindRegistration(module);
  GivenAlignment alignment;
  const std::string align_doc = kAlign + Describe(alignment.Options("vgicp"));
  module->def(
      "align",
      [](const py::args& args, const py::kwargs& named) {
        py::dict options;
        const auto given =
            TakeArguments(kAlign,
                          {{"source", {}},
                           {"target", {}},
                           {"method", py::str("gicp")},
                           {"initial_target_from_source", py::none()}},
                          4,
                          args,
                          named,
                          &options);
        return AlignClouds(given[0], given[1], given[2], given[3], options);
      },
      align_doc.c_str());
  module->def(
      "read_cloud",
      [](const py::args& args, const py::kwargs& named) {
        const auto given =
            TakeArguments(kReadCloud,
                          {{"path", {}}, {"point_floats", py::int_(0)}},
                          2,
                          args,
                          named,
                          nullptr);
        return ReadPoints(given[0], given[1]);
      },
      kReadCloud);
  module->def(
      "methods",
      [](const py::args& args, const py::kwargs& named) {
        TakeArguments(kMethods, {}, 0, args, named, nullptr);
        return MethodDict();
      },
      kMethods);
  module->def(
      "presets",
      [](const py::args& args, const py::kwargs& named) {
        TakeArguments(kPresets, {}, 0, args, named, nullptr);
        return PresetTuple();
      },
      kPresets);
}

}  // namespace
}  // namespace quatro

PYBIND11_MODULE(_quatro, module) {
  module.attr("__version__") = QUATRO_VERSION;
  quatro::BindSummaries(&module);
  quatro::BindAlignment(&module);
  quatro::BindFunctions(&module);
}
