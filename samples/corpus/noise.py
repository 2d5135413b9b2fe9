#!/usr/bin/python3
"""How well the noise of accumulated light is known: estimate and truth where camera and scene stand still.

    noise.py --output DIR [--scene FILE] [--size WxH] [--sampler NAME]    renders, denoises, prints a table

Frames of one moment with 1 to 64 rays per pixel are accumulated. A reference tells the error, by quantiles of luminance. The
estimate is that by which walr chooses the share of accumulated light (passes/LEARNT.md). It takes this frame's light y,
the mean m of N frames and the prediction p of the fits. With the history h = (N m - y) / (N - 1), the square of m's noise is the
mean of (m - p)^2 - (y - p)(h - p) over pixels around and over frames, relative to their light. It takes the variance to be in
proportion to the light of a pixel. In the first 40 frames it is too high by up to an eighth: N counts no further than the longest
history, while the noise still falls. Needs numpy and Pillow (Debian: python3-matplotlib)."""
import argparse
import pathlib
import sys

sys.dont_write_bytecode = True
import entries as table
import judging
import numpy as np
from judging import exr

SAMPLES = (1, 4, 16, 64)
LAST = 39
FRAMES = {16: 16, 64: 10}
"""Frames where they are fewer than MOST_FRAMES, because their rays cost so much."""
MOST_FRAMES = 40
MOMENT = "1000000"
"""Frames per second: at so many, all frames show the first moment of the animation."""
REFERENCE_SAMPLES = 768
QUANTILES = 5
TILE, RADIUS, KEPT = 5, 5, 7 / 8
"""Pixels per axis of a tile, the window's radius in tiles, and what a frame keeps of the sums of earlier ones. The tiles of walr
have so many pixels at 215 to 257 lines."""
MAX_HISTORY = 8


