#!/usr/bin/python3
"""Computes the error metrics with scikit-image, which shares no code with samples/metrics.

Writes metric_fixture.json, or with --check compares it with freshly computed values. Needs python3-skimage.
The test images come from a formula that metric_pictures.h repeats.
"""
import importlib.util
import json
import pathlib
import sys

import numpy as np

FIXTURE = pathlib.Path(__file__).with_name("metric_fixture.json")
CASES = [
    # name, width, height, amplitude of the noise, every n-th pixel masked out (0: none)
    ("odd_size", 37, 29, 0.3, 0),
    ("masked", 48, 33, 0.5, 5),
    ("strong_noise", 64, 40, 3.0, 3),
    ("one_window", 11, 11, 0.2, 0),
]


def uniform(index):
    """A hash of 32-bit integers to [0, 1)."""
    n = np.asarray(index, dtype=np.uint32)
    n = n ^ (n >> np.uint32(16))
    n = n * np.uint32(0x7FEB352D)
    n = n ^ (n >> np.uint32(15))
    n = n * np.uint32(0x846CA68B)
    n = n ^ (n >> np.uint32(16))
    return n / 4294967296.0


def pictures(width, height, amplitude):
    y, x, c = np.meshgrid(np.arange(height), np.arange(width), np.arange(3), indexing="ij")
    reference = 0.1 + 0.15 * ((3 * x + 5 * y + 7 * c) % 17) + 0.02 * x
    test = reference * (1.0 + amplitude * (uniform((y * width + x) * 3 + c) - 0.5))
    return test.astype(np.float32), reference.astype(np.float32)


def figures(width, height, amplitude, stride):
    from skimage.metrics import mean_squared_error, peak_signal_noise_ratio, structural_similarity

    test, reference = (np.maximum(p, 0) / (1 + np.maximum(p, 0)) for p in pictures(width, height, amplitude))
    test, reference = test.astype(np.float64), reference.astype(np.float64)
    y, x = np.mgrid[:height, :width]
    mask = np.ones((height, width), bool) if stride == 0 else (x + 2 * y) % stride != 0
    test[~mask] = reference[~mask]
    _, ssim = structural_similarity(
        reference, test, channel_axis=2, data_range=1.0, gaussian_weights=True, sigma=1.5,
        use_sample_covariance=False, K1=0.01, K2=0.03, full=True)
    inside = np.zeros_like(mask)
    inside[5:height - 5, 5:width - 5] = True
    return {
        "rmse": float(np.sqrt(mean_squared_error(reference[mask], test[mask]))),
        "psnr": float(peak_signal_noise_ratio(reference[mask], test[mask], data_range=1.0)),
        "ssim": float(ssim[mask & inside].mean()),
    }


def main():
    cases = [
        {"name": name, "width": w, "height": h, "amplitude": a, "masked_stride": s, **figures(w, h, a, s)}
        for name, w, h, a, s in CASES
    ]
    if "--check" not in sys.argv:
        FIXTURE.write_text(json.dumps(cases, indent=1) + "\n")
        return
    for stored, fresh in zip(json.loads(FIXTURE.read_text()), cases, strict=True):
        for key, value in fresh.items():
            same = abs(stored[key] - value) < 1e-9 if isinstance(value, float) else stored[key] == value
            if not same:
                sys.exit(f"{stored['name']}: stored {key} {stored[key]}, scikit-image computes {value}")


if __name__ == "__main__":
    if importlib.util.find_spec("skimage") is None:
        print("scikit-image (python3-skimage) is not installed: the stored values are not checked")
        sys.exit(77)
    main()
