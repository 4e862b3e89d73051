#!/usr/bin/env bash
#SBATCH --job-name=quatro-merge
#SBATCH --output=quatro-merge-%j.log
# After array.sh, with the same flags: puts the parts together and writes the
# tables. QUATRO_EXPERIMENT as there.
set -euo pipefail

exec "${QUATRO_EXPERIMENT:-build/bin/quatro_experiment}" "$@" --merge
