#!/usr/bin/env bash
# README's two lines for Python as they stand, in a clone of the newest commit, on systems that have Python and git alone, with a clock.
#   sudo tests/install/checkout.sh [SUITE]...      # else bookworm (Debian 12, g++ 12), noble (Ubuntu 24.04, g++ 13), trixie (Debian 13, g++ 14)
#   sudo tests/install/checkout.sh --evolve [SUITE]...    # README's first line, which evolves a swimmer, on systems that have git alone
# Needs root, debootstrap, mirrors of Debian and Ubuntu, and PyPI. CXX=clang++: by clang. Systems are kept: 0.8 GB each.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
. tests/install/system.sh

mapfile -t lines < <(awk '/^```/ { inside = !inside } inside && /^(\.\/setup\.sh --python|build\/python\/bin\/python) /' README.md)
(( ${#lines[@]} == 2 )) || { echo "checkout.sh: README.md must have two lines for Python, found: ${lines[*]-none}" >&2; exit 1; }
typed() {
    inside PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin ${CXX:+CXX="$CXX"} /usr/bin/env -C /tried/natator bash -c "$1"
}

evolve=
if [[ ${1-} == --evolve ]]; then
    evolve=$(awk '/^```/ { inside = !inside } inside && /^\.\/setup\.sh && mvn -q -Pevolve$/' README.md)
    [[ -n $evolve ]] || { echo 'checkout.sh: README.md must have the line "./setup.sh && mvn -q -Pevolve"' >&2; exit 1; }
    shift
fi
(( $# )) || set -- bookworm noble trixie
for suite in "$@"; do
    if [[ $evolve ]]; then
        rm -f "${NATATOR_ROOTS:-build/roots}/evolve-$suite/complete"
        system "evolve-$suite" "$suite" git
        git clone --quiet . "$root/tried/natator"
        began=$EPOCHREALTIME
        said=$(typed "$evolve")
        printf '%s: evolved in %s: %s\n' "$suite" "$(clock "$began")" "$(grep -E 'swims: [0-9.]+ ± ' <<<"$said")"
        continue
    fi
    rm -f "${NATATOR_ROOTS:-build/roots}/checkout-$suite/complete"  # what the last run has installed is to go
    compiler=${CXX:+clang}
    system "checkout-$suite" "$suite" "python3,git${compiler:+,$compiler}"
    git clone --quiet . "$root/tried/natator"
    began=$EPOCHREALTIME
    typed "${lines[0]}"
    installed=$EPOCHREALTIME
    said=$(typed "${lines[1]}")
    swum=$EPOCHREALTIME
    grep -Eq '^pool/eel: 0\.[0-9]+ in 2\.00 s' <<<"$said"
    printf '%s\n%s, %s: installed in %s, first swim %s later: %s\n' "$(typed 'build/python/bin/natator-sim --version')" "$suite" \
        "$(typed '"${CXX:-g++}" --version' | head -1)" "$(clock "$began" "$installed")" "$(clock "$installed" "$swum")" "$said"
done
