"""Random indoor and outdoor scenes to train on. Everything follows from a seed; no built-in or measured scene is among them."""
import math
import pathlib
import random
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "scenes"))
from gltf_writer import Gltf, Mesh, png, turn

FRAMES = 10
TEXELS = 64


class Builder:
    """Adds random things to a scene, away from the place where the camera walks."""

    def __init__(self, seed, name, sky):
        self.random = random.Random(seed)
        self.scene = Gltf(name, sky)
        self.count = 0

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


def stairs(b, x, z):
    steps, rise, run, width = b.random.randint(3, 8), b.between(0.12, 0.22), b.between(0.2, 0.35), b.between(0.6, 1.6)
    mesh = Mesh()
    for i in range(steps):
        mesh.block((0, (i + 0.5) * rise, i * run), (width, rise, run))
    b.add(mesh, translation=[x, 0.0, z], rotation=turn((0.0, 1.0, 0.0), b.random.choice([0.0, 90.0, 180.0, 270.0]) + b.between(-10, 10)))


def fence(b, x, z):
    bars, pitch, thick, height = b.random.randint(6, 24), b.between(0.08, 0.2), b.between(0.015, 0.06), b.between(0.5, 1.6)
    mesh = Mesh()
    for i in range(bars):
        mesh.block(((i - 0.5 * bars) * pitch, 0.5 * height, 0), (thick, height, thick))
    for y in (0.2, 0.85):
        mesh.block((0, y * height, 0), (bars * pitch, thick, 0.5 * thick))
    b.add(mesh, translation=[x, 0.0, z], rotation=turn((0.0, 1.0, 0.0), b.between(0, 180)))


def boxes(b, x, z):
    mesh, y = Mesh(), 0.0
    for _ in range(b.random.randint(1, 3)):
        size = (b.between(0.15, 0.9), b.between(0.1, 0.9), b.between(0.15, 0.9))
        mesh.block((b.between(-0.1, 0.1), y + 0.5 * size[1], b.between(-0.1, 0.1)), size, b.between(0, 90))
        y += size[1]
    b.add(mesh, translation=[x, 0.0, z])


def table(b, x, z):
    width, depth, height, leg = b.between(0.5, 1.6), b.between(0.4, 1.0), b.between(0.35, 0.9), b.between(0.03, 0.08)
    mesh = Mesh().block((0, height, 0), (width, 0.04, depth))
    for i in (-1, 1):
        for j in (-1, 1):
            mesh.block((i * (0.5 * width - leg), 0.5 * height, j * (0.5 * depth - leg)), (leg, height, leg))
    for _ in range(b.random.randint(0, 3)):
        size = b.between(0.06, 0.25)
        mesh.block((b.between(-0.3, 0.3) * width, height + 0.02 + 0.5 * size, b.between(-0.3, 0.3) * depth), (size, size, size), b.between(0, 90))
    b.add(mesh, translation=[x, 0.0, z], rotation=turn((0.0, 1.0, 0.0), b.between(0, 180)))


def turned(b, x, z):
    """A column, pot or ball on a foot: a body of revolution."""
    height, y, profile = b.between(0.3, 2.6), 0.0, [(0.0, 0.0)]
    radius = b.between(0.08, 0.35)
    for _ in range(b.random.randint(2, 6)):
        profile.append((radius * b.between(0.5, 1.2), round(y, 4)))
        y += height * b.between(0.1, 0.4)
    profile += [(radius * b.between(0.3, 1.0), y), (0.0, y)]
    b.add(Mesh().lathe((0, 0, 0), profile, b.random.choice([6, 12, 20])), translation=[x, 0.0, z])


def cloth(b, x, z):
    """A hanging, wavy surface."""
    width, height, depth, folds = b.between(0.6, 1.8), b.between(0.8, 2.2), b.between(0.02, 0.12), b.between(2, 8)
    twist = b.between(0, 3)

    def point(u, v):
        return (width * (u - 0.5), height * v, depth * math.sin(2 * math.pi * folds * u + twist * v) * (1.1 - v))

    b.add(Mesh().surface(point, 48, 12), translation=[x, 0.0, z], rotation=turn((0.0, 1.0, 0.0), b.between(0, 360)))


