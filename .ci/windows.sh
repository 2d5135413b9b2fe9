#!/usr/bin/env bash
# Installs what the tests of walr on Windows need (tests/windows): MinGW, Wine, and LLVM's tools for Visual Studio's ABI. Without
# these packages, the tests are skipped.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source .ci/setup.sh

walr_packages=("${walr_windows_packages[@]}")
walr_setup
