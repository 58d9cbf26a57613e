#!/usr/bin/env bash
# Exports each creature's swim for ParaView and draws it 3 s after the start, as paraview-creature-N.png beside this file.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$here/../..
work=$(mktemp -d)
trap 'rm -r "$work"' EXIT

# The gaits that results/thesis/README.md names as best evolved in scheme conserving.
for run in 1/conserving/seed-1 2/conserving/seed-3 3/conserving/seed-2 4/conserving/seed-1; do
    creature=${run%%/*}
    java -jar "$root/ga-java/target/natator.jar" export "$root/results/thesis/runs/creature-$run" \
        --format vtp --duration 3 --every 180 --output-dir "$work/$creature"
    "$root/.readers/bin/python" "$here/render.py" "$work/$creature" 3 "$here/paraview-creature-$creature.png"
done
