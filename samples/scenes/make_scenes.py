#!/usr/bin/env python3
"""Writes the built-in scenes, box.gltf and turntable.gltf, to the folder of this script.

    make_scenes.py           write the files
    make_scenes.py --check   fail if the files differ from what this script writes

Needs Python only. Units and conventions are those of samples/render/load_scene.h: metres, +Y up, radiometric
light units, 24 frames a second.
"""

import argparse
import base64
import json
import math
import pathlib
import struct
import sys
import zlib

FPS = 24.0


def png(width, height, rows, channels):
    """A PNG image whose data are stored uncompressed, so that the bytes do not depend on the zlib version."""

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    color_type = {3: 2, 4: 6}[channels]
    raw = b"".join(b"\0" + bytes(row) for row in rows)
    header = struct.pack(">IIBBBBB", width, height, 8, color_type, 0, 0, 0)
    # One stored deflate block holds at most 65535 bytes.
    assert len(raw) <= 65535
    stored = b"\x78\x01\x01" + struct.pack("<HH", len(raw), 0xFFFF - len(raw)) + raw
    stored += struct.pack(">I", zlib.adler32(raw))
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", stored) + chunk(b"IEND", b"")


def tile_normal_map(size=64, bevel=6):
    """One tile with slanted edges, as a normal map (green up)."""

    def slope(i):
        if i < bevel:
            return -1.0
        return 1.0 if i >= size - bevel else 0.0

    def encode(x, y):
        length = math.sqrt(x * x + y * y + 1.0)
        return [round(127.5 + 127.5 * c / length) for c in (x, y, 1.0)]

    # Row 0 is the top of the image; the left edge faces left, the top edge faces up.
    return png(size, size, [sum((encode(0.6 * slope(x), -0.6 * slope(y)) for x in range(size)), []) for y in range(size)], 3)


def perforation(size=32):
    """A plate with a round hole, in the alpha channel."""

    def texel(x, y):
        dx, dy = x + 0.5 - size / 2, y + 0.5 - size / 2
        return [200, 170, 110, 0 if dx * dx + dy * dy < (0.36 * size) ** 2 else 255]

    return png(size, size, [sum((texel(x, y) for x in range(size)), []) for y in range(size)], 4)


class Mesh:
    """Triangles with hard edges: faces share no vertices."""

    def __init__(self):
        self.positions, self.normals, self.uvs, self.indices = [], [], [], []

    def quad(self, corner, u, v, tiles=(1.0, 1.0)):
        """A parallelogram whose front faces cross(u, v). The texture repeats `tiles` times; its top points along v."""
        normal = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
        length = math.sqrt(sum(c * c for c in normal))
        first = len(self.positions)
        for a, b in ((0, 0), (1, 0), (1, 1), (0, 1)):
            self.positions.append(tuple(corner[i] + a * u[i] + b * v[i] for i in range(3)))
            self.normals.append(tuple(c / length for c in normal))
            self.uvs.append((a * tiles[0], (1 - b) * tiles[1]))
        self.indices += [first, first + 1, first + 2, first, first + 2, first + 3]

    def block(self, center, size, degrees=0.0):
        """A box turned about the vertical axis."""
        cosine, sine = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
        x = (cosine * size[0], 0.0, -sine * size[0])
        y = (0.0, size[1], 0.0)
        z = (sine * size[2], 0.0, cosine * size[2])

        def corner(a, b, c):
            return tuple(center[i] + (a - 0.5) * x[i] + (b - 0.5) * y[i] + (c - 0.5) * z[i] for i in range(3))

        def minus(v):
            return tuple(-c for c in v)

        self.quad(corner(0, 0, 1), x, y)
        self.quad(corner(1, 0, 0), minus(x), y)
        self.quad(corner(1, 0, 1), minus(z), y)
        self.quad(corner(0, 0, 0), z, y)
        self.quad(corner(0, 1, 1), x, minus(z))
        self.quad(corner(0, 0, 0), x, z)
        return self


