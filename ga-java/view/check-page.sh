#!/usr/bin/env bash
# Checks the page's scripts: types, linter, unit tests. Where what that needs is not installed, it says so and passes; in
# continuous integration (CI is set) it fails then.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
if ! command -v npm >/dev/null || [[ ! node_modules/.package-lock.json -nt package-lock.json ]]; then
    echo 'check-page.sh: page not checked: npm, or what package-lock.json names, is missing; ./setup.sh --browser installs it' >&2
    [[ -z ${CI:-} ]] || exit 1
    exit 0
fi
npm --silent test
