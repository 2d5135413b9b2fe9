"""The network that makes guides, and FLR's regression as the project's shaders compute it, both differentiable."""
import math

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
INVERSE_DEPTH = 3
"""Index of inverse depth among the geometric guides; its ridge is relative."""
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
        """With gradients, the layers before the head compute in bfloat16, which some processors do four times as fast."""
        height, width = seen.shape[2:]
        padded = F.pad(seen, (0, -width % self.shrink, 0, -height % self.shrink))
        with torch.autocast(seen.device.type, dtype=torch.bfloat16, enabled=torch.is_grad_enabled()):
            last = self.trunk(padded.contiguous(memory_format=torch.channels_last))
        guides = torch.sigmoid(self.head(last.float()))
        guides = F.pixel_shuffle(guides, self.shrink) if self.shrink > 1 else guides
        return guides[:, :, :height, :width]


PRESETS = {
    "small": {"widths": (16, 24, 32, 48), "guides": 3, "shrink": 2, "replaces": False},
    "full": {"widths": (16, 24, 32, 48), "guides": 3, "shrink": 1, "replaces": False},
    "paper": {"widths": (16, 24, 32, 48), "guides": 5, "shrink": 1, "replaces": True},
}
"""`paper`: as the poster says, at full size, five guides in place of the geometric ones. It only says that the widths are low."""

EXPERIMENTS = {
    "small_wide": {**PRESETS["small"], "widths": (32, 48, 64, 96)},
}
"""Networks that no shader has, to see what more channels gain."""


def cells_of(maps):
    """The pixels of each cell: batch x rows x columns x channels x pixels of a cell. The picture is filled up with zeros."""
    maps = F.pad(maps, (0, -maps.shape[3] % FACTOR, 0, -maps.shape[2] % FACTOR))
    batch, channels, height, width = maps.shape
    split = maps.reshape(batch, channels, height // FACTOR, FACTOR, width // FACTOR, FACTOR)
    return split.permute(0, 2, 4, 1, 3, 5).reshape(batch, height // FACTOR, width // FACTOR, channels, FACTOR * FACTOR)


def along_both_axes(values, down, across):
    """Maps of batch x rows x columns x channels, with a matrix applied to their columns and one to their rows."""
    batch, height, width, channels = values.shape
    values = (down @ values.reshape(batch, height, width * channels)).reshape(batch * len(down), width, channels)
    return (across @ values).reshape(batch, len(down), len(across), channels)


def gaussian(cells, sigma, device):
    """The Gaussian of flr_blur.comp and flr_solve.comp along one axis, as a matrix; `sigma` in cells."""
    cell = torch.arange(cells, device=device)
    away = (cell[:, None] - cell).abs()
    return torch.exp(-0.5 * (away / sigma) ** 2) * (away <= math.ceil(REACH * sigma))


def bilinear(pixels, cells, device):
    """The interpolation of cells at pixels along one axis, as a matrix."""
    at = ((torch.arange(pixels, device=device) + 0.5) / FACTOR - 0.5).clamp(0, cells - 1)
    return (1 - (at[:, None] - torch.arange(cells, device=device)).abs()).clamp(min=0)


class Solve(torch.autograd.Function):
    """The solutions of many small systems with symmetric positive definite matrices, by Gauss and Jordan: such matrices need no
    pivots. Libraries solve one small system after the other, and differentiate a factorization step by step."""

    @staticmethod
    def solutions(matrix, right):
        size = matrix.shape[-1]
        system = torch.cat([matrix, right], -1)
        for i in range(size):
            pivot = system[..., i:i + 1, :] / system[..., i:i + 1, i:i + 1]
            column = system[..., i:i + 1].clone()
            column[..., i, :] -= 1
            system = system - column * pivot
        return system[..., size:]

    @staticmethod
    def forward(context, matrix, right):
        result = Solve.solutions(matrix, right)
        context.save_for_backward(matrix, result)
        return result

    @staticmethod
    def backward(context, gradient):
        """Of A X = B: dB = A^-1 dX, and dA = -dB X^T."""
        matrix, result = context.saved_tensors
        of_right = Solve.solutions(matrix, gradient)
        return -of_right @ result.transpose(-1, -2), of_right


def slopes_of(covariance, right, ridge):
    """choleskySolve of cholesky.glsl. Its floor under pivots acts on rounding only: a ridge keeps them above it. Rows and columns are
    scaled to a diagonal of 1 before."""
    variance = torch.diagonal(covariance.detach(), dim1=-2, dim2=-1)[..., None].clamp(min=0)
    scale = torch.rsqrt(variance + ridge)
    matrix = scale * covariance * scale.transpose(-1, -2) + torch.diag_embed((ridge * scale * scale)[..., 0])
    return scale * Solve.apply(matrix, scale * right)


def regression(frame, learned, replaces, sigma):
    """FLR (flr_regression.h) with bilinear upsampling: the filtered light.

    `learned`: more guides, or None; with `replaces`, they stand in place of normal, inverse depth and occlusion."""
    light, height, width = frame["light"], *frame["light"].shape[2:]
    geometric = [] if replaces else [frame["normal"], frame["inverse_depth"], frame["occlusion"]]
    counts = ((frame["samples"] > 0) & (frame["inverse_depth"] > 0)).to(light.dtype)
    row = torch.cat([torch.ones_like(counts), *geometric, *([] if learned is None else [learned])], 1)
    size = row.shape[1]
    products = cells_of(row * counts) @ cells_of(torch.cat([row, light], 1)).transpose(3, 4)
    batch, rows, columns = products.shape[:3]
    cell_sigma = sigma / FACTOR
    sums = along_both_axes(products.reshape(batch, rows, columns, -1), gaussian(rows, cell_sigma, light.device),
                           gaussian(columns, cell_sigma, light.device))

    sums = sums.reshape(batch, rows, columns, size, size + 3)
    samples = sums[..., :1, :1]
    found = samples > 0
    means = sums / torch.where(found, samples, torch.ones_like(samples))
    x, y = means[..., 0, 1:size, None], means[..., :1, size:]
    covariance, right = means[..., 1:, 1:size] - x * x.transpose(-1, -2), means[..., 1:, size:] - x * y
    ridge = torch.full_like(x, RIDGE)
    if not replaces:
        ridge[..., INVERSE_DEPTH, :] *= x[..., INVERSE_DEPTH, :].detach() ** 2
    slopes = slopes_of(covariance, right, ridge + 1e-30)
    constant = y - x.transpose(-1, -2) @ slopes

    coefficients = (torch.cat([constant, slopes], -2) * found).reshape(batch, rows, columns, -1)
    both = along_both_axes(torch.cat([coefficients, found[..., 0].to(light.dtype)], -1), bilinear(height, rows, light.device),
                           bilinear(width, columns, light.device))
    guides = row.permute(0, 2, 3, 1).reshape(-1, 1, size)
    result = (guides @ both[..., :-1].reshape(-1, size, 3)).reshape(batch, height, width, 3) / both[..., -1:].clamp(min=1e-6)
    return result.permute(0, 3, 1, 2).clamp(min=0)
