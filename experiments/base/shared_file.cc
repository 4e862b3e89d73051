// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/base/shared_file.h"

#include <system_error>

namespace quatro {

namespace fs = std::filesystem;

fs::path FindSharedFile(const std::string& name) {
  std::error_code ignored;
  const fs::path bin =
      fs::read_symlink("/proc/self/exe", ignored).parent_path();
  // The last folder is for programs of users that are built with quatro.
  for (const fs::path& folder : {bin / "../share/quatro",
                                 bin / "../../experiments",
                                 fs::path(QUATRO_BUILT_SHARE)}) {
    if (fs::exists(folder / name, ignored)) return folder / name;
  }
  return fs::path(QUATRO_SCRIPTS) / name;
}

}  // namespace quatro