def cards(b, x, z):
    """A plant of crossing cards."""
    mesh = Mesh()
    for _ in range(b.random.randint(8, 30)):
        angle, rise, size = b.between(0, 6.3), b.between(0.1, 1.2), b.between(0.08, 0.3)
        out, side = (math.cos(angle), b.between(-0.4, 0.8), math.sin(angle)), (-math.sin(angle), b.between(-0.3, 0.3), math.cos(angle))
        near = b.between(0.0, 0.25)
        corner = tuple(near * o - 0.5 * size * s + (rise if i == 1 else 0) for i, (o, s) in enumerate(zip(out, side)))
        mesh.quad(corner, tuple(size * s for s in side), tuple(1.4 * size * o for o in out))
    mesh.block((0, 0.5, 0), (0.04, 1.0, 0.04))
    b.add(mesh, translation=[x, 0.0, z])


def rock(b, x, z):
    """A bumpy ball."""
    radius = [b.between(0.15, 0.6) for _ in range(3)]
    waves = [(b.random.randint(1, 5), b.random.randint(1, 5), b.between(0, 6.3)) for _ in range(4)]

    def point(u, v):
        around, up = 2 * math.pi * u, math.pi * (v - 0.5)
        swell = 1 + 0.06 * sum(math.cos(up) * math.sin(i * around + j * up + c) for i, j, c in waves)
        return (swell * radius[0] * math.cos(up) * math.sin(around), radius[1] + swell * radius[1] * math.sin(up),
                swell * radius[2] * math.cos(up) * math.cos(around))

    b.add(Mesh().surface(point, 28, 14, closed=True), translation=[x, 0.0, z])


THINGS = [boxes, boxes, table, stairs, fence, turned, turned, cloth, cards, rock]


def scatter(b, count, width, depth, camera):
    """Things on the ground, none within 1.1 m of where the camera starts."""
    placed = 0
    while placed < count:
        x, z = b.between(-0.5, 0.5) * width, b.between(-0.5, 0.5) * depth
        if math.hypot(x - camera[0], z - camera[2]) < 1.1:
            continue
        b.random.choice(THINGS)(b, round(x, 3), round(z, 3))
        placed += 1


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


def indoor(seed):
    rng = random.Random(seed)
    sun = rng.random() < 0.6
    sky = [round(rng.uniform(0.05, 0.4) * c, 3) for c in (0.8, 1.0, 1.3)] if sun else [0.0, 0.0, 0.0]
    b = Builder(seed, f"indoor {seed}", sky)
    width, depth, height = b.between(3, 8), b.between(3, 8), b.between(2.2, 4.5)
    x, z = 0.5 * width, 0.5 * depth
    window = (b.between(0.15, 0.45), b.between(0.55, 0.85), b.between(0.2, 0.45), b.between(0.7, 0.95)) if sun else None
    plaster = b.material()
    other = b.material() if b.chance(0.4) else plaster
    wall(b, (-x, 0, -z), (width, 0, 0), (0, height, 0), plaster)
    wall(b, (x, 0, z), (-width, 0, 0), (0, height, 0), plaster)
    wall(b, (-x, 0, z), (0, 0, -depth), (0, height, 0), other, window)
    wall(b, (x, 0, -z), (0, 0, depth), (0, height, 0), b.material() if b.chance(0.4) else other)
    wall(b, (-x, 0, z), (width, 0, 0), (0, 0, -depth), b.material())
    wall(b, (-x, height, -z), (width, 0, 0), (0, 0, depth), plaster)
    if sun:
        strength = b.between(6, 25)
        target = (b.between(-0.3, 0.3) * width, 0.0, b.between(-0.3, 0.3) * depth)
        middle = (-x, height * 0.5 * (window[2] + window[3]), z - 0.5 * (window[0] + window[1]) * depth)
        away = tuple(m + 3 * (m - t) for m, t in zip(middle, target))
        b.scene.sun((strength, 0.95 * strength, 0.85 * strength), away, target)
        if b.chance(0.5):
            bars, span = Mesh(), (window[1] - window[0]) * depth
            for i in range(b.random.randint(2, 7)):
                bars.block((-x, height * 0.5 * (window[2] + window[3]), z - window[0] * depth - (i + 0.5) * span / 7), (0.04, height, 0.04))
            b.add(bars)
    for _ in range(b.random.randint(0, 2) if sun else b.random.randint(1, 3)):
        size = b.between(0.15, 1.0)
        place = (b.between(-0.8, 0.8) * (x - size), height - b.between(0.01, 0.6), b.between(-0.8, 0.8) * (z - size))
        b.lamp(Mesh().block(place, (size, 0.05, size * b.between(0.2, 1.0)), b.between(0, 90)), b.between(3, 12) / size)
    camera = (b.between(-0.8, 0.8) * (x - 0.4), b.between(0.8, 1.8), z - 0.5)
    scatter(b, b.random.randint(9, 22), 0.85 * width, 0.85 * depth, camera)
    walk(b, camera, (b.between(-0.5, 0.5) * x, b.between(0.2, 1.3), b.between(-0.8, 0.0) * z))
    return b.scene


