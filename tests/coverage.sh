#!/usr/bin/env bash
# Measures the share of lines that the tests of each folder and of the later
# folders reach. Fails below 90 % in features, solvers or robust. Writes a page
# to build-coverage/coverage/.
#   tests/coverage.sh
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
# shellcheck source=third_party/setup.sh
source third_party/setup.sh

bash third_party/install.sh --coverage
# Here, each file is compiled by itself, which .ci/run does not do.
quatro_configure coverage build-coverage -DQUATRO_UNITY=OFF -DQUATRO_TESTS='^(features|solvers|robust)/'
# Counters of the previous run would add up.
find build-coverage -name '*.gcda' -delete
quatro_build build-coverage quatro_tests
ctest --test-dir build-coverage -R '^(features|solvers|robust)/' -LE slow -j "$(quatro_jobs)" --output-on-failure

mkdir -p build-coverage/coverage
report() {
  gcovr --root . --object-directory build-coverage --exclude-throw-branches "$@"
}
report --filter '(features|solvers|robust)/' --html-details build-coverage/coverage/index.html
for folder in features solvers robust; do
  printf '%s: ' "$folder"
  report --filter "$folder/" --fail-under-line 90 | grep '^TOTAL'
done
echo "build-coverage/coverage/index.html"
