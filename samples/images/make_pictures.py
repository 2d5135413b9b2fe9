#!/usr/bin/python3
"""Makes the pictures of the README from a glTF scene with a sun and a constant sky.

    make_pictures.py SCENE.glb FOLDER [--walr build/bin/walr] [--frame 20] [--samples 320]

renders the scene into FOLDER (what is there already is kept), denoises it, and writes to this script's folder

    comparison.webp   frame --frame: noisy, denoised, reference side by side, and two enlarged crops of each
    animation.webp    32 frames: the left half of the picture noisy, the right half denoised

Needs numpy and Pillow, which come with Debian's python3-matplotlib. The reference takes most of the time: about a
quarter of an hour on two idle cores at 320 samples per pixel.

The light of the sun is free of noise at one sample per pixel, as in an engine that has shadow maps or traces shadow
rays. What is denoised is the rest: light of the sky and light that surfaces reflect. `walr render` writes the light of
the sky into the direct light. This script moves it into the indirect light: it is what the direct light holds beyond
that of the same frames rendered under a black sky.
"""
import argparse
import pathlib
import subprocess

import exr
import numpy as np
from PIL import Image, ImageDraw, ImageFont

HERE = pathlib.Path(__file__).resolve().parent
FONT = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf"
# Upper left corners in the picture of 960 x 540: a relief in the shade; chains and leaves.
CROPS = [(728, 298), (125, 245)]
CROP = (120, 90)
SCALE = 4


def run(*command):
    print(*command)
    subprocess.run([str(part) for part in command], check=True)


def merge(lit, sun, target):
    """`lit` with the light of its sky among the indirect light. Only the sun, known from `sun`, stays direct."""
    images, direct = exr.read(lit), exr.read(sun)
    for c in "RGB":
        sky = np.maximum(images["Direct." + c] - direct["Direct." + c], 0)
        images["Indirect." + c] += sky
        images["Direct." + c] = direct["Direct." + c]
    exr.rewrite(lit, target, images)


def display(linear, exposure):
    """Exposure, tone map x / (1 + x), then sRGB."""
    x = np.maximum(linear * exposure, 0)
    x = x / (1 + x)
    x = np.where(x <= 0.0031308, 12.92 * x, 1.055 * np.power(np.maximum(x, 1e-9), 1 / 2.4) - 0.055)
    return (np.clip(x, 0, 1) * 255 + 0.5).astype(np.uint8)


def exposure_of(linear):
    """Brings the geometric mean of the luminance to 0.3."""
    luminance = linear @ np.array([0.2126, 0.7152, 0.0722], np.float32)
    return 0.3 / float(np.exp(np.mean(np.log(luminance + 1e-3))))


def lit_picture(frame, indirect):
    """Albedo times light plus emission."""
    return exr.colour(frame, "Albedo") * (exr.colour(frame, "Direct") + indirect) + exr.colour(frame, "Emission")


def sequence(arguments, folder, size, last):
    """Renders frames 0 to `last` and denoises them, with the sky's light among the indirect light."""
    folder.mkdir(parents=True, exist_ok=True)
    exr.write_black(folder / "black.exr")
    common = ["render", arguments.scene, "--frames", f"0-{last}", "--size", size, "--output"]
    run(arguments.walr, *common, folder / "lit")
    run(arguments.walr, *common, folder / "sun", "--bounces", 0, "--sky", folder / "black.exr")
    (folder / "input").mkdir(exist_ok=True)
    for frame in range(last + 1):
        name = f"noisy_{frame:04d}.exr"
        merge(folder / "lit" / name, folder / "sun" / name, folder / "input" / name)
    run(arguments.walr, "denoise", folder / "input", "--output", folder / "denoised")


def reference(arguments, folder, size, frame):
    """The light of one frame, as the denoiser is to find it."""
    run(arguments.walr, "render", arguments.scene, "--frames", f"{frame}-{frame}", "--size", size, "--output",
        folder / "reference", "--reference-spp", arguments.samples)
    source = folder / "reference" / f"ref_{frame:04d}.exr"
    target = folder / "reference" / "merged.exr"
    merge(source, folder / "sun" / f"noisy_{frame:04d}.exr", target)
    return exr.colour(exr.read(target), "Indirect")


