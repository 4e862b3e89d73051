// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT
// Reads a program's inputs and writes its outputs. The path "-" means standard
// input or standard output; "./-" is a file. /dev/stdout, /dev/stderr and
// /dev/fd/N are open files and are written to, not replaced.

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

// Whether a file can be written to this path, as far as this is known
// beforehand. A character device, such as /dev/null, can. Symbolic links are
// followed, and the file that they name need not exist.
bool CanWrite(const std::string& name, std::string* error);

// Whether all outputs of a program can be written; empty paths are ignored. An
// output must not be an input or another output unless it is a device, and at
// most one may go to standard output.
bool CanWriteAll(const std::vector<OutputFlag>& outputs,
                 const std::vector<std::string>& inputs,
                 std::string* error);

// Whether the file's name has the ending of its only format, for example
// ".png". True for an empty name and for "-".
bool HasEnding(const OutputFlag& output,
               const std::string& ending,
               std::string* error);

// Whether the path can name a folder: it is neither empty nor "-".
bool CanBeFolder(const OutputFlag& output, std::string* error);

// The stream for a program's summary: standard output, or standard error if an
// output goes to standard output, which must then contain nothing else.
std::FILE* SummaryStream(const std::vector<std::string>& outputs);

// Reads a text file, or standard input if `path` is "-". Errors are those of
// ReadTextFile().
std::optional<std::string> ReadInput(const std::string& path,
                                     std::string* error);

// Makes a folder and its missing parents, or none of them if there is an error.
// Returns the new folders, the innermost first.
std::vector<std::filesystem::path> MakeFolders(
    const std::filesystem::path& folder, std::error_code* error);

// Flushes standard output. Returns false and sets *error if anything printed so
// far could not be written.
bool FlushOutput(std::string* error);

// Writes each file completely or not at all, and keeps the permissions to read
// and write a file that is replaced. If one of the files or standard
// output cannot be written, returns false and restores all files. New files
// remain only if a folder changes in the meantime. What a device has received
// stays.
bool WriteOutputs(const std::vector<OutputFile>& files, std::string* error);

}  // namespace quatro

#endif  // QUATRO_EXPERIMENTS_BASE_OUTPUTS_H_
