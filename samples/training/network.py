"""The network that makes guides, and FLR's regression as the project's shaders compute it, both differentiable."""
import torch
from torch import nn
from torch.nn import functional as F

FEATURES = 8
"""What the network sees of a pixel: normal x, y; depth; ambient occlusion; light, three channels; samples."""
SLOPE = 0.1
"""Of LeakyReLU below 0."""
SAMPLES_SCALE = 1 / 16
RIDGE = 1e-4
REACH = 3.0
FACTOR = 4
SIGMA = {"accumulated": 6.0, "single": 12.0}
"""Standard deviation of FLR's Gaussian window in pixels: `regression.sigma`, `regression.single-frame-sigma`."""


class Means:
    """Means over a frame that what the network sees is relative to. `light`: of all channels; `inverse_depth`: of surfaces."""

    def __init__(self, light, inverse_depth):
        self.light, self.inverse_depth = light, inverse_depth

    @staticmethod
    def of(frame):
        sampled, surface = frame["samples"] > 0, frame["inverse_depth"] > 0

        def mean(values, where):
            total = (values * where).sum((1, 2, 3), keepdim=True)
            return total / where.sum((1, 2, 3), keepdim=True).clamp(min=1)

        return Means(mean(frame["light"].mean(1, keepdim=True), sampled), mean(frame["inverse_depth"], surface))


def features(frame, means):
    """flnr_encode.comp: what the network sees of each pixel. Everything is 0 where there is no surface."""
    surface = frame["inverse_depth"] > 0
    depth = frame["inverse_depth"] / (frame["inverse_depth"] + means.inverse_depth).clamp(min=1e-30)
    light = torch.log1p(frame["light"] / means.light.clamp(min=1e-30))
    seen = torch.cat([frame["normal"][:, :2], depth, frame["occlusion"], light, frame["samples"] * SAMPLES_SCALE], 1)
    return torch.where(surface, seen, torch.zeros_like(seen))


class Block(nn.Module):
    """Two 3 x 3 convolutions with LeakyReLU."""

    def __init__(self, inputs, outputs):
        super().__init__()
        self.layers = nn.ModuleList([nn.Conv2d(inputs, outputs, 3, padding=1), nn.Conv2d(outputs, outputs, 3, padding=1)])

    def forward(self, x):
        for layer in self.layers:
            x = F.leaky_relu(layer(x), SLOPE)
        return x


class GuideNetwork(nn.Module):
    """A U-Net with skips from the encoder to the decoder.

    `shrink`: pixels per axis of a square that becomes one pixel with more channels; the result grows back by as much."""

    def __init__(self, widths, guides, shrink, replaces):
        super().__init__()
        self.shrink, self.guides, self.replaces = shrink, guides, replaces
        inputs = [FEATURES * shrink * shrink, *widths[:-1]]
        self.encoder = nn.ModuleList(Block(a, b) for a, b in zip(inputs, widths))
        self.decoder = nn.ModuleList(Block(widths[i + 1] + widths[i], widths[i]) for i in reversed(range(len(widths) - 1)))
        self.head = nn.Conv2d(widths[0], guides * shrink * shrink, 1)

    def trunk(self, seen):
        """The last layer before the head."""
        x = F.pixel_unshuffle(seen, self.shrink) if self.shrink > 1 else seen
        skips = []
        for block in self.encoder:
            x = block(F.max_pool2d(x, 2, ceil_mode=True) if skips else x)
            skips.append(x)
        skips.pop()
        for block in self.decoder:
            skip = skips.pop()
            larger = F.interpolate(x, scale_factor=2, mode="nearest")[:, :, :skip.shape[2], :skip.shape[3]]
            x = block(torch.cat([larger, skip], 1))
        return x

    def forward(self, seen):
        height, width = seen.shape[2:]
        padded = F.pad(seen, (0, -width % self.shrink, 0, -height % self.shrink))
        guides = torch.sigmoid(self.head(self.trunk(padded)))
        guides = F.pixel_shuffle(guides, self.shrink) if self.shrink > 1 else guides
        return guides[:, :, :height, :width]


PRESETS = {
    "small": {"widths": (16, 24, 32, 48), "guides": 3, "shrink": 2, "replaces": False},
    "faithful": {"widths": (16, 32, 64, 128), "guides": 5, "shrink": 1, "replaces": True},
}
"""`faithful`: as the poster says, five guides in place of the geometric ones; widths are not published."""


