"""The places of largest error, with pictures of them."""
import numpy as np
from judging import CLASSES, SQUARE, clean_square, frame_truth, tone_map
from PIL import Image, ImageDraw

TILE = 32
"""Side in pixels of the places that are compared. A picture shows the square of 64 pixels around it, which has a reference."""
SCALE = 3


def worst_tiles(square, judged, count):
    """Top left corners of the tiles with the largest mean of `square` over the judged pixels; at most one in each square, and
    only tiles of which half is judged."""
    rows, columns = (n // TILE for n in judged.shape)

    def tiles(image):
        return image[:rows * TILE, :columns * TILE].reshape(rows, TILE, columns, TILE).sum(axis=(1, 3))

    number = tiles(judged.astype(float))
    mean = np.where(number >= TILE * TILE / 2, tiles(np.where(judged, square, 0.0)) / np.maximum(number, 1), -np.inf)
    found, taken = [], set()
    for index in np.argsort(-mean, axis=None):
        row, column = divmod(int(index), columns)
        place = row * TILE // SQUARE, column * TILE // SQUARE
        if not np.isfinite(mean[row, column]) or len(found) == count:
            break
        if place not in taken:
            found.append((column * TILE, row * TILE))
            taken.add(place)
    return found


def displayed(light, exposure):
    """Exposed and tone-mapped values in 0 to 255, as sRGB. Pixels without a value are grey."""
    value = tone_map(np.nan_to_num(light) * exposure)
    value = np.where(value <= 0.0031308, 12.92 * value, 1.055 * np.power(np.maximum(value, 1e-9), 1 / 2.4) - 0.055)
    value = np.where(np.isfinite(light).all(axis=2, keepdims=True), value, 0.5)
    return (np.clip(value, 0, 1) * 255 + 0.5).astype(np.uint8)


def describe(truth, pictures, frame, methods, rivals, corner):
    """What lies at a tile: the RMSE of every method there, the best of `rivals`, and the commonest class in each split."""
    x, y = corner
    tile = np.s_[y:y + TILE, x:x + TILE]
    judged = truth.judged[tile]
    errors = {}
    for method in methods:
        result = np.load(pictures / f"{method}_{frame:04d}.npy").astype(float)[tile]
        square = clean_square(result, truth.reference[tile], truth.half[tile])[judged].mean()
        errors[method] = float(np.sqrt(max(square, 0.0)))
    common = {split: names[int(np.bincount(truth.classes[split][tile][judged]).argmax())]
              for split, names in CLASSES.items() if split != "all"}
    return {"frame": frame, "x": x, "y": y, "rmse": errors, "best_other": min(rivals, key=errors.get, default=None), **common}


def picture(truth, pictures, place, baseline):
    """The square around a place: noisy, the baseline, the best other method and the reference, under one exposure."""
    x, y = place["x"] // SQUARE * SQUARE, place["y"] // SQUARE * SQUARE
    square = np.s_[y:y + SQUARE, x:x + SQUARE]
    judged = truth.judged[square][:, :, None]
    level = np.median(truth.reference[square][truth.judged[square]])
    exposure = 0.4 / max(level, 1e-4)
    named = {"noisy": truth.noisy[square]}
    for method in (baseline, place["best_other"]):
        if method:
            named[method] = np.load(pictures / f"{method}_{place['frame']:04d}.npy").astype(float)[square]
    named["reference"] = truth.reference[square]
    side = SQUARE * SCALE
    sheet = Image.new("RGB", ((side + 4) * len(named) - 4, side + 14), "white")
    draw = ImageDraw.Draw(sheet)
    for index, (name, light) in enumerate(named.items()):
        image = Image.fromarray(displayed(np.where(judged, light, np.nan), exposure))
        left = index * (side + 4)
        sheet.paste(image.resize((image.width * SCALE, image.height * SCALE), Image.NEAREST), (left, 14))
        draw.text((left + 2, 1), name, fill="black")
        tile = [left + (place["x"] - x) * SCALE, 14 + (place["y"] - y) * SCALE]
        draw.rectangle([*tile, tile[0] + TILE * SCALE - 1, tile[1] + TILE * SCALE - 1], outline=(255, 220, 0))
    return sheet


def overview(sheets, rows=5):
    """The pictures of several places in columns of `rows`."""
    width, height = max(s.width for s in sheets) + 10, max(s.height for s in sheets) + 6
    columns = -(-len(sheets) // rows)
    whole = Image.new("RGB", (columns * width, min(rows, len(sheets)) * height), "white")
    for index, sheet in enumerate(sheets):
        whole.paste(sheet, (index // rows * width, index % rows * height))
    return whole


def worst_places(sequence, pictures, frames, methods, baseline, rivals, count):
    """The worst places of a sequence by the baseline's error in its middle judged frame, described, with their pictures.

    rivals: the methods of which the best one at the place is shown beside the baseline"""
    frame = frames[len(frames) // 2]
    truth = frame_truth(sequence, pictures, frame)
    result = np.load(pictures / f"{baseline}_{frame:04d}.npy").astype(float)
    square = clean_square(result, truth.reference, truth.half)
    found = [describe(truth, pictures, frame, methods, rivals, corner) for corner in worst_tiles(square, truth.judged, count)]
    return [(place, picture(truth, pictures, place, baseline)) for place in found]
