#!/usr/bin/env bash
# Installs what is missing, builds everything, and runs all tests. Needs no GPU.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source .ci/setup.sh
source .ci/ray_query_driver.sh

walr_setup
walr_ray_query_driver
walr_build
# One test more than there are cores: some wait for a screen or a device.
ctest --preset "$walr_preset" --parallel "$(($(nproc) + 1))"
