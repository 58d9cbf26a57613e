#!/usr/bin/env bash
# Exports each creature's swim for ParaView and draws it 3 s after the start, as paraview-creature-N.png beside this file.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$here/../..
work=$(mktemp -d)
trap 'rm -r "$work"' EXIT

for creature in 1 2 3 4; do
    case $creature in
        1 | 2) swim=("$root/results/quick-evolution/creature-$creature") ;;
        *) swim=("thesis/creature-$creature" --gait "$here/creature-$creature.json") ;;
    esac
    java -jar "$root/ga-java/target/natator.jar" export "${swim[@]}" --format vtp --duration 3 --every 180 \
        --output-dir "$work/$creature"
    "$root/.readers/bin/python" "$here/render.py" "$work/$creature" 3 "$here/paraview-creature-$creature.png"
done
