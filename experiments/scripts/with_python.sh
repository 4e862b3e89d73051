#!/usr/bin/env bash
# Runs a script with a Python that has the modules it needs, because the first
# python3 on PATH may lack them. QUATRO_PYTHON is tried first.
#   experiments/scripts/with_python.sh MODULE[,MODULE] SCRIPT [ARGS...]
# Exit code: the script's; 2 if no Python has the modules.
set -euo pipefail
trap 'exit 130' HUP INT TERM

if (($# < 2)) || [[ ! $1 =~ ^[A-Za-z_][A-Za-z0-9_.]*(,[A-Za-z_][A-Za-z0-9_.]*)*$ ]]; then
  echo "usage: $0 MODULE[,MODULE] SCRIPT [ARGS...]" >&2
  exit 2
fi
modules=$1
shift

mapfile -t others < <(compgen -c python3. | grep -xE 'python3\.[0-9]+' | sort -ruV)
for python in "${QUATRO_PYTHON:-}" python3 /usr/bin/python3 "${others[@]}"; do
  if [[ -n $python ]] && "$python" -c "import $modules" </dev/null >/dev/null 2>&1; then
    exec "$python" "$@"
  fi
done
echo "with_python.sh: no python3 has ${modules//,/, }; on Debian:" \
     "apt-get install $(sed 's/[^,]*/python3-&/g; s/,/ /g' <<<"$modules")" >&2
exit 2
