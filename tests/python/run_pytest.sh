#!/usr/bin/env bash
# Runs one file of Python tests on the module of a build folder.
#   tests/python/run_pytest.sh PYTHON BUILD_FOLDER FILE
# PYTHON is empty where no module is built. Exit code: pytest's; 77, which ctest
# takes as skipped, where something is missing.
set -euo pipefail

python=$1
build=$2
file=$3
if [[ -z $python ]]; then
  echo "skipped: no module was built (third_party/install.sh: pybind11-dev, python3-dev)"
  exit 77
fi
for module in numpy pytest; do
  if ! "$python" -c "import $module" 2>/dev/null; then
    echo "skipped: no $module for $python (third_party/install.sh: python3-$module)"
    exit 77
  fi
done
cd "$(dirname "${BASH_SOURCE[0]}")"
export PYTHONPATH="$build/python:$PWD" PYTHONDONTWRITEBYTECODE=1 QUATRO_BIN="$build/bin"
exec "$python" -m pytest -q -rs -p no:cacheprovider "$file"
