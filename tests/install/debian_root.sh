#!/usr/bin/env bash
# Tries a clone of this repository's HEAD on a bare Debian made by debootstrap:
# demo, tests, Python, install, packages. As root, with debootstrap, git, 6 GB of
# disk and an hour of two cores; not run by ctest.
#   tests/install/debian_root.sh SUITE FOLDER MIRROR, SUITE e.g. bookworm or trixie
# FOLDER gets the roots bare, build and packages, and the logs. The bare root is
# used again if it is there.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)

if (($# != 3)); then
  echo "usage: $0 SUITE FOLDER MIRROR" >&2
  exit 2
fi
for tool in debootstrap chroot git; do
  if ! command -v "$tool" >/dev/null; then
    echo "debian_root.sh: no $tool; apt-get install debootstrap coreutils git" >&2
    exit 2
  fi
done
suite=$1
mirror=$3
mkdir -p "$2"
folder=$(realpath "$2")
proxy=$(apt-config dump Acquire::http::Proxy | sed -nE 's/.*"(.*)";/\1/p')
if [[ -n $proxy ]]; then export http_proxy=$proxy; fi

if [[ ! -e $folder/bare.made ]]; then
  echo "== debootstrap $suite"
  script=/usr/share/debootstrap/scripts/$suite
  [[ -e $script ]] || script=/usr/share/debootstrap/scripts/sid
  debootstrap --variant=minbase "$suite" "$folder/bare" "$mirror" "$script" >"$folder/bare.log"
  touch "$folder/bare.made"
fi

#   in_root NAME: a fresh copy of the bare root runs its steps, in_root.sh
in_root() {
  local root=$folder/$1 code=0
  # An interrupted run leaves it mounted.
  while mountpoint -q "$root/proc"; do umount "$root/proc"; done
  rm -rf --one-file-system "$root"
  cp -a "$folder/bare" "$root"
  cp -L /etc/resolv.conf "$root/etc/resolv.conf"
  mkdir -p "$root/usr/local/share/ca-certificates"
  cp -r /usr/local/share/ca-certificates/. "$root/usr/local/share/ca-certificates/"
  git clone -q --no-hardlinks "$here/../.." "$root/root/quatro"
  if [[ -d $folder/debs ]]; then cp -r "$folder/debs" "$root/root/debs"; fi
  mount -t proc proc "$root/proc"
  chroot "$root" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C \
      DEBIAN_FRONTEND=noninteractive ${http_proxy:+http_proxy="$http_proxy"} \
      bash "/root/quatro/tests/install/in_root.sh" "$1" </dev/null || code=$?
  umount "$root/proc"
  return "$code"
}

rm -rf "$folder/debs"
in_root build
mkdir "$folder/debs"
cp "$folder"/build/root/quatro/build/packages/*.deb "$folder/debs/"
in_root packages
echo "== all passed on $suite ($SECONDS s)"
