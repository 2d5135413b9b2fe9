"""The results of a benchmark for report.py: bench.json and the images next to it."""
import json
import math
import pathlib

import numpy as np

# Okabe and Ito's palette, which colour-blind readers can distinguish. The baseline is black.
COLOURS = {"walr": "#000000", "walr_paper": "#666666", "bmfr": "#0072B2", "svgf": "#D55E00", "flr": "#009E73", "flnr": "#56B4E9",
           "joint_bilateral": "#CC79A7", "accumulate": "#E69F00", "none": "#999999"}
SPARE_COLOURS = ["#8C6D31", "#7F3C8D", "#B2182B", "#4D9221"]
ERRORS = [("rmse", "RMSE"), ("flip", "FLIP"), ("ssim", "1 - SSIM"), ("flicker", "flicker")]
TABLE = [("rmse", "RMSE", 4), ("psnr", "PSNR", 2), ("ssim", "SSIM", 4), ("flip", "FLIP", 4),
         ("relative_mse", "relMSE", 4), ("flicker", "flicker", 5)]


class Bench:
    """A benchmark's results, indexed by name."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        self.json = json.loads((self.folder / "bench.json").read_text())
        self.variants = {v["name"]: v for v in self.json["variants"]}
        self.sequences = {s["name"]: s for s in self.json["sequences"]}
        self.runs = {(s["name"], r["variant"]): r for s in self.json["sequences"] for r in s["runs"]}
        self.methods = list(self.variants)
        # Methods without a spatial filter have so large errors that they would stretch every scale.
        self.filters = [n for n in self.methods if self.variants[n]["method"] not in ("none", "accumulate")]
        self.baseline = self.json["baseline"]
        # Times of a CPU device are shown as ratios only.
        self.absolute = not self.json["device"]["software"]
        self.better = {m["name"]: m["better"] for m in self.json["metrics"]}

    def mean(self, sequence, variant, metric):
        """Mean after the warm-up; over all sequences if `sequence` is None."""
        if sequence is None:
            values = [self.mean(s, variant, metric) for s in self.sequences]
            return None if None in values else sum(values) / len(values)
        return self.runs[sequence, variant]["mean_after_4"][metric]

    def error(self, sequence, variant, metric):
        value = self.mean(sequence, variant, metric)
        return 1 - value if metric == "ssim" and value is not None else value

    def ratio(self, sequence, variant):
        """Median, 5 % and 95 % quantile of the time ratio to the baseline; geometric means if `sequence` is None."""
        if sequence is None:
            all_ratios = [self.ratio(s, variant) for s in self.sequences]
            if None in all_ratios:
                return None
            return tuple(math.exp(sum(math.log(r[i]) for r in all_ratios) / len(all_ratios)) for i in range(3))
        ratio = self.runs[sequence, variant]["ratio"]
        return ratio and (ratio["median"], ratio["p5"], ratio["p95"])

    def milliseconds(self, sequence, variant):
        time = self.runs[sequence, variant]["milliseconds"]
        return time and time["median"]

    def cost_at(self, variant, width, height):
        """The plan's costs at a size; None if they are not known."""
        return next((c for c in self.variants[variant]["costs"] if (c["width"], c["height"]) == (width, height)), None)

    def cost(self, sequence, variant):
        """The plan's costs at the size of the sequence, or of the first sequence if `sequence` is None."""
        s = self.sequences[sequence] if sequence else next(iter(self.sequences.values()))
        return self.cost_at(variant, s["width"], s["height"])

    def estimate(self, variant):
        """Estimated GPU time in us at 1920 x 1080, which is no measurement; None if there is none."""
        cost = self.cost_at(variant, 1920, 1080)
        return cost and cost["estimated_microseconds"]

    def bytes_per_pixel(self, sequence, variant):
        cost = self.cost(sequence, variant)
        return cost["bytes_read_per_pixel"] + cost["bytes_written_per_pixel"]

    def floor(self, sequence):
        """Noise of the reference as an RMSE, mean over frames that have one; None if it is not known."""
        if sequence is None:
            floors = [self.floor(s) for s in self.sequences]
            return None if None in floors else sum(floors) / len(floors)
        values = [f["reference_noise"] for f in self.sequences[sequence]["frames"] if f["reference_noise"] is not None]
        return sum(values) / len(values) if values else None

    def floor_by_roughness(self, sequence):
        """The same in each class of roughness; None in a class that is not known in every frame."""
        frames = [f.get("reference_noise_by_roughness", [None] * 6) for f in self.sequences[sequence]["frames"]]
        judged = [f for f in frames if any(v is not None for v in f)]
        return [None if None in values else sum(values) / len(values) for values in zip(*judged)] or [None] * 6

    def picture(self, sequence, name, frame):
        path = self.folder / "pictures" / sequence / f"{name}_{frame:04d}.npy"
        return np.load(path).astype(np.float32)

    def change(self, sequence, name, frame):
        """Change of a variant's error along motion; None if the previous frame has no reference."""
        path = self.folder / "pictures" / sequence / f"{name}.change_{frame:04d}.npy"
        return np.load(path).astype(np.float32) if path.exists() else None

    def colour(self, variant):
        v = self.variants[variant]
        if v["name"] != v["method"] and not v["preset"]:
            own = [n for n in self.methods if self.variants[n]["name"] != self.variants[n]["method"]
                   and not self.variants[n]["preset"]]
            if variant in own:
                return SPARE_COLOURS[own.index(variant) % len(SPARE_COLOURS)]
        return COLOURS.get(v["method"], SPARE_COLOURS[sum(v["method"].encode()) % len(SPARE_COLOURS)])

    def dash(self, variant):
        return "--" if self.variants[variant]["preset"] else "-"


def pareto(points):
    """Names of the points that are not dominated by another one; smaller coordinates are better."""
    return [name for name, (x, y) in points.items()
            if not any(a <= x and b <= y and (a, b) != (x, y) for a, b in points.values())]


def number(value, decimals):
    return "-" if value is None else f"{value:.{decimals}f}"
