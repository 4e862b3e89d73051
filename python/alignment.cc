// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include <string>

#include "python/arrays.h"
#include "python/class_parts.h"
#include "python/summaries.h"

namespace quatro {
namespace {

namespace py = pybind11;

std::string Represent(const Alignment& a) {
  const AlignmentSummary& s = a.summary;
  std::string text = std::string("Alignment(") +
                     TerminationName(s.termination) + ", " + a.method;
  if (s.target_from_source) text += ", " + Describe(*s.target_from_source);
  return text + ", iterations=" + std::to_string(s.iterations.size()) +
         ", inliers=" + std::to_string(s.num_inliers) + ": " + s.message + ")";
}

}  // namespace

void BindAlignment(py::module_* module) {
  py::class_<Alignment>(*module, "Alignment", "The result of local alignment.")
      .def("__repr__", &Represent)
      .def("as_dict", &AsDict, kAsDictDoc)
      .def(
          "transform",
          [](const Alignment& a,
             const py::args& args,
             const py::kwargs& named) {
            return Transform(
                a.summary.target_from_source, a.summary.message, args, named);
          },
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
