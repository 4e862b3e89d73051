// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "python/options.h"

#include <initializer_list>
#include <limits>
#include <utility>

#include "python/arrays.h"

namespace quatro {
namespace {

namespace py = pybind11;

[[noreturn]] void Refuse(const std::string& name,
                         const py::handle& value,
                         const std::string& wanted) {
  throw py::type_error(name + " = " + py::repr(value).cast<std::string>() +
                       ", must be " + wanted);
}

template <typename Integer>
Option IntegerOption(std::string name, std::string text, Integer* field) {
  const auto set = [name, field](const py::handle& value) {
    if (py::isinstance<py::bool_>(value) || !PyIndex_Check(value.ptr())) {
      Refuse(name, value, "an integer");
    }
    try {
      *field =
          py::int_(py::reinterpret_borrow<py::object>(value)).cast<Integer>();
    } catch (const py::cast_error&) {
      throw py::value_error(
          name + " = " + py::repr(value).cast<std::string>() +
          ", must be from " +
          std::to_string(std::numeric_limits<Integer>::min()) + " to " +
          std::to_string(std::numeric_limits<Integer>::max()));
    }
  };
  return {std::move(name), std::move(text), set};
}

template <typename Enum>
using Names = std::initializer_list<std::pair<const char*, Enum>>;

// An option with named values; the names are appended to the text.
template <typename Enum>
Option EnumOption(std::string name,
                  const std::string& text,
                  Names<Enum> names,
                  Enum* field) {
  std::string all;
  for (const auto& known : names) {
    all += (all.empty() ? "" : ", ") + std::string(known.first);
  }
  const std::vector<std::pair<std::string, Enum>> values(names.begin(),
                                                         names.end());
  const auto set = [name, all, values, field](const py::handle& value) {
    if (!py::isinstance<py::str>(value)) Refuse(name, value, "one of " + all);
    const auto given = value.cast<std::string>();
    for (const auto& [known, enumerator] : values) {
      if (given != known) continue;
      *field = enumerator;
      return;
    }
    throw py::value_error(name + " = \"" + given + "\", must be one of " + all);
  };
  return {std::move(name), text + ": " + all + ".", set};
}

Option PruningOption(Pruning* field) {
  return EnumOption("pruning",
                    "How inconsistent matches are removed",
                    {{"clique_heuristic", Pruning::kCliqueHeuristic},
                     {"exact_clique", Pruning::kExactClique},
                     {"max_core", Pruning::kMaxCore},
                     {"none", Pruning::kNone}},
                    field);
}

Option TimLayoutOption(TimLayout* field) {
  return EnumOption("tim_layout",
                    "Which differences of matches (TIMs) are used",
                    {{"ring", TimLayout::kRing},
                     {"complete", TimLayout::kComplete},
                     {"random", TimLayout::kRandom}},
                    field);
}

void AddGnc(GncOptions* gnc, OptionList* list) {
  list->push_back(EnumOption(
      "gnc_start",
      "Residuals that determine the first mu of GNC",
      {{"plain_fit", GncStart::kPlainFit}, {"identity", GncStart::kIdentity}},
      &gnc->start));
  list->push_back(MakeOption(
      "gnc_mu_step", "> 1, factor of mu per GNC iteration.", &gnc->mu_step));
  list->push_back(MakeOption("gnc_max_num_iterations",
                             ">= 1, limit of GNC iterations.",
                             &gnc->max_num_iterations));
}

Option AttitudeOption(std::string name, std::string text, Attitude* field) {
  const auto set = [name, field](const py::handle& value) {
    Eigen::Vector3d angles;
    MakeOption(name, "", &angles).set(value);
    *field = {angles.x(), angles.y(), angles.z()};
  };
  return {std::move(name), std::move(text), set};
}

}  // namespace

Option MakeOption(std::string name, std::string text, double* field) {
  const auto set = [name, field](const py::handle& value) {
    if (py::isinstance<py::bool_>(value) || !PyNumber_Check(value.ptr())) {
      Refuse(name, value, "a number");
    }
    *field = PyFloat_AsDouble(value.ptr());
    if (PyErr_Occurred()) throw py::error_already_set();
  };
  return {std::move(name), std::move(text), set};
}

Option MakeOption(std::string name, std::string text, bool* field) {
  const auto set = [name, field](const py::handle& value) {
    const bool is_numpys =
        std::string(Py_TYPE(value.ptr())->tp_name) == "numpy.bool_";
    if (!py::isinstance<py::bool_>(value) && !is_numpys) {
      Refuse(name, value, "True or False");
    }
    *field = PyObject_IsTrue(value.ptr()) == 1;
  };
  return {std::move(name), std::move(text), set};
}

Option MakeOption(std::string name, std::string text, int* field) {
  return IntegerOption(std::move(name), std::move(text), field);
}

Option MakeOption(std::string name, std::string text, std::int64_t* field) {
  return IntegerOption(std::move(name), std::move(text), field);
}

Option MakeOption(std::string name, std::string text, std::uint64_t* field) {
  return IntegerOption(std::move(name), std::move(text), field);
}

Option MakeOption(std::string name, std::string text, Eigen::Vector3d* field) {
  const auto set = [name, field](const py::handle& value) {
    const auto array = py::array_t<double, py::array::forcecast>::ensure(value);
    if (!array) PyErr_Clear();
    if (!array || array.ndim() != 1 || array.shape(0) != 3) {
      Refuse(name, value, "three numbers");
    }
    *field << array.at(0), array.at(1), array.at(2);
  };
  return {std::move(name), std::move(text), set};
}

OptionList OptionsOfExact(QuatroOptions* o) {
  return {
      MakeOption("tim_bound_factor",
                 "Bound of a TIM relative to noise_bound.",
                 &o->tim_bound_factor),
      EnumOption("consistency_test",
                 "The test of two matches for consistency",
                 {{"length", ConsistencyTest::kLength},
                  {"planar", ConsistencyTest::kPlanar},
                  {"planar_and_height", ConsistencyTest::kPlanarAndHeight}},
                 &o->consistency_test),
      MakeOption("max_tilt", "[rad], for planar_and_height.", &o->max_tilt),
      PruningOption(&o->pruning),
      MakeOption("clique_time_limit_seconds",
                 "[s], for exact_clique.",
                 &o->clique_time_limit_seconds),
      TimLayoutOption(&o->tim_layout),
      MakeOption("num_random_tims",
                 ">= 1, number of TIMs for random.",
                 &o->num_random_tims),
      MakeOption("recover_translation",
                 "Re-estimate the translation over all matches.",
                 &o->recover_translation),
      MakeOption("polish", "Polish roll and pitch on the inliers.", &o->polish),
      MakeOption("polish_max_tilt",
                 "[rad], a larger tilt is rejected.",
                 &o->polish_max_tilt),
      MakeOption("polish_max_rotation_std",
                 "[rad], a less certain rotation is rejected.",
                 &o->polish_max_rotation_std),
      MakeOption("crosscheck",
                 "Also solve every subproblem by Ceres. Slow.",
                 &o->crosscheck)};
}

OptionList OptionsOf(QuatroOptions* o) {
  OptionList list = OptionsOfExact(o);
  list.push_back(EnumOption(
      "surrogate",
      "Surrogate loss of GNC",
      {{"truncated_least_squares", SurrogateType::kTruncatedLeastSquares},
       {"geman_mcclure", SurrogateType::kGemanMcClure},
       {"welsch", SurrogateType::kWelsch}},
      &o->surrogate));
  AddGnc(&o->gnc, &list);
  list.push_back(MakeOption("replace_missed_optimum",
                            "Use the exact yaw if GNC's has a higher cost.",
                            &o->replace_missed_optimum));
  list.push_back(MakeOption("certificate_tolerance",
                            "Smallest difference of costs that counts.",
                            &o->certificate_tolerance));
  return list;
}

OptionList OptionsOf(ArcConsensusOptions* o) {
  return {
      MakeOption(
          "max_tilt", "[rad], largest tilt between the scans.", &o->max_tilt),
      MakeOption("num_pairs", ">= 1, number of random pairs.", &o->num_pairs),
      MakeOption("min_planar_length",
                 "[m], shorter pairs are skipped.",
                 &o->min_planar_length)};
}

OptionList OptionsOf(TeaserOptions* o) {
  OptionList list = {PruningOption(&o->pruning),
                     MakeOption("clique_time_limit_seconds",
                                "[s], for exact_clique.",
                                &o->clique_time_limit_seconds),
                     TimLayoutOption(&o->tim_layout)};
  AddGnc(&o->gnc, &list);
  const OptionList rest = {
      MakeOption("estimate_scale",
                 "Also estimate the scale of the target over the source.",
                 &o->estimate_scale),
      MakeOption("num_scale_tims",
                 ">= 1, number of TIMs for the scale.",
                 &o->num_scale_tims),
      MakeOption("crosscheck",
                 "Also solve every subproblem by Ceres. Slow.",
                 &o->crosscheck)};
  list.insert(list.end(), rest.begin(), rest.end());
  return list;
}

OptionList OptionsOf(FgrOptions* o) {
  return {MakeOption("start_scale",
                     "Root of the first mu relative to the clouds' radius.",
                     &o->start_scale),
          MakeOption("mu_step", "> 1, divisor of mu.", &o->mu_step),
          MakeOption("iterations_per_mu", ">= 1.", &o->iterations_per_mu),
          MakeOption("max_iterations", ">= 1.", &o->max_iterations),
          MakeOption("step_tolerance",
                     "[rad] and radii, limit of the last step.",
                     &o->step_tolerance),
          MakeOption("start_at_plain_fit",
                     "Start from least squares over all matches.",
                     &o->start_at_plain_fit)};
}

OptionList OptionsOf(RansacOptions* o) {
  return {
      MakeOption(
          "max_iterations", ">= 1, limit of samples.", &o->max_iterations),
      MakeOption("confidence",
                 "In (0, 1], of having drawn an outlier-free sample.",
                 &o->confidence),
      MakeOption("local_optimization",
                 "Refit every new best pose.",
                 &o->local_optimization),
      EnumOption("sample",
                 "The sample for a pose",
                 {{"three_points", MinimalSample::kThreePoints},
                  {"two_points", MinimalSample::kTwoPoints}},
                 &o->minimal.sample),
      EnumOption("edge_test",
                 "The test of a sample's edges",
                 {{"none", EdgeTest::kNone},
                  {"bound", EdgeTest::kBound},
                  {"ratio", EdgeTest::kRatio}},
                 &o->minimal.edge_test),
      MakeOption("edge_similarity",
                 "In (0, 1], for ratio.",
                 &o->minimal.edge_similarity),
      MakeOption("max_tilt", "[rad], for two_points.", &o->minimal.max_tilt)};
}

OptionList OptionsOf(InsOptions* o) {
  return {EnumOption("ins_mode",
                     "How an INS is used",
                     {{"none", InsMode::kNone},
                      {"relative", InsMode::kRelative},
                      {"leveled", InsMode::kLeveled},
                      {"fused", InsMode::kFused}},
                     &o->mode),
          AttitudeOption("source_rpy",
                         "[rad], the INS' roll, pitch and yaw of the source; x "
                         "ahead, z up.",
                         &o->source_attitude),
          AttitudeOption("target_rpy",
                         "[rad], the INS' roll, pitch and yaw of the target.",
                         &o->target_attitude),
          MakeOption("attitude_std",
                     "[rad], standard deviation of roll and pitch, for fused.",
                     &o->attitude_std),
          MakeOption(
              "match_std",
              "[m], standard deviation of an inlier per axis, for fused; 0: a "
              "third of noise_bound.",
              &o->match_std),
          MakeOption(
              "up", "Unit vector, the up direction of a level cloud.", &o->up)};
}

OptionList OptionsOf(FrontEndOptions* o) {
  return {MakeOption(
              "voxel_size", "[m], voxels of the downsampling.", &o->voxel_size),
          MakeOption("normal_radius",
                     "[m], neighborhood of the normals.",
                     &o->normal_radius),
          MakeOption("fpfh_radius",
                     "[m], neighborhood of the descriptors; normal_radius to "
                     "100 voxel_size.",
                     &o->fpfh_radius),
          MakeOption("tuple_test",
                     "Remove matches that are in no consistent triangle.",
                     &o->tuple_test),
          MakeOption("tuple_scale",
                     "In (0, 1), similarity of its edges.",
                     &o->tuple.scale)};
}

OptionList OptionsOf(RefinementOptions* o) {
  return {EnumOption("refine",
                     "Local registration that refines the pose",
                     {{"none", RefinementMethod::kNone},
                      {"icp", RefinementMethod::kIcp},
                      {"gicp", RefinementMethod::kGicp},
                      {"vgicp", RefinementMethod::kVgicp}},
                     &o->method),
          MakeOption("refine_max_translation",
                     "[m], a larger translation is rejected.",
                     &o->max_translation),
          MakeOption("refine_max_rotation",
                     "[rad], a larger rotation is rejected.",
                     &o->max_rotation)};
}

OptionList OptionsOf(LocalAlignmentOptions* o) {
  return {MakeOption("max_correspondence_distance",
                     "[m], > 0.",
                     &o->max_correspondence_distance),
          EnumOption("kernel",
                     "Robust kernel of each error",
                     {{"none", RobustKernelType::kNone},
                      {"huber", RobustKernelType::kHuber},
                      {"cauchy", RobustKernelType::kCauchy},
                      {"geman_mcclure", RobustKernelType::kGemanMcClure}},
                     &o->kernel.type),
          MakeOption("kernel_width",
                     "[m] for icp; see solvers/local/gicp.h, vgicp.h.",
                     &o->kernel.width),
          MakeOption("translation_tolerance",
                     "[m], limit of the last step.",
                     &o->translation_tolerance),
          MakeOption("rotation_tolerance",
                     "[rad], limit of the last step.",
                     &o->rotation_tolerance),
          MakeOption("max_num_iterations", ">= 1.", &o->max_num_iterations),
          MakeOption("min_conditioning",
                     "In [0, 1), below it the pose is degenerate.",
                     &o->min_conditioning)};
}

void Apply(const py::dict& given,
           const OptionList& options,
           const std::string& function) {
  for (const auto& [key, value] : given) {
    const auto name = key.cast<std::string>();
    bool is_known = false;
    std::string known;
    for (const Option& option : options) {
      known += (known.empty() ? "" : ", ") + option.name;
      if (name != option.name) continue;
      option.set(value);
      is_known = true;
    }
    if (!is_known) {
      throw py::type_error(function + " has no option " + name +
                           ", must be one of " + known);
    }
  }
}

std::string Describe(const OptionList& options) {
  std::string text;
  for (const Option& option : options) {
    text += "  " + option.name + "  " + option.text + "\n";
  }
  return text;
}

}  // namespace quatro
