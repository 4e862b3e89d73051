// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/report/run_report.h"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <system_error>
#include <utility>

#include "experiments/report/report_page.h"
#include "experiments/runner/run_folder.h"
#include "features/base/file.h"

namespace quatro {
namespace {

namespace fs = std::filesystem;

// The views of the pairs that have one, in the order of the results.
std::vector<ReportView> ReadViews(const std::string& folder,
                                  const std::vector<PairResult>& results) {
  std::vector<ReportView> views;
  std::set<std::string> seen;
  for (const PairResult& result : results) {
    if (!seen.insert(result.pair).second) continue;
    std::string ignored;
    auto json = ReadWholeFile(ViewPath(folder, result.pair), &ignored);
    if (!json || !nlohmann::json::accept(*json)) continue;
    views.push_back({result.pair, std::move(*json)});
  }
  return views;
}

std::vector<ReportFigure> ReadFigures(const std::string& folder) {
  std::vector<ReportFigure> figures;
  for (const std::string& place : {folder, folder + "/figures"}) {
    std::error_code status;
    for (fs::directory_iterator it(place, status), end; !status && it != end;
         it.increment(status)) {
      if (it->path().extension() != ".png") continue;
      std::string ignored;
      auto png = ReadWholeFile(it->path().string(), &ignored);
      if (png) figures.push_back({it->path().stem().string(), std::move(*png)});
    }
  }
  std::sort(figures.begin(), figures.end(), [](const auto& a, const auto& b) {
    return a.name < b.name;
  });
  return figures;
}

// Returns "kitti" for "runs/kitti/".
std::string NameOf(const std::string& folder) {
  const fs::path path = fs::absolute(folder).lexically_normal();
  return (path.has_filename() ? path : path.parent_path()).filename().string();
}

}  // namespace

bool WriteRunReport(const std::string& folder,
                    const std::vector<PairResult>& results,
                    const std::vector<SuccessLimit>& limits,
                    const std::vector<RunTable>& tables,
                    const std::string& report_template,
                    std::string* error) {
  const auto manifest = ReadManifest(folder + "/manifest.json", error);
  if (!manifest) return false;
  ReportPage page;
  page.title = NameOf(folder);
  page.manifest = *manifest;
  page.tables = tables;
  page.results = results;
  page.limits = limits;
  page.views = ReadViews(folder, results);
  page.figures = ReadFigures(folder);
  return WriteFileAtomically(
      folder + "/report.html", FormatReportPage(page, report_template), error);
}

}  // namespace quatro
