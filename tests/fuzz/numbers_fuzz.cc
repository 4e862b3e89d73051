// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Numbers out of text: in files, and in flags that hold several.

#include "experiments/base/number_text.h"

#include <cmath>

#include "experiments/odometry/outside_drift.h"
#include "experiments/programs/ins_flags.h"
#include "experiments/protocols/protocols.h"
#include "experiments/runner/runner.h"
#include "features/base/cloud_text.h"
#include "tests/fuzz/fuzz.h"

namespace quatro {
namespace {

void FuzzWords(std::string_view text) {
  if (const auto number = ParseFiniteNumber(text)) {
    CHECK(std::isfinite(*number));
  }
  if (const auto count = ParseCount(text)) {
    CHECK(ParseCount(std::to_string(*count)) == count);
  }
  ParseNumber(text);
  CheckIsOneLine(Quoted(text));
  std::size_t num_lines = 0;
  for (const std::string_view line : SplitLines(text)) {
    for (const std::string_view field : SplitFields(line, ", \t")) {
      CHECK(!field.empty());
    }
    num_lines += line.empty() ? 0 : 1;
  }
  CHECK_LE(CountLines(text), num_lines);
}

// `text` as the value of each flag in turn.
void FuzzFlags(const std::string& text) {
  std::string error;
  if (const auto shard = ParseShard(text, &error)) {
    CHECK(1 <= shard->index && shard->index <= shard->count);
  }
  if (const auto bins = ParseBins(text, &error)) {
    for (const DistanceBin& bin : *bins) CHECK_LT(bin.min, bin.max);
  }
  if (const auto outside = ParseOutside(text, &error)) {
    for (const OutsideResult& result : *outside) CHECK(!result.path.empty());
  }
  for (const char* mode : {"none", "relative", "leveled", "fused"}) {
    for (int place = 0; place < 3; ++place) {
      InsFlags flags{mode, "0,1,2", "3,4,5", 0.5, "0,0,1"};
      (place == 0   ? flags.source_rpy_deg
       : place == 1 ? flags.target_rpy_deg
                    : flags.gravity) = text;
      error.clear();
      const auto ins = ParseInsFlags(flags, &error);
      if (ins) {
        CHECK(ins->up.allFinite());
        CHECK_NEAR(ins->up.norm(), 1.0, 1e-9);
      } else {
        CHECK(!error.empty());
      }
    }
  }
}

}  // namespace
}  // namespace quatro

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  const std::string_view text = quatro::AsText(data, size);
  quatro::FuzzWords(text);
  // An argument ends at its first zero.
  quatro::FuzzFlags(std::string(text.substr(0, text.find('\0'))));
  return 0;
}
