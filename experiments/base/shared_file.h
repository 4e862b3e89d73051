// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Files that the programs need at run time: scripts and the template of the
// report.

#ifndef QUATRO_EXPERIMENTS_BASE_SHARED_FILE_H_
#define QUATRO_EXPERIMENTS_BASE_SHARED_FILE_H_

#include <filesystem>
#include <string>

namespace quatro {

// Finds a shared file. Installed programs have it in share/, and generated
// files are in the build folder. If neither has the file, returns its path in
// experiments/scripts/, whether or not it exists there.
std::filesystem::path FindSharedFile(const std::string& name);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_BASE_SHARED_FILE_H_
