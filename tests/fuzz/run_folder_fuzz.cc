// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The rows of a run's folder, whatever was left there: read, gone on with, and
// read again.

#include "experiments/runner/run_folder.h"

#include "tests/fuzz/fuzz.h"

namespace quatro {
namespace {

const std::vector<std::string> kMethods = {"quatro", "icp"};

// What is read comes back.
void FuzzLine(const std::string& line) {
  std::string error;
  const auto result = ParseResultCsv(line, &error);
  if (!result) {
    CheckIsOneLine(error);
    return;
  }
  const std::string text = FormatResultCsv(*result);
  const auto again = ParseResultCsv(text, &error);
  CHECK(again) << error;
  CHECK_EQ(FormatResultCsv(*again), text);
}

std::vector<PairResult> NewRows() {
  std::vector<PairResult> results(2);
  for (std::size_t i = 0; i < 2; ++i) {
    results[i].pair = "a new pair";
    results[i].method = kMethods[i];
    results[i].status = "registered";
  }
  return results;
}

void FuzzFolder(const std::string& path) {
  std::string error;
  std::size_t size = 0;
  {
    const auto folder = RunFolder::Open(path, kMethods, &error);
    if (!folder) {
      CheckIsOneLine(error);
      return;
    }
    const bool is_there = folder->Has(NewRows().front().pair);
    CHECK(folder->Append(NewRows(), "", "", &error)) << error;
    size = folder->size();
    CHECK(is_there || folder->Has(NewRows().front().pair));
  }
  const auto folder = RunFolder::Open(path, kMethods, &error);
  CHECK(folder) << error;
  CHECK_EQ(folder->size(), size);
  CHECK(ReadResultCsv(path + "/rows.csv", &error)) << error;
}

}  // namespace
}  // namespace quatro

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  static const quatro::ScratchFolder folder;
  static const std::string header = quatro::ResultCsvHeader() + "\n";
  const std::string text(quatro::AsText(data, size));
  quatro::FuzzLine(text.substr(0, text.find('\n')));
  folder.Write("run.lock", "");
  folder.Write("rows.csv", text);
  quatro::FuzzFolder(folder.path());
  // The line of names is long, and hard to hit on.
  folder.Write("rows.csv", header + text);
  quatro::FuzzFolder(folder.path());
  return 0;
}
