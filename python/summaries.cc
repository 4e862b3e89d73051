// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "python/summaries.h"

#include <optional>
#include <string>
#include <vector>

#include "features/base/rigid3.h"
#include "python/arrays.h"
#include "python/class_parts.h"

namespace quatro {
namespace {

namespace py = pybind11;

template <typename Summary>
const PoseSummary& SolutionOf(const Summary& s) {
  return s.summary.solution;
}
template <typename Summary>
const Verdict& VerdictOf(const Summary& s) {
  return s.summary.verdict;
}

// Formats "Solution(registered, quatro, probability=0.99, yaw=...)".
template <typename Summary>
std::string Represent(const char* name, const Summary& summary) {
  const PoseSummary& solution = SolutionOf(summary);
  const Verdict& verdict = VerdictOf(summary);
  std::string text = std::string(name) + "(" + StatusName(verdict.status) +
                     ", " + summary.method;
  if (solution.target_from_source) {
    text += Print(", probability=%.2f, ", verdict.probability) +
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

py::list CandidatesOf(const RegistrationSummary& summary) {
  py::list list;
  for (const PoseCandidate& candidate : summary.candidates) {
    py::dict entry;
    entry["target_from_source"] =
        Copy(std::optional<Rigid3>(candidate.target_from_source));
    entry["origin"] = candidate.origin;
    entry["score"] = candidate.Score();
    entry["overlap"] = candidate.geometry.overlap;
    entry["contradicted_share"] = candidate.geometry.contradicted_share;
    entry["log_likelihood_ratio"] = candidate.log_likelihood_ratio;
    list.append(entry);
  }
  return list;
}

// Returns a function that adds a read-only property: add(name, doc, get).
template <typename Summary>
auto Adder(py::class_<Summary>* type) {
  return [type](const char* field, const char* doc, auto get) {
    type->def_property_readonly(field, get, doc);
  };
}

// The method, the verdict and how the estimator ended.
template <typename Summary>
void BindStatus(py::class_<Summary>* type) {
  const auto add = Adder(type);
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
      "float: that the pose is within the tolerance; 0 if there is no pose.",
      [](const Summary& s) { return VerdictOf(s).probability; });
  add("tolerance",
      "tuple: a pose is correct within these errors, meters and degrees.",
      [](const Summary& s) {
        const SuccessTolerance& tolerance = VerdictOf(s).tolerance;
        return py::make_tuple(tolerance.translation,
                              tolerance.rotation * 180.0 / M_PI);
      });
  add("features", "dict: the inputs of the probability.", [](const Summary& s) {
    py::dict dict;
    for (const Feature& feature : VerdictOf(s).features) {
      dict[py::str(feature.name)] = feature.value;
    }
    return dict;
  });
}

// The pose and its uncertainty.
template <typename Summary>
void BindPose(py::class_<Summary>* type) {
  const auto add = Adder(type);
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
}

// Inliers and counts.
template <typename Summary>
void BindCounts(py::class_<Summary>* type) {
  const auto add = Adder(type);
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
}

// Certificate, times and notes of the stages.
template <typename Summary>
void BindStages(py::class_<Summary>* type) {
  const auto add = Adder(type);
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

// The members that results from matches and from clouds have in common.
template <typename Summary>
void BindCommon(const char* name, py::class_<Summary>* type) {
  type->def("__repr__",
            [name](const Summary& s) { return Represent(name, s); });
  type->def("as_dict", &AsDict, kAsDictDoc);
  type->def(
      "transform",
      [](const Summary& s, const py::args& args, const py::kwargs& named) {
        return Transform(SolutionOf(s).target_from_source,
                         SolutionOf(s).message,
                         args,
                         named);
      },
      kTransformDoc);
  BindStatus(type);
  BindPose(type);
  BindCounts(type);
  BindStages(type);
}

// How the clouds were sampled and matched, and what the search did.
void BindSearch(py::class_<Registration>* registration) {
  registration
      ->def_property_readonly(
          "num_source_voxels",
          [](const Registration& r) { return r.summary.num_source_voxels; },
          "int: points of the source after sampling.")
      .def_property_readonly(
          "num_target_voxels",
          [](const Registration& r) { return r.summary.num_target_voxels; },
          "int: points of the target after sampling.")
      .def_property_readonly(
          "error_radius",
          [](const Registration& r) -> py::object {
            const auto& radius = r.summary.error_radius;
            if (!radius) return py::none();
            return py::make_tuple(radius->translation,
                                  radius->rotation * 180.0 / M_PI);
          },
          "tuple or None: meters and degrees that a registered pose is off by "
          "at most, 19 times in 20.")
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
          "leveled_by",
          [](const Registration& r) { return r.summary.leveled_by; },
          "str: what the vertical came from: 'given', or the scans' own "
          "'matches' or 'normals'.")
      .def_property_readonly(
          "candidates",
          [](const Registration& r) { return CandidatesOf(r.summary); },
          "list of dict: poses that the search found, the best of each rung "
          "first: target_from_source, origin, score, overlap, "
          "contradicted_share, log_likelihood_ratio. Empty without a search.")
      .def_readonly("num_source_dropped",
                    &Registration::num_source_dropped,
                    "int: points of the source that are not finite, or zero.")
      .def_readonly("num_target_dropped",
                    &Registration::num_target_dropped,
                    "int: points of the target that are not finite, or zero.");
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
          "unrefined_target_from_source.");
  BindSearch(&registration);
}

}  // namespace quatro
