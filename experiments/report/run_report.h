// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Writes report.html into a run's folder, from its manifest, results, tables,
// views and figures.

#ifndef QUATRO_EXPERIMENTS_REPORT_RUN_REPORT_H_
#define QUATRO_EXPERIMENTS_REPORT_RUN_REPORT_H_

#include <string>
#include <vector>

#include "experiments/metrics/pair_result.h"
#include "experiments/metrics/registration_metrics.h"
#include "experiments/tables/run_tables.h"

namespace quatro {

// Figures are the .png files in the folder itself and in figures/, where
// draw_experiment.py writes them. Running the same command again includes new
// figures. Returns false and sets *error if the manifest cannot be read or the
// page cannot be written.
bool WriteRunReport(const std::string& folder,
                    const std::vector<PairResult>& results,
                    const std::vector<SuccessLimit>& limits,
                    const std::vector<RunTable>& tables,
                    const std::string& report_template,
                    std::string* error);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_REPORT_RUN_REPORT_H_
