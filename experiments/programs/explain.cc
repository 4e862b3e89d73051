// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/programs/explain.h"

#include <cmath>
#include <sstream>
#include <vector>

namespace quatro {
namespace {

constexpr std::size_t kWidth = 79;
constexpr std::size_t kIndent = 14;

// Fewer matches than these seldom hold a pose among outliers.
constexpr int kFewMatches = 100;

// "label:       text", wrapped.
std::string Paragraph(std::string label, const std::string& text) {
  if (!label.empty()) label += ':';
  label.resize(kIndent, ' ');
  std::string paragraph = label;
  std::size_t column = kIndent;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    if (column > kIndent && column + 1 + word.size() > kWidth) {
      paragraph += '\n' + std::string(kIndent, ' ');
      column = kIndent;
    } else if (column > kIndent) {
      paragraph += ' ';
      ++column;
    }
    paragraph += word;
    column += word.size();
  }
  return paragraph + '\n';
}

// The value at a path of names, null if there is none.
Json At(const Json& json, const std::vector<std::string>& path) {
  const Json* value = &json;
  for (const std::string& name : path) {
    if (!value->is_object() || !value->contains(name)) return nullptr;
    value = &(*value)[name];
  }
  return *value;
}

// A number as a reader wants it; "?" if there is none.
std::string Number(const Json& value, int digits = 3) {
  if (!value.is_number()) return "?";
  std::ostringstream text;
  if (value.is_number_integer()) {
    text << value.get<long long>();
  } else {
    text.precision(digits);
    text << value.get<double>();
  }
  return text.str();
}

double NumberOr(const Json& value, double otherwise) {
  return value.is_number() ? value.get<double>() : otherwise;
}

std::string Percent(const Json& share) {
  return share.is_number()
             ? Number(std::round(100.0 * share.get<double>())) + " %"
             : "?";
}

// ", as by chance in 1 of 1e12 problems" for the stage, if it was tested.
std::string ByChance(const Json& report, const std::string& stage) {
  for (const Json& alarms : At(report, {"evidence", "false_alarms"})) {
    if (alarms["stage"] != stage) continue;
    const double exponent = -alarms["log10_false_alarms"].get<double>();
    if (exponent < 1.0) return ", as chance alone would give";
    return ", as chance alone would give in 1 of 1e" +
           Number(std::floor(exponent), 12) + " problems";
  }
  return "";
}

std::string Note(const Json& report, const std::string& stage) {
  const Json note = At(report, {"notes", stage});
  return note.is_string() ? "; " + note.get<std::string>() : "";
}

// Not so with a method that takes the clouds alone.
bool HasMatches(const Json& report) {
  const Json counts = At(report, {"counts"});
  return counts.contains("mutual_matches") || !counts.contains("source_voxels");
}

std::string ExplainFrontEnd(const Json& report) {
  const Json counts = At(report, {"counts"});
  if (!counts.contains("source_voxels")) return "";
  const auto parameter = [&](const char* name) {
    return Number(At(report, {"parameters", name}));
  };
  const auto dropped = [&](const char* name) {
    const Json count = At(counts, {name});
    return NumberOr(count, 0.0) > 0.0
               ? " (" + Number(count) + " were not finite and dropped)"
               : std::string();
  };
  std::string text = Paragraph(
      "voxels",
      "of " + Number(counts["source_points"]) + " points of the source" +
          dropped("source_dropped") + " " + Number(counts["source_voxels"]) +
          " means in voxels of " + parameter("voxel_size") +
          " m are kept, of the target's " + Number(counts["target_points"]) +
          dropped("target_dropped") + " " + Number(counts["target_voxels"]));
  if (!HasMatches(report)) return text;
  text += Paragraph("features",
                    "normals within " + parameter("normal_radius") +
                        " m, FPFH within " + parameter("fpfh_radius") + " m");
  return text +
         Paragraph(
             "matching",
             Number(counts["mutual_matches"]) +
                 " points are each other's nearest by FPFH; the tuple test "
                 "keeps " +
                 Number(counts["matches"]) + " of their matches");
}

std::string ExplainSolver(const Json& report) {
  const Json counts = At(report, {"counts"});
  std::string text;
  if (HasMatches(report)) {
    text += Paragraph("consensus",
                      Number(counts["consistent"]) + " of " +
                          Number(counts["matches"]) +
                          " distinct matches are consistent with each other" +
                          ByChance(report, "clique"));
  }
  if (NumberOr(counts["tims"], 0.0) > 0.0) {
    text +=
        Paragraph("rotation",
                  Number(counts["rotation_inliers"]) + " of " +
                      Number(counts["tims"]) + " differences agree with it" +
                      ByChance(report, "rotation") + Note(report, "rotation"));
  }
  const Json gap = At(report, {"certificate", "gap"});
  if (gap.is_number()) {
    text += Paragraph(
        "certificate",
        gap.get<double>() <= 1e-6
            ? "the yaw is the global optimum of its problem, of cost " +
                  Number(report["certificate"]["optimal_cost"])
            : "graduated non-convexity stopped " + Number(gap) +
                  " above the optimum, of cost " +
                  Number(report["certificate"]["optimal_cost"]));
  }
  if (HasMatches(report) && !At(report, {"target_from_source"}).is_null()) {
    text += Paragraph("translation",
                      Number(counts["translation_inliers"]) +
                          " matches are within the noise bound of " +
                          Number(At(report, {"parameters", "noise_bound"})) +
                          " m on each axis" + Note(report, "recovery"));
  }
  const Json polish = At(report, {"notes", "polish"});
  if (polish.is_string()) text += Paragraph("polish", polish);
  const Json ins_mode = At(report, {"parameters", "ins_mode"});
  if (ins_mode.is_string() && ins_mode != "none") {
    text +=
        Paragraph("ins",
                  "roll and pitch of the INS, " + ins_mode.get<std::string>() +
                      "; " + report["message"].get<std::string>());
  }
  const Json refinement = At(report, {"refinement"});
  if (refinement.is_object()) {
    text += Paragraph("refinement",
                      refinement["method"].get<std::string>() + " moved by " +
                          Number(refinement["moved_m"]) + " m and " +
                          Number(refinement["moved_deg"]) +
                          " deg: " + refinement["message"].get<std::string>());
  }
  const Json unobservable = At(report, {"unobservable_directions"});
  if (unobservable.is_array() && !unobservable.empty()) {
    std::string directions;
    for (const Json& direction : unobservable) {
      if (!directions.empty()) directions += "; ";
      directions += direction.is_string()
                        ? direction.get<std::string>()
                        : At(direction, {"text"}).get<std::string>();
    }
    text += Paragraph("not held", directions);
  }
  return text;
}

std::string ExplainEvidence(const Json& report) {
  std::string text;
  const Json rival = At(report, {"evidence", "rival"});
  if (rival.is_object()) {
    text +=
        Paragraph("rival",
                  "the best other pose has " + Number(rival["inliers"]) +
                      " matches against " +
                      Number(report["counts"]["inliers"]) + ", a margin of " +
                      Number(rival["margin"], 2) + " standard deviations");
  }
  const Json geometry = At(report, {"evidence", "geometry"});
  if (geometry.is_object()) {
    text += Paragraph(
        "geometry",
        Percent(geometry["structure_overlap"]) +
            " of what stands in one scan is met in the other, " +
            Percent(geometry["contradicted_share"]) +
            " of the surfaces stand where the other scan saw through; under "
            "the best other pose " +
            Percent(geometry["rival_overlap"]) + " are met, against " +
            Percent(geometry["coarse_overlap"]));
  }
  return text;
}

// What to change, from what failed.
std::vector<std::string> Advice(const Json& report) {
  std::vector<std::string> advice;
  if (report["status"] == "registered") return advice;
  const Json counts = At(report, {"counts"});
  const double num_matches = NumberOr(At(counts, {"matches"}), 0.0);
  const double num_mutual = NumberOr(At(counts, {"mutual_matches"}), 0.0);
  const bool has_clouds = counts.contains("mutual_matches");
  if (has_clouds && num_matches < kFewMatches) {
    advice.emplace_back(
        "there are few matches: larger radii (--fpfh_radius of five voxels and "
        "more, --normal_radius of three), smaller voxels (--voxel_size), or "
        "--preset=auto, which looks at the density of the scans");
    if (num_mutual > 0.0 && num_mutual >= 10.0 * num_matches) {
      advice.emplace_back(
          "the tuple test left less than a tenth of the matches: descriptors "
          "tell little here, or the scans share little");
    }
  }
  if (!HasMatches(report)) {
    if (report["status"] == "insufficient") {
      advice.emplace_back(
          "too little of one scan is near the other: a method with matches "
          "first, this one as its --refine");
    } else if (report["status"] == "degenerate") {
      advice.emplace_back(
          "the surfaces do not hold the pose: scans of more than one wall, a "
          "smaller --voxel_size, or odometry for what is not held");
    }
  } else if (report["status"] == "insufficient") {
    advice.emplace_back(
        "too few matches are consistent with each other: a larger "
        "--noise_bound, or matches with fewer outliers");
  } else if (report["status"] == "degenerate") {
    advice.emplace_back(
        "the consistent matches do not hold the pose: they are at one place or "
        "on one line; larger radii or scans that share more would add others");
  }
  const Json evidence = At(report, {"evidence"});
  const Json alarms = At(evidence, {"false_alarms"});
  const bool is_accidental =
      !alarms.empty() &&
      alarms.back()["log10_false_alarms"].get<double>() > -3.0;
  if (is_accidental) {
    advice.emplace_back(
        "no consensus stands out from chance: the scans share no place, or the "
        "matches are too poor; scans nearer to each other, or other radii");
  } else if (NumberOr(At(evidence, {"rival", "margin"}), 9.0) < 2.0) {
    advice.emplace_back(
        "another pose has nearly as many matches: the place is symmetric or "
        "repeats itself, or the matches lie at one place; a rough guess of the "
        "pose can decide, evidence.rival has the other one");
  }
  const Json geometry = At(evidence, {"geometry"});
  if (geometry.is_object()) {
    if (NumberOr(geometry["structure_overlap"], 1.0) < 0.3) {
      advice.emplace_back(
          "little of the structure is met: the scans share no place, or less "
          "than can be told; take scans that are nearer to each other");
    } else if (NumberOr(geometry["coarse_overlap"], 1.0) -
                   NumberOr(geometry["rival_overlap"], 0.0) <
               0.1) {
      advice.emplace_back(
          "the scans fit as well elsewhere: a corridor or a symmetric place, "
          "where geometry cannot tell; use odometry");
    }
    if (NumberOr(geometry["contradicted_share"], 0.0) > 0.3) {
      advice.emplace_back(
          "surfaces stand in free space of the other scan: the pose is wrong, "
          "or most of what was seen moved between the scans");
    }
  }
  const Json ins_mode = At(report, {"parameters", "ins_mode"});
  if (ins_mode == "none" && At(report, {"notes", "polish"}).is_string() &&
      At(report, {"unpolished_target_from_source"}).is_null() &&
      !At(report, {"target_from_source"}).is_null()) {
    advice.emplace_back(
        "roll and pitch were taken to be zero, since the matches do not hold "
        "them; on slopes give those of an INS (--ins_mode)");
  }
  return advice;
}

}  // namespace

std::string Explain(const Json& report) {
  std::string text = ExplainFrontEnd(report);
  text += ExplainSolver(report);
  text += ExplainEvidence(report);
  std::string verdict = report["status"].get<std::string>();
  const double probability = NumberOr(At(report, {"probability"}), 0.0);
  if (!At(report, {"target_from_source"}).is_null()) {
    verdict += ", right with a probability of " + Number(probability, 4);
  }
  text += Paragraph("verdict",
                    verdict + ": " + report["reason"].get<std::string>());
  std::string label = "what to do";
  for (const std::string& advice : Advice(report)) {
    text += Paragraph(label, advice);
    label.clear();
  }
  return text;
}

}  // namespace quatro
