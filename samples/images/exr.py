"""Reads what `walr` writes: OpenEXR files of scan lines, uncompressed or ZIP, by channel name."""
import struct
import zlib

import numpy as np

TYPES = {0: np.dtype("<u4"), 1: np.dtype("<f2"), 2: np.dtype("<f4")}
LINES_PER_BLOCK = {0: 1, 2: 1, 3: 16}  # Without compression; ZIP of single lines; ZIP of 16 lines.


def attributes(data):
    """The header's attributes by name, as bytes, and where the header ends."""
    found, at = {}, 8
    while data[at]:
        name, kind = (text.decode() for text in data[at:].split(b"\0", 2)[:2])
        at += len(name) + len(kind) + 2
        size, = struct.unpack_from("<i", data, at)
        found[name] = data[at + 4:at + 4 + size]
        at += 4 + size
    return found, at + 1


def channels_of(attribute):
    """Names and types of the channels, in the order of the file."""
    found = []
    while attribute[0]:
        name, attribute = attribute.split(b"\0", 1)
        found.append((name.decode(), TYPES[struct.unpack_from("<i", attribute)[0]]))
        attribute = attribute[16:]
    return found


def inflate(packed, size):
    """Undo ZIP as OpenEXR uses it: deflate, then differences of bytes, then halves that were interleaved."""
    if len(packed) == size:
        return packed
    delta = np.frombuffer(zlib.decompress(packed), np.uint8).astype(np.int64)
    delta[1:] -= 128
    ordered = np.cumsum(delta).astype(np.uint8)
    result = np.empty(size, np.uint8)
    half = (size + 1) // 2
    result[0::2], result[1::2] = ordered[:half], ordered[half:]
    return result.tobytes()


def read(path):
    """All channels of a file, each an array of height x width."""
    with open(path, "rb") as file:
        data = file.read()
    header, at = attributes(data)
    left, top, right, bottom = struct.unpack("<4i", header["dataWindow"])
    width, height = right - left + 1, bottom - top + 1
    compression = header["compression"][0]
    if compression not in LINES_PER_BLOCK:
        raise ValueError(f"{path}: compression {compression} is not read here; write it with none or ZIP")
    lines = LINES_PER_BLOCK[compression]
    channels = channels_of(header["channels"])
    images = {name: np.empty((height, width), np.float32) for name, _ in channels}
    for offset in struct.unpack_from(f"<{-(-height // lines)}Q", data, at):
        y, packed = struct.unpack_from("<2i", data, offset)
        y -= top
        count = min(lines, height - y)
        size = count * width * sum(kind.itemsize for _, kind in channels)
        block = data[offset + 8:offset + 8 + packed]
        if compression:
            block = inflate(block, size)
        position = 0
        for line in range(count):
            for name, kind in channels:
                images[name][y + line] = np.frombuffer(block, kind, width, position)
                position += width * kind.itemsize
    return images


def layer(images, name, letters="RGB"):
    """The channels of a layer as one array of double precision."""
    return np.stack([images[f"{name}.{c}"] for c in letters], axis=2).astype(float)


def colour(images, layer=""):
    """The channels R, G and B of a layer as one array."""
    prefix = layer + "." if layer else ""
    return np.stack([images[prefix + name] for name in "RGB"], axis=2)
