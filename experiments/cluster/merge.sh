#!/usr/bin/env bash
#SBATCH --job-name=quatro-merge
#SBATCH --output=quatro-merge-%j.log
# Run after array.sh with the same flags: merges the parts and writes the
# tables. QUATRO_EXPERIMENT is as in array.sh.
set -euo pipefail

exec "${QUATRO_EXPERIMENT:-build/bin/quatro_experiment}" "$@" --merge
