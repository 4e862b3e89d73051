#!/usr/bin/env bash
# Registers two scans and shows the result. On a clean clone it first installs
# and builds what it needs.
#   experiments/demo.sh                 two simulated scans with a known pose
#   experiments/demo.sh SOURCE TARGET   two scans of yours
# Exit code: 0 registered, 1 not registered, 2 bad input, 3 setup failed. The
# results stay in build/demo/.
set -euo pipefail

if [[ ${1:-} == --help || ${1:-} == -h ]]; then
  sed -n '2,7s/^# //p' "$0"
  exit 0
fi

usage() {
  echo "usage: $0 [SOURCE TARGET]" >&2
  exit 2
}

source=
target=
case $# in
  0) ;;
  2)
    for scan in "$@"; do
      if [[ ! -r $scan ]]; then
        [[ $scan == -* ]] && usage
        echo "demo.sh: cannot read $scan" >&2
        exit 2
      fi
    done
    source=$(realpath -- "$1")
    target=$(realpath -- "$2")
    ;;
  *) usage ;;
esac

cd "$(dirname "${BASH_SOURCE[0]}")/.."
# shellcheck source=third_party/setup.sh
source third_party/setup.sh

log=build/setup.log
out=build/demo
mkdir -p "$out"
: >"$log"

quatro_step "installing" quatro_install
quatro_step "configuring" quatro_configure release build
quatro_step "building (a few minutes the first time)" \
     quatro_build build quatro_simulate quatro_register

simulated=
if [[ -z $source ]]; then
  simulated=$(mktemp -d)
  trap 'rm -rf -- "$simulated"' EXIT
  quatro_step "simulating" build/bin/quatro_simulate --output="$simulated" --overwrite \
       --num_frames=11 --frame_spacing=1.0
  source=$(find "$simulated" -name 000010.bin -print -quit)
  target=$(find "$simulated" -name 000000.bin -print -quit)
fi

rm -f "$out"/registration.*
echo "registering" >&2
code=0
build/bin/quatro_register --source="$source" --target="$target" \
    --json="$out/registration.json" --picture="$out/registration.png" || code=$?

# Reads the JSON and, for simulated scans, the true poses.
if [[ -s $out/registration.json ]]; then
  bash experiments/scripts/with_python.sh numpy - "$out/registration.json" "$simulated" <<'END' || true
import json
import pathlib
import sys

import numpy as np


def yaw_and_translation(pose):
    yaw = np.degrees(np.arctan2(pose[1, 0], pose[0, 0]))
    return 'yaw %.2f deg, translation (%.2f, %.2f, %.2f) m' % (yaw, *pose[:3, 3])


def rows(line):
    return np.vstack([np.reshape([float(x) for x in line.split()], (3, 4)), [0, 0, 0, 1]])


def true_pose(folder, source, target):
    """KITTI stores the poses of the camera; Tr maps the lidar frame to it."""
    folder = pathlib.Path(folder)
    files = [*folder.rglob('poses*.txt'), *folder.rglob('poses/*.txt')]
    poses = [rows(line) for line in files[0].read_text().splitlines()]
    camera_from_lidar = np.eye(4)
    for calibration in folder.rglob('calib.txt'):
        for line in calibration.read_text().splitlines():
            if line.startswith('Tr:'):
                camera_from_lidar = rows(line[3:])
    return (np.linalg.inv(poses[target] @ camera_from_lidar)
            @ poses[source] @ camera_from_lidar)


result = json.load(open(sys.argv[1]))
print()
print('status     ', result['status'], '(%s)' % result['reason'] if result.get('reason') else '')
estimate = result.get('target_from_source')
if estimate:
    estimate = np.array(estimate, dtype=float)
    print('estimate   ', yaw_and_translation(estimate))
if sys.argv[2]:
    truth = true_pose(sys.argv[2], source=10, target=0)
    print('truth      ', yaw_and_translation(truth))
    if estimate is not None:
        error = np.linalg.inv(truth) @ estimate
        angle = np.degrees(np.arccos(np.clip((np.trace(error[:3, :3]) - 1) / 2, -1, 1)))
        print('error       %.2f deg, %.2f m' % (angle, np.linalg.norm(error[:3, 3])))
for name, count in (result.get('counts') or {}).items():
    print('%-20s %d' % (name.replace('_', ' '), count))
total = (result.get('timings_ms') or {}).get('total')
if total is not None:
    print('time        %.0f ms' % total)
END
fi
if [[ -s $out/registration.png ]]; then
  echo "picture     $PWD/$out/registration.png"
fi
exit "$code"
