#!/usr/bin/env bash
# Makes the Debian packages of a build folder, and on a bare Debian 12 made by
# debootstrap installs them, registers two simulated scans and builds a program
# of somebody else's. As root, with a mirror and 2 GB of disk; not run by ctest.
#   tests/install/debian_root.sh BUILD_FOLDER ROOT [MIRROR]
# ROOT is made if it is not there, and left.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)

if (($# < 2 || $# > 3)); then
  echo "usage: $0 BUILD_FOLDER ROOT [MIRROR]" >&2
  exit 2
fi
for tool in debootstrap cpack chroot dpkg-shlibdeps; do
  if ! command -v "$tool" >/dev/null; then
    echo "debian_root.sh: no $tool; apt-get install debootstrap cmake coreutils dpkg-dev" >&2
    exit 2
  fi
done
build=$(realpath "$1")
mkdir -p "$2"
root=$(realpath "$2")
mirror=${3:-$(apt-get indextargets --format '$(SITE)' 'Created-By: Packages' | head -n 1)}
proxy=$(apt-config dump Acquire::http::Proxy | sed -nE 's/.*"(.*)";/\1/p')
if [[ -n $proxy ]]; then export http_proxy=$proxy; fi

echo "== packages"
rm -rf "$build/packages"
(cd "$build" && cpack -G DEB -B "$build/packages")
rm -rf "$build/packages/_CPack_Packages"
for package in "$build"/packages/*.deb; do
  dpkg-deb --field "$package" Package Version Depends Installed-Size
done

if [[ ! -e $root/etc/debian_version ]]; then
  echo "== debootstrap from $mirror"
  debootstrap --variant=minbase bookworm "$root" "$mirror"
fi
cp -L /etc/resolv.conf "$root/etc/resolv.conf"
rm -rf "$root/root/quatro"
mkdir -p "$root/root/quatro"
cp "$build"/packages/*.deb "$here"/*_main.cc "$root/root/quatro/"
cp -r "$here/find_package" "$root/root/quatro/"
mount -t proc proc "$root/proc"
trap 'umount "$root/proc"' EXIT

chroot "$root" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C \
    DEBIAN_FRONTEND=noninteractive ${http_proxy:+http_proxy="$http_proxy"} bash -euo pipefail <<'END'
cd /root/quatro
install() { apt-get -q -y --no-install-recommends install "$@" </dev/null >install.log 2>&1 || { cat install.log; exit 1; }; }
apt-get -q update </dev/null >update.log 2>&1 || { cat update.log; exit 1; }

echo "== the programs alone"
install ./quatro_*.deb
quatro_register --version
quatro_simulate --output=scans --num_frames=2 --frame_spacing=8 2>simulate.log || { cat simulate.log; exit 1; }
quatro_register --source=scans/velodyne/000001.bin --target=scans/velodyne/000000.bin \
    --json=answer.json
grep -q '"status": "registered"' answer.json
if quatro_register --source=scans/velodyne/000001.bin --target=scans/velodyne/000000.bin \
    --picture=a.png >/dev/null 2>no_picture.txt; then exit 1; fi
cat no_picture.txt

echo "== with pictures"
install python3-matplotlib python3-numpy
quatro_register --source=scans/velodyne/000001.bin --target=scans/velodyne/000000.bin \
    --picture=a.png >/dev/null
test -s a.png

echo "== somebody else's program"
install ./libquatro-dev_*.deb g++ cmake make
cmake -S find_package -B build >configure.log 2>&1 || { cat configure.log; exit 1; }
cmake --build build >build.log 2>&1 || { cat build.log; exit 1; }
build/features_consumer
build/consumer

echo "== removed"
apt-get -q -y purge quatro libquatro-dev </dev/null >purge.log 2>&1
left=$(find /usr -path '*quatro*')
if [[ -n $left ]]; then echo "left: $left"; exit 1; fi
END
echo "== all passed"
