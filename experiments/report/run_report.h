// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// report.html of a run's folder, from its manifest, results, tables, views and
// the figures in it.

#ifndef QUATRO_EXPERIMENTS_REPORT_RUN_REPORT_H_
#define QUATRO_EXPERIMENTS_REPORT_RUN_REPORT_H_

#include <string>
#include <vector>

#include "experiments/metrics/pair_result.h"
#include "experiments/metrics/registration_metrics.h"
#include "experiments/tables/run_tables.h"

namespace quatro {

// Figures are the .png files in the folder itself and in figures/, where
// draw_experiment.py puts them; the same command a second time takes up those
// that were drawn since. Returns false and sets *error if the manifest can't be
// read or the page can't be written.
bool WriteRunReport(const std::string& folder,
                    const std::vector<PairResult>& results,
                    const std::vector<SuccessLimit>& limits,
                    const std::vector<RunTable>& tables,
                    const std::string& report_template,
                    std::string* error);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_REPORT_RUN_REPORT_H_
