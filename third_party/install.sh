#!/usr/bin/env bash
# Installs the missing packages for building, testing and plotting, with apt on
# Debian and Ubuntu, and with npm the packages bundled into HTML reports. Never
# asks.
#   third_party/install.sh [--check] [--ci] [--docs] [--tidy] [--coverage] [--peers]
#     --check     install nothing; list missing packages, exit 1 if there are any
#     --ci        also packages that only .ci/run needs
#     --docs      also packages that only docs/build.sh needs
#     --tidy      also packages that only tests/tidy_test.sh needs
#     --coverage  also packages that only tests/coverage.sh needs
#     --peers     also packages that only -DQUATRO_WITH_OPEN3D and _PCL need (1 GB)
# Exits with 1 if something could not be installed. On other systems it lists
# the packages to install and exits with 0; cmake then finds out whether they
# are present.
set -euo pipefail

# third_party/README.md explains the purpose of each package.
packages=(g++ cmake ninja-build make libeigen3-dev libceres-dev
          libgoogle-glog-dev libgflags-dev libnanoflann-dev liblzf-dev
          nlohmann-json3-dev libembree-dev libgtest-dev libgmock-dev
          libbenchmark-dev librapidcheck-dev python3-numpy python3-matplotlib
          pybind11-dev python3-dev python3-pytest python3-pip)
# Node.js and npm from other sources conflict with Debian's packages.
command -v node >/dev/null && command -v npm >/dev/null || packages+=(nodejs npm)

docs=(doxygen mkdocs mkdocs-material libjs-mathjax)

check=false
for arg in "$@"; do
  case "$arg" in
    --check) check=true ;;
    --ci) packages+=(clang-format clang libclang-rt-dev chromium "${docs[@]}") ;;
    --peers) packages+=(libopen3d-dev libpcl-dev) ;;
    --docs) packages+=("${docs[@]}") ;;
    --tidy) packages+=(clang clang-tidy) ;;
    --coverage) packages+=(gcovr) ;;
    *) echo "usage: $0 [--check] [--ci] [--docs] [--tidy] [--coverage] [--peers]" >&2; exit 2 ;;
  esac
done

# Installs into experiments/report/node_modules, as pinned by package-lock.json.
# A build without these packages only lacks HTML reports.
report="$(dirname "${BASH_SOURCE[0]}")/../experiments/report"
has_report_packages() {
  cmp -s "$report/package-lock.json" "$report/node_modules/.quatro-lock"
}
install_report_packages() {
  has_report_packages && return
  if command -v npm >/dev/null &&
      npm ci --prefix "$report" --ignore-scripts --no-audit --no-fund --loglevel=error </dev/null >&2; then
    cp "$report/package-lock.json" "$report/node_modules/.quatro-lock"
  else
    echo "install.sh: no HTML reports: npm could not install three and esbuild" >&2
  fi
}

if ! command -v apt-get >/dev/null || ! command -v dpkg-query >/dev/null; then
  cat >&2 <<'END'
install.sh: no apt-get here; with your own package manager install
  a C++20 compiler, CMake (3.22 or newer), Ninja or make, Eigen (3.4),
  Ceres Solver (2.1 or newer), glog, gflags, nanoflann, liblzf,
  nlohmann-json (3), Embree (3), GoogleTest with GoogleMock,
  Google Benchmark for quatro_benchmark, RapidCheck for some tests,
  Python 3 with NumPy and Matplotlib; for the module its headers, pybind11
  (2.10) and pip, for its tests pytest; for HTML reports Node.js (18) and npm
END
  install_report_packages
  exit 0
fi

find_missing() {
  missing=()
  local installed package
  installed=$(dpkg-query -W -f '${db:Status-Status} ${Package}\n' "${packages[@]}" 2>/dev/null || true)
  for package in "${packages[@]}"; do
    grep -qxF "installed $package" <<<"$installed" || missing+=("$package")
  done
}

find_missing
if $check; then
  has_report_packages || missing+=("npm:three and npm:esbuild")
  if ((${#missing[@]} == 0)); then
    exit 0
  fi
  printf '%s\n' "${missing[@]}"
  exit 1
fi
if ((${#missing[@]} == 0)); then
  install_report_packages
  exit 0
fi

as_root=()
if ((EUID != 0)); then
  as_root=(sudo -n)
fi
apt_get() {
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
      apt-get -q -o DPkg::Lock::Timeout=300 "$@" </dev/null
}
if "${as_root[@]}" true 2>/dev/null; then
  # If the index cannot be updated, the existing one may suffice.
  apt_get update || true
  apt_get install -y --no-install-recommends "${missing[@]}" || true
fi

install_report_packages
find_missing
if ((${#missing[@]} != 0)); then
  echo "install.sh: could not install; as root: apt-get install ${missing[*]}" >&2
  exit 1
fi
