#!/usr/bin/python3
"""What light directions are worth: the normal-mapped wall of box.gltf, shaded with other normals than the denoiser got.

    light_direction.py --output DIR    renders three short sequences, denoises them, prints a table, writes a picture

Needs numpy and Pillow (Debian: python3-matplotlib). The table is in the integration guide, "Light for other normals"."""
import argparse
import json
import pathlib
import sys

sys.dont_write_bytecode = True
import entries as table
import judging
import numpy as np
from judging import exr
from PIL import Image

FRAME = 19
SIZE, SMALL = (256, 144), (128, 72)
STEEP = 20
"""Degrees between mapped and geometric normal from which a pixel belongs to an edge of a tile."""


def without_normal_maps(scene, file):
    contents = json.loads(scene.read_text())
    for material in contents["materials"]:
        material.pop("normalTexture", None)
    file.write_text(json.dumps(contents))
    return file


def denoised(walr, scene, folder, size, *options):
    """Denoised light, slopes (rows, columns, colour, axis) and normals of the last frame of a sequence."""
    render = ["render", scene, "--camera", "tiled wall", "--output", folder, "--frames", f"{FRAME - 9}-{FRAME}", "--size",
              "x".join(map(str, size)), "--spp", "1", *options]
    for command in (render, ["denoise", folder, "--output", folder / "denoised", "--light-direction"]):
        table.run_walr(walr, *command)
    slopes = exr.read(folder / "denoised" / f"direction_{FRAME:04d}.exr")
    return (exr.layer(exr.read(folder / "denoised" / f"denoised_{FRAME:04d}.exr"), "Indirect"),
            np.stack([exr.layer(slopes, f"Slope{axis}") for axis in "XYZ"], axis=3),
            exr.layer(exr.read(folder / f"noisy_{FRAME:04d}.exr"), "Normal", "XYZ"))


def shaded(light, slopes, change):
    return np.maximum(light + np.einsum("hwca,hwa->hwc", slopes, change), 0)


def interpolated(image_at):
    """A picture of SIZE from one of SMALL: `image_at` gives the small one's values, for a pixel of each of the four nearest."""
    rows, columns = np.mgrid[:SIZE[1], :SIZE[0]]
    y, x = ((n + 0.5) * SMALL[0] / SIZE[0] - 0.5 for n in (rows, columns))
    top, left = np.floor(y).astype(int), np.floor(x).astype(int)
    total = 0.0
    for dy in (0, 1):
        for dx in (0, 1):
            weight = np.abs(1 - dy - (y - top)) * np.abs(1 - dx - (x - left))
            place = np.clip(top + dy, 0, SMALL[1] - 1), np.clip(left + dx, 0, SMALL[0] - 1)
            total = total + weight[:, :, None] * image_at(place)
    return total


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--output", required=True, type=pathlib.Path)
    parser.add_argument("--walr", type=pathlib.Path, default=table.BUILD / "bin" / "walr")
    arguments = parser.parse_args()
    folder, walr, scene = arguments.output, arguments.walr, table.BUILT_IN / "box.gltf"
    folder.mkdir(parents=True, exist_ok=True)
    mapped, _, normal = denoised(walr, scene, folder / "mapped", SIZE, "--reference-spp", "256", "--reference-frames", f"{FRAME}-{FRAME}")
    flat, flat_slopes, flat_normal = denoised(walr, without_normal_maps(scene, folder / "flat.gltf"), folder / "flat", SIZE)
    small, small_slopes, small_normal = denoised(walr, scene, folder / "small", SMALL)
    truth = exr.read(folder / "mapped" / f"ref_{FRAME:04d}.exr")
    reference, half = exr.layer(truth, "Indirect"), exr.layer(truth, "IndirectA")
    results = {
        "denoised with the mapped normal": mapped,
        "denoised with the geometric normal": flat,
        "the same, shaded with the mapped normal by light direction": shaded(flat, flat_slopes, normal - flat_normal),
        "denoised with the mapped normal at half the size, interpolated": interpolated(lambda q: small[q]),
        "the same, shaded with the mapped normal by light direction ": interpolated(
            lambda q: shaded(small[q], small_slopes[q], normal - small_normal[q])),
    }
    cosine = np.clip((normal * flat_normal).sum(axis=2), -1, 1)
    known = np.isfinite(reference).all(axis=2) & (normal != 0).any(axis=2)
    classes = {"all": known, "edges of tiles": known & (cosine < np.cos(np.radians(STEEP)))}
    print("| RMSE | " + " | ".join(classes) + " |")
    for name, result in results.items():
        square = judging.clean_square(result, reference, half)
        print(f"| {name.strip()} | " + " | ".join(f"{max(square[c].mean(), 0) ** 0.5:.5f}" for c in classes.values()) + " |")
    shown = [judging.tone_map(6 * p[40:104, 80:176]) ** (1 / 2.2) for p in (reference, *results.values())]
    sheet = np.concatenate([np.concatenate(shown[:3], axis=1), np.concatenate(shown[3:], axis=1)])
    picture = Image.fromarray((255 * sheet).astype(np.uint8))
    picture.resize((4 * picture.width, 4 * picture.height), Image.Resampling.NEAREST).save(folder / "wall.png")


if __name__ == "__main__":
    main()
