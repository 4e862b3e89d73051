#!/usr/bin/env bash
# Lists tracked sources that do not match .clang-format, and fails if there are
# any. Versions of clang-format differ in details; Debian 12's is the reference.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

clang_format=$(command -v clang-format-14 || command -v clang-format) || {
  echo "format_test.sh: no clang-format; third_party/install.sh --ci installs it" >&2
  exit 2
}
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
