#!/usr/bin/env bash
# Evaluations as processes of their own, the way evolution runs them: what starting one costs (program, scene, settled
# start from the cache, result), and what several side by side give. Prints CSV.
#   overhead: seconds of an evaluation of 1 frame less a frame's part of one of 240 frames; medians, taken in turns
#   side by side: evaluations per second of K processes over that of one; the best round of each, taken in turns
set -euo pipefail

usage='usage: processes.sh NATATOR_SIM [ROUNDS] [PROCESSES] > processes.csv'
program=${1:?$usage}
rounds=${2:-7}
processes=${3:-2}
export NATATOR_CACHE
NATATOR_CACHE=$(mktemp -d)
trap 'rm -rf "$NATATOR_CACHE"' EXIT
export LC_ALL=C

request() {  # scheme, duration in seconds
    printf '{"id":1,"scene":"thesis/creature-1","scheme":"%s","duration":%s,' "$1" "$2"
    printf '"gait":{"frequency":1.861,"amplitude":[0.973,0.69],"phase":[0,0.648]},'
    printf '"overrides":{"stopping":{"planeContact":false,"noProgressAfter":0}}}\n'
}

evaluate() {  # scheme, duration
    request "$1" "$2" | "$program" evaluate --plain >/dev/null
}

seconds() {  # a command; prints how long it took
    local start=$EPOCHREALTIME
    "$@"
    awk -v from="$start" -v to="$EPOCHREALTIME" 'BEGIN { printf "%.6f\n", to - from }'
}

side_by_side() {  # processes, scheme
    local k
    for ((k = 0; k < $1; ++k)); do evaluate "$2" 4 & done
    wait
}

median() {
    sort -g | awk '{ v[NR] = $1 } END { printf "%.6f\n", NR % 2 ? v[(NR + 1) / 2] : (v[NR / 2] + v[NR / 2 + 1]) / 2 }'
}

echo 'scheme,evaluation_seconds,overhead_seconds,overhead_share,processes,rate_of_one,rate_side_by_side,ratio'
for scheme in flex conserving; do
    evaluate "$scheme" 4  # settles, warms up
    short='' long='' one='' many=''
    for ((round = 0; round < rounds; ++round)); do
        short+=$(seconds evaluate "$scheme" 0.016666666666666666)$'\n'
        long+=$(seconds evaluate "$scheme" 4)$'\n'
        one+=$(seconds side_by_side 1 "$scheme")$'\n'
        many+=$(seconds side_by_side "$processes" "$scheme")$'\n'
    done
    awk -v scheme="$scheme" -v k="$processes" -v short="$(median <<<"${short%$'\n'}")" \
        -v long="$(median <<<"${long%$'\n'}")" -v one="$(sort -g <<<"${one%$'\n'}" | head -1)" \
        -v many="$(sort -g <<<"${many%$'\n'}" | head -1)" 'BEGIN {
            overhead = short - (long - short) / 239
            printf "%s,%.4f,%.4f,%.4f,%d,%.4f,%.4f,%.4f\n", scheme, long, overhead, overhead / long, k, 1 / one, k / many,
                k * one / many }'
done
