// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/programs/registration_flags.h"

#include <gflags/gflags.h>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <set>
#include <string_view>
#include <system_error>
#include <utility>

#include "experiments/programs/bad_flag.h"
#include "experiments/programs/bound_flags.h"
#include "experiments/programs/explain.h"
#include "experiments/programs/ins_flags.h"
#include "experiments/programs/methods.h"
#include "experiments/programs/program.h"
#include "features/base/cloud_text.h"
#include "robust/registration/any_vertical.h"
#include "robust/registration/methods.h"

DEFINE_bool(list_methods, false, "List the methods and exit");
DEFINE_string(options,
              "",
              "Further options of the method, \"name=value;name=value\" in "
              "quotes; see --list_options");
DEFINE_bool(list_options,
            false,
            "List the options of --method, and the flags that set some of "
            "them, and exit");
DEFINE_string(recover,
              "",
              "Re-estimate the translation: on or off; empty: the "
              "preset's");
DEFINE_string(polish,
              "",
              "Polish roll and pitch: on or off; empty: the preset's");
DEFINE_string(ins_mode,
              "none",
              "Roll and pitch from an INS: none, relative, leveled or fused");
DEFINE_string(source_rpy_deg,
              "",
              "The INS' roll,pitch,yaw of the source [deg]; x ahead, z up");
DEFINE_string(target_rpy_deg,
              "",
              "The INS' roll,pitch,yaw of the target [deg]");
DEFINE_double(ins_std_deg,
              0.5,
              "Standard deviation of each roll and pitch [deg], for fused");
DEFINE_string(gravity,
              "preset",
              "Which way is up: x,y,z; scans: z, and if that pose is not "
              "registered, what the scans say; none: what the scans say; "
              "preset: scans for auto, 0,0,1 for others");
DEFINE_string(guess,
              "",
              "A prior on target_from_source: x,y,z,yaw_deg, or a text file of "
              "4, 12 or 16 numbers (the rows of a matrix); empty: no motion");
DEFINE_double(max_translation,
              0.0,
              "Largest distance from the guess [m]; 0: any");
DEFINE_double(max_yaw_deg, 180.0, "Largest yaw from the guess [deg]; 180: any");
DEFINE_double(
    max_tilt_deg,
    5.0,
    "Largest tilt from the guess [deg], with one of the bounds above");
DEFINE_bool(crosscheck,
            false,
            "Solve every weighted subproblem by Ceres too and report the "
            "largest difference");
DEFINE_double(noise_bound,
              0.0,
              "Largest error of an inlier [m]; 0: the preset's");
DEFINE_uint64(seed, 0, "Random seed");
DEFINE_int32(threads,
             0,
             "Threads; 0: one per core. Does not affect the result");
DEFINE_string(json, "", "File for the answer; empty or -: standard output");
DEFINE_bool(explain,
            false,
            "Print what came of each stage in plain words, in place of the "
            "JSON on standard output");
DEFINE_string(picture, "", "PNG file for the points before and after");

