// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Files that the programs need while they run: scripts, the report's template.

#ifndef QUATRO_EXPERIMENTS_BASE_SHARED_FILE_H_
#define QUATRO_EXPERIMENTS_BASE_SHARED_FILE_H_

#include <filesystem>
#include <string>

namespace quatro {

// An installed program has them in share, the build folder those that are made;
// the others stand beside the sources. The last of these places if it is in
// none.
std::filesystem::path FindSharedFile(const std::string& name);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_BASE_SHARED_FILE_H_