class Gltf:
    """Collects a scene and turns it into the text of one glTF file with an embedded buffer."""

    def __init__(self, name, sky):
        self.buffer = bytearray()
        self.document = {
            "asset": {"version": "2.0", "generator": "samples/scenes/make_scenes.py"},
            "extensionsUsed": ["KHR_materials_emissive_strength"],
            "scene": 0,
            "scenes": [{"name": name, "nodes": [], "extras": {"sky_radiance": sky}}],
            "nodes": [],
            "meshes": [],
            "materials": [],
            "accessors": [],
            "bufferViews": [],
        }

    def add(self, kind, value):
        entries = self.document.setdefault(kind, [])
        entries.append(value)
        return len(entries) - 1

    def view(self, data):
        while len(self.buffer) % 4:
            self.buffer.append(0)
        self.buffer += data
        return self.add("bufferViews", {"buffer": 0, "byteOffset": len(self.buffer) - len(data), "byteLength": len(data)})

    def floats(self, rows, kind, bounds=False):
        accessor = {"componentType": 5126, "count": len(rows), "type": kind}
        packed = [struct.pack(f"<{len(row)}f", *row) for row in rows]
        accessor["bufferView"] = self.view(b"".join(packed))
        if bounds:
            columns = list(zip(*(struct.unpack(f"<{len(rows[0])}f", row) for row in packed)))
            accessor["min"], accessor["max"] = [min(c) for c in columns], [max(c) for c in columns]
        return self.add("accessors", accessor)

    def texture(self, name, picture):
        image = self.add("images", {"name": name, "mimeType": "image/png", "bufferView": self.view(picture)})
        sampler = self.add("samplers", {"magFilter": 9729, "minFilter": 9729, "wrapS": 10497, "wrapT": 10497})
        return self.add("textures", {"source": image, "sampler": sampler})

    def material(self, name, color, emission=None, picture=None, **properties):
        """A Lambert material. `picture`: PNG that multiplies the colour; `emission`: radiance, from the front only."""
        material = {
            "name": name,
            "doubleSided": emission is None,
            "pbrMetallicRoughness": {"baseColorFactor": [*color, 1.0], "metallicFactor": 0.0, "roughnessFactor": 1.0},
            **properties,
        }
        if picture is not None:
            material["pbrMetallicRoughness"]["baseColorTexture"] = {"index": self.texture(name, picture)}
        if emission is not None:
            strength = max(emission)
            material["emissiveFactor"] = [c / strength for c in emission]
            material["extensions"] = {"KHR_materials_emissive_strength": {"emissiveStrength": strength}}
        return self.add("materials", material)

    def mesh(self, name, mesh, material, textured=False, parent=None, **placement):
        attributes = {
            "POSITION": self.floats(mesh.positions, "VEC3", bounds=True),
            "NORMAL": self.floats(mesh.normals, "VEC3"),
        }
        if textured:
            attributes["TEXCOORD_0"] = self.floats(mesh.uvs, "VEC2")
        view = self.view(struct.pack(f"<{len(mesh.indices)}H", *mesh.indices))
        indices = self.add("accessors", {"componentType": 5123, "count": len(mesh.indices), "type": "SCALAR", "bufferView": view})
        index = self.add("meshes", {"name": name, "primitives": [{"attributes": attributes, "indices": indices, "material": material}]})
        return self.node({"name": name, "mesh": index, **placement}, parent)

    def node(self, node, parent=None):
        index = self.add("nodes", node)
        siblings = self.document["scenes"][0]["nodes"] if parent is None else self.document["nodes"][parent].setdefault("children", [])
        siblings.append(index)
        return index

    def animate(self, node, path, keys):
        """Adds a channel with one key per frame, from frame 0."""
        animation = self.document.setdefault("animations", [{"samplers": [], "channels": []}])[0]
        times = self.floats([(i / FPS,) for i in range(len(keys))], "SCALAR", bounds=True)
        output = self.floats(keys, "VEC4" if path == "rotation" else "VEC3")
        animation["samplers"].append({"input": times, "output": output, "interpolation": "LINEAR"})
        animation["channels"].append({"sampler": len(animation["samplers"]) - 1, "target": {"node": node, "path": path}})

    def camera(self, positions, targets, name="camera"):
        """A camera with one position and one target per frame."""
        camera = self.add("cameras", {"name": name, "type": "perspective",
                                      "perspective": {"yfov": 0.8, "aspectRatio": 16 / 9, "znear": 0.05, "zfar": 50.0}})
        rotations = [look_at(p, t) for p, t in zip(positions, targets)]
        node = self.node({"name": name, "camera": camera, "translation": positions[0], "rotation": rotations[0]})
        self.animate(node, "translation", positions)
        self.animate(node, "rotation", rotations)

    def text(self):
        """The document with one line per entry of each of its lists: a change of one node changes one line."""

        def lines(value):
            if not isinstance(value, list):
                return json.dumps(value)
            return "[\n  " + ",\n  ".join(map(json.dumps, value)) + "\n ]"

        data = base64.b64encode(bytes(self.buffer)).decode()
        self.document["buffers"] = [{"byteLength": len(self.buffer), "uri": "data:application/octet-stream;base64," + data}]
        return "{\n " + ",\n ".join(f'"{key}": {lines(value)}' for key, value in self.document.items()) + "\n}\n"


