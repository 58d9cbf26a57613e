#!/usr/bin/env bash
# Whether WebAssembly gives the bits of the native portable kernels: short runs of each scheme by node, and what the page's
# simulator streams. Needs build/release and build/wasm.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
tests/same_bits.sh portable portable node build/wasm/bin/natator-sim.js
node tests/wasm/same_frames.mjs build/release/bin/natator-sim build/wasm/bin
