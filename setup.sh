#!/usr/bin/env bash
# Installs what Natator needs to be built and run on Debian or Ubuntu. Does nothing where all of it is there.
set -euo pipefail

usage() {
    cat <<'TEXT'
usage: ./setup.sh [--check] [--python | [--cuda] [--browser] [--readers] [--tidy] [--wasm]]
  --check   only report what is missing (exit 1 if anything is), install nothing
  --python  only what the Python package is built with, and build/python to install it into
  --cuda    also what the CUDA backend is compiled with: where there is no nvcc 13, from PyPI into .cuda (400 MB)
  --browser also what the tests look at the page of natator view with: chromium, unless it or Google Chrome is there; and
            node and npm, with what its scripts are checked with from the npm registry (50 MB)
  --readers also what results/ are made with (pandas, scipy, matplotlib), and what the tests read exports back and
            try the Python client with: pyvista, plyfile, USD, pygltflib,
            pysplashsurf, numpy, gymnasium, pettingzoo, skrl with JAX, pycma, pyribs, tensorboard, MLflow, Optuna, nbclient, and what makes and checks its wheel and the site, from PyPI into .readers (2 GB); the validator of glTF, where npm
            is; PyTorch, from Debian, beside Stable-Baselines3; libegl1 and libgl1, which draw; valgrind, which runs the program as on a processor without AVX-512; doxygen; and
            dpkg-dev and gpg, which packages are made with
  --tidy    also what else looks for mistakes: clang-tidy, for .ci/tidy, and clang, a second compiler (cmake --preset clang)
  --wasm    also what makes the simulator of natator page --live: emscripten, and node (cmake --preset wasm)
TEXT
}

check_only=false
python_only=false
with_cuda=false
with_browser=false
with_readers=false
with_tidy=false
with_wasm=false
for argument in "$@"; do
    case $argument in
        --check) check_only=true ;;
        --python) python_only=true ;;
        --cuda) with_cuda=true ;;
        --browser) with_browser=true ;;
        --readers) with_readers=true ;;
        --tidy) with_tidy=true ;;
        --wasm) with_wasm=true ;;
        -h|--help) usage; exit 0 ;;
        *) printf 'setup.sh: unknown option %s\n' "$argument" >&2; usage >&2; exit 2 ;;
    esac
done

if $python_only && { $with_cuda || $with_browser || $with_readers || $with_tidy || $with_wasm; }; then
    echo 'setup.sh: --python: goes with --check alone' >&2
    exit 2
fi

fail() {
    printf 'setup.sh: %s\n' "$1" >&2
    exit 1
}

# --- what is needed: tools are probed, so that they may come from anywhere; libraries are Debian packages -------------

libraries=(libeigen3-dev=3.4 nlohmann-json3-dev=3.11 libcli11-dev=2.1)  # or later
$python_only || libraries+=(libgtest-dev)
readonly libraries
readonly minimum_cmake=3.25 minimum_java=17 minimum_node=18.18

compiler_works() {
    echo '#include <concepts>
          static_assert(__cplusplus >= 202002L);' | "${CXX:-c++}" -std=c++20 -fsyntax-only -x c++ - 2>/dev/null
}

is_at_least() {
    [[ -n $1 ]] && printf '%s\n' "$2" "$1" | sort --check=quiet --version-sort
}

cmake_works() {
    is_at_least "$(cmake --version 2>/dev/null | awk 'NR == 1 { print $3 }')" "$minimum_cmake"
}

node_works() {
    is_at_least "$(node --version 2>/dev/null | tr --delete v)" "$minimum_node"
}

java_works() {
    local version
    version=$(javac -version 2>&1) || return 1
    [[ $version =~ ([0-9]+) ]] && (( BASH_REMATCH[1] >= minimum_java ))
}

readonly cuda_folder=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)/.cuda
readonly cuda_version=13.0.2  # of all parts: they fit together only within one version

