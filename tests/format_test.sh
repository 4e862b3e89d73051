#!/usr/bin/env bash
# Fails if a tracked source is not as .clang-format has it; lists those.
# Versions differ in details: 14, that of Debian 12, is the one that counts, and
# the test is skipped where there is only another.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

clang_format=$(command -v clang-format-14 || command -v clang-format) || {
  echo "format_test.sh: no clang-format; third_party/install.sh --ci installs it" >&2
  exit 2
}
version=$("$clang_format" --version | sed -nE 's/.*version ([0-9]+).*/\1/p')
if [[ $version != 14 ]]; then
  echo "format: skipped, clang-format $version is not 14"
  exit 0
fi
list=$(git ls-files -- '*.h' '*.cc')
mapfile -t sources <<<"$list"

num_bad=0
for source in "${sources[@]}"; do
  if [[ -e $source ]] && ! "$clang_format" --dry-run -Werror "$source" 2>/dev/null; then
    echo "not formatted: $source"
    num_bad=$((num_bad + 1))
  fi
done
if ((num_bad > 0)); then
  echo "format: $num_bad of ${#sources[@]} files; clang-format -i <file> fixes them"
  exit 1
fi
echo "format: ${#sources[@]} files checked"
