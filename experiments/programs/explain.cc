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

// Below this number, matches rarely determine a pose despite outliers.
constexpr int kFewMatches = 100;

// Formats "label:       text" with wrapped lines.
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

// The value at a path of names; null if it does not exist.
Json At(const Json& json, const std::vector<std::string>& path) {
  const Json* value = &json;
  for (const std::string& name : path) {
    if (!value->is_object() || !value->contains(name)) return nullptr;
    value = &(*value)[name];
  }
  return *value;
}

// Formats a number for people; "?" if there is none.
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

// "; chance alone would ... once in 1e12 problems" for a stage that was tested.
std::string ByChance(const Json& report, const std::string& stage) {
  for (const Json& alarms : At(report, {"evidence", "false_alarms"})) {
    if (alarms["stage"] != stage) continue;
    const double exponent = -alarms["log10_false_alarms"].get<double>();
    if (exponent < 1.0) return "; chance alone would produce such a consensus";
    return "; chance alone would produce such a consensus once in 1e" +
           Number(std::floor(exponent), 12) + " problems";
  }
  return "";
}

std::string Note(const Json& report, const std::string& stage) {
  const Json note = At(report, {"notes", stage});
  return note.is_string() ? "; " + note.get<std::string>() : "";
}

// Returns false for a method that uses only the clouds.
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
               ? " (" + Number(count) + " not finite or zero, dropped)"
               : std::string();
  };
  std::string text = Paragraph(
      "voxels",
      "the " + Number(counts["source_points"]) + " source points" +
          dropped("source_dropped") + " are sampled to " +
          Number(counts["source_voxels"]) + " voxel means, the " +
          Number(counts["target_points"]) + " target points" +
          dropped("target_dropped") + " to " + Number(counts["target_voxels"]) +
          "; the voxel size is " + parameter("voxel_size") + " m");
  if (!HasMatches(report)) return text;
  text += Paragraph("features",
                    "normals within " + parameter("normal_radius") +
                        " m, FPFH within " + parameter("fpfh_radius") + " m");
  return text +
         Paragraph("matching",
                   Number(counts["mutual_matches"]) +
                       " pairs are mutual nearest neighbors by FPFH" +
                       (NumberOr(At(report, {"rung"}), 0.0) > 0.0
                            ? std::string()
                            : "; the tuple test keeps " +
                                  Number(counts["matches"]) + " of them"));
}

// Explains how the search chose the pose.
std::string ExplainSearch(const Json& report) {
  const Json candidates = At(report, {"candidates"});
  if (!candidates.is_array() || candidates.empty()) return {};
  const double rung = NumberOr(At(report, {"rung"}), 0.0);
  std::string text =
      "the matches that passed the tuple test gave no pose that could be "
      "registered, so " +
      std::to_string(candidates.size()) +
      " candidates were aligned with the scans; ";
  text += rung == 0.0 ? std::string("none is more probable")
                      : "the answer is from rung " + Number(rung);
  // The best candidate of the rung that gave the answer.
  const std::string origin = "rung " + Number(rung == 0.0 ? 1.0 : rung);
  std::size_t first = 0;
  while (first + 1 < candidates.size() &&
         !candidates[first]["origin"].get<std::string>().starts_with(origin)) {
    ++first;
  }
  const Json& best = candidates[first];
  text += "; the best has a score of " + Number(best["score"], 2) + ", with " +
          Percent(best["overlap"]) + " overlap and " +
          Percent(best["contradicted_share"]) + " in free space (" +
          best["origin"].get<std::string>() + ")";
  if (first + 1 < candidates.size()) {
    text += ", the next one " + Number(candidates[first + 1]["score"], 2);
  }
  return Paragraph("search", text);
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
                      Number(counts["tims"]) + " differences are inliers" +
                      ByChance(report, "rotation") + Note(report, "rotation"));
  }
  const Json gap = At(report, {"certificate", "gap"});
  if (gap.is_number()) {
    text += Paragraph(
        "certificate",
        gap.get<double>() <= 1e-6
            ? "the yaw is the global optimum of its problem, with cost " +
                  Number(report["certificate"]["optimal_cost"])
            : "GNC stopped " + Number(gap) +
                  " above the optimum, whose cost is " +
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
    text +=
        Paragraph("refinement",
                  refinement["method"].get<std::string>() +
                      " moved the pose by " + Number(refinement["moved_m"]) +
                      " m and " + Number(refinement["moved_deg"]) +
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
    text += Paragraph("unobservable", directions);
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
                      " inliers, compared with " +
                      Number(report["counts"]["inliers"]) + ", a margin of " +
                      Number(rival["margin"], 2) + " standard deviations");
  }
  const Json geometry = At(report, {"evidence", "geometry"});
  if (geometry.is_object()) {
    text += Paragraph(
        "geometry",
        Percent(geometry["structure_overlap"]) +
            " of the vertical structure overlaps, " +
            Percent(geometry["contradicted_share"]) +
            " of the surfaces are in free space of the other scan; the best "
            "other pose has an overlap of " +
            Percent(geometry["rival_overlap"]) + ", compared with " +
            Percent(geometry["coarse_overlap"]));
    if (geometry["guided_matches"].is_number()) {
      text += Paragraph("guided",
                        Number(geometry["guided_inliers"]) + " of " +
                            Number(geometry["guided_matches"]) +
                            " matches near the pose are inliers");
    }
  }
  return text;
}

