// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Lines of CSV, tables of them, and the lists of pairs in such tables.

#include "experiments/datasets/pairs_csv.h"

#include "experiments/base/csv_line.h"
#include "experiments/datasets/csv_table.h"
#include "tests/fuzz/fuzz.h"

namespace quatro {
namespace {

void FuzzLine(std::string_view text) {
  const auto cells = SplitCsvLine(text.substr(0, text.find('\n')));
  if (!cells) return;
  CHECK(!cells->empty());
  // A carriage return within a cell becomes a blank.
  if (text.find('\r') != std::string_view::npos) return;
  CHECK(SplitCsvLine(JoinCsvLine(*cells)) == cells);
}

void FuzzTable(const std::string& path) {
  std::string error;
  const auto table = ReadCsvTable(path, &error);
  if (!table) {
    CheckIsOneLine(error);
    return;
  }
  for (const CsvRow& row : table->rows) {
    CHECK_EQ(row.cells.size(), table->columns.size());
  }
}

void FuzzPairs(const std::string& path) {
  std::string error;
  const auto pairs = ReadPairsCsv(path, &error);
  if (!pairs) {
    CheckIsOneLine(error);
    return;
  }
  for (const PairTask& task : pairs->tasks) {
    CHECK(!task.name.empty());
    if (!task.true_target_from_source) continue;
    CHECK(task.true_target_from_source->ToMatrix().allFinite());
  }
}

}  // namespace
}  // namespace quatro

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  static quatro::MemoryFile file;
  const std::string_view text = quatro::AsText(data, size);
  const std::string path = file.Hold(text);
  quatro::FuzzLine(text);
  quatro::FuzzTable(path);
  quatro::FuzzPairs(path);
  return 0;
}
