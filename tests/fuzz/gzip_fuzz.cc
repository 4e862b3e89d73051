// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// A file compressed by gzip, with text in it.

#include "features/io/gzip.h"

#include "features/io/point_text.h"
#include "tests/fuzz/cloud_checks.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  std::string error;
  const auto bytes = quatro::Gunzip(quatro::AsText(data, size), &error);
  if (!bytes) {
    quatro::CheckIsOneLine(error);
    return 0;
  }
  quatro::CheckCloud(quatro::ParsePointText(*bytes, &error), error);
  return 0;
}
