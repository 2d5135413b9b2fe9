#!/usr/bin/env python3
"""Checks that the regression that a network is trained with is that of the pipeline: PyTorch against `walr denoise --method flr`.

    check_regression.py --walr build/bin/walr SEQUENCE [--frames A-B]

Compares frames filtered by themselves. The program writes halves, of relative precision 2^-11; sums of products in single
precision may add as much again where guides hardly differ. So 99.9 % of the values must agree to 2^-10 of the frame's mean plus
2^-10 of the value.
"""
import argparse
import pathlib
import sys
import tempfile

import numpy as np
import torch

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "images"))
from dataset import frame_of
from make_data import planes, run, seen_frames
from network import SIGMA, regression

TOLERANCE = 2.0 ** -10


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("sequence", type=pathlib.Path, help="folder in walr's own layout")
    parser.add_argument("--walr", default="build/bin/walr")
    parser.add_argument("--frames", default="0-0", help="A-B (default: %(default)s)")
    options = parser.parse_args()
    first, last = map(int, options.frames.split("-"))
    with tempfile.TemporaryDirectory() as folder:
        run(options.walr, "denoise", options.sequence, "--output", folder, "--method", "flr", "--spatial-only", "--frames", options.frames,
            *(word for view in ("light", "guide-normal", "guide-depth") for word in ("--view", view)))
        for number in range(first, last + 1):
            frame = frame_of(dict(seen_frames(options.sequence, pathlib.Path(folder), [number]))["single"])
            with torch.no_grad():
                ours = regression(frame, None, False, SIGMA["single"])[0].permute(1, 2, 0).numpy()
            theirs = planes(pathlib.Path(folder) / f"denoised_{number:04d}.exr", [f"Indirect.{c}" for c in "RGB"])
            surface = frame["inverse_depth"][0, 0].numpy() > 0
            error = np.abs(ours - theirs)[surface] / (theirs[surface].mean() + theirs[surface])
            share = float((error <= TOLERANCE).mean())
            print(f"frame {number}: {100 * share:.3f} % within {TOLERANCE:.2g}, median {np.median(error):.2g}, largest {error.max():.2g}")
            if share < 0.999:
                sys.exit("the regressions differ")


if __name__ == "__main__":
    main()
