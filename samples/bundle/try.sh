#!/bin/sh
# Denoises the sample sequence, compares two methods on it, and plays a scene in the sample host without a window.
#
#     try.sh [FOLDER]    FOLDER: where the results go; default: ./results
set -eu
bundle=$(dirname "$(readlink -f "$0")")
results=${1:-results}

"$bundle/bin/walr" denoise "$bundle/samples/box" --output "$results/denoised" --composite --direct-light reference --png
echo "Noisy | denoised | reference: $results/denoised/comparison_0005.png"
"$bundle/bin/walr" bench --sequences "$bundle/samples/box" --output "$results/bench" --methods walr,svgf
echo "Errors, times and memory: $results/bench/bench.csv"
"$bundle/bin/walr-host" "$bundle/samples/scenes/box.gltf" --headless --output "$results/host" --frames 0-3 \
  --size 256x144
echo "Traced, denoised and tone-mapped: $results/host/frame_0003.png"
