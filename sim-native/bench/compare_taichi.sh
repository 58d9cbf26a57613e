#!/usr/bin/env bash
# Natator beside a plain Position Based Fluids solver in Taichi (taichi_pbf.py), one thread each, taken in turns: 4 s of
# the thesis tank, with creature 1 in Natator. Prints CSV, a row per program and round.
set -euo pipefail

usage='usage: compare_taichi.sh NATATOR_SIM PYTHON_WITH_TAICHI [ROUNDS] > taichi.csv'
program=${1:?$usage}
python=${2:?$usage}
rounds=${3:-3}
here=$(dirname "${BASH_SOURCE[0]}")

natator_row() {  # scheme
    "$program" bench speed --scene creature-1 --scheme "$1" --repeats 1 2>/dev/null |
        awk -F, -v scheme="$1" 'NR == 1 { for (k = 1; k <= NF; ++k) column[$k] = k; next }
            $1 == "creature-1" { print "natator " scheme "," $column["seconds_least"] "," \
                $column["million_particle_iterations_per_second"]; exit }'
}

taichi_row() {
    "$python" "$here/taichi_pbf.py" | tail -1 | "$python" -c 'import json, sys
row = json.load(sys.stdin)
print("taichi", row["seconds"], row["million_particle_iterations_per_second"], sep=",")'
}

echo 'round,program,seconds,million_particle_iterations_per_second'
for ((round = 1; round <= rounds; ++round)); do
    for scheme in flex conserving; do echo "$round,$(natator_row "$scheme")"; done
    echo "$round,$(taichi_row)"
done
