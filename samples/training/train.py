#!/usr/bin/env python3
"""Trains a network that makes guides for FLR, on frames of make_data.py.

    train.py --cache DIR --state FILE --preset small --minutes 120

The state holds weights, optimiser and curve, and is written after every round: the command goes on where an earlier call ended.
Loss: squared error relative to the prediction's own magnitude plus the frame's mean. Its minimum is the mean of the targets, so that
these may be noisy (Lehtinen et al. 2018), and it weighs light much as the tone map x / (1 + x) does, in which the project is judged.
Light is relative to the frame's mean, as the network sees it. In the first tenth of the training, each guide is also drawn to one
channel of the target after the tone map, as a start; no longer, because guides that are best by themselves let noise through, which
the regression amplifies. A penalty keeps guides from the ends of their sigmoid, where nothing moves them any more.

Some crops are made less noisy: part of their light comes from one half of the target's samples, and the other half is then the target.
"""
import argparse
import copy
import json
import math
import pathlib
import random
import sys
import time

import torch

sys.dont_write_bytecode = True
from dataset import each, load, scenes
from network import EXPERIMENTS, PRESETS, SIGMA, GuideNetwork, Means, features, regression

CROP, STEPS = 128, 250
"""Pixels of a crop's side, steps of a round. A crop is wider than the largest window."""
CROPS, RATES = {"cpu": 2, "cuda": 64}, {"cpu": 1e-3, "cuda": 2e-3}
"""Crops of a step: a GPU needs many to have work for all of its processors. Adam's first rate: the more crops, the surer a step."""
EVALUATE = 20
"""Rounds between two judgements by held-out scenes."""
SINGLE = 0.4
"""Share of the steps on light of single frames."""
CLEANER = 0.3
"""Share of the crops that are made less noisy."""
EXPOSURE = 0.7
"""Natural logarithm of the largest factor by which a crop's light is made brighter or darker."""
SIGMAS = {"accumulated": (6.0, 8.0, 10.0), "single": (12.0, 16.0, 20.0)}
"""Windows of the regression to train with, pixels."""
BRIGHT = 4.0
"""Targets beyond so many times prediction plus mean count as that: a path of a noisy target must not outweigh a crop."""
DIRECT, DIRECT_SHARE = 0.5, 0.1
"""Weight of the guides' own squared errors at the start, and the share of the training in which it falls to 0."""
ENDS, LARGEST_LOGIT = 1e-2, 4.0
"""Weight of the squared excess of the sigmoid's inputs over the largest one that is free."""
LAST_RATE = 5e-5
"""Of Adam; from the first to this, it is a half cosine."""
MEMORY = 0.999
"""Share of the weights' average that a step keeps. The average is what is judged and exported."""


def loss_of(prediction, target, surface, mean):
    prediction, target = prediction / mean, target / mean
    own = prediction.detach()
    target = torch.minimum(target, BRIGHT * (own + 1))
    return (((prediction - target) / (own + 1)) ** 2 * surface).sum() / (3 * surface.sum().clamp(min=1))


def direct_loss_of(learned, target, surface, mean):
    """The squared error of the first three guides as channels of the light after the tone map."""
    target = target / mean
    count = 3 * surface.sum().clamp(min=1)
    return (((learned[:, :3] - target / (1 + target)) ** 2) * surface).sum() / count


def error_of(prediction, frame, weight, mean):
    """Squared error after the tone map, without the noise of the target: the two halves of its samples err independently, so
    that the product of the errors against both has the mean of the squared error against the truth. `weight`: the tone map's
    squared slope, from a prediction that does not depend on the target."""
    first, second = frame["half_target"] / mean, (2 * frame["target"] - frame["half_target"]) / mean
    own = prediction / mean
    return float((weight * (own - first) * (own - second)).sum() / weight.gt(0).sum().clamp(min=1))