def tile_means(image):
    rows, columns = (n // TILE for n in image.shape)
    return image[:rows * TILE, :columns * TILE].reshape(rows, TILE, columns, TILE).mean(axis=(1, 3))


def spread(tiles, shape):
    """Every pixel gets the value of its tile, those beyond the last tile that of the last."""
    rows, columns = (np.minimum(np.arange(n) // TILE, limit - 1) for n, limit in zip(shape, tiles.shape))
    return tiles[rows[:, None], columns[None, :]]


def window_sums(tiles):
    """Sums over the window around each tile, with weights that fall to its border."""
    weights = 1 - np.abs(np.arange(-RADIUS, RADIUS + 1)) / (RADIUS + 1)
    padded = np.pad(tiles, RADIUS)
    rows = sum(w * padded[i:i + tiles.shape[0]] for i, w in enumerate(weights))
    return sum(w * rows[:, i:i + tiles.shape[1]] for i, w in enumerate(weights))


class Estimate:
    """Estimates the standard error of accumulated luminance, from frames one by one."""

    def __init__(self):
        self.sums = self.pixels = 0.0

    def add(self, noisy, mean, predicted, length, counted):
        """Images of luminance; length: N. Pixels that are not counted have no surface. Returns an image, NaN where nothing is known."""
        usable = counted & (length >= 1.5)
        history = (length * mean - noisy) / np.maximum(length - 1, 0.5)
        square = length * ((mean - predicted) ** 2 - (noisy - predicted) * (history - predicted))
        share = tile_means(usable.astype(float))
        light = tile_means(np.where(usable, predicted, 0.0)) / np.maximum(share, 1e-12)
        relative = np.where(light > 0, tile_means(np.where(usable, square, 0.0)) / np.maximum(light, 1e-12), 0.0)
        self.sums = KEPT * self.sums + window_sums(relative)
        self.pixels = KEPT * self.pixels + window_sums(share)
        known = self.pixels > 0
        variance = np.where(known, np.maximum(self.sums, 0.0) / np.where(known, self.pixels, 1.0), np.nan)
        return np.sqrt(np.maximum(predicted, 0.0) * spread(variance, mean.shape) / np.maximum(length, 1))


def by_quantile(luminance, estimate, squared_error, counted):
    """Rows (largest luminance, estimated and measured standard error) for equal numbers of pixels. squared_error: without the
    reference's noise."""
    limits = np.quantile(luminance[counted], np.arange(1, QUANTILES + 1) / QUANTILES)
    classes = np.searchsorted(limits[:-1], luminance)
    rows = []
    for index, limit in enumerate(limits):
        chosen = counted & (classes == index) & np.isfinite(estimate)
        rows.append((limit, np.sqrt((estimate[chosen] ** 2).mean()), np.sqrt(max(squared_error[chosen].mean(), 0.0))))
    return rows


def light_of(file):
    return judging.luminance(exr.layer(exr.read(file), "Indirect"))


def frames_of(samples):
    return range(LAST + 1 - FRAMES.get(samples, MOST_FRAMES), LAST + 1)


def rendered(walr, arguments, samples):
    """The folder of a sequence. References are those of the first one."""
    folder, first = (arguments.output / f"{n}_rays" for n in (samples, SAMPLES[0]))
    frames = frames_of(samples)
    reference = ["--reference-spp", str(REFERENCE_SAMPLES), "--reference-frames", f"{LAST}-{LAST}"] if folder == first else []
    table.run_walr(walr, "render", arguments.scene, "--output", folder, "--fps", MOMENT, "--size", arguments.size,
                   "--spp", samples, "--sampler", arguments.sampler, "--frames", f"{frames[0]}-{frames[-1]}", *reference)
    return folder, first / f"ref_{LAST:04d}.exr"


def denoised(walr, folder, method):
    """Accumulated light alone, or the prediction of the fits: without accumulated light and anti-aliasing."""
    output = folder / method
    fits = ["--set", "antialiasing.enabled=off", "--set", "blocks.residual=off"] if method == "walr" else []
    table.run_walr(walr, "denoise", folder, "--output", output, "--method", method, "--set",
                   f"accumulation.max-history={MAX_HISTORY}", *fits)
    return output


def rows_of(walr, folder, reference):
    """Rows of by_quantile for the last frame of a sequence."""
    means, predictions = denoised(walr, folder, "accumulate"), denoised(walr, folder, "walr")
    estimate = Estimate()
    for age, file in enumerate(sorted(folder.glob("noisy_*.exr")), 1):
        images, frame = exr.read(file), file.stem[-4:]
        counted = (exr.layer(images, "Normal", "XYZ") != 0).any(axis=2) & (images["Depth.Z"] < judging.SKY_DEPTH)
        mean = light_of(means / f"denoised_{frame}.exr")
        length = np.full(mean.shape, float(min(age, MAX_HISTORY)))
        known = estimate.add(judging.luminance(exr.layer(images, "Indirect")), mean, light_of(predictions / f"denoised_{frame}.exr"), length,
                             counted)
    light = exr.read(reference)
    truth, half = (judging.luminance(exr.layer(light, name)) for name in ("Indirect", "IndirectA"))
    return by_quantile(truth, known, (mean - truth) ** 2 - (half - truth) ** 2, counted)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--output", type=pathlib.Path, required=True, help="folder for frames and results")
    parser.add_argument("--scene", default=table.SHARED / "scenes" / "cornell_fence.glb")
    parser.add_argument("--size", default="384x216", help="default: %(default)s")
    parser.add_argument("--sampler", default="blue-noise", help="of walr render; default: %(default)s")
    parser.add_argument("--walr", type=pathlib.Path, default=table.BUILD / "bin" / "walr", help="the program")
    arguments = parser.parse_args()
    print("rays  luminance up to  estimated  measured  ratio")
    for samples in SAMPLES:
        for limit, estimated, measured in rows_of(arguments.walr, *rendered(arguments.walr, arguments, samples)):
            ratio = f"{estimated / measured:5.2f}" if measured > 0 else "-"
            print(f"{samples:4}  {limit:15.4f}  {estimated:9.5f}  {measured:8.5f}  {ratio}", flush=True)


if __name__ == "__main__":
    main()
