// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// What a program leaves behind. "-" is standard output wherever a file is to be
// written, and standard input where one is read; "./-" is a file.

#ifndef QUATRO_EXPERIMENTS_BASE_OUTPUTS_H_
#define QUATRO_EXPERIMENTS_BASE_OUTPUTS_H_

#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

namespace quatro {

struct OutputFile {
  std::string path;  // Empty or "-": standard output.
  std::string bytes;
};

// A flag that names a file to write.
struct OutputFlag {
  std::string name;  // "json"
  std::string path;
};

// Whether a file could be written here, as far as this is known beforehand.
bool CanWrite(const std::string& path, std::string* error);

// Whether all outputs of a program can be written; empty ones are left out.
// None may be one of the inputs or another output, and at most one standard
// output.
bool CanWriteAll(const std::vector<OutputFlag>& outputs,
                 const std::vector<std::string>& inputs,
                 std::string* error);

// Whether the file's name has the ending of its only format, for example
// ".png". True for an empty name and for "-".
bool HasEnding(const OutputFlag& output,
               const std::string& ending,
               std::string* error);

// Whether a folder can be asked for by this name: not empty and not "-".
bool CanBeFolder(const OutputFlag& output, std::string* error);

// The stream for a program's summary: standard output, or standard error if one
// of its outputs goes to standard output, which is then this output alone.
std::FILE* SummaryStream(const std::vector<std::string>& outputs);

// Reads a text file, or standard input if `path` is "-". Errors are those of
// ReadTextFile().
std::optional<std::string> ReadInput(const std::string& path,
                                     std::string* error);

// Makes a folder and its parents, or on an error none of them. Returns those
// that it made, the innermost first.
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
