#!/usr/bin/env bash
# Makes the wheel of a built program, installs it as its users do into a folder of its own, and runs the client's tests:
# run.sh PYTHON SIMULATOR FOLDER [TESTS [PATTERN [PYTHON that runs them]]]
set -euo pipefail
readonly python=$1 simulator=$2 folder=$3 tests=${4:-python} pattern=${5:-*_test.py}
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)

if [[ ! -x $python ]]; then
    echo "the packages that the Python client is tested with are missing; install them by: ./setup.sh --readers" >&2
    exit 1
fi
rm -rf "$folder"
build=$(dirname "$(dirname "$simulator")")
"$python" -m pip --quiet --disable-pip-version-check wheel --no-index --no-deps --no-build-isolation \
    --config-settings "cmake.define.NATATOR_BUILT=$build" --wheel-dir "$folder/wheel" "$root"
NATATOR_WHEEL=$(echo "$folder"/wheel/natator-*.whl)
"$python" -m pip --quiet --disable-pip-version-check install --no-index --no-deps --target "$folder/installed" "$NATATOR_WHEEL"
export NATATOR_WHEEL PYTHONPATH=$folder/installed PYTHONDONTWRITEBYTECODE=1 NATATOR_SIM=$simulator TQDM_DISABLE=1
exec "${6:-$python}" -W error -m unittest discover --start-directory "$root/tests/$tests" --pattern "$pattern"
