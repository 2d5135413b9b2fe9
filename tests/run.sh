#!/usr/bin/env bash
# Installs what is missing, builds everything, and runs the tests that matter to users. Needs no GPU. .ci/run runs all tests.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source .ci/setup.sh

walr_setup
walr_build
# One test more than there are cores: some wait for a screen or a device.
ctest --preset "$walr_preset" --parallel "$(($(nproc) + 1))"
