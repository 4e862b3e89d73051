#!/usr/bin/env bash
# Fails if clang-tidy reports anything; .clang-tidy configures the checks.
#   tests/tidy_test.sh [source file...]
# Without files, checks all sources except the tests. build-tidy/ gets the
# compile commands; only a generated header is built.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
# shellcheck source=third_party/setup.sh
source third_party/setup.sh

bash third_party/install.sh --tidy
cmake -S . -B build-tidy -DCMAKE_BUILD_TYPE=Release -DQUATRO_BUILD_TESTS=OFF -DCMAKE_CXX_COMPILER=clang++ \
      -DQUATRO_BUILD_EXPERIMENTS=ON -DQUATRO_BUILD_PYTHON=ON -DCMAKE_EXPORT_COMPILE_COMMANDS=ON >/dev/null
cmake --build build-tidy --target quatro_commit >/dev/null
if (($# > 0)); then
  sources=("$@")
else
  list=$(git ls-files -- 'features/*.cc' 'solvers/*.cc' 'robust/*.cc' 'experiments/*.cc' 'python/*.cc' \
                         ':!experiments/peers')
  mapfile -t sources <<<"$list"
fi
printf '%s\0' "${sources[@]}" | xargs -0 -n 1 -P "$(quatro_jobs)" clang-tidy -p build-tidy --quiet 2>/dev/null || {
  echo "tidy: issues above, in ${#sources[@]} checked files" >&2
  exit 1
}
echo "tidy: ${#sources[@]} files checked"
