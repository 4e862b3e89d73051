#!/usr/bin/env bash
# Installs the module by pip into a folder of its own, without a network, from
# what a build folder has, and imports it from there.
#   tests/python/pip_test.sh PYTHON BUILD_FOLDER SCRATCH VERSION
# Exit code: 77, which ctest takes as skipped, where something is missing.
set -euo pipefail

python=$1
build=$2
scratch=$3
version=$4
if [[ -z $python ]] || ! "$python" -c 'import setuptools, pip, wheel, numpy' 2>/dev/null; then
  echo "skipped: no module was built, or pip, setuptools or wheel are missing"
  exit 77
fi
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
rm -rf "$scratch"
mkdir -p "$scratch"
# Setuptools leaves folders of its own beside setup.py.
cp -r "$root/python" "$root/CMakeLists.txt" "$scratch/"
QUATRO_BUILD_FOLDER=$build "$python" -m pip --disable-pip-version-check install -q --no-index \
    --no-build-isolation --no-deps --target "$scratch/site" "$scratch/python"
cd "$scratch"
found=$(PYTHONPATH="$scratch/site" "$python" -c '
import importlib.metadata, quatro
print(quatro.__version__, importlib.metadata.version("quatro"), quatro.__file__)')
if [[ $found != "$version $version $scratch/site/quatro/__init__.py" ]]; then
  echo "installed: $found"
  exit 1
fi
rm -rf "$scratch"
