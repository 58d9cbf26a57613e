#!/usr/bin/env bash
# The whole test suite again and again while every core is kept busy: what leans on time or on who runs first fails here.
set -uo pipefail

usage() {
    cat <<'TEXT'
usage: tests/repeat_suite.sh [--build] [--resume] [--stop] [--output DIR] N
  N             how often the native and the Java tests run, one busy process a core beside them
  --build       first build what is tested; without it "mvn verify" or this must have been run before
  --resume      go on with the table in DIR, where a call before this ended early; the build must be the same
  --stop        end at the first run that fails; without it all N are done
  --output DIR  the table and the logs of the runs that failed; default: build/repeat-suite
Ends with 1 if a test failed or hung. It can be interrupted at any time: the runs that ended stay in the table.
TEXT
}

fail() {
    printf 'repeat_suite.sh: %s\n' "$1" >&2
    exit 2
}

cd "$(dirname "${BASH_SOURCE[0]}")/.." || exit 2
runs= build=false resume=false stop=false output=build/repeat-suite
while (( $# > 0 )); do
    case $1 in
        --build) build=true; shift ;;
        --resume) resume=true; shift ;;
        --stop) stop=true; shift ;;
        --output) output=${2:?--output needs a folder}; shift 2 ;;
        -h|--help) usage; exit 0 ;;
        -*) usage >&2; fail "unknown option $1" ;;
        *) [[ -z $runs ]] || fail "one number of runs, not $runs and $1"; runs=$1; shift ;;
    esac
done
[[ $runs =~ ^[1-9][0-9]{0,3}$ ]] || { usage >&2; fail "how often? a number from 1 to 9999, not '$runs'"; }
exec </dev/null

readonly half_limit=60m  # neither half takes nearly as long, even on busy cores: one that does hangs

# --- everything that was started ends with this script, also by kill -9: the load looks whether it is still there ----------

groups=()  # process groups that may still run
end_all() {
    local group
    for group in "${groups[@]}"; do kill -TERM -- "-$group" 2>/dev/null; done
    groups=()
}
interrupted() {
    end_all
    printf '\nrepeat_suite.sh: interrupted; go on with --resume\n' >&2
    exit 130
}
trap interrupted INT TERM HUP
trap end_all EXIT

# Runs a command in a process group of its own, with both outputs to the file, and waits for it.
in_group() {
    local log=$1 status
    shift
    set -m
    "$@" >"$log" 2>&1 &
    set +m
    local group=$!
    groups+=("$group")
    wait "$group"
    status=$?
    kill -TERM -- "-$group" 2>/dev/null  # what a test left behind
    return "$status"
}

busy='while kill -0 "$0" 2>/dev/null; do for (( i = 0; i < 100000; ++i )); do :; done; done'
start_load() {
    local core
    set -m
    for (( core = 0; core < $(nproc); ++core )); do
        bash -c "$busy" "$$" >/dev/null 2>&1 &
        groups+=("$!")
        disown "$!"
    done
    set +m
}

# --- what failed, from what the test programs themselves say ----------------------------------------------------------------

native_failures() {  # log
    sed -nE 's/^.*\[  FAILED  \] ([A-Za-z0-9_]+\.[^ ,]+|[A-Za-z0-9_]+\/[^ ,]+).*$/\1/p' "$1" | sort -u
    sed -nE '/^The following tests FAILED:/,$ s/^\s*[0-9]+ - (.*) \((Timeout|SEGFAULT|Child aborted|.*[Ee]xception.*)\).*/\1 (\2)/p' "$1"
}

java_failures() {
    awk 'match($0, /<testcase [^>]*/) {
             name = class = substr($0, RSTART, RLENGTH)
             sub(/.* name="/, "", name); sub(/".*/, "", name)
             sub(/.* classname="/, "", class); sub(/".*/, "", class); sub(/.*\./, "", class)
         }
         /<(failure|error)[ >]/ { print class "." name }' ga-java/*/target/surefire-reports/TEST-*.xml 2>/dev/null | sort -u
}

# --- the table ------------------------------------------------------------------------------------------------------------

if $build; then
    mvn -q verify -DskipTests || fail 'could not build'
fi
[[ -x build/release/bin/natator-tests && -d ga-java/app/target/test-classes ]] ||
    fail 'nothing to test: run mvn verify before this, or give --build'
built=$(find build/release/bin ga-java/*/target/classes ga-java/*/target/test-classes -type f -print0 | sort -z |
    xargs -0 cat | cksum | cut -d' ' -f1)

mkdir -p "$output" || fail "$output: can't be made"
table=$output/table.txt
readonly row='%4s %8s  %-6s  %s\n'
if $resume; then
    [[ -f $table ]] || fail "$table: no such table to go on with"
    [[ $(sed -n 's/^build //p' "$table") == "$built" ]] || fail "$table: is about another build; begin anew, without --resume"
else
    [[ -f $table || -z $(ls -A "$output") ]] || fail "$output: has something else in it"
    rm -rf "$output"/run-*
    { printf 'build %s\n' "$built"; printf "$row" run seconds result 'what failed'; } >"$table"
fi
done_before=$(awk '$1 ~ /^[0-9]+$/' "$table" | wc -l)

start_load
for (( run = done_before + 1; run <= runs; ++run )); do
    printf 'run %d of %d …\n' "$run" "$runs" >&2
    logs=$output/run-$run
    rm -rf "$logs" ga-java/*/target/surefire-reports
    mkdir -p "$logs"
    begin=$SECONDS failed=()
    if ! in_group "$logs/native.log" timeout --kill-after=10 "$half_limit" ctest --preset release; then
        mapfile -t -O ${#failed[@]} failed < <(native_failures "$logs/native.log")
        (( ${#failed[@]} > 0 )) || failed+=('native tests (see native.log)')
    fi
    # All modules, also those after one that failed; "test" compiles nothing anew, but tells modules of each other.
    if ! in_group "$logs/java.log" timeout --kill-after=10 "$half_limit" \
            mvn --batch-mode -f ga-java test -Dmaven.test.failure.ignore || grep -q '^\[ERROR\]' "$logs/java.log"; then
        before=${#failed[@]}
        mapfile -t -O "$before" failed < <(java_failures)
        (( ${#failed[@]} > before )) || failed+=('Java tests (see java.log)')
        cp -r --parents ga-java/*/target/surefire-reports "$logs/" 2>/dev/null
    fi
    result=passed
    if (( ${#failed[@]} > 0 )); then result=failed; else rm -rf "$logs"; fi
    printf "$row" "$run" "$((SECONDS - begin))" "$result" "$(printf '%s, ' "${failed[@]}" | sed 's/, $//')" >>"$table"
    tail -1 "$table" >&2
    [[ $result == failed ]] && $stop && break
done
end_all

sed 1d "$table"
failures=$(awk '$1 ~ /^[0-9]+$/ && $3 != "passed"' "$table" | wc -l)
all=$(awk '$1 ~ /^[0-9]+$/' "$table" | wc -l)
printf '%d of %d runs failed' "$failures" "$all"
(( failures == 0 )) && echo || printf '; their logs are in %s\n' "$output"
(( failures == 0 ))
