#!/usr/bin/env bash
# Installs what is missing, builds, renders a short noisy sequence of the built-in box scene with references on the CPU,
# denoises it on the Vulkan device found (Mesa's CPU device will do), prints the errors and leaves pictures.
#
#     samples/run.sh [FOLDER]    FOLDER: where the results go; default: build/run
#
# Takes a few minutes on two cores; run again, it goes on where it was.
set -euo pipefail
folder=$(realpath --canonicalize-missing "${1:-$(dirname "${BASH_SOURCE[0]}")/../build/run}")
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source .ci/setup.sh

walr_setup
walr_build walr
# References are most of the work, so only the last frames get one, once history has built up: at 192 paths a pixel some
# 15 s each on two idle cores. What noise that leaves in them is part of the errors.
build/bin/walr render samples/scenes/box.gltf --output "$folder/box" --frames 0-9 --size 320x180 --reference-spp 192 \
  --reference-frames 7-9
build/bin/walr denoise "$folder/box" --output "$folder/denoised" --png
echo "Pictures, noisy | denoised | reference: $folder/denoised/comparison_FFFF.png"
