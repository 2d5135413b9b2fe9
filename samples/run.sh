#!/usr/bin/env bash
# Installs what is missing, builds, renders a short noisy sequence of the built-in box scene with a reference on the
# CPU, denoises it on the Vulkan device found (Mesa's CPU device will do), prints the errors and leaves pictures.
#
#     samples/run.sh [FOLDER]    FOLDER: where the results go; default: build/run
#
# Takes some six minutes on two cores; run again, it goes on where it was.
set -euo pipefail
folder=$(realpath --canonicalize-missing "${1:-$(dirname "${BASH_SOURCE[0]}")/../build/run}")
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source .ci/setup.sh

walr_setup
walr_build walr
# The reference is nearly all of the work, so only the last frame gets one, once history has built up. At 4096 samples
# per pixel, some five minutes on two idle cores, its own noise is less than the result's error; both are printed.
build/bin/walr render samples/scenes/box.gltf --output "$folder/box" --frames 0-9 --size 320x180 --reference-spp 4096 \
  --reference-frames 9-9
build/bin/walr denoise "$folder/box" --output "$folder/denoised" --composite --direct-light reference --png
echo "Noisy | denoised | reference, lit and below the light alone: $folder/denoised/comparison_0009.png"
echo "Denoised, lit and beside it the light alone: $folder/denoised/denoised_0009.png"
