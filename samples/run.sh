#!/usr/bin/env bash
# Installs missing packages, builds walr, renders a short noisy sequence of the built-in kitchen with a reference on the
# CPU, denoises it on a Vulkan device (Mesa's CPU device is sufficient), prints the errors and writes images. The frames
# are jittered and move as those of the corpus do (samples/docs/corpus.md).
#
#     samples/run.sh [FOLDER]    FOLDER: where the results go; default: build/run
#
# Takes about six minutes on two cores. An interrupted run can be resumed.
set -euo pipefail
folder=$(realpath --canonicalize-missing "${1:-$(dirname "${BASH_SOURCE[0]}")/../build/run}")
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source .ci/setup.sh

walr_setup
walr_build walr
# The reference takes most of the time, so only the last frame gets one, when history has built up. At 1024 samples per
# pixel, about four minutes on two idle cores, its own noise is less than the error of the result; both are printed.
build/bin/walr render build/samples/scenes/kitchen.gltf --output "$folder/kitchen" --frames 0-9 --size 480x270 --jitter \
  --reference-spp 1024 --reference-frames 9-9 --reference-pixel area
build/bin/walr denoise "$folder/kitchen" --output "$folder/denoised" --composite --direct-light reference --png
echo "Noisy | denoised | reference; the lit images, and below them the light alone: $folder/denoised/comparison_0009.png"
echo "Denoised: the lit image, and beside it the light alone: $folder/denoised/denoised_0009.png"
