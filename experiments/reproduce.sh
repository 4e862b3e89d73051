#!/usr/bin/env bash
# Reproduces every table and figure of the paper. On a clean clone it first
# installs and builds what it needs.
#   experiments/reproduce.sh [--quick] [--output=DIR] [--kitti=DIR] [--naver=DIR]
#                            [--preset=NAME] [--threads=N]
#
#   --quick      few pairs and short drives: less than ten minutes on two cores
#   --output     build/reproduce by default; the same command resumes a run
#   --kitti      KITTI odometry, with SemanticKITTI's poses.txt if available;
#                default: simulated drives of the same names
#   --naver      NAVER LABS' HD_B1; default: a simulated building
#
# DIR gets data/ (simulated data), a folder with tables and figures for each run
# of quatro_experiment, and report.md. Exit code: 0; 2 for an invalid flag or
# bad data; 3 if the setup failed or the run was interrupted.
set -euo pipefail

quick=
output=
kitti=
naver=
preset=kitti
threads=0
for flag in "$@"; do
  case $flag in
    --quick) quick=1 ;;
    --output=*) output=$(realpath -m -- "${flag#*=}") ;;
    --kitti=*) kitti=$(realpath -- "${flag#*=}") ;;
    --naver=*) naver=$(realpath -- "${flag#*=}") ;;
    --preset=*) preset=${flag#*=} ;;
    --threads=*) threads=${flag#*=} ;;
    *)
      echo "usage: $0 [--quick] [--output=DIR] [--kitti=DIR] [--naver=DIR]" \
           "[--preset=NAME] [--threads=N]" >&2
      exit 2
      ;;
  esac
done

cd "$(dirname "${BASH_SOURCE[0]}")/.."
# shellcheck source=third_party/setup.sh
source third_party/setup.sh
output=${output:-$PWD/build/reproduce}
mkdir -p build "$output"
log=build/setup.log
: >"$log"

quatro_step "installing" quatro_install
quatro_step "configuring" quatro_configure release build
quatro_step "building (a few minutes the first time)" \
     quatro_build build quatro_simulate quatro_experiment quatro_register

drives=(00 02 05 06 07 08)
if [[ $quick ]]; then
  # Scans are 4 m apart, except for odometry.
  spacing=4 gap=25 per_source=0 pairs_one=8 pairs_three=6 pairs_yaw=3 pairs_timing=4 frames=106
  frames_inside=300 problems=10 lc_gap=62 pairs_lc=3 pairs_ablation=2
  intervals=(1 5)
  odometries=quatro,quatro_c2f,gicp,suma,aloam
else
  spacing=1 gap=100 per_source=3 pairs_one=200 pairs_three=200 pairs_yaw=50 pairs_timing=50 frames=600
  frames_inside=0 problems=100 lc_gap=250 pairs_lc=100 pairs_ablation=100
  intervals=(1 3 5)
  odometries=icp,gicp,vgicp,fgr,teaser,quatro,suma,aloam,quatro_c2f
fi

#   simulate <folder> <drive> <spacing> <frames>
simulate() {
  [[ -e $1/poses.txt ]] && return
  echo "simulating $2" >&2
  build/bin/quatro_simulate --output="$1" --protocol=drive --drive="$2" \
      --frame_spacing="$3" --num_frames="$4" --threads="$threads"
}

#   run <name> <flags of quatro_experiment>...
run() {
  local name=$1
  shift
  echo "running $name" >&2
  mkdir -p "$output/$name"
  rmdir --ignore-fail-on-non-empty "$output/$name"
  build/bin/quatro_experiment --output="$output/$name" --threads="$threads" "$@" \
      >"$output/$name.txt"
}

#   draw <name> <figures>
draw() {
  experiments/scripts/with_python.sh matplotlib experiments/scripts/draw_experiment.py \
      "$output/$1" --figures="$2" >/dev/null
}

drive_data=$kitti
odometry_data=$kitti
if [[ -z $kitti ]]; then
  drive_data=$output/data/drives
  odometry_data=$drive_data
  for drive in "${drives[@]}"; do
    simulate "$drive_data/$drive" "$drive" "$spacing" 0
  done
  if [[ $quick ]]; then
    odometry_data=$output/data/odometry
    simulate "$odometry_data/00" 00 1 "$frames"
  fi
