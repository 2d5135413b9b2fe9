#!/usr/bin/env python3
"""Renders random scenes to train on: short noisy sequences with targets, and what a network in the pipeline sees of them.

    make_data.py --walr build/bin/walr --cache DIR [--scenes N] [--first SEED]

Everything lies in DIR, outside the repository, one folder a seed. What is there is kept: an interrupted run goes on. Needs
Debian's python3-torch. The last step of each scene is the pipeline's own: `walr denoise --method flr` with views of the light that
the regression fits and of its guides, so that no stage before the network is written twice.
"""
import argparse
import pathlib
import shutil
import subprocess
import sys

import numpy as np
import torch

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "images"))
import exr
from random_scenes import random_scene
from scene_builder import FRAMES

TARGETS = 3, FRAMES - 1
"""Frames with a target: one with a short history, and one with the longest that `flr` keeps."""
RENDERING = ["--size", "320x180", "--frames", f"0-{FRAMES - 1}", "--reference-spp", "24"]


def run(walr, *arguments):
    result = subprocess.run([walr, *map(str, arguments)], capture_output=True, text=True, check=False)
    if result.returncode:
        sys.exit(f"{walr} {arguments[0]} failed: {result.stderr.strip()}")


def render(walr, folder, seed, threads):
    folder.mkdir(parents=True, exist_ok=True)
    scene = folder / "scene.gltf"
    text = random_scene(seed)
    if not scene.exists() or scene.read_text(encoding="utf-8") != text:
        scene.write_text(text, encoding="utf-8")
    for target in TARGETS:
        run(walr, "render", scene, "--output", folder / "frames", "--seed", seed, "--threads", threads, *RENDERING,
            "--reference-frames", f"{target}-{target}")


def planes(file, names):
    images = exr.read(file)
    return np.stack([images[name] for name in names], 2)


def seen_frames(folder, seen, numbers):
    """Frames with accumulated light and the same with the light of one frame, as dataset.py lists their parts."""
    for i in numbers:
        depth = planes(seen / f"view_guide-depth_{i:04d}.exr", "XYZ")
        surface = depth[:, :, :1] > 0
        noisy = planes(folder / f"noisy_{i:04d}.exr", [f"Indirect.{c}" for c in "RGB"])
        target = folder / f"ref_{i:04d}.exr"
        shared = {"normal": planes(seen / f"view_guide-normal_{i:04d}.exr", "XYZ"), "inverse_depth": depth[:, :, :1],
                  "occlusion": depth[:, :, 1:2],
                  **({"target": planes(target, [f"Indirect.{c}" for c in "RGB"]),
                      "half_target": planes(target, [f"IndirectA.{c}" for c in "RGB"])} if target.exists() else {})}
        light = planes(seen / f"view_light_{i:04d}.exr", "XYZ")
        yield "accumulated", {**shared, "light": light, "samples": depth[:, :, 2:]}
        yield "single", {**shared, "light": np.maximum(noisy, 0) * surface, "samples": surface.astype(np.float32)}


def tensors(frame):
    """Halves, but for inverse depth, of which differences count."""
    return {name: torch.from_numpy(np.ascontiguousarray(values.transpose(2, 0, 1)))[None].to(
        torch.float32 if name == "inverse_depth" else torch.float16) for name, values in frame.items()}


def dump(walr, folder):
    """Writes frames.pt: what the network sees of the frames with a target, and the targets."""
    result = folder / "frames.pt"
    if result.exists():
        return
    seen = folder / "seen"
    run(walr, "denoise", folder / "frames", "--output", seen, "--method", "flr",
        *(word for view in ("light", "guide-normal", "guide-depth") for word in ("--view", view)))
    frames = [(kind, tensors(frame)) for kind, frame in seen_frames(folder / "frames", seen, TARGETS)]
    partial = result.with_suffix(".partial")
    torch.save(frames, partial)
    partial.rename(result)
    shutil.rmtree(seen)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--walr", default="build/bin/walr", help="the program (default: %(default)s)")
    parser.add_argument("--cache", type=pathlib.Path, required=True, help="folder for the data, outside the repository")
    parser.add_argument("--scenes", type=int, default=430, help="number of scenes (default: %(default)s)")
    parser.add_argument("--first", type=int, default=0, help="seed of the first scene (default: %(default)s)")
    parser.add_argument("--threads", type=int, default=0, help="threads of the renderer; 0: one per core (default)")
    options = parser.parse_args()
    for seed in range(options.first, options.first + options.scenes):
        folder = options.cache / f"{seed:05d}"
        render(options.walr, folder, seed, options.threads)
        dump(options.walr, folder)
        print(f"{seed - options.first + 1} of {options.scenes} scenes", flush=True)


if __name__ == "__main__":
    main()