# CMakeLists.txt looks in the same places.
nvcc_works() {
    local nvcc version
    for nvcc in "${CUDACXX:-}" nvcc /usr/local/cuda/bin/nvcc "$cuda_folder/toolkit/bin/nvcc"; do
        [[ -n $nvcc ]] && command -v "$nvcc" >/dev/null || continue
        version=$("$nvcc" --version | grep -oE 'release [0-9]+') && (( ${version#release } >= 13 )) && return
    done
    return 1
}

# Makes nvcc and what it needs from NVIDIA's own packages on PyPI.
install_nvcc() {
    python3 -m venv "$cuda_folder" &&
        "$cuda_folder/bin/pip" --quiet --disable-pip-version-check install \
            "cuda-toolkit[nvcc,nvvm,crt,cudart,cccl]==$cuda_version" || return
    local toolkit
    toolkit=$(echo "$cuda_folder"/lib/python3*/site-packages/nvidia/cu13)
    ln --symbolic --force --no-dereference lib "$toolkit/lib64" &&
        ln --symbolic --force --no-dereference "$toolkit" "$cuda_folder/toolkit"
}

# The tests look in the same places.
browser_works() {
    local browser
    for browser in "${NATATOR_BROWSER:-}" chromium chromium-browser google-chrome google-chrome-stable; do
        [[ -n $browser ]] && command -v "$browser" >/dev/null && return
    done
    return 1
}

readonly page_folder=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)/ga-java/view

page_tools_work() {
    [[ $page_folder/node_modules/.package-lock.json -nt $page_folder/package-lock.json ]]
}

install_page_tools() {
    npm ci --silent --ignore-scripts --no-audit --no-fund --prefix "$page_folder"
}

readonly python_folder=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)/build/python

readonly readers_folder=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)/.readers
readonly readers_list=$(dirname "$readers_folder")/tests/readers/requirements.txt
readonly torch_list=$(dirname "$readers_folder")/tests/readers/torch.txt  # beside the PyTorch of Debian, whose own needs are there with it
readonly torch_packages=(python3-torch python3-pandas python3-matplotlib python3-pil)

readonly validator_version=2.0.0-dev.3.10
readonly uv_version=0.13.9  # installs in half of pip's time

has_all_of() {  # PYTHON LIST: whether every package is there in the version that the list names
    "$1" - "$2" 2>/dev/null <<'PYTHON'
import sys
from importlib.metadata import version
for line in open(sys.argv[1]):
    name, wanted = line.strip().split("==")
    if version(name) != wanted:
        sys.exit(1)
PYTHON
}

readers_work() {
    { ! command -v npm >/dev/null || [[ -d $readers_folder/node_modules/gltf-validator ]]; } &&
        has_all_of "$readers_folder/bin/python" "$readers_list" && has_all_of "$readers_folder/torch/bin/python" "$torch_list"
}

install_readers() {
    local cache=$readers_folder/cache  # in the same file system: nothing is copied
    python3 -m venv "$readers_folder" &&
        "$readers_folder/bin/pip" --quiet --disable-pip-version-check install "uv==$uv_version" &&
        "$readers_folder/bin/uv" pip install --quiet --python "$readers_folder/bin/python" --cache-dir "$cache" --compile-bytecode \
            --requirement "$readers_list" &&
        "$readers_folder/bin/uv" venv --quiet --clear --python /usr/bin/python3 --system-site-packages "$readers_folder/torch" &&
        "$readers_folder/bin/uv" pip install --quiet --python "$readers_folder/torch/bin/python" --cache-dir "$cache" --no-deps \
            --requirement "$torch_list" && rm -rf "$cache" || return
    ! command -v npm >/dev/null ||
        npm install --silent --no-fund --prefix "$readers_folder" "gltf-validator@$validator_version"
}

installed() {  # PACKAGE[=OLDEST VERSION]
    local status version
    read -r status version < <(dpkg-query --show --showformat='${db:Status-Status} ${Version}\n' "${1%=*}" 2>/dev/null) &&
        [[ $status == installed ]] && { [[ $1 != *=* ]] || is_at_least "${version#*:}" "${1#*=}"; }
}

# Sets `missing` to the packages that would bring what is not there.
find_missing() {
    missing=()
    compiler_works || missing+=(g++)
    if ! $python_only; then  # pip brings these two
        cmake_works || missing+=(cmake)
        command -v ninja >/dev/null || missing+=(ninja-build)
        java_works || missing+=("$(java_package)")
        command -v mvn >/dev/null || missing+=(maven)
    fi
    local library
    for library in "${libraries[@]}"; do
        installed "$library" || missing+=("${library%=*}")
    done
    $with_browser && ! browser_works && missing+=(chromium)
    $with_browser && ! node_works && missing+=(nodejs)
    $with_browser && ! command -v npm >/dev/null && missing+=(npm)
    $with_readers && ! command -v valgrind >/dev/null && missing+=(valgrind)
    $with_readers && ! command -v dpkg-shlibdeps >/dev/null && missing+=(dpkg-dev)
    $with_readers && ! command -v gpg >/dev/null && missing+=(gpg)
    $with_readers && ! command -v doxygen >/dev/null && missing+=(doxygen)
    for library in libegl1 libgl1 "${torch_packages[@]}"; do
        $with_readers && ! installed "$library" && missing+=("$library")
    done
    $with_tidy && ! command -v clang-tidy >/dev/null && missing+=(clang-tidy)
    $with_tidy && ! command -v clang++ >/dev/null && missing+=(clang)
    $with_wasm && ! command -v em++ >/dev/null && missing+=(emscripten)
    $with_wasm && ! node_works && missing+=(nodejs)
    nvcc_missing=false
    if $with_cuda && ! nvcc_works; then
        nvcc_missing=true
    fi
    page_tools_missing=false
    if $with_browser && ! page_tools_work; then
        page_tools_missing=true
    fi
    readers_missing=false
    if $with_readers && ! readers_work; then
        readers_missing=true
    fi
    python_missing=false
    if $python_only && [[ ! -x $python_folder/bin/pip ]]; then
        python_missing=true
    fi
    if $nvcc_missing || $readers_missing || $python_missing; then
        python3 -c 'import ensurepip' 2>/dev/null || missing+=(python3-venv)
    fi
}

