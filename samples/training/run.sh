#!/bin/sh
# From nothing to the weights of flnr: samples/training/run.sh DIR [MINUTES]. An interrupted run goes on.
# DIR receives scenes, frames and the state of the training; MINUTES of training of all networks, at once: 240.
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
export OMP_NUM_THREADS=1
train() { $python "$scripts/train.py" --cache "$data/scenes" --state "$data/$1.pt" --preset "$1" --minutes "$2"; }
networks="small full paper"
running=
for preset in $networks; do
  train "$preset" "${2:-240}" &
  running="$running $!"
done
for process in $running; do wait "$process"; done
for preset in $networks; do
  $python "$scripts/export_weights.py" --state "$data/$preset.pt" --cache "$data/scenes" --project "$project"
done
