# shellcheck shell=bash
# Setup from a clean clone to programs. Sourced by tests/run.sh, .ci/run,
# experiments/demo.sh and reproduce.sh, with the root of the repository as the
# current directory.

# Packages that cannot be installed may be present by other means; cmake finds
# out.
quatro_install() {
  bash third_party/install.sh || true
}

#   quatro_configure <preset> <build folder> [<option of cmake>...]
# An existing build folder keeps its generator.
quatro_configure() {
  local generator=()
  if [[ ! -e $2/CMakeCache.txt ]] && command -v ninja >/dev/null; then
    generator=(-G Ninja)
  fi
  cmake --preset "$1" "${generator[@]}" -DQUATRO_UNITY=ON "${@:3}"
}

# One job per core, limited to one per 2 GB of memory.
quatro_jobs() {
  local cores room
  cores=$(nproc 2>/dev/null || getconf _NPROCESSORS_ONLN)
  room=$(awk '/^MemAvailable:/ {print int($2 / 2e6)}' /proc/meminfo 2>/dev/null) || room=$cores
  room=$((room < cores ? room : cores))
  echo $((room < 1 ? 1 : room))
}

#   quatro_build <build folder> [<target>...]
quatro_build() {
  local folder=$1 targets=()
  shift
  if (($# > 0)); then
    targets=(--target "$@")
  fi
  cmake --build "$folder" -j "$(quatro_jobs)" "${targets[@]}"
}

#   quatro_step <what> <command>...
# Prints <what> and writes the output of the command to the file $log. Ends the
# script with exit code 3 if the command fails.
quatro_step() {
  echo "$1" >&2
  shift
  if ! "$@" >>"$log" 2>&1 </dev/null; then
    tail -n 30 "$log" >&2
    echo "${0##*/}: failed; the full log is $PWD/$log" >&2
    exit 3
  fi
}
