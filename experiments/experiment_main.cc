// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include <gflags/gflags.h>

#include <cstdio>
#include <string>

#include "experiments/outputs.h"
#include "experiments/program.h"
#include "experiments/progress_line.h"
#include "experiments/synthetic_protocols.h"

DEFINE_string(protocol,
              "",
              "tims (yaw from differences, 95-99 % outliers), degeneracy (1-5 "
              "true matches), quasi_inliers (right in xy, wrong in z), sizes "
              "(a thousand to a million matches), slopes (tilts of 2-15 deg "
              "with an INS) or surrogates (numbers for draw_surrogates.py). "
              "Required");
DEFINE_int32(seeds, 20, "Problems of each kind");
DEFINE_int64(max_matches, 1000000, "The largest problem of protocol sizes");
DEFINE_int32(threads, 0, "0: one per core. Results do not depend on it");
DEFINE_string(output, "", "CSV file for the table as well");

namespace {

constexpr char kUsage[] =
    "compares estimators on families of problems with known answers.\n"
    "\n"
    "  quatro_experiment --protocol=degeneracy\n"
    "\n"
    "The table goes to standard output, progress to standard error. Exits "
    "with\n"
    "0; 2 if a flag or the output is wrong.";

}  // namespace

int main(int argc, char** argv) {
  using quatro::Fail;
  if (const auto exit_code =
          quatro::ParseFlags(kUsage, "experiment_main", argc, argv)) {
    return *exit_code;
  }
  std::string error;
  if (FLAGS_seeds < 1) return Fail("--seeds must be >= 1");
  if (FLAGS_max_matches < 1000) return Fail("--max_matches must be >= 1000");
  if (FLAGS_threads < 0) return Fail("--threads must be >= 0");
  if (!FLAGS_output.empty() && !quatro::CanWrite(FLAGS_output, &error)) {
    return Fail(error);
  }

  const quatro::Progress progress = quatro::ProgressLine("problems");
  quatro::Table table;
  if (FLAGS_protocol == "tims") {
    table = quatro::RunTimProtocol(FLAGS_seeds, progress);
  } else if (FLAGS_protocol == "degeneracy") {
    table = quatro::RunDegeneracyProtocol(FLAGS_seeds, progress);
  } else if (FLAGS_protocol == "quasi_inliers") {
    table = quatro::RunQuasiInlierProtocol(FLAGS_seeds, progress);
  } else if (FLAGS_protocol == "sizes") {
    table = quatro::RunSizeProtocol(
        FLAGS_seeds, FLAGS_max_matches, FLAGS_threads, progress);
  } else if (FLAGS_protocol == "slopes") {
    table = quatro::RunSlopeProtocol(FLAGS_seeds, progress);
  } else if (FLAGS_protocol == "surrogates") {
    table = quatro::TabulateSurrogates();
  } else {
    return Fail("--protocol=" + FLAGS_protocol +
                ", must be tims, degeneracy, quasi_inliers, sizes, slopes "
                "or surrogates");
  }
  std::fputs(quatro::FormatTable(table).c_str(), stdout);
  if (!FLAGS_output.empty() &&
      !quatro::WriteOutputs({{FLAGS_output, quatro::FormatCsv(table)}},
                            &error)) {
    return Fail(error);
  }
  return quatro::kExitDone;
}
