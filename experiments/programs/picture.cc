// SPDX-FileCopyrightText: 2026 The quatro authors
// SPDX-License-Identifier: MIT

#include "experiments/programs/picture.h"

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <utility>

#include "experiments/base/shared_file.h"
#include "features/base/file.h"
#include "features/voxel_grid.h"

extern char** environ;  // NOLINT: declared by glibc, but not by others.

namespace quatro {
namespace {

namespace fs = std::filesystem;

constexpr double kDrawnVoxel = 0.2;      // [m]
constexpr double kOriginStep = 10000.0;  // [m]

sigset_t StopSignals() {
  sigset_t signals;
  sigemptyset(&signals);
  for (const int signal : {SIGHUP, SIGINT, SIGTERM}) {
    sigaddset(&signals, signal);
  }
  return signals;
}

// Holds Ctrl-C and the like back, so that temporary files are removed first.
class HeldSignals {
 public:
  HeldSignals() {
    const sigset_t signals = StopSignals();
    sigprocmask(SIG_BLOCK, &signals, &before_);
  }
  ~HeldSignals() { sigprocmask(SIG_SETMASK, &before_, nullptr); }
  HeldSignals(const HeldSignals&) = delete;
  HeldSignals& operator=(const HeldSignals&) = delete;

 private:
  sigset_t before_;
};

// Runs a script with a Python that has matplotlib. Its standard output goes to
// stderr because ours is for the JSON.
bool RunPython(const std::vector<std::string>& args, std::string* error) {
  std::vector<std::string> command = {FindSharedFile("with_python.sh").string(),
                                      "numpy,matplotlib"};
  command.insert(command.end(), args.begin(), args.end());
  std::vector<char*> argv;
  argv.reserve(command.size() + 1);
  for (std::string& arg : command) argv.push_back(arg.data());
  argv.push_back(nullptr);
  const pid_t child = fork();
  if (child == 0) {
    const sigset_t signals = StopSignals();
    sigprocmask(SIG_UNBLOCK, &signals, nullptr);
    dup2(STDERR_FILENO, STDOUT_FILENO);
    execv(argv[0], argv.data());
    _exit(127);
  }
  int status = -1;
  while (child > 0 && waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (child > 0 && WIFEXITED(status) && WEXITSTATUS(status) == 0) return true;
  *error = command[0] +
           ": could not draw; are python3-matplotlib and "
           "python3-numpy installed (third_party/install.sh)?";
  return false;
}

nlohmann::json PointRows(const PointsRef& points) {
  nlohmann::json rows = nlohmann::json::array();
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    rows.push_back({static_cast<float>(points(0, i)),
                    static_cast<float>(points(1, i)),
                    static_cast<float>(points(2, i))});
  }
  return rows;
}

nlohmann::json Thinned(const Points& points) {
  std::string ignored;
  const auto voxels = SampleVoxels(points, kDrawnVoxel, &ignored);
  return PointRows(voxels ? *voxels : points);
}

}  // namespace

bool CanDrawPictures(std::string* error) {
  return RunPython({FindSharedFile("draw_registration.py").string(), "--check"},
                   error);
}

std::optional<std::string> DrawRegistration(const RegistrationPicture& picture,
                                            std::string* error) {
  nlohmann::json data;
  data["title"] = picture.title;
  // Everything is drawn relative to a round number nearby, so that map
  // coordinates keep their digits; the origin is zero for all other data.
  const Eigen::Vector3d origin =
      picture.target.cols() > 0
          ? Eigen::Vector3d(
                (picture.target.col(0) / kOriginStep).array().round() *
                kOriginStep)
          : Eigen::Vector3d::Zero();
  data["origin"] = {origin.x(), origin.y(), origin.z()};
  data["source"] = Thinned(picture.source.colwise() - origin);
  data["target"] = Thinned(picture.target.colwise() - origin);
  data["matched_source"] = PointRows(picture.matched_source.colwise() - origin);
  data["matched_target"] = PointRows(picture.matched_target.colwise() - origin);
  data["inliers"] = picture.inliers;
  if (picture.target_from_source) {
    const Rigid3& motion = *picture.target_from_source;
    data["aligned"] = Thinned(motion.Apply(picture.source).colwise() - origin);
    data["matched_aligned"] =
        PointRows(motion.Apply(picture.matched_source).colwise() - origin);
  }

  const HeldSignals signals;
  std::string folder = (fs::temp_directory_path() / "quatro.XXXXXX").string();
  if (mkdtemp(folder.data()) == nullptr) {
    *error = folder + ": " + std::strerror(errno);
    return std::nullopt;
  }
  const std::string data_path = folder + "/data.json";
  const std::string picture_path = folder + "/picture.png";
  std::optional<std::string> bytes;
  const std::string json =
      data.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  if (WriteFileAtomically(data_path, json, error) &&
      RunPython({FindSharedFile("draw_registration.py").string(),
                 data_path,
                 picture_path},
                error)) {
    bytes = ReadWholeFile(picture_path, error);
  }
  std::error_code ignored;
  fs::remove_all(folder, ignored);
  return bytes;
}

}  // namespace quatro
