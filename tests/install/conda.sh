#!/usr/bin/env bash
# The conda recipe, with a clock: rattler-build builds and tests the package in a system that has Python; it is installed in another one, and swims.
#   sudo tests/install/conda.sh [CHANNEL]      CHANNEL: conda-forge
# Without CHANNEL what the recipe asks for comes from Debian (headers, g++) and PyPI (cmake, ninja), repacked as a channel: that tries all but
# conda-forge's own packages. Needs root, debootstrap, a Debian mirror and PyPI. Systems are kept: 0.8 GB.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
. tests/install/system.sh
readonly rattler=(py-rattler-build==0.73.0 py-rattler==0.28.0) given=${1-}
readonly recipe=/tried/checkout/.github/packaging/conda/recipe.yaml
readonly conda=(/tried/venv/bin/python /tried/conda.py)

venv() {
    inside python3 -m venv /tried/venv
    inside /tried/venv/bin/pip install --quiet "$@"
    cp tests/install/conda.py "$root/tried/"
}

# A package of a part of the channel: sets `part` to its folder.
begin_part() { part=$root/tried/parts/$1=$2; mkdir -p "$part"; }
plain() { sed 's/^[0-9]*://; s/[-+].*//' <<<"$1"; }  # the version without what is Debian's of it

headers() {  # PACKAGE OF DEBIAN, NAME OF CONDA-FORGE
    local file
    inside PATH=/usr/sbin:/usr/bin:/sbin:/bin /usr/bin/env -C /tried apt-get -qq -o APT::Sandbox::User=root download "$1"
    file=$(echo "$root/tried/$1"_*.deb)
    begin_part "$2" "$(plain "$(dpkg-deb --field "$file" Version)")"
    dpkg-deb --extract "$file" "$root/tried/unpacked"
    cp --archive "$root"/tried/unpacked/usr/{include,share} "$part"
    rm -r "$root/tried/unpacked" "$part/share/doc"
}

wheel() {  # NAME: what it holds is in $root/tried/unpacked
    local file
    inside /tried/venv/bin/pip download --quiet --no-deps --dest /tried/wheels "$1"
    file=$(echo "$root/tried/wheels/$1"-*.whl)
    file=${file##*/}
    begin_part "$1" "$(cut -d- -f2 <<<"$file")"
    rm -rf "$root/tried/unpacked"
    inside python3 -m zipfile --extract "/tried/wheels/$file" /tried/unpacked
}

compiler() {
    local libc
    libc=$(inside dpkg-query --show --showformat='${Version}' libc6)
    begin_part sysroot_linux-64 "$(plain "$libc")"
    echo "glibc $libc, Debian's" >"$part/sysroot"
    printf 'c_stdlib: [sysroot]\nc_stdlib_version: ["%s"]\n' "$(plain "$libc")" >"$root/tried/variants.yaml"
    begin_part gxx_linux-64 "$(inside g++ -dumpfullversion)"
    mkdir -p "$part/etc/conda/activate.d"
    local variable
    for variable in "${cache_variables[@]}"; do echo "export $variable" >>"$part/etc/conda/activate.d/gxx.sh"; done
    # As conda-forge's compiler sets them.
    cat >>"$part/etc/conda/activate.d/gxx.sh" <<'SHELL'
export CXX=/usr/bin/g++ CMAKE_PREFIX_PATH=$PREFIX
export CXXFLAGS="${CXXFLAGS-} -fvisibility-inlines-hidden -fmessage-length=0 -march=nocona -mtune=haswell -ftree-vectorize -fPIC -fstack-protector-strong -fno-plt \
-O2 -ffunction-sections -pipe -isystem $PREFIX/include -fdebug-prefix-map=$SRC_DIR=/usr/local/src/conda"
export LDFLAGS="-Wl,-O2 -Wl,--sort-common -Wl,--as-needed -Wl,-z,relro -Wl,-z,now -Wl,--disable-new-dtags -Wl,--gc-sections -Wl,-rpath,$PREFIX/lib \
-Wl,-rpath-link,$PREFIX/lib -L$PREFIX/lib"
export CMAKE_ARGS="-DCMAKE_BUILD_TYPE=Release -DCMAKE_INSTALL_PREFIX=$PREFIX -DCMAKE_INSTALL_LIBDIR=lib -DCMAKE_FIND_ROOT_PATH_MODE_PROGRAM=NEVER"
SHELL
}

system conda-build bookworm python3-venv"${given:-,g++}"
mkdir "$root/tried/checkout"
git ls-files -z | tar --create --null --files-from - | tar --extract --directory "$root/tried/checkout"
venv "${rattler[@]}"
channel=$given variants=${recipe%/*}/variants.yaml
if [[ -z $given ]]; then
    apt_get update
    headers libeigen3-dev eigen
    headers nlohmann-json3-dev nlohmann_json
    headers libcli11-dev cli11
    wheel cmake
    mv "$root"/tried/unpacked/cmake/data/{bin,share} "$part"
    wheel ninja
    mv "$root"/tried/unpacked/ninja-*.data/scripts "$part/bin"
    chmod +x "$root"/tried/parts/{cmake,ninja}=*/bin/*
    compiler
    channel=/tried/needed variants=/tried/variants.yaml
    inside "${conda[@]}" channel /tried/parts "$channel"
fi
began=$EPOCHREALTIME
inside "${conda[@]}" build "$recipe" "$variants" "$channel" /tried/channel
printf 'built and tested in %s\n' "$(clock "$began")"

made=$root/tried/channel
system conda bookworm python3-venv
cp --recursive "$made" "$root/tried/channel"
venv "${rattler[1]}"
began=$EPOCHREALTIME
inside "${conda[@]}" install natator-sim /tried/prefix /tried/channel ${given:+"$given"}
printf 'installed in %s\n' "$(clock "$began")"
began=$EPOCHREALTIME
said=$(inside PATH=/tried/prefix/bin /usr/bin/env -C /tried/elsewhere natator-sim run pool/eel --duration 1)
grep -q 'completed' <<<"$said"
printf 'swum in %s: %s\n' "$(clock "$began")" "$(inside PATH=/tried/prefix/bin natator-sim --version)"