def cholesky_slopes(covariances, right, ridge):
    """cholesky.glsl: the slopes of right-hand sides. Entries are maps; `covariances[i][j]` for j <= i."""
    count = len(ridge)
    lower = [[None] * count for _ in range(count)]
    for j in range(count):
        for i in range(j, count):
            value = covariances[i][j]
            if i == j:
                value = value.clamp(min=0) + ridge[i]
            for c in range(j):
                value = value - lower[i][c] * lower[j][c]
            lower[i][j] = torch.sqrt(torch.maximum(value, ridge[i])) if i == j else value / lower[j][j]
    x = [None] * count
    for i in range(count):
        value = right[i]
        for c in range(i):
            value = value - lower[i][c] * x[c]
        x[i] = value / lower[i][i]
    for i in reversed(range(count)):
        value = x[i]
        for c in range(i + 1, count):
            value = value - lower[c][i] * x[c]
        x[i] = value / lower[i][i]
    return x


def blur(maps, sigma):
    """The separable Gaussian of flr_blur.comp and flr_solve.comp over cells; `sigma` in cells."""
    radius = int(-(-REACH * sigma // 1))
    weights = torch.exp(-0.5 * (torch.arange(-radius, radius + 1, dtype=maps.dtype) / sigma) ** 2)
    batch, count, height, width = maps.shape
    maps = maps.reshape(batch * count, 1, height, width)
    maps = F.conv2d(maps, weights.view(1, 1, 1, -1), padding=(0, radius))
    maps = F.conv2d(maps, weights.view(1, 1, -1, 1), padding=(radius, 0))
    return maps.reshape(batch, count, height, width)


def regression(frame, learned, replaces, sigma):
    """FLR (flr_regression.h) with bilinear upsampling: the filtered light.

    `learned`: more guides, or None; with `replaces`, they stand in place of normal, inverse depth and occlusion."""
    light, height, width = frame["light"], *frame["light"].shape[2:]
    geometric = [] if replaces else [*frame["normal"].unbind(1), frame["inverse_depth"][:, 0], frame["occlusion"][:, 0]]
    guides = geometric + ([] if learned is None else list(learned.unbind(1)))
    count = len(guides)
    counts = ((frame["samples"] > 0) & (frame["inverse_depth"] > 0))[:, 0].to(light.dtype)
    row = [torch.ones_like(counts), *guides]
    colours = light.unbind(1)
    products = [row[i] * row[j] for i in range(count + 1) for j in range(i, count + 1)]
    products += [x * y for x in row for y in colours]
    maps = torch.stack(products, 1) * counts[:, None]
    maps = F.pad(maps, (0, -width % FACTOR, 0, -height % FACTOR))
    maps = blur(FACTOR * FACTOR * F.avg_pool2d(maps, FACTOR), sigma / FACTOR)

    samples = maps[:, 0]
    found = samples > 0
    maps = maps / torch.where(found, samples, torch.ones_like(samples))[:, None]
    entry = iter(maps.unbind(1))
    square = {(i, j): next(entry) for i in range(count + 1) for j in range(i, count + 1)}
    colour = [torch.stack([next(entry) for _ in range(3)], 1) for _ in range(count + 1)]
    mean = [square[0, i + 1] for i in range(count)]
    covariances = [[square[j + 1, i + 1] - mean[i] * mean[j] for j in range(i + 1)] for i in range(count)]
    inverse_depth = None if replaces else 3
    ridge = [RIDGE * (mean[i] ** 2 if i == inverse_depth else torch.ones_like(mean[i])) for i in range(count)]
    ridge = [r + 1e-30 for r in ridge]
    slopes = cholesky_slopes([[c[:, None] for c in line] for line in covariances],
                             [colour[i + 1] - colour[0] * mean[i][:, None] for i in range(count)], [r[:, None] for r in ridge])
    constant = colour[0] - sum(s * m[:, None] for s, m in zip(slopes, mean))

    coefficients = torch.cat([constant, *slopes], 1) * found[:, None]
    both = torch.cat([coefficients, found[:, None].to(light.dtype)], 1)
    both = F.interpolate(both, scale_factor=FACTOR, mode="bilinear", align_corners=False)[:, :, :height, :width]
    coefficients = both[:, :-1] / both[:, -1:].clamp(min=1e-6)
    result = coefficients[:, :3] + sum(coefficients[:, 3 * i + 3:3 * i + 6] * guides[i][:, None] for i in range(count))
    return result.clamp(min=0)
