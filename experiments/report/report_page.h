// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// One HTML file that tells a run: opens from disk, without a network. Data are
// JSON in elements that a browser does not look into; of the 3D views each is
// parsed when its pair is opened.

#ifndef QUATRO_EXPERIMENTS_REPORT_REPORT_PAGE_H_
#define QUATRO_EXPERIMENTS_REPORT_REPORT_PAGE_H_

#include <cstddef>
#include <string>
#include <vector>

#include "experiments/metrics/pair_result.h"
#include "experiments/runner/manifest.h"
#include "experiments/tables/run_tables.h"

namespace quatro {

struct ReportView {
  std::string pair;
  std::string json;  // Of FormatPairView().
};

struct ReportFigure {
  std::string name;
  std::string png;  // The file's bytes.
};

struct ReportPage {
  std::string title;
  Manifest manifest;
  std::vector<SuccessLimit> limits = UsualLimits();
  std::vector<RunTable> tables;
  std::vector<PairResult> results;
  std::vector<ReportView> views;
  std::vector<ReportFigure> figures;
};

struct PageLimits {
  // What does not fit is left out, last views first, and the page says so.
  std::size_t max_bytes = 29'000'000;
  std::size_t max_rows = 50'000;  // Of the table of pairs.
};

// Any text may be in any name. `report_template` of ReadReportTemplate().
std::string FormatReportPage(const ReportPage& page,
                             const std::string& report_template,
                             const PageLimits& limits = {});

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_REPORT_REPORT_PAGE_H_
