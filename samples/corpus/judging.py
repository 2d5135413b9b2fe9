"""Errors of every method on one sequence, as sums over squares of the image, from what `walr bench --all-pictures` writes."""
import dataclasses
import pathlib
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "images"))
import exr

SQUARE = 64
"""Side of the blocks in pixels: that of the squares in which `walr render` renders references."""
LEAST_ALBEDO = 0.01
SKY_DEPTH = 1e9
LEAST_COSINE = np.cos(np.radians(30))
"""Normals that differ by more are an edge, as they are a disocclusion for the metric of flicker."""
LARGEST_BEND = 0.03
"""A second difference of inverse depth, as a share of it, that is an edge. Inverse depth is linear in the image on a plane."""
SSIM_BORDER = 5
"""Pixels this near to the border of the image have no whole window of SSIM."""
WINDOW = 8
"""Radius in pixels of the window over which the noise of the input is averaged."""

CLASSES = {
    "all": ["all"],
    "edge": ["edge or next to it", "1 to 2", "3 to 7", "8 or more"],
    "noise": ["below 0.5", "0.5 to 1", "1 to 2", "2 or more"],
    "age": ["0", "1 to 3", "4 to 7", "8 or more"],
    "darkness": ["below 0.02", "0.02 to 0.1", "0.1 to 0.3", "0.3 or more"],
}
"""The ways in which pixels are split: pixels to the nearest geometric edge; standard deviation of the input at one pixel over the
light there; frames for which the surface has been visible before; luminance after the tone map."""
LIMITS = {"edge": [0.5, 2.5, 7.5], "noise": [0.5, 1, 2], "age": [0.5, 3.5, 7.5], "darkness": [0.02, 0.1, 0.3]}
FIGURES = ("pixels", "square", "windows", "dissimilarity", "flip", "pairs", "flicker")
"""Sums per block: judged pixels; squared error without the references' noise; pixels with a whole window of SSIM; 1 - SSIM; FLIP;
pixels with a predecessor; squared change of the error, without the references' noise."""


def tone_map(light):
    positive = np.maximum(light, 0.0)
    return positive / (1 + positive)


def luminance(colour):
    return colour @ np.array([0.2126, 0.7152, 0.0722])


def clean_square(result, reference, half):
    """Squared error of tone-mapped values without the noise of the reference, mean over R, G, B, per pixel.

    It is the measured square minus that of the noise, which is estimated as half the
    difference between the two halves of the reference's samples. A value that is not finite counts as the largest error."""
    expected = tone_map(reference)
    worst = np.where(expected < 0.5, 1.0, 0.0)
    got = np.where(np.isfinite(result), tone_map(np.where(np.isfinite(result), result, 0.0)), worst)
    return ((got - expected) ** 2 - half_noise(reference, half) ** 2).mean(axis=-1)


def half_noise(reference, half):
    """Half the difference between the two tone-mapped halves: its mean square is that of the reference's noise."""
    return (tone_map(half) - tone_map(2 * reference - half)) / 2


def edge_distance(depth, normal, most=8):
    """Distance in pixels, the larger of both axes, to the nearest pixel at a geometric edge; at most `most`."""
    inverse = np.where(depth < SKY_DEPTH, 1 / depth, 0.0)
    edge = np.zeros(depth.shape, bool)
    for axis in (0, 1):
        first, middle, last = (tuple(slice(a, b) if k == axis else slice(None) for k in (0, 1)) for a, b in ((0, -2), (1, -1), (2, None)))
        bend = np.abs(inverse[first] - 2 * inverse[middle] + inverse[last])
        edge[middle] |= bend > LARGEST_BEND * inverse[middle]
        turned = (normal[first] * normal[middle]).sum(axis=-1) < LEAST_COSINE
        turned |= (normal[last] * normal[middle]).sum(axis=-1) < LEAST_COSINE
        edge[middle] |= turned
    distance = np.full(depth.shape, most)
    reached = edge
    for step in range(most):
        distance[reached & (distance == most)] = step
        grown = reached.copy()
        grown[1:] |= reached[:-1]
        grown[:-1] |= reached[1:]
        wide = grown.copy()
        wide[:, 1:] |= grown[:, :-1]
        wide[:, :-1] |= grown[:, 1:]
        reached = wide
    return distance


def window_mean(values, counts, radius):
    """Mean of `values` over the pixels with `counts` in a square window around every pixel; 0 where there is none."""

    def box(image):
        total = np.pad(image.astype(float), radius + 1).cumsum(0).cumsum(1)
        side = 2 * radius + 1
        sums = total[side:, side:] - total[:-side, side:] - total[side:, :-side] + total[:-side, :-side]
        return sums[:image.shape[0], :image.shape[1]]

    number = box(counts)
    return np.where(number > 0, box(np.where(counts, values, 0.0)) / np.maximum(number, 1), 0.0)


