#!/usr/bin/env bash
# Does the steps of .devcontainer/Dockerfile in systems of their own, without docker, with a clock; then starts what the last one holds.
#   sudo tests/install/image.sh [STAGE...]     these stages alone, and the others as they were left; default: all
# Needs root, debootstrap, a Debian mirror and Maven Central. PRESET=cuda: as --build-arg PRESET=cuda.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
source tests/install/roots.sh

readonly file=.devcontainer/Dockerfile wanted=" $* "
declare -A variables folder_of  # of stages: WORKDIR
stage=final root='' work=/ entry=()

fail() {
    printf 'image.sh: %s: line %d: %s\n' "$file" "$number" "$1" >&2
    exit 1
}

# What docker would take along of the checkout, as an archive.
context() {
    local pattern options=()
    while read -r pattern; do
        case $pattern in
            '**/'*) options+=(--no-anchored --exclude="${pattern#'**/'}") ;;
            /*) options+=(--anchored --exclude="${pattern#/}") ;;
            *) fail ".dockerignore: $pattern: must begin with / or **/" ;;
        esac
    done <.dockerignore
    git ls-files -z | tar --create "${options[@]}" --null --files-from -
}

begin_stage() {  # IMAGE [AS NAME]
    local base=$1
    stage=${3:-final}
    work=${folder_of[$base]:-/}
    if [[ $base == debian:12-slim ]]; then
        make_root image/debian bookworm
    else
        root=$roots/image/$base
        [[ -d $root ]] || fail "there is no stage $base"
    fi
    local from=$root
    root=$roots/image/$stage
    skipped=false
    [[ -z ${wanted// } || $wanted == *" $stage "* ]] || skipped=true
    $skipped && return
    rm -rf "$root"
    cp --archive --reflink=auto "$from" "$root"
    began=$SECONDS
}

copy() {  # [--from=STAGE] SOURCE TARGET
    local from=
    if [[ $1 == --from=* ]]; then
        from=$roots/image/${1#--from=}
        shift
    fi
    local target=$2
    [[ $target == /* ]] || target=$work/$target
    if [[ -n $from ]]; then
        mkdir -p "$(dirname "$root$target")"
        cp --archive --no-target-directory "$from$1" "$root$target"
    elif [[ $1 == . ]]; then
        context | tar --extract --directory "$root$target"
    else
        [[ -f $1 ]] || fail "COPY: there is no file $1"
        [[ $target == */ ]] && target+=${1##*/}
        install -D --mode="$(stat -c %a "$1")" "$1" "$root$target"
    fi
}

run() {
    local assignments=() name
    for name in "${!variables[@]}"; do assignments+=("$name=${variables[$name]}"); done
    in_root HOME=/root PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin "${assignments[@]}" env -C "$work" "$@"
}

end_stage() {
    folder_of[$stage]=$work
    $skipped || printf '%s: %d s, %d MB\n' "$stage" $((SECONDS - began)) "$(du -sm "$root" | cut -f1)"
}

number=0 skipped=true
while read -r -u 3 instruction rest; do
    number=$((number + 1))
    case $instruction in
        '' | '#'*) ;;
        FROM)
            [[ -z $root ]] || end_stage
            # shellcheck disable=SC2086
            begin_stage $rest
            ;;
        ENV) variables[${rest%%=*}]=${rest#*=} ;;
        ARG)
            name=${rest%%=*}
            variables[$name]=${!name:-${rest#*=}}
            ;;
        WORKDIR)
            work=$rest
            $skipped || mkdir -p "$root$work"
            ;;
        # shellcheck disable=SC2086
        COPY) $skipped || copy $rest ;;
        RUN) $skipped || run sh -c "$rest" ;;
        ENTRYPOINT) mapfile -t entry < <(python3 -c 'import json, sys; print(*json.loads(sys.argv[1]), sep="\n")' "$rest") ;;
        *) fail "$instruction: is unknown here" ;;
    esac
done 3<"$file"
end_stage

[[ -d $root ]] || exit 0  # the last one was not asked for
run "${entry[@]}" --version
run "${entry[@]}" run pool/eel --duration 0.5
run natator --version
