// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/runner/manifest.h"

#include <filesystem>
#include <nlohmann/json.hpp>
#include <system_error>

#include "experiments/base/one_line.h"
#include "features/base/file.h"

namespace quatro {
namespace {

using Json = nlohmann::ordered_json;

// Reads the fields of an object and remembers the first missing or invalid one.
class FieldReader {
 public:
  explicit FieldReader(const Json* json) : json_(*json) {}

  const std::string& error() const { return error_; }

  void Read(const char* group, const char* name, std::string* value) {
    const Json* const field = Find(group, name);
    if (field && field->is_string()) {
      *value = field->get<std::string>();
    } else {
      Fail(group, name, "text");
    }
  }

  template <typename Integer>
  void Read(const char* group, const char* name, Integer* value) {
    const Json* const field = Find(group, name);
    if (field && field->is_number_unsigned()) {
      *value = field->get<Integer>();
    } else {
      Fail(group, name, "a whole number >= 0");
    }
  }

  void Read(const char* name, std::map<std::string, std::string>* values) {
    const Json* const field = Find(nullptr, name);
    if (!field || !field->is_object()) {
      Fail(nullptr, name, "an object of texts");
      return;
    }
    for (const auto& [key, value] : field->items()) {
      if (!value.is_string()) {
        Fail(name, key.c_str(), "text");
        return;
      }
      (*values)[key] = value.get<std::string>();
    }
  }

 private:
  const Json* Find(const char* group, const char* name) const {
    const Json* in = &json_;
    for (const char* const key : {group, name}) {
      if (!key) continue;
      if (!in->is_object()) return nullptr;
      const auto found = in->find(key);
      if (found == in->end()) return nullptr;
      in = &*found;
    }
    return in;
  }

  void Fail(const char* group, const char* name, const std::string& type) {
    if (!error_.empty()) return;
    error_ = OneLine((group ? std::string(group) + "." : "") + name) +
             " must be " + type;
  }

  const Json& json_;
  std::string error_;
};

std::string Quoted(const std::map<std::string, std::string>& flags,
                   const std::string& name) {
  const auto found = flags.find(name);
  return found == flags.end() ? "not set" : "'" + found->second + "'";
}

// The first flag, in the order of names, that differs.
std::optional<std::string> FlagDifference(
    const std::map<std::string, std::string>& was,
    const std::map<std::string, std::string>& is) {
  std::map<std::string, std::string> all = was;
  all.insert(is.begin(), is.end());
  for (const auto& [name, value] : all) {
    const std::string before = Quoted(was, name);
    const std::string now = Quoted(is, name);
    if (before != now)
      return "flag --" + name + " was " + before + ", is " + now;
  }
  return std::nullopt;
}

}  // namespace

Manifest BeginManifest() {
  Manifest manifest;
  manifest.build = GetBuildInfo();
  manifest.machine = GetMachineInfo();
  manifest.start_time = UtcNow();
  return manifest;
}

std::string FormatManifest(const Manifest& manifest) {
  const Json json = {
      {"version", manifest.build.version},
      {"commit", manifest.build.commit},
      {"compiler", manifest.build.compiler},
      {"start_time", manifest.start_time},
      {"seed", manifest.seed},
      {"flags", Json(manifest.flags)},
      {"other_flags", Json(manifest.other_flags)},
      {"machine",
       {{"cpu", manifest.machine.cpu},
        {"cores", static_cast<std::uint64_t>(manifest.machine.cores)},
        {"memory_mib",
         static_cast<std::uint64_t>(manifest.machine.memory_mib)}}},
      {"data",
       {{"checksum", manifest.data.checksum},
        {"files", static_cast<std::uint64_t>(manifest.data.num_files)},
        {"missing", static_cast<std::uint64_t>(manifest.data.num_missing)},
        {"bytes", manifest.data.num_bytes}}}};
  // Replaces invalid UTF-8 instead of throwing.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::optional<Manifest> ParseManifest(const std::string& text,
                                      std::string* error) {
  const Json json = Json::parse(text, nullptr, false);
  if (!json.is_object()) {
    *error = "is not a JSON object";
    return std::nullopt;
  }
  Manifest manifest;
  FieldReader reader(&json);
  reader.Read(nullptr, "version", &manifest.build.version);
  reader.Read(nullptr, "commit", &manifest.build.commit);
  reader.Read(nullptr, "compiler", &manifest.build.compiler);
  reader.Read(nullptr, "start_time", &manifest.start_time);
  reader.Read(nullptr, "seed", &manifest.seed);
  reader.Read("flags", &manifest.flags);
  reader.Read("other_flags", &manifest.other_flags);
  reader.Read("machine", "cpu", &manifest.machine.cpu);
  reader.Read("machine", "cores", &manifest.machine.cores);
  reader.Read("machine", "memory_mib", &manifest.machine.memory_mib);
  reader.Read("data", "checksum", &manifest.data.checksum);
  reader.Read("data", "files", &manifest.data.num_files);
  reader.Read("data", "missing", &manifest.data.num_missing);
  reader.Read("data", "bytes", &manifest.data.num_bytes);
  *error = reader.error();
  if (!error->empty()) return std::nullopt;
  return manifest;
}

std::optional<Manifest> ReadManifest(const std::string& path,
                                     std::string* error) {
  const auto text = ReadTextFile(path, error);
  if (!text) return std::nullopt;
  auto manifest = ParseManifest(*text, error);
  if (!manifest) *error = path + ": " + *error;
  return manifest;
}

bool DecidesTheSame(const Manifest& was,
                    const Manifest& is,
                    std::string* difference) {
  difference->clear();
  if (was.build.version != is.build.version) {
    *difference =
        "version was " + was.build.version + ", is " + is.build.version;
  } else if (was.seed != is.seed) {
    *difference = "seed was " + std::to_string(was.seed) + ", is " +
                  std::to_string(is.seed);
  } else if (const auto flag = FlagDifference(was.flags, is.flags)) {
    *difference = *flag;
  } else if (was.data.checksum != is.data.checksum) {
    *difference = "checksum of the data was " + was.data.checksum + ", is " +
                  is.data.checksum;
  }
  *difference = OneLine(*difference);
  return difference->empty();
}

bool TakeManifest(const std::string& folder,
                  const Manifest& manifest,
                  std::string* error) {
  const std::string path = folder + "/manifest.json";
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) {
    return WriteFileAtomically(path, FormatManifest(manifest), error);
  }
  const auto was = ReadManifest(path, error);
  if (!was) return false;
  std::string difference;
  if (DecidesTheSame(*was, manifest, &difference)) return true;
  *error = folder + ": belongs to another run: " + difference +
           "; choose another --output, or use its original flags and data";
  return false;
}

}  // namespace quatro
