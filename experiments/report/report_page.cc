// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/report/report_page.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>

#include "experiments/report/base64.h"
#include "experiments/report/report_template.h"
#include "features/base/degree.h"

namespace quatro {
namespace {

using Json = nlohmann::ordered_json;

// In JSON, "<" occurs only in strings, where it can be escaped. An HTML parser
// then finds neither tags nor comments.
std::string EscapeJson(std::string_view json) {
  std::string escaped;
  escaped.reserve(json.size());
  for (const char c : json) {
    if (c == '<') {
      escaped += "\\u003c";
    } else {
      escaped += c;
    }
  }
  return escaped;
}

std::string EscapeHtml(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    switch (c) {
      case '<':
        escaped += "&lt;";
        break;
      case '&':
        escaped += "&amp;";
        break;
      default:
        escaped += c;
    }
  }
  return escaped;
}

// Replaces invalid UTF-8 instead of throwing.
std::string Dump(const Json& json) {
  return EscapeJson(json.dump(-1, ' ', false, Json::error_handler_t::replace));
}

// Rounds to six digits, enough for any reader.
Json Rounded(const std::optional<double>& value) {
  if (!value || !std::isfinite(*value)) return nullptr;
  char text[32];
  std::snprintf(text, sizeof(text), "%.6g", *value);
  return std::strtod(text, nullptr);
}

Json Describe(const std::vector<SuccessLimit>& limits) {
  Json list = Json::array();
  for (const SuccessLimit& limit : limits) {
    list.push_back({{"name", limit.Name()},
                    {"translation_m", limit.translation},
                    {"rotation_deg", Rounded(limit.rotation / kDegree)}});
  }
  return list;
}

Json Describe(const std::vector<RunTable>& tables) {
  Json list = Json::array();
  for (const RunTable& table : tables) {
    list.push_back({{"name", table.name},
                    {"caption", table.caption},
                    {"columns", table.with_intervals.columns},
                    {"rows", table.with_intervals.rows}});
  }
  return list;
}

Json Describe(const PairResult& result) {
  const auto& error = result.error;
  Json stages = Json::array();
  for (const StageTime& stage : result.stage_times) {
    stages.push_back({stage.stage, Rounded(1e3 * stage.seconds)});
  }
  return {result.pair,
          result.set,
          result.bin,
          result.method,
          result.status,
          error ? Rounded(error->translation) : Json(),
          error ? Rounded(error->rotation / kDegree) : Json(),
          Rounded(result.distance),
          result.is_truth_known,
          Rounded(result.probability),
          result.num_matches,
          result.num_consistent,
          result.num_inliers,
          Rounded(1e3 * result.total_seconds),
          stages};
}

Json DescribePairs(const std::vector<PairResult>& results,
                   std::size_t max_rows) {
  Json rows = Json::array();
  for (std::size_t i = 0; i < std::min(max_rows, results.size()); ++i) {
    rows.push_back(Describe(results[i]));
  }
  return {{"columns",
           {"pair",
            "set",
            "bin",
            "method",
            "status",
            "t_m",
            "r_deg",
            "distance_m",
            "is_truth_known",
            "probability",
            "matches",
            "consistent",
            "inliers",
            "ms",
            "stages"}},
          {"rows", rows}};
}

// The number of items, from the start of the list, that fit into the remaining
// bytes.
template <typename Item, typename SizeOf>
std::size_t CountFitting(const std::vector<Item>& items,
                         const SizeOf& size_of,
                         std::size_t* bytes_left) {
  std::size_t count = 0;
  while (count < items.size() && size_of(items[count]) <= *bytes_left) {
    *bytes_left -= size_of(items[count]);
    ++count;
  }
  return count;
}

std::string NoteLeftOut(std::size_t shown,
                        std::size_t all,
                        const std::string& what) {
  return "To keep this page small, " + std::to_string(shown) + " of " +
         std::to_string(all) + " " + what;
}

std::string ViewElement(const std::string& json, std::size_t index) {
  return "<script type=\"application/json\" id=\"view-" +
         std::to_string(index) + "\">" + json + "</script>\n";
}

// Replaces the marks of the template, each of which occurs once and in order.
std::string FillTemplate(std::string_view text,
                         const std::string& title,
                         const std::string& data,
                         const std::string& views) {
  std::string filled;
  filled.reserve(text.size() + data.size() + views.size());
  const auto fill = [&](std::string_view mark, const std::string& content) {
    const std::size_t at = text.find(mark);
    filled.append(text.substr(0, at)).append(content);
    text.remove_prefix(at + mark.size());
  };
  fill(kTitleMark, title);
  fill(kDataMark, data);
  fill(kViewsMark, views);
  return filled.append(text);
}

}  // namespace

std::string FormatReportPage(const ReportPage& page,
                             const std::string& report_template,
                             const PageLimits& limits) {
  Json data = {{"title", page.title},
               {"manifest", Json::parse(FormatManifest(page.manifest))},
               {"limits", Describe(page.limits)},
               {"tables", Describe(page.tables)},
               {"pairs", DescribePairs(page.results, limits.max_rows)},
               {"figures", Json::array()},
               {"views", Json::object()},
               {"notes", Json::array()}};
  if (page.results.size() > limits.max_rows) {
    data["notes"].push_back(NoteLeftOut(limits.max_rows,
                                        page.results.size(),
                                        "rows of pairs are shown; all are in "
                                        "results.csv."));
  }

  constexpr std::size_t kMargin = 10'000;  // For notes and elements.
  const std::size_t used = report_template.size() + Dump(data).size() + kMargin;
  std::size_t bytes_left =
      limits.max_bytes > used ? limits.max_bytes - used : 0;
  const std::size_t num_figures = CountFitting(
      page.figures,
      [](const ReportFigure& figure) {
        return figure.png.size() * 4 / 3 + 100;
      },
      &bytes_left);
  for (std::size_t i = 0; i < num_figures; ++i) {
    data["figures"].push_back({{"name", page.figures[i].name},
                               {"png", EncodeBase64(page.figures[i].png)}});
  }
  if (num_figures < page.figures.size()) {
    data["notes"].push_back(
        NoteLeftOut(num_figures, page.figures.size(), "figures are included."));
  }
  std::vector<std::string> escaped;
  for (const ReportView& view : page.views) {
    escaped.push_back(EscapeJson(view.json));
  }
  std::size_t num_views = CountFitting(
      escaped,
      [](const std::string& view) { return view.size() + 300; },
      &bytes_left);
  if (num_views < escaped.size()) {
    data["notes"].push_back(NoteLeftOut(
        num_views, escaped.size(), "stored 3D views are included."));
  }
  std::string views;
  for (std::size_t i = 0; i < num_views; ++i) {
    data["views"][page.views[i].pair] = i;
    views += ViewElement(escaped[i], i);
  }
  return FillTemplate(
      report_template, EscapeHtml(page.title), Dump(data), views);
}

}  // namespace quatro
