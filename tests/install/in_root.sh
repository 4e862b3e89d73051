#!/usr/bin/env bash
# The steps of debian_root.sh inside its roots:
#   tests/install/in_root.sh build      what a clone does, to the packages in build/packages
#   tests/install/in_root.sh packages   what those packages do on a system without the sources
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

#   step NAME COMMAND...: the output goes to NAME.log, its end here if it fails
step() {
  local name=$1 begin=$SECONDS
  shift
  if ! "$@" >"/root/$name.log" 2>&1; then
    tail -n 40 "/root/$name.log"
    echo "== FAILED: $name ($((SECONDS - begin)) s)"
    exit 1
  fi
  echo "== passed: $name ($((SECONDS - begin)) s)"
}

install() { apt-get -q -y --no-install-recommends install "$@"; }

# What the README's "Install" says, in a folder of a user's own.
installed_consumer() {
  cmake --install build --prefix /root/installed
  cmake -S tests/install/find_package -B /root/consumer -DCMAKE_PREFIX_PATH=/root/installed
  cmake --build /root/consumer
  /root/consumer/features_consumer
  /root/consumer/consumer
}

pip_install() {
  python3 -m pip install --no-build-isolation --break-system-packages ./python
  cd /
  python3 -c 'import quatro; print(quatro.__version__)'
}

make_packages() {
  install dpkg-dev file
  (cd build && cpack -G DEB -B packages)
  for package in build/packages/*.deb; do
    dpkg-deb --field "$package" Package Version Depends Installed-Size
  done
}

# The compiler's warnings while the demo and the tests were built.
no_warnings() {
  ! grep -h 'warning:' build/setup.log /root/tests.log
}

versions() {
  local names
  read -r -a names < <(bash third_party/install.sh --print debian | sed 's/.*--no-install-recommends //')
  dpkg-query -W -f '${Package} ${Version}\n' "${names[@]}" "g++-[0-9]*" 2>/dev/null | grep ' [0-9]' | sort
  if cmp -s experiments/report/package-lock.json experiments/report/node_modules/.quatro-lock; then
    echo "HTML reports: built"
  else
    echo "HTML reports: not built, npm could not install their packages"
  fi
}

register() {
  quatro_register --source=/root/scans/velodyne/000001.bin \
      --target=/root/scans/velodyne/000000.bin "$@"
}

programs_alone() {
  install /root/debs/quatro_*.deb
  quatro_register --version
  quatro_simulate --output=/root/scans --num_frames=2 --frame_spacing=8
  register --json=/root/answer.json
  grep -q '"status": "registered"' /root/answer.json
  ! register --picture=/root/a.png
}

with_pictures() {
  install python3-matplotlib python3-numpy
  register --picture=/root/a.png
  test -s /root/a.png
}

somebody_elses_program() {
  install /root/debs/libquatro-dev_*.deb g++ cmake make
  cmake -S tests/install/find_package -B /root/consumer
  cmake --build /root/consumer
  /root/consumer/features_consumer
  /root/consumer/consumer
}

removed() {
  apt-get -q -y purge quatro libquatro-dev
  local left
  left=$(find /usr -path '*quatro*')
  if [[ -n $left ]]; then echo "left: $left"; return 1; fi
}

# "step" runs its command under "if", where set -e does not hold for a function:
# each function gets a shell of its own.
export -f install register
run() {
  # shellcheck disable=SC2163
  export -f "$1"
  step "$1" bash -euo pipefail -c "$1"
}

step update apt-get -q update
case "${1:-}" in
  build)
    step git install git ca-certificates
    step demo bash experiments/demo.sh
    step tests bash tests/run.sh
    tail -n 40 /root/tests.log | grep -E 'tests passed|Skipped|^\s+[0-9]+ - ' || true
    run installed_consumer
    run pip_install
    run make_packages
    run no_warnings
    versions
    ;;
  packages)
    run programs_alone
    run with_pictures
    run somebody_elses_program
    run removed
    ;;
  *) echo "usage: $0 build|packages" >&2; exit 2 ;;
esac