def lit_pictures(folder, frame):
    """The frame's guides and direct light, its noisy and its denoised light."""
    images = exr.read(folder / "input" / f"noisy_{frame:04d}.exr")
    denoised = exr.read(folder / "denoised" / f"denoised_{frame:04d}.exr")
    return images, exr.colour(images, "Indirect"), exr.colour(denoised, "Indirect")


def enlarged(picture, corner):
    x, y = corner
    crop = Image.fromarray(picture[y:y + CROP[1], x:x + CROP[0]])
    return np.asarray(crop.resize((CROP[0] * SCALE, CROP[1] * SCALE), Image.NEAREST))


def labelled(picture, text):
    image = Image.fromarray(picture)
    draw = ImageDraw.Draw(image)
    font = ImageFont.truetype(FONT, 22)
    box = draw.textbbox((16, 12), text, font=font)
    draw.rectangle((box[0] - 8, box[1] - 6, box[2] + 8, box[3] + 6), fill=(0, 0, 0))
    draw.text((16, 12), text, font=font, fill=(255, 255, 255))
    return np.asarray(image)


def framed(picture):
    """With the crops marked."""
    image = Image.fromarray(picture)
    draw = ImageDraw.Draw(image)
    for x, y in CROPS:
        draw.rectangle((x - 1, y - 1, x + CROP[0], y + CROP[1]), outline=(255, 255, 255))
    return np.asarray(image)


def comparison(arguments, folder):
    sequence(arguments, folder, "960x540", arguments.frame)
    truth = reference(arguments, folder, "960x540", arguments.frame)
    draw_comparison(folder, arguments.frame, truth, f"reference, {arguments.samples} samples per pixel")


def draw_comparison(folder, frame, truth, label):
    """Three pictures side by side, below each two crops of it."""
    images, noisy, denoised = lit_pictures(folder, frame)
    exposure = exposure_of(lit_picture(images, truth))
    columns = []
    for light, text in ((noisy, "1 sample per pixel"), (denoised, "denoised by walr"), (truth, label)):
        picture = display(lit_picture(images, light), exposure)
        crops = np.concatenate([enlarged(picture, corner) for corner in CROPS], axis=1)
        columns.append(np.concatenate([labelled(framed(picture), text), crops], axis=0))
    image = Image.fromarray(np.concatenate(columns, axis=1))
    image.save(HERE / "comparison.webp", quality=88, method=4)


def animation(arguments, folder, frames=32, start=12):
    """The frames from `start` on, by when history has built up, at the exposure of their first one."""
    sequence(arguments, folder, "640x360", start + frames - 1)
    draw_animation(folder, range(start, start + frames))


def draw_animation(folder, frames):
    """The left half of each picture noisy, the right half denoised."""
    pictures, exposure = [], None
    for frame in frames:
        images, noisy, denoised = lit_pictures(folder, frame)
        exposure = exposure or exposure_of(lit_picture(images, denoised))
        picture = display(lit_picture(images, denoised), exposure)
        middle = picture.shape[1] // 2
        picture[:, :middle] = display(lit_picture(images, noisy), exposure)[:, :middle]
        picture[:, middle - 1:middle + 1] = 255
        pictures.append(Image.fromarray(picture))
    pictures[0].save(HERE / "animation.webp", save_all=True, append_images=pictures[1:], duration=80, loop=0,
                     quality=55, method=4)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scene", type=pathlib.Path)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--walr", default="build/bin/walr")
    parser.add_argument("--frame", type=int, default=20)
    parser.add_argument("--samples", type=int, default=320, help="per pixel of the reference")
    parser.add_argument("--only", choices=["comparison", "animation"])
    arguments = parser.parse_args()
    if arguments.only != "animation":
        comparison(arguments, arguments.folder / "comparison")
    if arguments.only != "comparison":
        animation(arguments, arguments.folder / "animation")


if __name__ == "__main__":
    main()
