// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// A run as one HTML file, which can be opened from disk without a network. The
// data are JSON in elements that the browser does not parse; each 3D view is
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
  std::string json;  // Result of FormatPairView().
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
  // Content that does not fit is left out, starting with the last views, and
  // the page says so.
  std::size_t max_bytes = 29'000'000;
  std::size_t max_rows = 50'000;  // In the table of pairs.
};

// Names may contain any text. `report_template` comes from
// ReadReportTemplate().
std::string FormatReportPage(const ReportPage& page,
                             const std::string& report_template,
                             const PageLimits& limits = {});

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_REPORT_REPORT_PAGE_H_
