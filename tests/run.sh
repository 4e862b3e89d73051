#!/usr/bin/env bash
# Installs missing packages, builds everything in build/ and runs the tests.
#   tests/run.sh [ctest arguments], e.g. tests/run.sh -R robust
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
# shellcheck source=third_party/setup.sh
source third_party/setup.sh

quatro_install
quatro_configure release build
quatro_build build
exec ctest --test-dir build -j "$(quatro_jobs)" --output-on-failure "$@"
