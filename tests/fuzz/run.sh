#!/usr/bin/env bash
# Fuzzes the readers and programs, each target from its seeds in
# tests/fuzz/corpus; builds nothing (see preset fuzz, target
# quatro_fuzz_targets).
#   tests/fuzz/run.sh [--seconds=N | --cpu_seconds=N | --runs=N]
#                     [--build=FOLDER] [TARGET...]
#     --seconds      for each target; 5
#     --cpu_seconds  as much of a processor in place of the clock's time, for a
#                    machine with other work
#     --runs         as many inputs in place of a time: the same ones each time
#     --build        build-fuzz
#     TARGET         g2o, pcd, ...; all that are built
# Inputs that reach new code are kept in FOLDER/fuzz/corpus and gone on with;
# findings in FOLDER/fuzz/findings: `FOLDER/fuzz/TARGET_fuzz FILE` shows one
# again. FOLDER/fuzz/results.csv gets a line a target. Exits with 1 if there
# was a finding, 2 for a wrong argument.
set -euo pipefail
seeds=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)/corpus
build=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)/build-fuzz
limit=(-max_total_time=5 -timeout=5)
cpu_seconds=0
targets=()

is_count() { [[ $1 =~ ^[1-9][0-9]{0,8}$ ]]; }
for arg in "$@"; do
  value=${arg#*=}
  case "$arg" in
    --seconds=*) is_count "$value" && limit=(-max_total_time="$value" -timeout=5) || limit=() ;;
    # An input's time is the clock's: what took long is asked once more below.
    --cpu_seconds=*) is_count "$value" && limit=(-timeout=3600 -report_slow_units=5) || limit=()
      cpu_seconds=$value ;;
    --runs=*) is_count "$value" && limit=(-runs="$value" -timeout=5) || limit=() ;;
    --build=*) build=$value ;;
    -*) limit=() ;;
    *) targets+=("$arg") ;;
  esac
  if ((${#limit[@]} == 0)); then
    echo "run.sh: $arg: must be --seconds=N, --cpu_seconds=N, --runs=N, --build=FOLDER or a target" >&2
    exit 2
  fi
done
if ((${#targets[@]} == 0)); then
  for program in "$build"/fuzz/*_fuzz; do
    targets+=("$(basename "${program%_fuzz}")")
  done
fi
for target in "${targets[@]}"; do
  if [[ ! -x $build/fuzz/${target}_fuzz ]]; then
    echo "run.sh: $build/fuzz/${target}_fuzz: is not there; build quatro_fuzz_targets with preset fuzz" >&2
    exit 2
  fi
done

results=$build/fuzz/results.csv
mkdir -p "$build/fuzz/findings" "$build/fuzz/logs"
[[ -e $results ]] || echo "target,exit_code,cpu_s,executions,edges,corpus" >"$results"
# What is freed is not kept back for long: memory is limited. Names of functions
# take longer than an input may.
export ASAN_OPTIONS=quarantine_size_mb=16:symbolize=0:${ASAN_OPTIONS:-}
TIMEFORMAT='%U %S'

ticks=$(getconf CLK_TCK)
#   run <program> <argument>...: for $cpu_seconds, unless it is 0
run() {
  if ((cpu_seconds == 0)); then
    "$@"
    return
  fi
  "$@" &
  local pid=$! stat
  # Fields 14 and 15 are its time; a program that has ended has none.
  while read -r -a stat 2>/dev/null <"/proc/$pid/stat" && [[ ${stat[2]} != Z ]]; do
    if (((stat[13] + stat[14]) / ticks >= cpu_seconds)); then
      kill -USR1 "$pid"
    fi
    sleep 1
  done
  wait "$pid"
}

#   is_slow <program> <input>...: whether one of them takes 5 s of a processor
is_slow() {
  local input
  for input in "${@:2}"; do
    [[ -e $input ]] || continue
    (ulimit -t 5; exec "$1" -rss_limit_mb=512 -close_fd_mask=3 "$input") </dev/null || return 0
    rm "$input"
  done
  return 1
}

#   fuzz <target>: one line on what came of it, and one in $results
fuzz() {
  local log=$build/fuzz/logs/$1.log corpus=$build/fuzz/corpus/$1 code=0 cpu
  local program=$build/fuzz/${1}_fuzz options=()
  mkdir -p "$corpus" "$seeds/$1"
  [[ -e $seeds/../$1.dict ]] && options=(-dict="$seeds/../$1.dict")
  # The programs' own output is dropped (3): it would be all of the log.
  cpu=$({ time run "$program" "${limit[@]}" -seed=1 -rss_limit_mb=512 \
      -max_len=4096 -close_fd_mask=3 -print_final_stats=1 "${options[@]}" \
      -artifact_prefix="$build/fuzz/findings/$1-" \
      "$corpus" "$seeds/$1" >"$log" 2>&1 </dev/null; } 2>&1) || code=$?
  if ((code == 0)) && is_slow "$program" "$build/fuzz/findings/$1"-slow-unit-* >>"$log" 2>&1; then
    code=70
  fi
  local executions edges size
  cpu=$(awk '{printf "%.0f", $1 + $2}' <<<"$cpu")
  executions=$(sed -nE 's/^stat::number_of_executed_units: *//p' "$log")
  edges=$(sed -nE 's/.* cov: ([0-9]+) .*/\1/p' "$log" | tail -n 1)
  size=$(sed -nE 's/.* corp: ([0-9]+).*/\1/p' "$log" | tail -n 1)
  echo "$1,$code,$cpu,$executions,$edges,$size" >>"$results"
  if ((code != 0)); then
    echo "$1: FINDING, see $log"
    return 1
  fi
  echo "$1: $executions inputs, $edges edges, ${cpu} s of CPU, no finding"
}

code=0
for target in "${targets[@]}"; do
  fuzz "$target" || code=1
done
exit "$code"
