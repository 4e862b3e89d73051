#!/usr/bin/env bash
#SBATCH --job-name=quatro
#SBATCH --cpus-per-task=1
#SBATCH --requeue
#SBATCH --output=quatro-%A_%a.log
# A run of quatro_experiment shared out over a Slurm job array. From the folder
# that the flags' paths are relative to:
#
#   job=$(sbatch --parsable --array=1-16 experiments/cluster/array.sh --protocol=loop
#         --data=KITTI --methods=quatro,teaser --output=RUN)
#   sbatch --dependency=afterok:"$job" experiments/cluster/merge.sh the same flags
#
# A task that was killed, or ran out of time, goes on from its last pair: requeue
# it (scontrol requeue JOB_TASK), or submit that index again with the number of
# parts, QUATRO_SHARDS=16 sbatch --array=7 ...
# QUATRO_EXPERIMENT: the program, build/bin/quatro_experiment by default.
set -euo pipefail

if [[ -z ${SLURM_ARRAY_TASK_ID:-} ]]; then
  echo "array.sh: is to be submitted, sbatch --array=1-N $0 FLAGS" >&2
  exit 2
fi
exec "${QUATRO_EXPERIMENT:-build/bin/quatro_experiment}" "$@" \
     --threads="${SLURM_CPUS_PER_TASK:-1}" \
     --shard="$SLURM_ARRAY_TASK_ID/${QUATRO_SHARDS:-$SLURM_ARRAY_TASK_MAX}"
