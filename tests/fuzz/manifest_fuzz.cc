// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// A run's manifest, and the same one written again.

#include "experiments/runner/manifest.h"

#include "tests/fuzz/fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  std::string error;
  const auto manifest =
      quatro::ParseManifest(std::string(quatro::AsText(data, size)), &error);
  if (!manifest) {
    quatro::CheckIsOneLine(error);
    return 0;
  }
  const std::string text = quatro::FormatManifest(*manifest);
  const auto again = quatro::ParseManifest(text, &error);
  CHECK(again) << error;
  CHECK_EQ(quatro::FormatManifest(*again), text);
  CHECK(quatro::DecidesTheSame(*manifest, *again, &error)) << error;
  return 0;
}
