#!/usr/bin/env bash
# Starts a Slurm of one node on this machine, in its own folder. Splits a small
# run over a job array, kills and requeues one task, merges, and compares the
# tables with those of an unsplit run.
#   experiments/cluster/try_slurm.sh FOLDER FLAGS OF quatro_experiment...
# The flags must not include --output, --threads and --shard. Needs root, and
# Debian's slurm-wlm and munge. Slurm's logs stay in FOLDER. Exit code: 0 if all
# tables except the timing tables are equal; 1 if not; 2 if something is
# missing.
set -euo pipefail

if (($# < 2)); then
  echo "usage: $0 FOLDER FLAGS..." >&2
  exit 2
fi
folder=$(realpath -m -- "$1")
shift
for program in munged slurmctld slurmd sbatch; do
  if ! command -v "$program" >/dev/null; then
    echo "try_slurm.sh: $program is missing; on Debian: apt-get install slurm-wlm munge" >&2
    exit 2
  fi
done
if ((EUID != 0)); then
  echo "try_slurm.sh: must be run by root because of slurmd" >&2
  exit 2
fi
if [[ -e $folder ]]; then
  echo "try_slurm.sh: $folder already exists" >&2
  exit 2
fi

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
export QUATRO_EXPERIMENT=${QUATRO_EXPERIMENT:-$here/../../build/bin/quatro_experiment}
QUATRO_EXPERIMENT=$(realpath -- "$QUATRO_EXPERIMENT")
num_shards=4

mkdir -p "$folder"/{state,spool,munge}
export SLURM_CONF=$folder/slurm.conf
host=$(hostname -s)
cat >"$SLURM_CONF" <<CONF
ClusterName=quatro
SlurmctldHost=$host(127.0.0.1)
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket=$folder/munge/socket
CryptoType=crypto/munge
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
ReturnToService=2
MpiDefault=none
JobRequeue=1
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd.pid
SlurmctldLogFile=$folder/slurmctld.log
SlurmdLogFile=$folder/slurmd.log
SlurmctldPort=16817
SlurmdPort=16818
NodeName=$host NodeAddr=127.0.0.1 CPUs=$(nproc) State=UNKNOWN
PartitionName=all Nodes=$host Default=YES MaxTime=INFINITE State=UP
CONF

cleanup() {
  for pid_file in slurmd slurmctld munged; do
    [[ -e $folder/$pid_file.pid ]] && kill "$(<"$folder/$pid_file.pid")" 2>/dev/null
  done
  return 0
}
trap cleanup EXIT

chown munge: "$folder/munge"
chmod 755 "$folder/munge" "$folder"
runuser -u munge -- munged --force --socket="$folder/munge/socket" --pid-file="$folder/munge/pid" \
    --log-file="$folder/munge/log" --seed-file="$folder/munge/seed" \
    --key-file="${MUNGE_KEY:-/etc/munge/munge.key}"
ln -s munge/pid "$folder/munged.pid"
slurmctld
slurmd

#   wait_for <what> <seconds> <command>...: until the command succeeds
wait_for() {
  local what=$1 end=$((SECONDS + $2))
  shift 2
  until "$@" >/dev/null 2>&1; do
    if ((SECONDS > end)); then
      echo "try_slurm.sh: no $what; see the logs in $folder" >&2
      exit 2
    fi
    sleep 0.2
  done
}
is_idle() { [[ $(sinfo -h -o %T) == idle ]]; }
is_gone() { [[ -z $(squeue -h -j "$1" 2>/dev/null) ]]; }
is_running() { [[ $(squeue -h -j "$1" -o %T) == RUNNING ]]; }
wait_for "node" 60 is_idle

cd "$folder"
flags=("$@")
job=$(sbatch --parsable --array=1-$num_shards "$here/array.sh" "${flags[@]}" --output="$folder/parts")
echo "job $job of $num_shards tasks"
wait_for "first task" 60 is_running "${job}_1"
sleep 0.5
scontrol requeue "${job}_1" && echo "task 1 killed and requeued"
# A requeued task otherwise waits for two minutes.
wait_for "requeue" 60 scontrol update JobId="${job}_1" StartTime=now
wait_for "end of the array" 3600 is_gone "$job"
merge=$(sbatch --parsable "$here/merge.sh" "${flags[@]}" --output="$folder/parts")
wait_for "merge" 600 is_gone "$merge"
cat "quatro-merge-$merge.log" >&2
"$QUATRO_EXPERIMENT" "${flags[@]}" --output="$folder/whole" >/dev/null
if diff -r --exclude='timing*' "$folder/whole/tables" "$folder/parts/tables"; then
  echo "tables are identical"
else
  echo "tables differ" >&2
  exit 1
fi
