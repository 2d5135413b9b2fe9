#!/usr/bin/env python3
"""Writes the weights of a trained network as the shaders read them, and a record of the training beside them.

    export_weights.py --state FILE --cache DIR --project .

It writes three files of the project: the weights, passes/network/weights/flnr_PRESET.f16; their record, flnr_PRESET.json beside them, with
the points of the training's curve at which held-out scenes were judged, and the last; and the network's columns of
tests/passes/fixtures/flnr.txt. That is a small frame and the guides that PyTorch makes of it with the weights of each preset, for the
tests of the shaders.
"""
import argparse
import itertools
import json
import math
import pathlib
import random
import subprocess
import sys

import torch
from torch.nn import functional as F

sys.dont_write_bytecode = True
from dataset import scenes
from network import PRESETS, GuideNetwork, Means, features


def convolution(layer):
    """convolution.comp: of every eight results, for every four inputs and each tap, for each input the first and last four results;
    then the biases."""
    outputs, inputs = layer.weight.shape[:2]
    weights = layer.weight.reshape(outputs // 8, 2, 4, inputs // 4, 4, 9)
    return torch.cat([weights.permute(0, 3, 5, 4, 1, 2).reshape(-1), layer.bias])


def heads(network):
    """flnr_head.comp: for each input, for each group of four, its results; then the biases. One layer where a group is a guide of four
    pixels; a layer for each group of four guides of a pixel, and zeros fill up the last group."""
    weight, bias = network.head.weight[:, :, 0, 0], network.head.bias
    if network.shrink == 2:
        return [weight.t().reshape(-1), bias]
    missing = -len(bias) % 4
    weight, bias = F.pad(weight, (0, 0, 0, missing)), F.pad(bias, (0, missing))
    return [torch.cat([weight[i:i + 4].t().reshape(-1), bias[i:i + 4]]) for i in range(0, len(bias), 4)]


def halves(network):
    """All weights in the order of the layers."""
    blocks = [*network.encoder, *network.decoder]
    parts = [convolution(layer) for block in blocks for layer in block.layers] + heads(network)
    return torch.cat(parts).detach().to(torch.float16).numpy()


def commit():
    return subprocess.run(["git", "-C", pathlib.Path(__file__).parent, "rev-parse", "HEAD"], capture_output=True, text=True,
                          check=True).stdout.strip()


def decoded(steps):
    """The normal of two 12-bit steps of the octahedral map (surface.glsl)."""
    x, y = (2 * s / 4095 - 1 for s in steps)
    z = 1 - abs(x) - abs(y)
    fold = max(-z, 0.0)
    x, y = x - math.copysign(fold, x), y - math.copysign(fold, y)
    length = math.sqrt(x * x + y * y + z * z)
    return x / length, y / length, z / length


def frame_and_guides(network, preset, width=21, height=17):
    """A row of texts for each pixel of a frame: the steps of its normal, depth (0: no surface), occlusion in steps, light, samples. Another
    of the learned guides. All inputs are exact in the formats of the pipeline."""
    rng = random.Random(5)
    rows, frame = [], {name: torch.zeros(1, count, height, width) for name, count in
                       (("normal", 3), ("inverse_depth", 1), ("occlusion", 1), ("light", 3), ("samples", 1))}
    for y in range(height):
        for x in range(width):
            steps = rng.randrange(900, 3200), rng.randrange(900, 3200)
            depth = 0.0 if rng.random() < 0.05 else round(256 * (2 + 0.1 * x + rng.random())) / 256
            occlusion, samples = rng.randrange(256), rng.randrange(9)
            light = [float(torch.tensor(math.exp(rng.gauss(-1, 1.5))).half()) for _ in range(3)]
            if depth > 0:
                frame["normal"][0, :, y, x] = torch.tensor(decoded(steps))
                frame["inverse_depth"][0, 0, y, x] = 1 / depth
                frame["occlusion"][0, 0, y, x] = occlusion / 255
                if samples:
                    frame["light"][0, :, y, x] = torch.tensor(light)
                    frame["samples"][0, 0, y, x] = samples
            rows.append([*steps, depth, occlusion, *light, samples])
    rounded = GuideNetwork(**PRESETS[preset])
    rounded.load_state_dict({name: values.half().float() for name, values in network.state_dict().items()})
    with torch.no_grad():
        learned = rounded(features(frame, Means.of(frame)))[0].permute(1, 2, 0).reshape(width * height, -1).tolist()
    return [[f"{v:.9g}" for v in row] for row in rows], [[f"{v:.9g}" for v in guides] for guides in learned]


def write_fixture(file, preset, frame, learned):
    """The file has a line with width and height; then for each pixel the frame and the learned guides of all presets in the order of
    PRESETS. If the frame has changed, export every preset."""
    begin = len(frame[0]) + sum(PRESETS[name]["guides"] for name in itertools.takewhile(lambda name: name != preset, PRESETS))
    size, *rows = [line.split() for line in file.read_text(encoding="utf-8").splitlines()]
    for row, inputs, guides in zip(rows, frame, learned, strict=True):
        row[:len(inputs)] = inputs
        row[begin:begin + len(guides)] = guides
    file.write_text("".join(" ".join(row) + "\n" for row in [size, *rows]), encoding="utf-8")


def seeds(files):
    return [int(file.parent.name) for file in files]


def milestones(curve):
    """The points at which held-out scenes were judged, and the last."""
    return [point for point in curve if "held_out_mse" in point or point is curve[-1]]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--state", type=pathlib.Path, required=True, help="file of train.py")
    parser.add_argument("--cache", type=pathlib.Path, required=True, help="folder of make_data.py")
    parser.add_argument("--project", type=pathlib.Path, required=True, help="folder that receives the files")
    options = parser.parse_args()
    state = torch.load(options.state, map_location="cpu")
    preset = state["preset"]
    if preset not in PRESETS:
        sys.exit(f"{options.state}: holds the experiment {preset}, which no shader computes; train one of {', '.join(PRESETS)}")
    network = GuideNetwork(**PRESETS[preset])
    network.load_state_dict(state["average"])
    output = options.project / f"passes/network/weights/flnr_{preset}.f16"
    halves(network).tofile(output)
    write_fixture(options.project / "tests/passes/fixtures/flnr.txt", preset, *frame_and_guides(network, preset))
    trained, held_out = scenes(options.cache)
    record = {"preset": preset, "commit": commit(), "steps": state["steps"], "seconds": round(state["seconds"]),
              "training_seeds": seeds(trained), "held_out_seeds": seeds(held_out), "curve": milestones(state["curve"])}
    lines = ",\n".join(f" {json.dumps(key)}: " + ("[\n  " + ",\n  ".join(map(json.dumps, value)) + "\n ]" if key == "curve" else
                                                  json.dumps(value)) for key, value in record.items())
    output.with_suffix(".json").write_text("{\n" + lines + "\n}\n", encoding="utf-8")


if __name__ == "__main__":
    main()