@dataclasses.dataclass
class FrameTruth:
    """A frame's reference and what pixels are judged, with the class of every pixel in each split."""

    reference: np.ndarray
    half: np.ndarray
    noisy: np.ndarray
    judged: np.ndarray
    classes: dict


def frame_truth(sequence, pictures, frame):
    """sequence: folder with the frames of `walr render`; pictures: folder of `walr bench`."""
    inputs = exr.read(sequence / f"noisy_{frame:04d}.exr")
    light = exr.read(sequence / f"ref_{frame:04d}.exr")

    def stack(images, layer, letters):
        return np.stack([images[f"{layer}.{c}"] for c in letters], axis=2)

    reference, half = stack(light, "Indirect", "RGB"), stack(light, "IndirectA", "RGB")
    noisy, normal, depth = stack(inputs, "Indirect", "RGB"), stack(inputs, "Normal", "XYZ"), inputs["Depth.Z"]
    judged = (stack(inputs, "Albedo", "RGB") >= LEAST_ALBEDO).any(axis=2) & (normal != 0).any(axis=2) & (depth < SKY_DEPTH)
    judged &= np.isfinite(reference).all(axis=2)
    reference, half, noisy = (np.where(judged[:, :, None], i, 0.0).astype(float) for i in (reference, half, noisy))
    other = 2 * reference - half
    variance = window_mean(((noisy - half) * (noisy - other)).mean(axis=2), judged, WINDOW)
    level = window_mean((half * other).mean(axis=2), judged, WINDOW)
    values = {
        "edge": edge_distance(depth, normal),
        "noise": np.sqrt(np.maximum(variance, 0) / np.maximum(level, 1e-12)),
        "age": np.load(pictures / f"_age_{frame:04d}.npy")[:, :, 0].astype(float),
        "darkness": window_mean(luminance(tone_map(reference)), judged, 2),
    }
    classes = {"all": np.zeros(judged.shape, int), **{name: np.digitize(v, LIMITS[name]) for name, v in values.items()}}
    return FrameTruth(reference, half, noisy, judged, classes)


def block_of_pixels(shape):
    """The number of the square that holds each pixel, and the number of squares."""
    rows, columns = (np.arange(n) // SQUARE for n in shape)
    across = columns[-1] + 1
    return rows[:, None] * across + columns[None, :], int((rows[-1] + 1) * across)


class Sums:
    """Sums over blocks: for every method and split an array of figures x classes x blocks."""

    def __init__(self, shape, methods):
        self.blocks, self.count = block_of_pixels(shape)
        self.values = {(m, s): np.zeros((len(FIGURES), len(names), self.count)) for m in methods for s, names in CLASSES.items()}

    def add(self, method, truth, figures):
        """figures: maps by name of FIGURES; pixels that are NaN do not count."""
        for split, names in CLASSES.items():
            place = truth.classes[split] * self.count + self.blocks
            target = self.values[method, split]
            for index, figure in enumerate(FIGURES):
                counted = truth.judged & np.isfinite(figures[figure])
                sums = np.bincount(place[counted], figures[figure][counted], minlength=len(names) * self.count)
                target[index] += sums.reshape(len(names), self.count)


def method_figures(pictures, name, frame, truth):
    """The maps that `Sums.add` takes."""
    result = np.load(pictures / f"{name}_{frame:04d}.npy").astype(float)
    errors = np.load(pictures / f"{name}.errors_{frame:04d}.npy").astype(float)
    change = pictures / f"{name}.change_{frame:04d}.npy"
    ones, nothing = np.ones(truth.judged.shape), np.full(truth.judged.shape, np.nan)
    windows = np.pad(np.ones([n - 2 * SSIM_BORDER for n in ones.shape]), SSIM_BORDER, constant_values=np.nan)
    figures = {"pixels": ones, "square": clean_square(result, truth.reference, truth.half), "windows": windows,
               "dissimilarity": (1 - errors[:, :, 1]) * windows, "flip": errors[:, :, 2], "pairs": nothing, "flicker": nothing}
    if change.exists():
        moved = np.load(change)[:, :, 0].astype(float)
        noise = luminance(half_noise(truth.reference, truth.half))
        figures["pairs"] = np.where(np.isfinite(moved), 1.0, np.nan)
        # The change holds the noise of two references, over the root of two: on average that of one.
        figures["flicker"] = moved**2 - noise**2
    return figures


def judge(sequence, pictures, frames, methods):
    """Sums over blocks for every method, and the mean square of the references' noise."""
    sums, noise, pixels = None, 0.0, 0
    for frame in frames:
        truth = frame_truth(sequence, pictures, frame)
        sums = sums or Sums(truth.judged.shape, methods)
        for method in methods:
            sums.add(method, truth, method_figures(pictures, method, frame, truth))
        noise += (half_noise(truth.reference, truth.half)[truth.judged] ** 2).mean(axis=1).sum()
        pixels += truth.judged.sum()
    return sums, noise / max(pixels, 1)