def turn(axis, degrees):
    """A quaternion x, y, z, w."""
    half = math.radians(degrees) / 2
    return tuple(round(c * math.sin(half), 7) for c in axis) + (round(math.cos(half), 7),)


def look_at(position, target):
    """The rotation that turns -Z towards the target without roll, as a quaternion x, y, z, w."""
    dx, dy, dz = (t - p for t, p in zip(target, position))
    yaw = math.atan2(-dx, -dz)
    pitch = math.atan2(dy, math.hypot(dx, dz))
    cy, sy, cp, sp = math.cos(yaw / 2), math.sin(yaw / 2), math.cos(pitch / 2), math.sin(pitch / 2)
    return tuple(round(c, 7) for c in (cy * sp, sy * cp, -sy * sp, cy * cp))


def room(scene, tiles):
    """A room of 4 x 2.6 x 5 m with coloured side walls, a lamp under the ceiling, and a barred window to the sky."""
    white = scene.material("white", (0.73, 0.73, 0.73))
    red = scene.material("red", (0.65, 0.06, 0.05))
    green = scene.material("green", (0.13, 0.48, 0.15))
    shell = Mesh()
    shell.quad((-2, 0, 2.5), (4, 0, 0), (0, 0, -5))
    shell.quad((-2, 2.6, -2.5), (4, 0, 0), (0, 0, 5))
    shell.quad((2, 0, 2.5), (-4, 0, 0), (0, 2.6, 0))
    scene.mesh("floor, ceiling and front", shell, white)
    back = Mesh()
    back.quad((-2, 0, -2.5), (4, 0, 0), (0, 2.6, 0), tiles=(10.0, 6.5))
    scene.mesh("tiled wall", back, tiles, textured=True)
    left = Mesh()
    left.quad((-2, 0, 2.5), (0, 0, -5), (0, 2.6, 0))
    scene.mesh("red wall", left, red)
    # The window leaves x = 2, y 0.9 to 2.1, z -1.6 to -0.2 open.
    right = Mesh()
    right.quad((2, 0, -2.5), (0, 0, 5), (0, 0.9, 0))
    right.quad((2, 2.1, -2.5), (0, 0, 5), (0, 0.5, 0))
    right.quad((2, 0.9, -2.5), (0, 0, 0.9), (0, 1.2, 0))
    right.quad((2, 0.9, -0.2), (0, 0, 2.7), (0, 1.2, 0))
    scene.mesh("green wall with a window", right, green)
    bars = Mesh()
    for i in range(6):
        bars.block((1.99, 1.5, -1.4 + 0.2 * i), (0.016, 1.2, 0.016))
    scene.mesh("window bars", bars, scene.material("iron", (0.2, 0.2, 0.22)))
    lamp = Mesh()
    lamp.quad((-0.65, 2.57, -0.15), (0.3, 0, 0), (0, 0, 0.3))
    scene.mesh("lamp", lamp, scene.material("lamp", (0.0, 0.0, 0.0), emission=(34.0, 28.0, 20.0)))


