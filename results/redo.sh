#!/usr/bin/env bash
# Makes the tables and pictures of a page again from its data: results/redo.sh PAGE [--check | --run]. Without a page it tells which there are.
set -euo pipefail
results=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
python=${NATATOR_PYTHON:-$results/../.readers/bin/python}
if [[ $# == 0 || ! -f $results/$1/make.py ]]; then
    pages=$(cd "$results" && echo */make.py)
    echo "usage: results/redo.sh PAGE [--check | --run]; pages: ${pages//\/make.py/}" >&2
    exit 2
fi
if [[ ! -x $python ]]; then
    echo "results/redo.sh: needs the packages of tests/readers/requirements.txt; install them by: ./setup.sh --readers" >&2
    exit 1
fi
PYTHONDONTWRITEBYTECODE=1 PYTHONPATH=$results:$results/../sim-native/python exec "$python" "$results/$1/make.py" "${@:2}"
