#!/usr/bin/env bash
# The Debian package on systems that have nothing else, with a clock: from apt install to the first swim, a small evolution and its page,
# by a user without rights; then it is removed, and nothing of it is left. Needs root, debootstrap and mirrors of Debian and Ubuntu.
#   sudo tests/install/deb.sh [SUITE]...      # else bookworm (Debian 12) and noble (Ubuntu 24.04)
# Needs build/deb/natator_*.deb: mvn package -DskipTests && cpack --preset deb. Systems are kept: 0.2 GB each.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
. tests/install/system.sh
version=$(tests/versions.py --show)
readonly package=build/deb/natator_${version}_amd64.deb
[[ -f $package ]] || { echo "deb.sh: no $package: make it by mvn package -DskipTests && cpack --preset deb" >&2; exit 1; }
printf '%s: %d bytes\n' "$package" "$(stat -c %s "$package")"

user() { inside setpriv --reuid=65534 --regid=65534 --clear-groups /usr/bin/env -C /tried/elsewhere "$@"; }

(( $# )) || set -- bookworm noble
for suite in "$@"; do
    system "deb-$suite" "$suite" ''
    inside PATH=/usr/sbin:/usr/bin:/sbin:/bin dpkg --purge natator >/dev/null 2>&1  # of a run that was cut short
    apt_get purge --auto-remove
    apt_get update
    chmod 777 "$root/tried/elsewhere"
    cp "$package" "$root/tried/"
    began=$EPOCHREALTIME
    apt_get install "/tried/${package##*/}"
    installed=$EPOCHREALTIME
    user natator-sim run pool/eel --duration 1 >"$root.log"
    swum=$EPOCHREALTIME
    [[ $(user natator-sim --version) == "natator-sim $version, commit "* ]]
    [[ $(user natator --version) == "natator $version"* ]]
    evolving=$EPOCHREALTIME
    user HOME=/tried/elsewhere natator evolve --creature 1 --population 4 --generations 1 --duration 0.5 --seed 7 --output-dir run >"$root.log" 2>&1 ||
        { cat "$root.log" >&2; exit 1; }
    user HOME=/tried/elsewhere natator page run >"$root.log" 2>&1 || { cat "$root.log" >&2; exit 1; }
    grep -q "<html" "$root/tried/elsewhere/swim.html"
    evolved=$EPOCHREALTIME
    apt_get purge natator
    removed=$EPOCHREALTIME
    left=$(find "$root" -xdev -path "$root/tried" -prune -o -name '*natator*' -print)
    [[ -z $left ]] || { printf 'deb.sh: left on %s: %s\n' "$suite" "$left" >&2; exit 1; }
    printf '%s: installed in %s, first swim %s later, evolution and page %s, removed in %s\n' "$suite" "$(clock "$began" "$installed")" \
        "$(clock "$installed" "$swum")" "$(clock "$evolving" "$evolved")" "$(clock "$evolved" "$removed")"
done