known_to_apt() {
    [[ -n $(apt-cache --names-only search "^$1\$" 2>/dev/null) ]]
}

# Later releases no longer have version 17 and call the current one default-jdk-headless.
java_package() {
    if known_to_apt default-jdk-headless && ! known_to_apt openjdk-17-jdk-headless; then
        echo default-jdk-headless
    else
        echo openjdk-17-jdk-headless
    fi
}

# --- report or install ------------------------------------------------------------------------------------------------

# Ends the script: what apt brings is there.
finish() {
    if $nvcc_missing; then
        printf 'setup: installing nvcc %s into %s\n' "$cuda_version" "$cuda_folder"
        install_nvcc && nvcc_works || fail "could not install nvcc from PyPI into $cuda_folder"
    fi
    if $page_tools_missing; then
        printf 'setup: installing what %s names\n' "$page_folder/package-lock.json"
        install_page_tools && page_tools_work || fail "could not install what $page_folder/package-lock.json names from the npm registry"
    fi
    if $readers_missing; then
        printf 'setup: installing the packages of %s into %s\n' "$readers_list" "$readers_folder"
        install_readers && readers_work || fail "could not install $readers_list from PyPI into $readers_folder"
    fi
    if $python_missing; then
        python3 -m venv "$python_folder" || fail "could not make the virtual environment $python_folder"
    fi
    echo "$1"
    exit 0
}

find_missing
if $check_only && { (( ${#missing[@]} > 0 )) || $nvcc_missing || $page_tools_missing || $readers_missing || $python_missing; }; then
    $nvcc_missing && missing+=('nvcc 13')
    $page_tools_missing && missing+=('ga-java/view/node_modules')
    $readers_missing && missing+=('.readers')
    $python_missing && missing+=('build/python')
    printf 'setup: missing: %s\n' "${missing[*]}"
    exit 1
fi
(( ${#missing[@]} > 0 )) || finish 'setup: everything needed is installed'

as_root=()
if (( EUID != 0 )); then
    as_root=(sudo)
    [[ -t 0 ]] || as_root+=(--non-interactive)
fi
apt() {  # errors go to standard error
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -qq --yes -o Dpkg::Use-Pty=0 "$@" >/dev/null
}
install() {
    apt install --no-install-recommends "${missing[@]}"
}
needed_command() {
    printf "sudo sh -c 'apt-get update && apt-get install --yes --no-install-recommends %s'" "${missing[*]}"
}

command -v apt-get >/dev/null ||
    fail "this is not Debian or Ubuntu: install what these packages hold there: ${missing[*]}"
if (( EUID != 0 )) && ! { command -v sudo >/dev/null && "${as_root[@]}" true; }; then
    fail "root is needed to install what is missing; run: $(needed_command)"
fi

printf 'setup: installing %s\n' "${missing[*]}"
known=true
for package in "${missing[@]}"; do
    known_to_apt "$package" || known=false
done
if ! $known; then
    apt update || fail "apt-get update failed; needed: $(needed_command)"
    find_missing  # the name of the Java package depends on what apt offers
fi
install || { apt update && install; } || fail "could not install; needed: $(needed_command)"

requested=("${missing[@]}")
find_missing
if (( ${#missing[@]} > 0 )); then
    fail "installed ${requested[*]}, but too old or not found: ${missing[*]} (needed: C++20, cmake >= $minimum_cmake, JDK >= $minimum_java, node >= $minimum_node, ${libraries[*]} or later)"
fi
finish 'setup: done'