def make_box():
    """Colour bleeding, a small lamp, thin bars, a perforated plate, a normal-mapped wall, sky behind a window."""
    scene = Gltf("box", [1.6, 2.1, 2.8])
    tiles = scene.material("tiles", (0.7, 0.69, 0.63), normalTexture={"index": scene.texture("tile", tile_normal_map())})
    room(scene, tiles)
    scene.mesh("tall block", Mesh().block((-0.85, 0.7, -1.3), (0.7, 1.4, 0.7), 18.0), scene.material("plaster", (0.75, 0.75, 0.75)))
    scene.mesh("blue block", Mesh().block((0.75, 0.3, -1.0), (0.7, 0.6, 0.7), -20.0), scene.material("blue", (0.2, 0.34, 0.7)))
    fence = Mesh()
    for i in range(12):
        fence.block((-1.6 + 0.14 * i, 0.4, 0.25), (0.03, 0.8, 0.012))
    fence.block((-0.83, 0.2, 0.235), (1.7, 0.04, 0.012))
    fence.block((-0.83, 0.65, 0.235), (1.7, 0.04, 0.012))
    scene.mesh("fence", fence, scene.material("wood", (0.8, 0.68, 0.4)))
    plate = Mesh()
    plate.quad((0.55, 1.05, -0.6), (0.9, 0, 0.2), (0, 0.8, 0), tiles=(9.0, 8.0))
    brass = scene.material("brass", (1.0, 1.0, 1.0), picture=perforation(), alphaMode="MASK", alphaCutoff=0.5)
    scene.mesh("perforated plate", plate, brass, textured=True)

    # The camera stands still in frames 0 to 3, then moves to the right and keeps looking at the middle of the room.
    steps = [max(0, i - 3) for i in range(48)]
    scene.camera([(round(-0.9 + 0.04 * s, 6), 1.45, round(2.3 - 0.012 * s, 6)) for s in steps],
                 [(round(-0.15 + 0.012 * s, 6), 1.05, -1.2) for s in steps])
    # Each of the other cameras looks at one object and moves from the start.
    frames = range(48)
    scene.camera([(round(-1.5 + 0.02 * i, 6), 0.75, 1.25) for i in frames],
                 [(round(-1.1 + 0.015 * i, 6), 0.45, 0.25) for i in frames], "fence")
    scene.camera([(round(0.7 - 0.02 * i, 6), 1.5, -1.3) for i in frames],
                 [(round(0.1 - 0.02 * i, 6), 1.6, -2.5) for i in frames], "tiled wall")
    scene.camera([(1.0, 1.6, round(-2.0 + 0.012 * i, 6)) for i in frames],
                 [(2.0, 1.5, round(-1.0 + 0.006 * i, 6)) for i in frames], "window")
    return scene


def make_turntable():
    """Moving objects, one on a turntable and one that slides, seen by a camera that first stands still."""
    scene = Gltf("turntable", [1.6, 2.1, 2.8])
    room(scene, scene.material("plaster", (0.7, 0.69, 0.63)))
    blue = scene.material("blue", (0.2, 0.34, 0.7))
    wood = scene.material("wood", (0.8, 0.68, 0.4))
    table = scene.node({"name": "turntable", "translation": [-0.4, 0.0, -0.7], "rotation": [0.0, 0.0, 0.0, 1.0]})
    scene.mesh("turning block", Mesh().block((0.0, 0.5, 0.0), (0.5, 1.0, 0.5), 10.0), blue, parent=table)
    bars = Mesh()
    for i in range(5):
        bars.block((0.0, 0.35, 0.0), (0.03, 0.7, 0.03))
        bars.positions[-24:] = [(x + 0.55 + 0.08 * i, y, z) for x, y, z in bars.positions[-24:]]
    scene.mesh("turning bars", bars, wood, parent=table)
    slider = scene.mesh("sliding block", Mesh().block((0.0, 0.2, 0.0), (0.4, 0.4, 0.4)), wood, translation=[0.9, 0.0, -0.2])
    frames = 48
    scene.animate(table, "rotation", [turn((0.0, 1.0, 0.0), 3.0 * i) for i in range(frames)])
    scene.animate(slider, "translation", [(round(0.9 - 0.03 * i, 6), 0.0, -0.2) for i in range(frames)])
    steps = [max(0, i - 11) for i in range(frames)]
    scene.camera([(round(0.2 - 0.03 * s, 6), 1.4, 2.3) for s in steps], [(0.0, 0.7, -0.8)] * frames)
    return scene


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true", help="compare the files with what this script would write")
    check = parser.parse_args().check
    folder = pathlib.Path(__file__).resolve().parent
    stale = []
    for name, make in (("box", make_box), ("turntable", make_turntable)):
        file = folder / f"{name}.gltf"
        text = make().text()
        if not check:
            file.write_text(text, encoding="utf-8")
        elif not file.exists() or file.read_text(encoding="utf-8") != text:
            stale.append(file.name)
    if stale:
        sys.exit(f"{', '.join(stale)}: differs from what {pathlib.Path(__file__).name} writes; run it again")


if __name__ == "__main__":
    main()
