"""Meshes, pictures and glTF files of the built-in scenes. Needs Python only; all bytes are the same on every machine."""

import base64
import json
import math
import struct
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

    def surface(self, point, columns, rows, closed=False):
        """A smooth surface of (columns x rows) quads. point(u, v), with u and v in 0..1, gives a position; the front faces
        cross(d/du, d/dv). `closed`: u = 0 and u = 1 are the same line."""
        first, step = len(self.positions), 1e-4

        def slope(u, v, du, dv):
            ahead, behind = point(u + du, v + dv), point(u - du, v - dv)
            return tuple(a - b for a, b in zip(ahead, behind))

        for row in range(rows + 1):
            for column in range(columns + 1):
                u, v = column / columns, row / rows
                # At the ends of an open surface, slopes are taken a little inside, where `point` is defined.
                inside_u = u if closed else min(max(u, step), 1 - step)
                inside_v = min(max(v, step), 1 - step)
                a, b = slope(inside_u, inside_v, step, 0), slope(inside_u, inside_v, 0, step)
                normal = (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])
                length = math.sqrt(sum(c * c for c in normal))
                self.positions.append(tuple(round(c, 6) for c in point(u, v)))
                self.normals.append(tuple(round(c / length, 6) for c in normal))
                self.uvs.append((u, 1 - v))
        for row in range(rows):
            for column in range(columns):
                corner = first + row * (columns + 1) + column
                above = corner + columns + 1
                self.indices += [corner, corner + 1, above + 1, corner, above + 1, above]
        return self

    def lathe(self, center, profile, sides=16):
        """A body of revolution about the vertical axis through `center`. `profile`: radius and height of each ring, such that
        the body is to the right of the path. Every part between two rings is smooth around the axis and has its own normals
        along it, so that rims are sharp."""
        for (r0, y0), (r1, y1) in zip(profile, profile[1:]):
            def point(u, v, r0=r0, y0=y0, r1=r1, y1=y1):
                angle, radius = 2 * math.pi * u, r0 + (r1 - r0) * v
                return (center[0] + radius * math.sin(angle), center[1] + y0 + (y1 - y0) * v, center[2] + radius * math.cos(angle))

            self.surface(point, sides, 1, closed=True)
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
        """A node with a mesh of its own."""
        return self.place(name, self.shape(name, mesh, material, textured), parent, **placement)

    def place(self, name, shape, parent=None, **placement):
        """A node that shows a mesh of `shape`, which several nodes may share."""
        return self.node({"name": name, "mesh": shape, **placement}, parent)

    def shape(self, name, mesh, material, textured=False):
        attributes = {
            "POSITION": self.floats(mesh.positions, "VEC3", bounds=True),
            "NORMAL": self.floats(mesh.normals, "VEC3"),
        }
        if textured:
            attributes["TEXCOORD_0"] = self.floats(mesh.uvs, "VEC2")
        view = self.view(struct.pack(f"<{len(mesh.indices)}H", *mesh.indices))
        indices = self.add("accessors", {"componentType": 5123, "count": len(mesh.indices), "type": "SCALAR", "bufferView": view})
        return self.add("meshes", {"name": name, "primitives": [{"attributes": attributes, "indices": indices, "material": material}]})

    def sun(self, irradiance, position, target):
        """A directional light that shines from `position` to `target`."""
        self.document["extensionsUsed"].append("KHR_lights_punctual")
        strength = max(irradiance)
        light = {"name": "sun", "type": "directional", "intensity": strength, "color": [c / strength for c in irradiance]}
        self.document["extensions"] = {"KHR_lights_punctual": {"lights": [light]}}
        self.node({"name": "sun", "rotation": look_at(position, target), "extensions": {"KHR_lights_punctual": {"light": 0}}})

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
