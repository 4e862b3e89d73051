#!/usr/bin/env bash
#SBATCH --job-name=quatro
#SBATCH --cpus-per-task=1
#SBATCH --requeue
#SBATCH --output=quatro-%A_%a.log
# Splits a run of quatro_experiment over a Slurm job array. Submit it from the
# folder to which the paths in the flags are relative:
#
#   job=$(sbatch --parsable --array=1-16 experiments/cluster/array.sh --protocol=loop
#         --data=KITTI --methods=quatro,teaser --output=RUN)
#   sbatch --dependency=afterok:"$job" experiments/cluster/merge.sh the same flags
#
# A task that was killed or ran out of time resumes after its last completed
# pair: requeue it (scontrol requeue JOB_TASK), or submit that index again with
# the number of parts, QUATRO_SHARDS=16 sbatch --array=7 ... QUATRO_EXPERIMENT
# is the program, by default build/bin/quatro_experiment.
set -euo pipefail

if [[ -z ${SLURM_ARRAY_TASK_ID:-} ]]; then
  echo "array.sh: must be submitted as a job array: sbatch --array=1-N $0 FLAGS" >&2
  exit 2
fi
exec "${QUATRO_EXPERIMENT:-build/bin/quatro_experiment}" "$@" \
     --threads="${SLURM_CPUS_PER_TASK:-1}" \
     --shard="$SLURM_ARRAY_TASK_ID/${QUATRO_SHARDS:-$SLURM_ARRAY_TASK_MAX}"