class Frames:
    """Frames of one kind of light, and the means of each whole frame."""

    def __init__(self, frames):
        self.frames = frames
        means = [Means.of(frame) for frame in each(frames)]
        self.means = Means(torch.cat([m.light for m in means]), torch.cat([m.inverse_depth for m in means]))

    def __len__(self):
        return len(self.frames["light"])

    def __iter__(self):
        """Each frame with its means."""
        for i, frame in enumerate(each(self.frames)):
            yield frame, Means(self.means.light[i:i + 1], self.means.inverse_depth[i:i + 1])

    def crops(self, count):
        """Random crops of random frames, mirrored or not, and the means of their frames."""
        height, width = self.frames["light"].shape[2:]
        device = self.frames["light"].device

        def below(end):
            return torch.randint(end, (count, 1, 1, 1), device=device)

        frame, mirrored, pixel = below(len(self.frames["light"])), below(2), torch.arange(CROP, device=device)
        row = 8 * below((height - CROP) // 8 + 1) + pixel[:, None]
        column = 8 * below((width - CROP) // 8 + 1) + torch.where(mirrored > 0, pixel.flip(0), pixel)
        crops = {name: values[frame, torch.arange(values.shape[1], device=device)[:, None, None], row, column].float()
                 for name, values in self.frames.items()}
        crops["normal"] = crops["normal"] * torch.cat([1.0 - 2 * mirrored, torch.ones_like(mirrored).expand(-1, 2, -1, -1)], 1)
        return crops, Means(self.means.light[frame[:, 0, 0, 0]], self.means.inverse_depth[frame[:, 0, 0, 0]])


def varied(crops):
    """Crops some of which are made less noisy, each brighter or darker, with its channels of light in a random order."""
    count, device = len(crops["light"]), crops["light"].device

    def uniform():
        return torch.rand((count, 1, 1, 1), device=device)

    cleaner = (uniform() < CLEANER).float()
    share = cleaner * uniform() * (crops["samples"] > 0)
    light = (1 - share) * crops["light"] + share * crops["half_target"]
    target = crops["target"] + cleaner * (crops["target"] - crops["half_target"])
    order = torch.rand((count, 3), device=device).argsort(1)[:, :, None, None].expand_as(light)
    factor = torch.exp(EXPOSURE * (2 * uniform() - 1))
    return {**crops, "light": factor * light.gather(1, order), "target": factor * target.gather(1, order)}


def ends_loss_of(learned):
    """The squared excess of the sigmoid's inputs."""
    return ((torch.logit(learned, 1e-6).abs() - LARGEST_LOGIT).clamp(min=0) ** 2).mean()


def filtered(network, frame, means, sigma):
    """The filtered light, and the learned guides or None."""
    learned = network(features(frame, means)) if network else None
    return regression(frame, learned, network.replaces if network else False, sigma), learned


def evaluate(network, frames):
    """Mean squared error over held-out frames and that of FLR, by kind of light."""
    errors = {}
    with torch.no_grad():
        for kind, some in frames.items():
            ours, plain = 0.0, 0.0
            for frame, means in some:
                mean = means.light.clamp(min=1e-30)
                flr, _ = filtered(None, frame, means, SIGMA[kind])
                weight = (frame["inverse_depth"] > 0) / (1 + flr / mean) ** 4
                ours += error_of(filtered(network, frame, means, SIGMA[kind])[0], frame, weight, mean)
                plain += error_of(flr, frame, weight, mean)
            errors[kind] = ours / len(some), plain / len(some)
    return errors


class Training:
    def __init__(self, options, device):
        self.file, self.preset, self.device = options.state, options.preset, device
        self.rng = random.Random(options.seed)
        torch.manual_seed(options.seed)
        self.network = GuideNetwork(**{**PRESETS, **EXPERIMENTS}[options.preset]).to(device)
        self.average = copy.deepcopy(self.network).requires_grad_(False)
        self.optimiser = torch.optim.Adam(self.network.parameters(), RATES[device])
        self.curve, self.steps, self.seconds = [], 0, 0.0
        if self.file.exists():
            state = torch.load(self.file, map_location=device)
            if state["preset"] != options.preset:
                raise SystemExit(f"{self.file}: holds preset {state['preset']}; give another --state for {options.preset}")
            self.network.load_state_dict(state["network"])
            self.average.load_state_dict(state["average"])
            self.optimiser.load_state_dict(state["optimiser"])
            self.curve, self.steps, self.seconds = state["curve"], state["steps"], state["seconds"]
            self.rng = random.Random(options.seed + self.steps)
            torch.manual_seed(options.seed + self.steps)

    def save(self):
        partial = self.file.with_suffix(".partial")
        torch.save({"preset": self.preset, "network": self.network.state_dict(), "average": self.average.state_dict(),
                    "optimiser": self.optimiser.state_dict(), "curve": self.curve, "steps": self.steps, "seconds": self.seconds}, partial)
        partial.rename(self.file)

    def step(self, frames, share):
        """One step at a share of the whole time."""
        for group in self.optimiser.param_groups:
            group["lr"] = LAST_RATE + (RATES[self.device] - LAST_RATE) * 0.5 * (1 + math.cos(math.pi * min(share, 1.0)))
        kind = "single" if self.rng.random() < SINGLE else "accumulated"
        frame, means = frames[kind].crops(CROPS[self.device])
        frame = varied(frame)
        surface = (frame["inverse_depth"] > 0).float()
        mean = means.light.clamp(min=1e-30)
        light, learned = filtered(self.network, frame, means, self.rng.choice(SIGMAS[kind]))
        loss = loss_of(light, frame["target"], surface, mean) + ENDS * ends_loss_of(learned)
        direct = DIRECT * max(0.0, 1 - share / DIRECT_SHARE)
        if direct > 0:
            loss = loss + direct * direct_loss_of(learned, frame["target"], surface, mean)
        self.optimiser.zero_grad()
        loss.backward()
        torch.nn.utils.clip_grad_norm_(self.network.parameters(), 0.3)
        self.optimiser.step()
        self.steps += 1
        memory = min(MEMORY, self.steps / (self.steps + 10))
        with torch.no_grad():
            for mean, now in zip(self.average.parameters(), self.network.parameters()):
                mean.lerp_(now, 1 - memory)
        return loss.detach()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--cache", type=pathlib.Path, required=True, help="folder of make_data.py")
    parser.add_argument("--state", type=pathlib.Path, required=True, help="file that the training is kept in")
    parser.add_argument("--preset", choices=[*PRESETS, *EXPERIMENTS], default="small")
    parser.add_argument("--minutes", type=float, default=120, help="length of the whole training, all calls together (default: %(default)s)")
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    device = "cuda" if torch.cuda.is_available() else "cpu"
    training_files, held_out_files = scenes(options.cache)
    frames, held_out = ({kind: Frames(some) for kind, some in load(files, device).items()} for files in (training_files, held_out_files))
    training = Training(options, device)
    print(f"{len(training_files)} scenes, {len(held_out_files)} held out; "
          f"{sum(p.numel() for p in training.network.parameters())} parameters", flush=True)
    while training.seconds < 60 * options.minutes:
        start = time.monotonic()
        loss = float(sum(training.step(frames, training.seconds / (60 * options.minutes)) for _ in range(STEPS))) / STEPS
        training.seconds += time.monotonic() - start
        errors = evaluate(training.average, held_out) if (training.steps // STEPS) % EVALUATE == 0 else None
        entry = {"steps": training.steps, "seconds": round(training.seconds), "device": device, "loss": round(loss, 5),
                 **({"held_out_mse": {k: [round(e, 7) for e in both] for k, both in errors.items()}} if errors else {})}
        training.curve.append(entry)
        training.save()
        print(json.dumps(entry), flush=True)


if __name__ == "__main__":
    main()
