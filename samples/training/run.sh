#!/bin/sh
# From nothing to the weights of flnr: samples/training/run.sh DIR [MINUTES]. An interrupted run goes on.
# DIR receives scenes, frames and the state of the training; MINUTES of training: 180.
set -eu
data=${1:?usage: samples/training/run.sh DIR [MINUTES]}
project=$(cd "$(dirname "$0")/../.." && pwd)
scripts=$project/samples/training
walr=$project/build/bin/walr
[ -x "$walr" ] || { echo "$walr does not exist: build it first (samples/run.sh does)" >&2; exit 1; }
python=/usr/bin/python3
$python -c "import torch" || { echo "install python3-torch" >&2; exit 1; }
$python "$scripts/make_data.py" --walr "$walr" --cache "$data/scenes"
$python "$scripts/check_regression.py" --walr "$walr" "$data/scenes/00000/frames"
$python "$scripts/train.py" --cache "$data/scenes" --state "$data/small.pt" --minutes "${2:-180}"
$python "$scripts/export_weights.py" --state "$data/small.pt" --cache "$data/scenes" \
  --output "$project/passes/weights/flnr_small.f16" --fixture "$project/tests/passes/fixtures/flnr_small.txt"
