// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
#include <iostream>
#include <string>

#include "features/io/cloud_io.h"
#include "robust/registration/presets.h"
#include "robust/registration/registration.h"

int main(int argc, char** argv) {
  std::string error;
  const auto source = quatro::ReadCloud(argc > 1 ? argv[1] : "a.bin", &error);
  const auto target = quatro::ReadCloud(argc > 2 ? argv[2] : "b.bin", &error);
  if (!source || !target) {
    std::cerr << error << "\n";
    return 2;
  }
  const auto result = quatro::Register(
      *source, *target, quatro::MakeAutoOptions(*source, *target));
  std::cout << quatro::StatusName(result.verdict.status) << ": "
            << result.verdict.reason << "\n";
  const auto& pose = result.target_from_source();
  if (pose) std::cout << pose->ToMatrix() << "\n";
  return result.verdict.IsRegistered() ? 0 : 1;
}
