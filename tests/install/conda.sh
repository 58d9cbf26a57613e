#!/usr/bin/env bash
# Does what the conda recipe says, without conda: its build scripts, then those of its tests, in the system of stage `native` that
# tests/install/image.sh has left.
#   sudo tests/install/conda.sh
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
source tests/install/roots.sh
readonly recipe=.github/packaging/conda/recipe.yaml prefix=/tmp/conda
root=$roots/image/native
[[ -d $root/natator ]] || { echo "conda.sh: there is no $root: run tests/install/image.sh first" >&2; exit 1; }

# Commands below the key `script` of a part (build, tests).
scripts() {
    awk -v part="$1" '/^[a-z]/ { inside = $0 == part ":"; listed = 0 } /script:/ { listed = 1; next } inside && listed && sub(/^ +- /, "")' "$recipe"
}

do_all() {  # PART
    local command commands
    mapfile -t commands < <(scripts "$1")
    (( ${#commands[@]} > 0 )) || { echo "conda.sh: $recipe: no script of $1" >&2; exit 1; }
    for command in "${commands[@]}"; do
        printf '%s\n' "$command"
        in_root HOME=/root PATH=$prefix/bin:/usr/bin:/bin PREFIX=$prefix CMAKE_ARGS= env -C /natator sh -c "$command"
    done
}

rm -rf "$root$prefix"
do_all build
do_all tests
