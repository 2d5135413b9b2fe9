"""Random things that stand on the ground of a scene."""
import math
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "scenes"))
from gltf_writer import Mesh, turn


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


def scatter(b, count, width, depth, camera, kinds=THINGS, clear=1.1):
    """Things on the ground, none within `clear` metres of where the camera starts."""
    placed = 0
    while placed < count:
        x, z = b.between(-0.5, 0.5) * width, b.between(-0.5, 0.5) * depth
        if math.hypot(x - camera[0], z - camera[2]) < clear:
            continue
        b.random.choice(kinds)(b, round(x, 3), round(z, 3))
        placed += 1