fi
building_data=$naver
if [[ -z $naver ]]; then
  building_data=$output/data/building/hd_b1
  simulate "$building_data" hd_b1 0.3 "$frames_inside"
fi

loops=(--protocol=loop --data="$drive_data" --preset="$preset" --min_frame_gap="$gap"
       --max_pairs_per_source="$per_source")
run table_one "${loops[@]}" --sequences=00,02,05,06,07,08 --bins=9-12 --max_pairs="$pairs_one" \
    --methods=quatro,quatro_ins,quatro_c2f,teaser,fgr,ransac1k,ransac10k
draw table_one success,recall
# With the paper's radii and no polish there are fewer inliers, and methods
# differ.
run table_one_paper "${loops[@]}" --preset=paper --sequences=00,02,05,06,07,08 --bins=9-12 \
    --max_pairs="$pairs_one" --methods=quatro,quatro_ins,quatro_c2f,teaser,fgr,ransac1k,ransac10k
draw table_one_paper success,recall
run table_three "${loops[@]}" --sequences=06 --bins=0-2,2-4,4-6,6-8,8-10 --max_pairs="$pairs_three" \
    --methods=ransac10k,fgr,teaser,quatro,quatro_ins
draw table_three distance
# The rules of kitti_lc: more than 250 frames apart, kept pairs 2 m apart.
run loops --protocol=loop --data="$drive_data" --preset="$preset" \
    --sequences=00,02,05,06,07,08 --min_frame_gap="$lc_gap" --min_pair_spacing=2 \
    --bins=0-10,10-20,20-30 --max_pairs="$pairs_lc" --limits=2/5,2/10,0.6/5 \
    --methods=quatro,quatro_single,teaser,ransac10k,arc_consensus
draw loops distance
# The ablation: each part of the search off in turn, on pairs 20 to 30 m apart.
for world in street crossing hill; do
  echo "simulating $world" >&2
  build/bin/quatro_simulate --protocol=pairs --world="$world" --min_distance=20 --seed=77 \
      --pairs="$pairs_ablation" --output="$output/data/far/$world"
done
for part in none consensus segments cliques geometric_choice guided_matching rung_2 rung_3; do
  case $part in
    none) options=() ;;
    rung_2) options=(--options=max_rung=1) ;;
    rung_3) options=(--options=max_rung=2) ;;
    *) options=(--options="$part=off") ;;
  esac
  echo "running ablation/$part" >&2
  mkdir -p "$output/ablation/$part"
  for world in street crossing hill; do
    python3 experiments/scripts/run_pairs.py --pairs="$output/data/far/$world/pairs.csv" \
        --output="$output/ablation/$part/$world.csv" -- --preset="$preset" "${options[@]}" \
        >"$output/ablation/$part/$world.txt"
  done
done
run table_two --protocol=odometry --data="$odometry_data" --sequences=00 --preset="$preset" \
    --intervals="$(IFS=,; echo "${intervals[*]}")" --max_frames="$frames" --methods="$odometries"
run yaw --protocol=yaw --data="$building_data" --preset=indoor --intervals=5 --yaw_step_deg=30 \
    --max_pairs="$pairs_yaw" --methods=quatro,teaser,fgr,ransac10k
draw yaw yaw
run timing --protocol=timing --data="$drive_data" --sequences=00 --preset="$preset" \
    --min_frame_gap="$gap" --max_pairs_per_source="$per_source" --bins=0-10 --max_pairs="$pairs_timing" \
    --methods=quatro,quatro_exact,teaser,fgr,ransac10k
draw timing timing
run tilt --protocol=tilt --data="$drive_data" --sequences=00,02,05,06,07,08 --min_frame_gap="$gap" \
    --bins=0-12
draw tilt tilt
run synthetic --protocol=synthetic --preset="$preset" --seeds="$problems" \
    --methods=quatro,teaser,fgr,ransac1k,ransac10k
draw synthetic bins
for protocol in tims degeneracy quasi_inliers surrogates; do
  echo "running $protocol" >&2
  build/bin/quatro_experiment --protocol="$protocol" --output="$output/$protocol.csv" \
      >"$output/$protocol.txt"
done
experiments/scripts/with_python.sh matplotlib experiments/scripts/draw_surrogates.py "$output/surrogates.csv" \
    "$output/surrogates.png"

python3 experiments/scripts/report_paper.py "$output" >"$output/report.md.part"
mv "$output/report.md.part" "$output/report.md"
echo "$output/report.md" >&2
