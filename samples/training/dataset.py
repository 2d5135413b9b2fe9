"""Frames to train on, as `make_data.py` leaves them.

A frame is a dictionary of tensors of 1 x channels x height x width: `normal` (view space), `inverse_depth` (0: no surface),
`occlusion`, `light`, `samples` in the light (0: none), `target`, and `half_target`, the mean of one half of the target's samples.
Several frames of one size are such a dictionary, too: their tensors have a row for each.
"""
import pathlib

import torch

HELD_OUT = 20
"""One scene in so many is not trained on, but judges the training."""


def frame_of(images):
    """A frame of tensors from arrays of height x width x channels."""
    return {name: torch.from_numpy(images[name].astype("float32")).permute(2, 0, 1)[None] for name in images}


def scenes(cache):
    """Files of training scenes and of held-out ones."""
    files = sorted(pathlib.Path(cache).glob("*/frames.pt"))
    if not files:
        raise SystemExit(f"{cache}: no frames.pt in any folder; run make_data.py first")
    held_out = [f for f in files if int(f.parent.name) % HELD_OUT == HELD_OUT - 1]
    return [f for f in files if f not in held_out], held_out


def load(files, device="cpu"):
    """All frames of the files by the kind of their light: "accumulated" or "single". Most tensors hold halves."""
    frames = {"accumulated": [], "single": []}
    for file in files:
        for kind, frame in torch.load(file):
            frames[kind].append(frame)
    return {kind: {name: torch.cat([frame.pop(name) for frame in some]).to(device) for name in list(some[0])}
            for kind, some in frames.items()}


def each(frames):
    """The frames one by one, in single precision."""
    for i in range(len(frames["light"])):
        yield {name: values[i:i + 1].float() for name, values in frames.items()}
