// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// The output files of a program.

#ifndef QUATRO_EXPERIMENTS_BASE_OUTPUTS_H_
#define QUATRO_EXPERIMENTS_BASE_OUTPUTS_H_

#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

namespace quatro {

struct OutputFile {
  std::string path;  // Empty for standard output.
  std::string bytes;
};

// Returns whether a file could be written here, as far as can be checked
// beforehand.
bool CanWrite(const std::string& path, std::string* error);

// Checks all outputs of a program. Empty paths are skipped. No output may be an
// input or another output.
bool CanWriteAll(const std::vector<std::string>& outputs,
                 const std::vector<std::string>& inputs,
                 std::string* error);

// Creates a folder and its parents, or none of them if there is an error.
// Returns the folders that it created, innermost first.
std::vector<std::filesystem::path> MakeFolders(
    const std::filesystem::path& folder, std::error_code* error);

// Flushes standard output. Returns false and sets *error if anything printed so
// far could not be written.
bool FlushOutput(std::string* error);

// Writes each file completely or not at all. If one of the files or standard
// output cannot be written, returns false and restores all files. New files
// remain only if a folder changes in the meantime.
bool WriteOutputs(const std::vector<OutputFile>& files, std::string* error);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_BASE_OUTPUTS_H_
