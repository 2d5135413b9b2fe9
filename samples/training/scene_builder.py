"""Adds random materials, meshes, lamps and a camera to a scene. Everything follows from a seed."""
import math
import pathlib
import random
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "scenes"))
from gltf_writer import Gltf, Mesh, png

FRAMES = 10
TEXELS = 64


class Builder:
    """Adds random things to a scene, away from the place where the camera walks."""

    def __init__(self, seed, name, sky):
        self.random = random.Random(seed)
        self.scene = Gltf(name, sky)
        self.count = 0

    def sky(self, radiance):
        """Another sky than that of the start."""
        self.scene.document["scenes"][0]["extras"]["sky_radiance"] = radiance

    def between(self, low, high):
        return self.random.uniform(low, high)

    def chance(self, share):
        return self.random.random() < share

    def colour(self):
        """A reflectance: mostly pale or brownish, now and then saturated."""
        value = self.between(0.2, 0.8)
        tint = 0.8 if self.chance(0.3) else 0.25
        return tuple(round(value * (1 - tint * self.random.random()), 3) for _ in range(3))

    def material(self):
        """A plain, patterned or bumpy material, and whether it needs texture coordinates."""
        kind = self.random.random()
        if kind < 0.55:
            return self.scene.material(f"plain {self.count}", self.colour()), False
        if kind < 0.8:
            picture = pattern(self.random, self.colour(), self.colour())
            return self.scene.material(f"pattern {self.count}", (1.0, 1.0, 1.0), picture=picture), True
        texture = self.scene.texture(f"bumps {self.count}", bumps(self.random))
        return self.scene.material(f"bumpy {self.count}", self.colour(), normalTexture={"index": texture}), True

    def add(self, mesh, material=None, **placement):
        self.count += 1
        number, textured = material or self.material()
        self.scene.mesh(f"thing {self.count}", mesh, number, textured, **placement)

    def lamp(self, mesh, strength):
        self.count += 1
        radiance = [round(strength * self.between(0.7, 1.0), 3) for _ in range(3)]
        self.scene.mesh(f"lamp {self.count}", mesh, self.scene.material(f"lamp {self.count}", (0.0, 0.0, 0.0), emission=radiance))


def pattern(rng, first, second):
    """Stripes, checks or blotches of two colours, as a PNG."""
    kind, size = rng.choice(["stripes", "checks", "blotches"]), rng.choice([4, 8, 16])
    wave = [(rng.uniform(1, 5), rng.uniform(1, 5), rng.uniform(0, 6.3)) for _ in range(4)]

    def share(x, y):
        if kind == "stripes":
            return (x // size) % 2
        if kind == "checks":
            return (x // size + y // size) % 2
        turns = 2 * math.pi / TEXELS
        return 0.5 + 0.125 * sum(math.sin(turns * (round(a) * x + round(b) * y) + c) for a, b, c in wave)

    def row(y):
        mixed = ((1 - s) * a + s * b for s in (share(x, y) for x in range(TEXELS)) for a, b in zip(first, second))
        return [round(255 * max(c, 0.0) ** (1 / 2.2)) for c in mixed]

    return png(TEXELS, TEXELS, [row(y) for y in range(TEXELS)], 3)


def bumps(rng):
    """A normal map of a sum of waves or of bricks, as a PNG."""
    wave = [(rng.randint(1, 6), rng.randint(1, 6), rng.uniform(0, 6.3), rng.uniform(0.05, 0.25)) for _ in range(5)]
    bricks = rng.choice([0, 8, 16])

    def slope(x, y):
        if bricks:
            offset = bricks if (y // bricks) % 2 else 0
            dx, dy = (x + offset) % (2 * bricks), y % bricks
            return (0.7 if dx == 0 else -0.7 if dx == 1 else 0.0), (0.7 if dy == 0 else -0.7 if dy == 1 else 0.0)
        turns = 2 * math.pi / TEXELS
        waves = [(a, b, h * math.cos(turns * (a * x + b * y) + c)) for a, b, c, h in wave]
        return sum(a * s for a, _, s in waves) / 3, sum(b * s for _, b, s in waves) / 3

    def texel(x, y):
        dx, dy = slope(x, y)
        length = math.sqrt(dx * dx + dy * dy + 1)
        return [round(127.5 + 127.5 * c / length) for c in (-dx, -dy, 1)]

    return png(TEXELS, TEXELS, [sum((texel(x, y) for x in range(TEXELS)), []) for y in range(TEXELS)], 3)


def wall(b, corner, along, up, material, opening=None):
    """A wall that faces cross(along, up), with a rectangular opening: its first and last share along and up."""
    mesh = Mesh()

    def part(a0, a1, v0, v1):
        start = tuple(corner[i] + a0 * along[i] + v0 * up[i] for i in range(3))
        mesh.quad(start, tuple((a1 - a0) * c for c in along), tuple((v1 - v0) * c for c in up), (4 * (a1 - a0), 3 * (v1 - v0)))

    if opening is None:
        part(0, 1, 0, 1)
    else:
        a0, a1, v0, v1 = opening
        part(0, a0, 0, 1), part(a1, 1, 0, 1), part(a0, a1, 0, v0), part(a0, a1, v1, 1)
    b.add(mesh, material)


def walk(b, position, target):
    """A camera that slides and turns at a constant, random speed; sometimes it stands still."""
    pace = 0.0 if b.chance(0.15) else b.between(0.0, 0.04)
    step = [b.between(-1, 1) * pace for _ in range(3)]
    swing = [b.between(-1, 1) * 1.5 * pace for _ in range(3)]

    def at(start, velocity, i):
        return tuple(round(c + v * i * (0.3 if axis == 1 else 1.0), 5) for axis, (c, v) in enumerate(zip(start, velocity)))

    b.scene.camera([at(position, step, i) for i in range(FRAMES)], [at(target, swing, i) for i in range(FRAMES)])
