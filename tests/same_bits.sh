#!/usr/bin/env bash
# Whether another build of the program, perhaps for another system and run by an emulator, gives the bits of build/release: the hashes of short
# runs of each scheme. Exit code 1 if not.
#   tests/same_bits.sh SET OTHER_SET COMMAND...      kernels (NATATOR_ISA) of build/release, and of the program that COMMAND starts
#   tests/same_bits.sh portable portable qemu-aarch64 -L /usr/aarch64-linux-gnu build/aarch64/bin/natator-sim
set -euo pipefail
(( $# > 2 )) || { echo "usage: tests/same_bits.sh SET OTHER_SET COMMAND..." >&2; exit 2; }
readonly here=$1 there=$2 other=("${@:3}")
readonly one=${NATATOR_SIM:-$(dirname "${BASH_SOURCE[0]}")/../build/release/bin/natator-sim}
different=0

hash_of() {  # SET COMMAND...
    NATATOR_ISA=$1 "${@:2}" --no-cache | awk '/^hash/ { sub("\r", ""); print $2 }'
}

compare() {
    local a b
    a=$(hash_of "$here" "$one" run "$@") b=$(hash_of "$there" "${other[@]}" run "$@")
    printf '%s %s %s\n' "$a" "$([[ $a == "$b" ]] && echo same || echo "$b")" "${*:1:5}"
    [[ $a == "$b" ]] || different=$((different + 1))
}

readonly short='"settling":{"updates":2}'
readonly thesis='{"frequency":1.861,"amplitude":[0.973,0.69],"phase":[0,0.648]}'
readonly eight='{"frequency":1,"amplitude":[1,1,1,1,1,1,1,1],"phase":[0,0,0,0,0,0,0,0]}'
compare bench/small-tank --duration 0.02 --scheme flex --overrides "{$short,\"fluid\":{\"count\":[6,5,5]}}"
compare bench/dam-break --duration 0.02 --scheme flex --overrides "{$short}"
compare thesis/creature-1 --duration 0.05 --scheme flex --gait "$thesis" --overrides "{$short}"
compare thesis/creature-1-vacuum --duration 0.2 --scheme flex --gait "$thesis"
compare thesis/creature-4-vacuum --duration 0.1 --scheme flex
compare pool/tadpole --duration 0.02 --scheme flex --precision double --overrides "{$short}"
compare bench/small-tank --duration 0.02 --scheme conserving --overrides "{$short,\"fluid\":{\"count\":[6,5,5]}}"
compare pool/eel --duration 0.05 --scheme conserving --gait "$eight" --overrides "{$short}"
compare pool/creature-2 --duration 0.03 --scheme conserving --precision double --overrides "{$short}"
compare company/hoop --duration 0.02 --scheme conserving --overrides "{$short}"
compare open-water/periodic --duration 0.02 --scheme conserving --overrides "{$short}"
compare lake/creature-2 --duration 0.1 --scheme lattice --gait "$eight" --overrides '{"planes":[],"fluid":{"count":[32,24,24]}}'
(( different == 0 )) || { echo "$different of 12 differ" >&2; exit 1; }
