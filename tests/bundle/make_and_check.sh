#!/usr/bin/env bash
# Makes the archive of the bundle from a build folder, and checks it.
#
#     make_and_check.sh CPACK BUILD PROGRAM STAGING [--release]
set -euo pipefail
cpack=$1 build=$2 program=$3 staging=$4
rm -rf "$staging"
mkdir -p "$staging"
"$cpack" -G TGZ --config "$build/CPackConfig.cmake" -B "$staging/packed"
archive=$(ls "$staging"/packed/walr-*-linux-*.tar.gz)
"$(dirname "${BASH_SOURCE[0]}")/check_bundle.sh" "$archive" "$program" "$staging/unpacked" "${@:5}"
