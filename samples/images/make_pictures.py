#!/usr/bin/python3
"""Makes the pictures of the README.

    make_pictures.py [--walr build/bin/walr] [--cache DIR] [--only comparison|animation]

writes to this script's folder

    comparison.webp   a frame of COMPARED: noisy, denoised, reference side by side, and two enlarged crops of each
    animation.webp    frames of ANIMATED: the left half of the picture noisy, the right half denoised

All light is noisy, with one sample per pixel of direct, indirect and, in COMPARED, specular light, and all of it is denoised. Frames
are rendered into the corpus's cache and kept there: some ten minutes on two idle cores, and one once they are there. Needs numpy and
Pillow, which come with Debian's python3-matplotlib.
"""
import argparse
import pathlib
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
import exr
import numpy as np
from PIL import Image, ImageDraw, ImageFont

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "corpus"))
import corpus
import entries
import judging
import places
import rendering

COMPARED = entries.built_in("kitchen_gloss", "kitchen_gloss", entries.QHD, (19, 19), 1, reference_samples=96, camera="floor")
ANIMATED = entries.corpus()["sponza_360"]
ANIMATED_FRAMES = 20, 51
FONT = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf"
# Upper left corners in the picture of COMPARED: a pot and a bowl; the window in the varnish of the floor.
CROPS = [(120, 215), (330, 450)]
CROP = (120, 90)
SCALE = 4


def rendered(cache, entry, options, *specular):
    """The folder of an entry's frames, rendered into the cache with these options of `walr render`."""
    version = entries.renderer_version(cache.walr, entry.scene, entry.camera, *specular)
    key = entries.key([entry.reference_settings(), options, *specular], version)
    frames = cache.folder / "pictures" / f"{entry.name}-{key}"
    frames.mkdir(parents=True, exist_ok=True)
    command = [cache.walr, "render", entry.scene, "--output", frames, *options, *specular]
    subprocess.run(list(map(str, command)), check=True)
    return frames


def lit(guides, light):
    """The lit image: albedo times light, of each lobe that there is, plus emission."""
    diffuse = exr.colour(light, "Direct") + exr.colour(light, "Indirect")
    image = exr.colour(guides, "Albedo") * diffuse + exr.colour(guides, "Emission")
    if "Specular.R" in guides:
        image += exr.colour(guides, "SpecularAlbedo") * exr.colour(light, "Specular")
    return image


def lit_pictures(walr, frames, light, indices):
    """The lit images of some frames of a folder, noisy and denoised. All frames before them are history."""
    with tempfile.TemporaryDirectory() as folder:
        command = [walr, "denoise", frames, "--output", folder, "--light", light]
        subprocess.run(list(map(str, command)), check=True, capture_output=True)
        pictures = []
        for index in indices:
            noisy = exr.read(frames / f"noisy_{index:04d}.exr")
            denoised = exr.read(pathlib.Path(folder) / f"denoised_{index:04d}.exr")
            pictures.append((lit(noisy, noisy), lit(noisy, denoised)))
    return pictures


def exposure_of(linear):
    """Brings the geometric mean of the luminance to 0.3."""
    return 0.3 / float(np.exp(np.mean(np.log(judging.luminance(linear) + 1e-3))))


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


def comparison(cache):
    """Three pictures side by side, below each two crops of it."""
    last = COMPARED.judged[1]
    frames = rendered(cache, COMPARED, COMPARED.render_options(), "--specular")
    (noisy, denoised), = lit_pictures(cache.walr, frames, "all", [last])
    reference = lit(exr.read(frames / f"noisy_{last:04d}.exr"), exr.read(frames / f"ref_{last:04d}.exr"))
    exposure = exposure_of(reference)
    columns = []
    for image, text in ((noisy, "1 sample per pixel"), (denoised, "denoised by walr"),
                        (reference, f"reference, {COMPARED.reference_samples} samples per pixel")):
        picture = places.displayed(image, exposure)
        crops = np.concatenate([enlarged(picture, corner) for corner in CROPS], axis=1)
        columns.append(np.concatenate([labelled(framed(picture), text), crops], axis=0))
    Image.fromarray(np.concatenate(columns, axis=1)).save(HERE / "comparison.webp", quality=88, method=4)


def animation(cache):
    """The left half of each picture noisy, the right half denoised, at the exposure of the first one.

    Without the corpus's jitter: no anti-aliasing of the lit image follows here, which a host that jitters has."""
    first, last = ANIMATED_FRAMES
    frames = rendered(cache, ANIMATED, ANIMATED.noisy_options((first - entries.WARM_UP, last), jitter=False))
    pairs = lit_pictures(cache.walr, frames, "both", range(first, last + 1))
    exposure = exposure_of(pairs[0][1])
    pictures = []
    for noisy, denoised in pairs:
        picture = places.displayed(denoised, exposure)
        middle = picture.shape[1] // 2
        picture[:, :middle] = places.displayed(noisy, exposure)[:, :middle]
        picture[:, middle - 1:middle + 1] = 255
        pictures.append(Image.fromarray(picture))
    pictures[0].save(HERE / "animation.webp", save_all=True, append_images=pictures[1:], duration=80, loop=0, quality=55, method=4)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--walr", default="build/bin/walr")
    parser.add_argument("--cache", default=corpus.default_cache(), help="folder for frames; default: %(default)s")
    parser.add_argument("--only", choices=["comparison", "animation"])
    arguments = parser.parse_args()
    cache = rendering.Cache(arguments.cache, pathlib.Path(arguments.walr).resolve())
    if arguments.only != "animation":
        comparison(cache)
    if arguments.only != "comparison":
        animation(cache)


if __name__ == "__main__":
    main()
