#!/usr/bin/env bash
# Runs report_browser_test.mjs, or exits with 77 (skipped) if a requirement is
# missing.
#   report_browser_test.sh BIN_FOLDER
set -euo pipefail
bin=$(realpath "$1")
cd "$(dirname "${BASH_SOURCE[0]}")"

skip() {
  echo "skipped: $1"
  exit 77
}
node=$(command -v node || command -v nodejs) || skip "no Node.js (third_party/install.sh)"
[[ -e $bin/../share/quatro/report_template.html ]] || skip "built without HTML reports"
chromium=$(command -v chromium || command -v chromium-browser || command -v google-chrome) ||
  skip "no chromium (third_party/install.sh --ci)"
exec "$node" report_browser_test.mjs "$bin" "$chromium"
