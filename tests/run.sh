#!/usr/bin/env bash
# Installs what is missing, builds everything with warnings as errors, and runs all tests. Needs no GPU.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source .ci/setup.sh

walr_setup
walr_build
ctest --preset ci --parallel "$(nproc)"
