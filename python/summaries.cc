// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "python/summaries.h"

#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include "features/base/rigid3.h"
#include "python/arrays.h"

namespace quatro {
namespace {

namespace py = pybind11;

constexpr double kDegree = M_PI / 180.0;  // [rad]

template <typename Summary>
const PoseSummary& SolutionOf(const Summary& s) {
  return s.summary.solution;
}
template <typename Summary>
const Verdict& VerdictOf(const Summary& s) {
  return s.summary.verdict;
}

py::object OrNone(const std::optional<double>& value) {
  if (!value) return py::none();
  return py::float_(*value);
}

py::dict Seconds(const std::vector<StageTime>& times) {
  py::dict seconds;
  for (const StageTime& time : times) {
    const py::str stage(time.stage);
    const double before =
        seconds.contains(stage) ? seconds[stage].cast<double>() : 0.0;
    seconds[stage] = before + time.seconds;
  }
  return seconds;
}

std::string Print(const char* format, double a, double b, double c, double d) {
  char text[200];
  std::snprintf(text, sizeof(text), format, a, b, c, d);
  return text;
}

std::string Describe(const Rigid3& pose) {
  const Eigen::Vector3d& t = pose.translation;
  return Print("yaw=%.2f deg, translation=(%.3f, %.3f, %.3f) m",
               Yaw(pose.rotation) / kDegree,
               t.x(),
               t.y(),
               t.z());
}

// Formats "Solution(registered, quatro, probability=0.99, yaw=...)".
template <typename Summary>
std::string Represent(const char* name, const Summary& summary) {
  const PoseSummary& solution = SolutionOf(summary);
  const Verdict& verdict = VerdictOf(summary);
  std::string text = std::string(name) + "(" + StatusName(verdict.status) +
                     ", " + summary.method;
  if (solution.target_from_source) {
    text += Print(", probability=%.2f, ", verdict.probability, 0, 0, 0) +
            Describe(*solution.target_from_source);
  }
  return text + ", matches=" + std::to_string(solution.num_matches) +
         ", inliers=" + std::to_string(verdict.num_inliers) + ": " +
         verdict.reason + ")";
}

py::object CovarianceOf(const PoseSummary& solution) {
  if (!solution.covariance || !solution.covariance->covariance) {
    return py::none();
  }
  return Copy(*solution.covariance->covariance);
}

py::list UnobservableOf(const PoseSummary& solution) {
  py::list texts;
  if (!solution.covariance) return texts;
  for (const UnobservableDirection& direction :
       solution.covariance->unobservable) {
    texts.append(direction.Describe());
  }
  return texts;
}

py::object CertificateOf(const PoseSummary& solution) {
  if (!solution.certificate) return py::none();
  const YawCertificate& certificate = *solution.certificate;
  py::dict dict;
  dict["gnc_cost"] = OrNone(certificate.gnc_cost);
  dict["optimal_cost"] = certificate.optimal_cost;
  dict["gap"] = OrNone(certificate.gap);
  return dict;
}

py::object CrosscheckOf(const PoseSummary& solution) {
  if (!solution.crosscheck) return py::none();
  py::dict dict;
  dict["num_subproblems"] = solution.crosscheck->num_subproblems;
  dict["max_rotation_difference"] =
      solution.crosscheck->max_rotation_difference;
  dict["max_translation_difference"] =
      solution.crosscheck->max_translation_difference;
  return dict;
}

py::object RefinementOf(const RegistrationSummary& summary) {
  if (!summary.refinement) return py::none();
  const RefinementSummary& refinement = *summary.refinement;
  py::dict dict;
  dict["method"] = RefinementName(refinement.method);
  dict["is_accepted"] = refinement.is_accepted;
  dict["message"] = refinement.message;
  dict["moved_translation"] = refinement.moved_translation;
  dict["moved_rotation"] = refinement.moved_rotation;
  dict["unrefined_target_from_source"] =
      Copy(std::optional<Rigid3>(refinement.unrefined_target_from_source));
  return dict;
}

// All properties by name; views are copied.
py::dict AsDict(const py::object& self) {
  const py::object is_property =
      py::module_::import("builtins").attr("property");
  py::dict values;
  for (const py::handle name : py::type::of(self).attr("__dict__")) {
    const py::object member = py::type::of(self).attr(name);
    if (!py::isinstance(member, is_property)) continue;
    const py::object value = self.attr(name);
    values[name] =
        py::isinstance<py::array>(value) ? value.attr("copy")() : value;
  }
  return values;
}

constexpr const char* kAsDictDoc =
    "dict: all properties by name, for a table or another process; "
    "arrays are copies. Can be pickled.";

constexpr const char* kTransformDoc =
    "transform(points)\n--\n\n"
    "(N, 3) points of the source in the target's frame [m], as float64. Raises "
    "ValueError\nif there is no pose.";

// Moved by the pose, if there is one.
py::array Transform(const std::optional<Rigid3>& target_from_source,
                    const std::string& message,
                    const py::object& points) {
  if (!target_from_source) {
    throw py::value_error("there is no pose to transform by: " + message);
  }
  return TakePoints(
      target_from_source->Apply(PointsArgument(points, "points").View()));
}

// What answers from matches and from clouds have in common.
template <typename Summary>
void BindCommon(const char* name, py::class_<Summary>* type) {
  const auto add = [type](const char* field, const char* doc, auto get) {
    type->def_property_readonly(field, get, doc);
  };
  type->def("__repr__",
            [name](const Summary& s) { return Represent(name, s); });
  type->def("as_dict", &AsDict, kAsDictDoc);
  type->def(
      "transform",
      [](const Summary& s, const py::object& points) {
        return Transform(
            SolutionOf(s).target_from_source, SolutionOf(s).message, points);
      },
      py::arg("points"),
      kTransformDoc);
  add("method", "str: the estimator's name.", [](const Summary& s) {
    return s.method;
  });
  add("status",
      "str: registered, ambiguous, degenerate or insufficient.",
      [](const Summary& s) {
        return std::string(StatusName(VerdictOf(s).status));
      });
  add("is_registered", "bool: the pose is reliable.", [](const Summary& s) {
    return VerdictOf(s).IsRegistered();
  });
  add("reason", "str: why it has this status.", [](const Summary& s) {
    return VerdictOf(s).reason;
  });
  add("probability",
      "float: that the pose is within 2 m and 10 deg; 0 if there is no pose.",
      [](const Summary& s) { return VerdictOf(s).probability; });
  add("features", "dict: the inputs of the probability.", [](const Summary& s) {
    py::dict dict;
    for (const Feature& feature : VerdictOf(s).features) {
      dict[py::str(feature.name)] = feature.value;
    }
    return dict;
  });
  add("message", "str: how the estimator ended.", [](const Summary& s) {
    return SolutionOf(s).message;
  });
  add("target_from_source",
      "(4, 4) float64 or None: moves homogeneous points of the source onto "
      "the target [m]. May be set even if it is not registered.",
      [](const Summary& s) { return Copy(SolutionOf(s).target_from_source); });
  add("unpolished_target_from_source",
      "(4, 4) float64 or None: the pose before polishing, if it was polished.",
      [](const Summary& s) {
        return Copy(SolutionOf(s).unpolished_target_from_source);
      });
  add("yaw",
      "float or None: of target_from_source [rad], in [-pi, pi].",
      [](const Summary& s) {
        std::optional<double> yaw;
        const auto& pose = SolutionOf(s).target_from_source;
        if (pose) yaw = Yaw(pose->rotation);
        return OrNone(yaw);
      });
  add("scale",
      "float: of the target over the source; 1 unless estimated.",
      [](const Summary& s) { return SolutionOf(s).scale; });
  add("covariance",
      "(6, 6) float64 or None: of the pose, rotation [rad] then translation "
      "[m], in the target frame. None if a direction is unobservable.",
      [](const Summary& s) { return CovarianceOf(SolutionOf(s)); });
  add("unobservable_directions",
      "list of str: directions that the data do not constrain.",
      [](const Summary& s) { return UnobservableOf(SolutionOf(s)); });
  type->def_property_readonly(
      "inliers",
      [](const py::object& self) {
        const auto& s = self.cast<const Summary&>();
        return ViewColumns(SolutionOf(s).translation_inliers, self);
      },
      "(K,) int64: rows of the matches within the noise bound of the "
      "estimator's pose. A view.");
  type->def_property_readonly(
      "consistent",
      [](const py::object& self) {
        const auto& s = self.cast<const Summary&>();
        return ViewColumns(SolutionOf(s).consistent, self);
      },
      "(K,) int64: rows of the matches that pruning kept. A view.");
  add("num_matches",
      "int: matches; duplicates count once.",
      [](const Summary& s) { return SolutionOf(s).num_matches; });
  add("num_consistent",
      "int: matches that pruning kept.",
      [](const Summary& s) { return SolutionOf(s).num_consistent; });
  add("num_tims", "int: differences of matches.", [](const Summary& s) {
    return SolutionOf(s).num_tims;
  });
  add("num_rotation_inliers",
      "int: differences within their bound.",
      [](const Summary& s) { return SolutionOf(s).num_rotation_inliers; });
  add("num_translation_inliers",
      "int: matches within the noise bound of the estimator's pose.",
      [](const Summary& s) { return SolutionOf(s).num_translation_inliers; });
  add("num_inliers",
      "int: matches within the noise bound of the final pose.",
      [](const Summary& s) { return VerdictOf(s).num_inliers; });
  add("certificate",
      "dict or None: gnc_cost, optimal_cost and gap of the yaw problem.",
      [](const Summary& s) { return CertificateOf(SolutionOf(s)); });
  add("crosscheck",
      "dict or None: num_subproblems also solved by Ceres, "
      "max_rotation_difference [rad], max_translation_difference [m].",
      [](const Summary& s) { return CrosscheckOf(SolutionOf(s)); });
  add("stage_seconds", "dict: time by stage [s].", [](const Summary& s) {
    return Seconds(s.summary.stage_times);
  });
  add("total_seconds", "float: time [s].", [](const Summary& s) {
    return s.summary.total_seconds;
  });
  add("notes", "dict: what a stage did, by stage.", [](const Summary& s) {
    py::dict dict;
    for (const StageNote& note : SolutionOf(s).notes) {
      dict[py::str(note.stage)] = note.text;
    }
    return dict;
  });
}

}  // namespace

void BindSummaries(py::module_* module) {
  py::class_<Solution> solution(
      *module, "Solution", "The pose of matched points, and its verdict.");
  BindCommon("Solution", &solution);

  py::class_<Registration> registration(
      *module, "Registration", "The pose of two clouds, and its verdict.");
  BindCommon("Registration", &registration);
  registration
      .def_property_readonly(
          "matched_source",
          [](const py::object& self) {
            const auto& r = self.cast<const Registration&>();
            return ViewPoints(r.summary.matched_source, self);
          },
          "(M, 3) float64: voxel means of the source [m]; row i is matched "
          "with row i of matched_target. A view.")
      .def_property_readonly(
          "matched_target",
          [](const py::object& self) {
            const auto& r = self.cast<const Registration&>();
            return ViewPoints(r.summary.matched_target, self);
          },
          "(M, 3) float64: voxel means of the target [m]. A view.")
      .def_property_readonly(
          "refinement",
          [](const Registration& r) { return RefinementOf(r.summary); },
          "dict or None: result of refine=..., if any: method, is_accepted, "
          "message, moved_translation [m], moved_rotation [rad], "
          "unrefined_target_from_source.")
      .def_property_readonly(
          "num_source_voxels",
          [](const Registration& r) { return r.summary.num_source_voxels; },
          "int: points of the source after sampling.")
      .def_property_readonly(
          "num_target_voxels",
          [](const Registration& r) { return r.summary.num_target_voxels; },
          "int: points of the target after sampling.")
      .def_property_readonly(
          "num_mutual_matches",
          [](const Registration& r) { return r.summary.num_mutual_matches; },
          "int: matches before the tuple test.")
      .def_property_readonly(
          "rung",
          [](const Registration& r) { return r.summary.rung; },
          "int: 0 if the estimator's own pose is the answer, else the rung of "
          "the search that gave it.")
      .def_property_readonly(
          "scale_factor",
          [](const Registration& r) { return r.summary.scale_factor; },
          "float: the lengths of the front end and the noise bound are those "
          "of the options times this.")
      .def_property_readonly(
          "candidates",
          [](const Registration& r) {
            py::list list;
            for (const PoseCandidate& candidate : r.summary.candidates) {
              py::dict entry;
              entry["target_from_source"] =
                  Copy(std::optional<Rigid3>(candidate.target_from_source));
              entry["origin"] = candidate.origin;
              entry["score"] = candidate.Score();
              entry["overlap"] = candidate.geometry.overlap;
              entry["contradicted_share"] =
                  candidate.geometry.contradicted_share;
              entry["log_likelihood_ratio"] = candidate.log_likelihood_ratio;
              list.append(entry);
            }
            return list;
          },
          "list of dict: poses that the search found, the best of each rung "
          "first: target_from_source, origin, score, overlap, "
          "contradicted_share, log_likelihood_ratio. Empty without a search.")
      .def_readonly("num_source_dropped",
                    &Registration::num_source_dropped,
                    "int: points of the source that are not finite, or zero.")
      .def_readonly("num_target_dropped",
                    &Registration::num_target_dropped,
                    "int: points of the target that are not finite, or zero.");

  py::class_<Alignment>(*module, "Alignment", "The result of local alignment.")
      .def("__repr__",
           [](const Alignment& a) {
             const AlignmentSummary& s = a.summary;
             std::string text = std::string("Alignment(") +
                                TerminationName(s.termination) + ", " +
                                a.method;
             if (s.target_from_source) {
               text += ", " + Describe(*s.target_from_source);
             }
             return text +
                    ", iterations=" + std::to_string(s.iterations.size()) +
                    ", inliers=" + std::to_string(s.num_inliers) + ": " +
                    s.message + ")";
           })
      .def("as_dict", &AsDict, kAsDictDoc)
      .def(
          "transform",
          [](const Alignment& a, const py::object& points) {
            return Transform(
                a.summary.target_from_source, a.summary.message, points);
          },
          py::arg("points"),
          kTransformDoc)
      .def_readonly("method", &Alignment::method, "str: icp, gicp or vgicp.")
      .def_property_readonly(
          "termination",
          [](const Alignment& a) {
            return std::string(TerminationName(a.summary.termination));
          },
          "str: converged, not_converged, degenerate or insufficient.")
      .def_property_readonly(
          "is_usable",
          [](const Alignment& a) { return a.summary.IsUsable(); },
          "bool: there is a pose, which is not necessarily correct.")
      .def_property_readonly(
          "message",
          [](const Alignment& a) { return a.summary.message; },
          "str: why it stopped.")
      .def_property_readonly(
          "target_from_source",
          [](const Alignment& a) { return Copy(a.summary.target_from_source); },
          "(4, 4) float64 or None: moves homogeneous points of the source onto "
          "the target [m].")
      .def_property_readonly(
          "cost",
          [](const Alignment& a) { return a.summary.cost; },
          "float: final cost.")
      .def_property_readonly(
          "costs",
          [](const Alignment& a) {
            py::list costs;
            for (const AlignmentIteration& iteration : a.summary.iterations) {
              costs.append(iteration.cost);
            }
            return costs;
          },
          "list of float: cost before each step.")
      .def_property_readonly(
          "num_inliers",
          [](const Alignment& a) { return a.summary.num_inliers; },
          "int: corresponding points.")
      .def_property_readonly(
          "conditioning",
          [](const Alignment& a) { return a.summary.conditioning; },
          "float: the smallest eigenvalue of the Hessian over the largest.")
      .def_property_readonly(
          "hessian",
          [](const Alignment& a) { return Copy(a.summary.hessian); },
          "(6, 6) float64: Hessian of half the cost, rotation [rad] first.")
      .def_property_readonly(
          "stage_seconds",
          [](const Alignment& a) { return Seconds(a.summary.stage_times); },
          "dict: time by stage [s].");
}

}  // namespace quatro
