#!/usr/bin/env bash
# Installs the missing packages for building, testing and plotting, with apt on
# Debian and Ubuntu, and with npm the packages bundled into HTML reports. Never
# asks.
#   third_party/install.sh [--check] [--ci] [--docs] [--tidy] [--coverage] [--peers]
#   third_party/install.sh --print SYSTEM
#     --check     install nothing; list what is missing, exit 1 if anything is
#     --print     install nothing; print the command for another system: debian,
#                 fedora, arch, brew or conda
#     --ci        with what only .ci/run needs
#     --docs      with what only docs/build.sh needs
#     --tidy      with what only tests/tidy_test.sh needs
#     --coverage  with what only tests/coverage.sh needs
#     --peers     with what only -DQUATRO_WITH_OPEN3D and _PCL need (a gigabyte)
# Exits 1 if something could not be installed. Without apt it prints the command
# of the system's own package manager and exits 0: cmake finds out whether the
# packages are there.
set -euo pipefail

# Package names by system; third_party/README.md says what each package is for.
# "+" comes with another package of the list, "-" is not packaged there.
systems=(debian fedora arch brew conda)
table='
C++20 compiler     | g++                | gcc-c++                | gcc               | +                 | cxx-compiler
CMake 3.22         | cmake              | cmake                  | cmake             | cmake             | cmake
Ninja              | ninja-build        | ninja-build            | ninja             | ninja             | ninja
make               | make               | make                   | make              | +                 | make
Eigen 3.4          | libeigen3-dev      | eigen3-devel           | eigen             | eigen             | eigen
Boost.Math         | libboost-dev       | boost-devel            | boost             | boost             | libboost-headers
Ceres Solver 2.1   | libceres-dev       | ceres-solver-devel     | ceres-solver      | ceres-solver      | ceres-solver
glog               | libgoogle-glog-dev | glog-devel             | google-glog       | glog              | glog
gflags             | libgflags-dev      | gflags-devel           | gflags            | gflags            | gflags
nanoflann 1.4      | libnanoflann-dev   | nanoflann-devel        | -                 | nanoflann         | nanoflann
liblzf             | liblzf-dev         | liblzf-devel           | -                 | liblzf            | liblzf
zlib               | zlib1g-dev         | zlib-devel             | zlib              | zlib              | zlib
nlohmann-json 3    | nlohmann-json3-dev | json-devel             | nlohmann-json     | nlohmann-json     | nlohmann_json
Embree 3           | libembree-dev      | embree-devel           | embree            | embree            | embree
GoogleTest         | libgtest-dev       | gtest-devel            | gtest             | googletest        | gtest
GoogleMock         | libgmock-dev       | gmock-devel            | +                 | +                 | gmock
Google Benchmark   | libbenchmark-dev   | google-benchmark-devel | benchmark         | google-benchmark  | benchmark
RapidCheck         | librapidcheck-dev  | rapidcheck-devel       | -                 | -                 | rapidcheck
NumPy              | python3-numpy      | python3-numpy          | python-numpy      | numpy             | numpy
Matplotlib         | python3-matplotlib | python3-matplotlib     | python-matplotlib | python-matplotlib | matplotlib-base
pybind11 2.10      | pybind11-dev       | pybind11-devel         | pybind11          | pybind11          | pybind11
Python headers     | python3-dev        | python3-devel          | python            | python            | python
pytest             | python3-pytest     | python3-pytest         | python-pytest     | pytest            | pytest
pip                | python3-pip        | python3-pip            | python-pip        | +                 | pip
setuptools 61      | python3-setuptools | python3-setuptools     | python-setuptools | python-setuptools | setuptools
wheel              | python3-wheel      | python3-wheel          | python-wheel      | -                 | wheel
Node.js 18         | nodejs             | nodejs                 | nodejs            | node              | nodejs
npm                | npm                | nodejs-npm             | npm               | +                 | +
'

# The cells of one system, a line each; of "what" the first column.
column() {
  local i names=(what "${systems[@]}")
  for i in "${!names[@]}"; do
    if [[ ${names[i]} == "$1" ]]; then
      awk -F ' *[|] *' -v i="$((i + 1))" 'NF {sub(/ +$/, "", $i); print $i}' <<<"$table"
    fi
  done
}

print_command() {
  local tool names missing
  case "$1" in
    debian) tool="sudo apt-get install --no-install-recommends" ;;
    fedora) tool="sudo dnf install" ;;
    arch) tool="sudo pacman -S --needed" ;;
    brew) tool="brew install" ;;
    conda) tool="conda install -c conda-forge" ;;
    *) echo "install.sh: --print $1: not one of ${systems[*]}" >&2; return 2 ;;
  esac
  names=$(column "$1" | grep -vx '[+-]' | paste -s -d ' ' -)
  echo "$tool $names"
  missing=$(paste -d '|' <(column "$1") <(column what) | sed -n 's/^-|//p' | paste -s -d ',' - | sed 's/,/, /g')
  if [[ -n $missing ]]; then
    echo "# not packaged there; install from source: $missing"
  fi
}

# What this system is, if it is not Debian's: a column of the table, or nothing.
find_system() {
  local ids
  ids=$(sed -nE 's/^ID(_LIKE)?="?([^"]*)"?$/\2/p' "${OS_RELEASE:-/etc/os-release}" 2>/dev/null || true)
  case " ${ids//$'\n'/ } " in
    *" fedora "*) echo fedora ;;
    *" arch "*) echo arch ;;
    *)
      if [[ $(uname) == Darwin ]]; then echo brew; elif [[ -n ${CONDA_PREFIX:-} ]]; then echo conda; fi ;;
  esac
}

others='^$'
# Node.js and npm from elsewhere exclude Debian's.
if command -v node >/dev/null && command -v npm >/dev/null; then others='^nodejs$|^npm$'; fi
read -r -d '' -a packages < <(column debian | grep -vE "$others") || true

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
    --print) print_command "${2:-}"; exit ;;
    *) echo "usage: $0 [--check] [--ci] [--docs] [--tidy] [--coverage] [--peers] | --print SYSTEM" >&2; exit 2 ;;
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
  system=$(find_system)
  if [[ -n $system ]]; then
    echo "install.sh: no apt-get here; install with" >&2
    print_command "$system" >&2
  else
    echo "install.sh: no apt-get here; with your own package manager install" >&2
    column what | paste -s -d ',' - | sed 's/,/, /g' >&2
    echo "or newer versions (nanoflann up to 1.12, Embree 3 or 4); see third_party/README.md" >&2
  fi
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
