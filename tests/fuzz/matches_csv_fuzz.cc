// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Matched points as text, and the same ones written again.

#include "experiments/programs/matches_csv.h"

#include "tests/fuzz/fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  static quatro::MemoryFile file;
  std::string error;
  const auto matches =
      quatro::ReadMatches(file.Hold(quatro::AsText(data, size)), &error);
  if (!matches) {
    quatro::CheckIsOneLine(error);
    return 0;
  }
  CHECK(matches->source.allFinite() && matches->target.allFinite());
  CHECK_EQ(matches->source.cols(), matches->target.cols());
  const auto again = quatro::ReadMatches(
      file.Hold(quatro::FormatMatches(matches->source, matches->target)),
      &error);
  CHECK(again) << error;
  CHECK(again->source == matches->source && again->target == matches->target);
  return 0;
}