namespace quatro {
namespace {

constexpr char kNoScans[] =
    "gravity = scans has no effect here: it needs two clouds, a method that "
    "searches other poses, such as quatro, max_rung > 0, and neither an INS "
    "nor bounds on the pose";

// Sets the option of this name. Returns false and sets *error if there is no
// such option or the value has another type.
bool SetOption(const OptionList& list,
               const std::string& name,
               const std::string& value,
               std::string* error) {
  std::vector<std::string> names;
  for (const Option& option : list) {
    if (option.name == name) return option.Parse(value, error);
    names.push_back(option.name);
  }
  const std::string nearest = NearestName(name, names);
  *error = "no option " + name +
           (nearest.empty() ? "" : ", did you mean " + nearest) +
           "; --list_options lists all";
  return false;
}

// The flag that sets the option, too. Returns nullopt if there is none.
std::optional<gflags::CommandLineFlagInfo> FlagOf(const std::string& option) {
  constexpr std::pair<std::string_view, const char*> kOtherNames[] = {
      {"num_threads", "threads"},
      {"recover_translation", "recover"},
      {"source_rpy", "source_rpy_deg"},
      {"target_rpy", "target_rpy_deg"},
      {"attitude_std", "ins_std_deg"}};
  std::string name = option;
  for (const auto& [of_option, of_flag] : kOtherNames) {
    if (option == of_option) name = of_flag;
  }
  gflags::CommandLineFlagInfo flag;
  if (!gflags::GetCommandLineFlagInfo(name.c_str(), &flag)) return std::nullopt;
  return flag;
}

// Sets options from "name=value;name=value".
bool SetOptions(const OptionList& list,
                std::string_view text,
                std::string* error) {
  std::set<std::string> given;
  while (!text.empty()) {
    const std::string_view part = text.substr(0, text.find(';'));
    text.remove_prefix(std::min(text.size(), part.size() + 1));
    if (Trim(part).empty()) continue;
    const std::size_t equals = part.find('=');
    if (equals == std::string_view::npos) {
      *error = std::string(part) + ", must be name=value";
      return false;
    }
    const std::string name(Trim(part.substr(0, equals)));
    const std::string value(Trim(part.substr(equals + 1)));
    const auto flag = FlagOf(name);
    if (!given.insert(name).second || (flag && !flag->is_default)) {
      *error = name + " is given twice, must be given once";
      return false;
    }
    if (!SetOption(list, name, value, error)) {
      if (value.find('=') != std::string::npos) {
        *error += "; options are separated by semicolons";
      }
      return false;
    }
  }
  return true;
}

bool SetSwitch(const OptionList& list,
               const std::string& flag,
               const std::string& option,
               const std::string& value,
               std::string* error) {
  if (value.empty() || SetOption(list, option, value, error)) return true;
  *error = "--" + flag + "=" + value + ", must be on or off";
  return false;
}

// Whether a method that starts from a guess can use the flags.
bool CanStartFromGuess(const std::string& method,
                       const std::string& refine,
                       const RegistrationOptions& options,
                       std::string* error) {
  const char* unused = nullptr;
  if (!refine.empty() && refine != "none") unused = "refine";
  if (FLAGS_gravity != "preset" && FLAGS_gravity != "0,0,1") unused = "gravity";
  if (options.ins.mode != InsMode::kNone) unused = "ins_mode";
  if (unused == nullptr) return true;
  *error = std::string("--") + unused + " does not go with --method=" + method;
  return false;
}

bool CheckMethod(const std::string& method,
                 const std::string& refine,
                 bool has_clouds,
                 const RegistrationOptions& options,
                 std::string* error) {
  if (has_clouds ? !FindPairSolver(method, {}, error)
                 : !FindMatchSolver(method, {}, error)) {
    return false;
  }
  if (StartsFromGuess(method)) {
    return CanStartFromGuess(method, refine, options, error);
  }
  std::string ignored;
  const Method* found = FindMethod(method, &ignored);
  if (found != nullptr) return CanUseIns(*found, options.ins, error);
  if (options.ins.IsPlain()) return true;
  *error = "--ins_mode and --gravity do not go with --method=" + method;
  return false;
}

// The options that the method reads, then the flags that set some of them, one
// on each line. Returns an empty text and sets *error for an unknown method.
std::string DescribeOptionsOf(const std::string& method,
                              bool has_clouds,
                              std::string* error) {
  const Method* found = FindMethod(method, error);
  if (found == nullptr) return {};
  RegistrationOptions options;
  std::string text =
      "Options, for --options=\"name=value;name=value\", Python and the "
      "JSON:\n";
  std::string flags = "Flags that set one of these options:\n";
  for (const Option& option : OptionsOf(*found, has_clouds, &options)) {
    text += "  " + option.name + "  " + option.Describe() + "\n";
    if (const auto flag = FlagOf(option.name)) {
      flags += "  --" + flag->name +
               (flag->name == option.name ? "" : " (" + option.name + ")") +
               "  " + flag->description + "\n";
    }
  }
  return text + "\n" + flags;
}

// The output of the JSON: a file, "-", or empty for none. Without --json, it is
// standard output, unless --explain uses that.
std::string JsonPath() {
  return FLAGS_json.empty() && !FLAGS_explain ? "-" : FLAGS_json;
}

}  // namespace

bool StartsFromGuess(const std::string& method) {
  const auto names = ExperimentMethodNames(MethodInput::kClouds);
  return std::find(names.begin(), names.end(), method) != names.end();
}

bool ApplyFlags(const std::string& method,
                const std::string& refine,
                bool has_clouds,
                RegistrationOptions* options,
                std::string* error) {
  if (FLAGS_noise_bound != 0.0) options->noise_bound = FLAGS_noise_bound;
  options->seed = FLAGS_seed;
  options->num_threads = FLAGS_threads;
  options->quatro.crosscheck = FLAGS_crosscheck;
  options->teaser.crosscheck = FLAGS_crosscheck;
  const OptionList quatro = QuatroOptionList(options);
  if (!SetSwitch(
          quatro, "recover", "recover_translation", FLAGS_recover, error) ||
      !SetSwitch(quatro, "polish", "polish", FLAGS_polish, error)) {
    return false;
  }
  if (!refine.empty() &&
      !SetOption(RefinementOptionList(options), "refine", refine, error)) {
    return false;
  }
  const bool is_of_preset = FLAGS_gravity == "preset";
  const auto ins = ParseInsFlags({FLAGS_ins_mode,
                                  FLAGS_source_rpy_deg,
                                  FLAGS_target_rpy_deg,
                                  FLAGS_ins_std_deg,
                                  is_of_preset ? "0,0,1" : FLAGS_gravity},
                                 error);
  if (!ins) return false;
  const Gravity of_preset = options->ins.gravity;
  options->ins = *ins;
  if (is_of_preset && has_clouds) options->ins.gravity = of_preset;
  const auto bounds = ParseBoundFlags({FLAGS_guess,
                                       FLAGS_max_translation,
                                       FLAGS_max_yaw_deg,
                                       FLAGS_max_tilt_deg},
                                      StartsFromGuess(method),
                                      error);
  if (!bounds) return false;
  options->bounds = *bounds;
  if (!CheckMethod(method, refine, has_clouds, *options, error)) return false;
  std::string ignored;
  const Method* found = FindMethod(method, &ignored);
  if (found != nullptr) options->method = found->name;
  if (!FLAGS_options.empty() &&
      !SetOptions(found ? OptionsOf(*found, has_clouds, options)
                        : CommonOptions(options),
                  FLAGS_options,
                  error)) {
    *error = "--options: " + *error;
    return false;
  }
  const bool is_asked =
      FLAGS_gravity == "scans" || of_preset != Gravity::kScans;
  if (is_asked && options->ins.gravity == Gravity::kScans &&
      !(found && found->searches && has_clouds && MayLevelByScans(*options))) {
    *error = kNoScans;
    return false;
  }
  return options->IsValid(error);
}

std::optional<int> PrintLists(const std::string& method, bool has_clouds) {
  if (FLAGS_list_methods) {
    std::fputs(
        (has_clouds ? DescribePairMethods() : DescribeMatchMethods()).c_str(),
        stdout);
    return kExitDone;
  }
  if (!FLAGS_list_options) return std::nullopt;
  std::string error;
  const std::string text = DescribeOptionsOf(method, has_clouds, &error);
  if (text.empty()) return Fail(error);
  std::fputs(text.c_str(), stdout);
  return kExitDone;
}

bool CanWriteAnswer(const std::vector<OutputFlag>& others,
                    std::vector<std::string> inputs,
                    std::string* error) {
  std::error_code ignored;
  if (std::filesystem::exists(FLAGS_guess, ignored)) {
    inputs.push_back(FLAGS_guess);
  }
  std::vector<OutputFlag> outputs = {{"json", JsonPath()},
                                     {"explain", FLAGS_explain ? "-" : ""},
                                     {"picture", FLAGS_picture}};
  outputs.insert(outputs.end(), others.begin(), others.end());
  return CanWriteAll(outputs, inputs, error) &&
         HasEnding({"picture", FLAGS_picture}, ".png", error) &&
         (FLAGS_picture.empty() || CanDrawPictures(error));
}

std::string VerdictLine(const Verdict& verdict) {
  return std::string(StatusName(verdict.status)) + ": " + verdict.reason;
}

int WriteAnswer(const Json& report,
                const RegistrationPicture& picture,
                const Verdict& verdict,
                std::vector<OutputFile> files) {
  std::string error;
  if (!FLAGS_picture.empty()) {
    const auto drawn = DrawRegistration(picture, &error);
    if (!drawn) return Fail(error);
    files.push_back({FLAGS_picture, *drawn});
  }
  const std::string json_path = JsonPath();
  if (!json_path.empty()) {
    // Names of files need not be UTF-8.
    files.push_back(
        {json_path,
         report.dump(2, ' ', false, Json::error_handler_t::replace) + "\n"});
  }
  if (FLAGS_explain) files.push_back({"", Explain(report)});
  if (!WriteOutputs(files, &error)) return Fail(error);
  return verdict.IsRegistered() ? kExitDone : kExitNotVouchedFor;
}

}  // namespace quatro
