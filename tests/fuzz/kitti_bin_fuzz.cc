// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// A .bin of any layout, and of KITTI's the same one written again.

#include "features/io/kitti_bin.h"

#include "features/io/bin_layout.h"
#include "tests/fuzz/cloud_checks.h"

namespace {

// Whether it is read as float32. Doubles are rounded when they are written, and
// bytes of which most numbers are tiny are refused.
bool IsFloat(std::string_view bytes) {
  std::string error;
  const auto layout = quatro::FindBinLayout(bytes, 4, &error);
  return layout && layout->type == quatro::ScalarType::kFloat32;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  std::string error;
  quatro::CheckCloud(
      quatro::ParseKittiBin(quatro::AsText(data, size), 0, &error), error);
  const auto cloud =
      quatro::ParseKittiBin(quatro::AsText(data, size), 4, &error);
  quatro::CheckCloud(cloud, error);
  if (!cloud || !IsFloat(quatro::AsText(data, size))) return 0;
  const auto bytes = quatro::FormatKittiBin(*cloud, &error);
  CHECK(bytes) << error;
  if (!IsFloat(*bytes)) return 0;
  const auto again = quatro::ParseKittiBin(*bytes, 4, &error);
  CHECK(again) << error;
  CHECK_EQ(again->num_dropped, 0);
  CHECK(again->points == cloud->points);
  return 0;
}
