#!/usr/bin/env bash
# Every check and benchmark of the CUDA backend on a machine with a GPU, and one table of what came out. Ends with 1 if
# a check fails. Logs, benchmark tables and the table itself go to the folder of --output.
set -uo pipefail

usage() {
    cat <<'TEXT'
usage: tests/cuda/run_on_gpu.sh [--build DIR] [--output DIR] [--no-ensembles] [--scene NAME]...
  --build DIR     use what was built there (bin/, share/), maybe on another machine; default: build it, preset cuda
  --output DIR    where logs and tables go; default: build/gpu-results
  --no-ensembles  leave out the comparison of 4-s ensembles with the CPU's, which takes minutes of all processors
  --scene NAME    benchmark this scene; default: creature-1 creature-4 vacuum fluid-x8 open-water
TEXT
}

fail() {
    printf 'run_on_gpu.sh: %s\n' "$1" >&2
    exit 1
}

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
build= output=$root/build/gpu-results ensembles=true scenes=()
while (( $# > 0 )); do
    case $1 in
        --build) build=${2:?--build needs a folder}; shift 2 ;;
        --output) output=${2:?--output needs a folder}; shift 2 ;;
        --no-ensembles) ensembles=false; shift ;;
        --scene) scenes+=(--scene "${2:?--scene needs a name}"); shift 2 ;;
        -h|--help) usage; exit 0 ;;
        *) usage >&2; fail "unknown option $1" ;;
    esac
done
mkdir -p "$output" || fail "$output: can't be made"
output=$(cd "$output" && pwd)

if [[ -z $build ]]; then
    build=$root/build/cuda
    cd "$root" && ./setup.sh --cuda && cmake --preset cuda && cmake --build --preset cuda || fail 'could not build'
fi
build=$(cd "$build" && pwd) || fail 'no such build folder'
simulator=$build/bin/natator-sim tests=$build/bin/natator-cuda-tests
[[ -x $simulator && -x $tests ]] || fail "$build: no bin/natator-sim and bin/natator-cuda-tests in it"
export NATATOR_CONFORMANCE=$root/tests/conformance
device=$(nvidia-smi --query-gpu=name,driver_version --format=csv,noheader 2>/dev/null | head -1)
[[ -n $device ]] || fail 'no GPU here (nvidia-smi finds none)'

# --- the table ----------------------------------------------------------------------------------------------------------

table=$output/gpu-checks.csv
printf 'check,outcome,seconds,measured\n' >"$table"
failed=0

row() {  # what, outcome, seconds, what was measured
    printf '%s,%s,%s,%s\n' "$1" "$2" "$3" "${4//,/;}" >>"$table"
    [[ $2 == ok || $2 == skipped ]] || failed=1
}

# check NAME COMMAND...: the command's log is NAME.log; it says what was measured in lines that begin with "measured: ".
check() {
    local name=$1 log=$output/$1.log start=$EPOCHREALTIME status=0
    shift
    printf '=== %s\n' "$name" >&2
    timeout 900 "$@" >"$log" 2>&1 || status=$?
    local seconds
    seconds=$(awk -v a="$start" -v b="$EPOCHREALTIME" 'BEGIN { printf "%.1f", b - a }')
    local passed
    passed=$(sed -n 's/^\[  PASSED  \] \([0-9]*\) test.*/\1 tests passed/p' "$log")
    local outcome=ok
    (( status == 0 )) || outcome="failed (exit $status)"
    grep -q '^\[  SKIPPED \]' "$log" && outcome='skipped tests'
    row "$name" "$outcome" "$seconds" "${passed}$(sed -n 's/^measured: / /p' "$log" | tr '\n' ';')"
}

suites=
suite() {
    suites+=:$2
    check "$1" "$tests" --gtest_filter="$2"
}

suite conformance '*GpuMicro*:*GpuOneFrame*:*GpuEffects*'
suite agreement-with-the-CPU '*GpuAgreement*:GpuInstability*'
suite water-on-a-lattice '*GpuLattice*'
suite laws-of-conserving 'Gpu/Laws*:GpuParticles*:*GpuWater*:GpuPeriodic*'
suite same-bits-in-any-batch '*GpuBatch*:*GpuTeams*:*EitherWay*'
suite one-scene-by-the-whole-GPU '*WholeGpu*:WithoutLists*:GpuRoof*'
$ensembles && suite ensemble-means-of-4-s '*GpuEnsemble*'
suite all-others "-${suites#:}:*GpuEnsemble*"

# --- benchmarks -----------------------------------------------------------------------------------------------------------

