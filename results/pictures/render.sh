#!/usr/bin/env bash
# Exports each creature's swim for ParaView and draws it 3 s after the start, as paraview-creature-N.png beside this file.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$here/../..
work=$(mktemp -d)
trap 'rm -r "$work"' EXIT
export PYTHONPATH=$root/sim-native/python

# The gaits that results/thesis/README.md draws as best evolved in open water.
for creature in 1 2 3 4; do
    gunzip -c "$root/results/thesis/recordings/creature-$creature-open-water.json.gz" |
        python3 -c 'import json, sys; json.dump(json.load(sys.stdin)["request"]["gait"], sys.stdout)' >"$work/gait.json"
    "$root/.readers/bin/python" -m natator export "open-water/creature-$creature" --gait "$work/gait.json" \
        --format vtp --duration 3 --every 180 --output-dir "$work/$creature"
    "$root/.readers/bin/python" "$here/render.py" "$work/$creature" 3 "$here/paraview-creature-$creature.png"
done
