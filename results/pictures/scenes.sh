#!/usr/bin/env bash
# Draws scenes and bundled bodies with python -m natator picture, each with a gait of its own: results/pictures/scene-*.png.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
bin=build/release/bin
export PYTHONPATH=sim-native/python
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

draw() {  # name, scene, gait or - for a wave by the scene's muscles, options of the command
    local name=$1 scene=$2 gait=$3
    shift 3
    if [[ $gait == - ]]; then
        gait=$work/$name.json
        "$bin/natator-sim" info "$scene" --gait-template >"$gait"
    fi
    .readers/bin/python -m natator picture "$scene" --gait "$gait" --size 900x520 "$@" -o "results/pictures/scene-$name.png"
}

gaits=sim-native/examples/gaits
for body in eel tadpole tuna ray; do
    draw "$body" "pool/$body" - --from three-quarter --at 1
done
draw endless endless/eel - --from top --at 2
draw turn goals/turn "$gaits/turn.json" --from top --at 2
draw reach goals/reach "$gaits/reach.json" --from top --at 2
draw school company/school "$gaits/fish-like.json" --from top --at 2
draw pillars company/pillars "$gaits/fish-like.json" --from top --at 2
draw periodic open-water/periodic "$gaits/fish-like.json" --from top --at 2
draw plane plane/loach "$gaits/loach.json" --from top --at 4 --vortices