// Advice if the front end found few matches.
void AdviseOnMatches(const Json& report, std::vector<std::string>* advice) {
  const Json counts = At(report, {"counts"});
  const double num_matches = NumberOr(At(counts, {"matches"}), 0.0);
  const double num_mutual = NumberOr(At(counts, {"mutual_matches"}), 0.0);
  const bool has_clouds = counts.contains("mutual_matches");
  if (has_clouds && num_matches < kFewMatches) {
    advice->emplace_back(
        "there are few matches: try larger radii (--fpfh_radius of at least "
        "five voxels, --normal_radius of at least three), smaller voxels "
        "(--voxel_size), or --preset=auto, which adapts to the density of the "
        "scans");
    if (num_mutual > 0.0 && num_mutual >= 10.0 * num_matches) {
      advice->emplace_back(
          "the tuple test kept less than a tenth of the matches: the "
          "descriptors are not distinctive here, or the overlap is small");
    }
  }
}

// Advice for a status without a pose.
void AdviseOnStatus(const Json& report, std::vector<std::string>* advice) {
  if (!HasMatches(report)) {
    if (report["status"] == "insufficient") {
      advice->emplace_back(
          "too few points of one scan are near the other: use a method with "
          "matches first, and this one as its --refine");
    } else if (report["status"] == "degenerate") {
      advice->emplace_back(
          "the surfaces do not constrain the pose: use scans of more than one "
          "wall, a smaller --voxel_size, or odometry for the unconstrained "
          "directions");
    }
  } else if (report["status"] == "insufficient") {
    advice->emplace_back(
        "too few matches are consistent with each other: try a larger "
        "--noise_bound, or matches with fewer outliers");
  } else if (report["status"] == "degenerate") {
    advice->emplace_back(
        "the consistent matches do not constrain the pose because they are at "
        "one point or on one line: try larger radii or scans with more "
        "overlap");
  }
}

// Advice if chance or another pose explains the consensus.
void AdviseOnConsensus(const Json& report, std::vector<std::string>* advice) {
  const Json evidence = At(report, {"evidence"});
  const Json alarms = At(evidence, {"false_alarms"});
  const bool is_accidental =
      !alarms.empty() &&
      alarms.back()["log10_false_alarms"].get<double>() > -3.0;
  if (is_accidental) {
    advice->emplace_back(
        "no consensus stands out from chance: the scans do not overlap, or the "
        "matches are too poor; try scans closer to each other, or other radii");
  } else if (NumberOr(At(evidence, {"rival", "margin"}), 9.0) < 2.0) {
    advice->emplace_back(
        "another pose has nearly as many inliers: the place is symmetric or "
        "repetitive, or the matches are close together; a rough guess of the "
        "pose can decide (evidence.rival has the other pose)");
  }
}

// Advice if the geometry of the scans contradicts the pose.
void AdviseOnGeometry(const Json& report, std::vector<std::string>* advice) {
  const Json geometry = At(report, {"evidence", "geometry"});
  if (geometry.is_object()) {
    if (NumberOr(geometry["structure_overlap"], 1.0) < 0.3) {
      advice->emplace_back(
          "little of the structure overlaps: the scans show different places, "
          "or the overlap is too small to measure; use scans closer to each "
          "other");
    } else if (NumberOr(geometry["coarse_overlap"], 1.0) -
                   NumberOr(geometry["rival_overlap"], 0.0) <
               0.1) {
      advice->emplace_back(
          "the scans fit as well at another pose: in a corridor or a symmetric "
          "place geometry cannot decide; use odometry");
    }
    if (NumberOr(geometry["contradicted_share"], 0.0) > 0.3) {
      advice->emplace_back(
          "surfaces are in free space of the other scan: the pose is "
          "incorrect, or most of the scene moved between the scans");
    }
  }
}

// Recommends changes, depending on what failed.
std::vector<std::string> Advice(const Json& report) {
  std::vector<std::string> advice;
  if (report["status"] == "registered") return advice;
  AdviseOnMatches(report, &advice);
  AdviseOnStatus(report, &advice);
  AdviseOnConsensus(report, &advice);
  AdviseOnGeometry(report, &advice);
  const Json ins_mode = At(report, {"parameters", "ins_mode"});
  if (ins_mode == "none" && At(report, {"notes", "polish"}).is_string() &&
      At(report, {"unpolished_target_from_source"}).is_null() &&
      !At(report, {"target_from_source"}).is_null()) {
    advice.emplace_back(
        "roll and pitch were assumed to be zero because the matches do not "
        "constrain them: on slopes, provide those of an INS (--ins_mode)");
  }
  return advice;
}

}  // namespace

std::string Explain(const Json& report) {
  std::string text = ExplainFrontEnd(report);
  text += ExplainSearch(report);
  text += ExplainSolver(report);
  text += ExplainEvidence(report);
  std::string verdict = report["status"].get<std::string>();
  const double probability = NumberOr(At(report, {"probability"}), 0.0);
  if (!At(report, {"target_from_source"}).is_null()) {
    const Json tolerance = At(report, {"tolerance"});
    verdict += ", within " + Number(tolerance["translation_m"]) + " m and " +
               Number(tolerance["rotation_deg"]) +
               " deg of the true pose with a probability of " +
               Number(probability, 4);
    const Json radius = At(report, {"error_radius"});
    if (radius.is_object() && report["status"] == "registered") {
      verdict += ", and within " + Number(radius["translation_m"], 2) +
                 " m and " + Number(radius["rotation_deg"], 2) +
                 " deg, 19 times in 20";
    }
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