rm -f "$output"/gpu-speed.csv "$output"/gpu-speed-profile.csv
(( ${#scenes[@]} > 0 )) || scenes=(--scene creature-1 creature-4 vacuum fluid-x8 open-water)
check bench-speed "$simulator" bench speed --backend cuda "${scenes[@]}" --output "$output/gpu-speed.csv"
check bench-single-scene "$simulator" bench speed --backend cuda --whole-gpu --scene creature-1 --batch 1 \
    --output "$output/gpu-speed.csv"
check bench-water-settings "$simulator" bench speed --backend cuda --scheme conserving --scene creature-1 --setting 1x4 --setting 2x4 --setting 1x2m \
    --batch 150 --output "$output/gpu-speed.csv"
check bench-large-scene "$simulator" bench speed --backend cuda --scene fluid-x64 --batch 1 --output "$output/gpu-speed.csv"

rm -f "$output"/throughput.csv "$output"/gpu-roofline.csv
check bench-throughput "$simulator" bench throughput --particles 1000 8000 64000 1000000 --batch 1 16 --repeats 2 \
    --output "$output/throughput.csv"
check bench-without-lists "$simulator" bench throughput --scheme conserving --particles 64000 1000000 --batch 1 --repeats 1 \
    --without-lists --output "$output/throughput.csv"
ten_million() {  # both schemes; a study goes on where one of its scenes can't be computed
    "$simulator" bench throughput --particles 10000000 --batch 1 --repeats 1 --output "$output/throughput.csv" &&
        awk -F, 'NR > 1 && $3 > 9e6 { ++rows } END { exit rows != 2 }' "$output/throughput.csv"
}
export -f ten_million
export simulator output
check bench-10-million-particles bash -uo pipefail -c ten_million
check bench-roofline "$simulator" bench roofline --backend cuda --output "$output/gpu-roofline.csv"

# 150 requests in a stream, as a generation asks them: process, reading, settling and answers included.
generation() {
    local k
    for (( k = 0; k < 150; ++k )); do
        printf '{"id":%d,"scene":"thesis/creature-1","duration":4,"gait":{"frequency":1.%03d,"amplitude":[0.97,0.69],' $k $k
        printf '"phase":[0,0.648]},"overrides":{"stopping":{"planeContact":false,"noProgressAfter":0}}}\n'
    done
}
serve_generation() {
    generation | "$simulator" serve --backend cuda | grep -c '"status":"ok"' | sed 's/^/measured: answers /'
}
export -f generation serve_generation
export simulator
check serve-150-requests bash -uo pipefail -c serve_generation

# --- memory accesses and races, on short runs of all schemes and teams -----------------------------------------------------

sanitizer=$(command -v compute-sanitizer || ls /usr/local/cuda/bin/compute-sanitizer 2>/dev/null)
runs_of() {  # how many, scene, settling updates, scheme with the begin of its overrides
    local k
    for (( k = 0; k < $1; ++k )); do
        printf '{"id":1,"scene":"%s","duration":0.0167,"gait":{"frequency":1.%02d,"amplitude":[0.9,0.7],"phase":[0,0.3]},' "$2" $k
        printf '"scheme":%s"settling":{"updates":%d}}}\n' "$4" "$3"
    done
}
short_runs() {
    # flex: by many blocks, by one, by some each; few substeps of the others, with which racecheck is slow
    runs_of 1 bench/small-tank 2 '"flex","overrides":{'
    runs_of 1 bench/small-tank 0 '"flex","precision":"double","overrides":{"solver":{"substeps":1},'
    runs_of 6 thesis/creature-1 0 '"flex","overrides":{"solver":{"substeps":1},'
    runs_of 1 bench/small-tank 2 '"conserving","overrides":{'
    # with so few iterations that most of the water's weight is carried
    runs_of 1 bench/small-tank 2 '"conserving","overrides":{"solver":{"modifiedPressure":true,"substeps":1,"numIterations":1},'
}
sanitize() {  # tool; the tests take racecheck longer than anyone waits
    local path
    for path in '' --whole-gpu; do
        short_runs | "$sanitizer" --tool "$1" --error-exitcode 9 "$simulator" serve --backend cuda $path || return
    done
    runs_of 1 bench/small-tank 2 '"conserving","overrides":{' |
        "$sanitizer" --tool "$1" --error-exitcode 9 "$simulator" serve --backend cuda --without-lists || return
    [[ $1 == racecheck ]] && return
    "$sanitizer" --tool "$1" --error-exitcode 9 "$tests" \
        --gtest_filter='GpuParticles*:*WholeGpu.ContactsWithout*:*WholeGpu.FullLists*:GpuLattice.TakesBodies*:GpuLattice.IsShifted*' || return
    # so many that few threads share a particle of the water
    "$sanitizer" --tool "$1" --error-exitcode 9 "$build/bin/natator-bench" speed --backend cuda --scheme conserving \
        --scene creature-1 --setting 1x1 --batch 10 --repeats 1 --quick
}
for tool in memcheck racecheck; do
    if [[ -n $sanitizer ]]; then
        export -f sanitize short_runs runs_of
        export sanitizer simulator tests build
        check "$tool" bash -uo pipefail -c "sanitize $tool"
    else
        row "$tool" skipped 0 'no compute-sanitizer here'
    fi
done

# --- what came out ----------------------------------------------------------------------------------------------------------

{
    printf '\n%s\n\n' "$device"
    awk -F, '{ printf "%-26s %-16s %8s  %s\n", $1, $2, $3, $4 }' "$table"
    printf '\n%-15s %-10s %-6s %5s %10s %10s %10s %12s\n' scene scheme real batch 'kernel s' 'settle s' 'whole s' 'M p-it/s'
    awk -F, 'NR > 1 { printf "%-15s %-10s %-6s %5s %10s %10s %10s %12s\n", $1, $2, $3, $4, $11, $12, $13, $14 }' \
        "$output/gpu-speed.csv"
    printf '\n%-10s %-6s %10s %5s %-9s %10s %10s %12s %10s\n' scheme real fluid batch path 'ms a frame' 'M p-it/s' 'M pairs/s' \
        'B/particle'
    awk -F, 'NR > 1 { printf "%-10s %-6s %10s %5s %-9s %10s %10s %12s %10s\n", $1, $2, $3, $4, $6, $16, $17, $18, $20 }' \
        "$output/throughput.csv"
    printf '\n%-9s %-19s %-17s %5s %12s %10s %6s\n' kind name scene batch 'M pairs/s' 'GB/s' share
    awk -F, 'NR > 1 { printf "%-9s %-19s %-17s %5s %12s %10s %6s\n", $1, $2, $3, $4, $9, $10, $11 }' \
        "$output/gpu-roofline.csv"
} | tee "$output/gpu-table.txt"
exit "$failed"