def outdoor(seed):
    rng = random.Random(seed)
    bright = rng.uniform(0.4, 1.6)
    b = Builder(seed, f"outdoor {seed}", [round(bright * c, 3) for c in (0.75, 1.0, 1.4)])
    strength = b.between(3, 14)
    b.scene.sun((strength, 0.92 * strength, 0.78 * strength), (b.between(-5, 5), b.between(2.5, 7), b.between(-5, 5)), (0.0, 0.0, 0.0))
    wall(b, (-15, 0, 15), (30, 0, 0), (0, 0, -30), b.material())
    camera = (b.between(-2, 2), b.between(0.8, 2.2), b.between(2.5, 5))
    for _ in range(b.random.randint(1, 4)):
        house(b, b.between(-6, 6), -b.between(1.5, 7))
    if b.chance(0.5):
        arcade(b, b.between(-2, 2), b.between(-2.5, 0.5))
    scatter(b, b.random.randint(12, 26), 7.0, 7.0, camera)
    walk(b, camera, (b.between(-2, 2), b.between(0.3, 1.6), b.between(-4, -1)))
    return b.scene


def house(b, x, z):
    width, height, depth = b.between(1.5, 5), b.between(1.5, 5), b.between(1, 3)
    mesh = Mesh().block((0, 0.5 * height, 0), (width, height, depth)).block((0, height, 0.1), (width + 0.3, 0.15, depth + 0.4))
    for i in range(b.random.randint(0, 4)):
        place = (b.between(-0.4, 0.4) * width, b.between(0.3, 0.8) * height, 0.5 * depth)
        mesh.block(place, (b.between(0.3, 0.9), b.between(0.1, 0.9), b.between(0.05, 0.5)))
    b.add(mesh, translation=[round(x, 3), 0.0, round(z, 3)], rotation=turn((0.0, 1.0, 0.0), b.between(-40, 40)))


def arcade(b, x, z):
    """Columns with a roof over them."""
    count, pitch, radius, height = b.random.randint(3, 7), b.between(0.6, 1.3), b.between(0.08, 0.25), b.between(1.6, 3.2)
    mesh = Mesh()
    for i in range(count):
        for side in (-0.7, 0.7):
            at = ((i - 0.5 * (count - 1)) * pitch, 0.0, side)
            mesh.lathe(at, [(1.4 * radius, 0.0), (1.4 * radius, 0.12), (radius, 0.2), (0.85 * radius, height - 0.2), (1.4 * radius, height)], 12)
    mesh.block((0, height + 0.1, 0), (count * pitch, 0.2, 2.0))
    b.add(mesh, translation=[round(x, 3), 0.0, round(z, 3)], rotation=turn((0.0, 1.0, 0.0), b.between(-30, 30)))


def random_scene(seed):
    """The scene of a seed: two of three are indoors, as the text of a glTF file."""
    return (outdoor if seed % 3 == 2 else indoor)(seed).text()
