// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// What a program leaves behind.

#ifndef QUATRO_EXPERIMENTS_BASE_OUTPUTS_H_
#define QUATRO_EXPERIMENTS_BASE_OUTPUTS_H_

#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

namespace quatro {

struct OutputFile {
  std::string path;  // Empty: standard output.
  std::string bytes;
};

// Whether a file could be written here, as far as that can be told beforehand.
bool CanWrite(const std::string& path, std::string* error);

// The same for all outputs of a program, of which empty ones are left out; none
// may be one of the inputs or another output.
bool CanWriteAll(const std::vector<std::string>& outputs,
                 const std::vector<std::string>& inputs,
                 std::string* error);

// Makes a folder and its parents, or on an error none of them. Returns those
// that it made, the innermost first.
std::vector<std::filesystem::path> MakeFolders(
    const std::filesystem::path& folder, std::error_code* error);

// Returns false and sets *error if anything printed so far did not arrive.
bool FlushOutput(std::string* error);

// Writes them, each whole or not at all. If one can't be written, or what was
// printed before, returns false, and all files are as they were; only if a
// folder changes meanwhile may some be new.
bool WriteOutputs(const std::vector<OutputFile>& files, std::string* error);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_BASE_OUTPUTS_H_
