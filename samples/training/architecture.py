"""Random curved and ornamented architecture: a hall or a court between walls of arches, with reliefs, balustrades and vaults.

It resembles no built-in or measured scene: all sizes, counts and shapes come from the seed."""
import math
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "scenes"))
from gltf_writer import Mesh, turn
from scene_builder import Builder, walk, wall
from things import boxes, cards, fence, rock, scatter, table, turned


def column(b, mesh, x, z, radius, height, flutes):
    """A column with flutes, a foot and a capital. It thins towards its top."""
    foot, capital = 0.06 * height, 0.1 * height

    def shaft(u, v):
        angle = 2 * math.pi * u
        r = radius * (1 - 0.2 * v) * (1 - (0.08 * abs(math.sin(0.5 * flutes * angle)) if flutes else 0.0))
        return (x + r * math.sin(angle), foot + v * (height - foot - capital), z + r * math.cos(angle))

    mesh.surface(shaft, 3 * flutes if flutes else 16, 2, closed=True)
    rings = [(1.5, 0.0), (1.5, 0.5 * foot), (1.2, 0.5 * foot), (1.2, foot), (0.0, foot)]
    mesh.lathe((x, 0, z), [(r * radius, y) for r, y in rings], 12)
    rings = [(0.8, 0.0), (1.1, 0.3 * capital), (0.9, 0.35 * capital), (1.5, capital)]
    mesh.lathe((x, height - capital, z), [(r * radius, y) for r, y in rings], 12)


def arch_wall(mesh, bays, pitch, pier, spring, height, thickness, pointed):
    """A wall along x, from z = 0 to -thickness, open below an arch in each of its bays. Arches are round or pointed."""
    half = 0.5 * (pitch - pier)
    rise = min(half * (1.5 if pointed else 1.0), height - spring - 0.05)

    def curve(u):
        side = 1 - 2 * u
        return half * side, spring + rise * (1 - abs(side) ** (1.3 if pointed else 2)) ** (1.0 if pointed else 0.5)

    for i in range(bays):
        middle = (i - 0.5 * (bays - 1)) * pitch

        def front(u, v, middle=middle):
            x, y = curve(1 - u)
            return (middle + x, y + v * (height - y), 0.0)

        def back(u, v, middle=middle):
            x, y = curve(u)
            return (middle + x, y + v * (height - y), -thickness)

        def under(u, v, middle=middle):
            x, y = curve(u)
            return (middle + x, y, -thickness * v)

        for face in (front, back):
            mesh.surface(face, 16, 2)
        mesh.surface(under, 16, 1)
    for i in range(bays + 1):
        mesh.block(((i - 0.5 * bays) * pitch, 0.5 * height, -0.5 * thickness), (pier, height, thickness))


def colonnade(b, mesh, bays, pitch, spring, radius, z):
    """Columns in front of the piers, as high as the lower ends of the arches."""
    flutes = b.random.choice([0, 0, 8, 12])
    for i in range(bays + 1):
        column(b, mesh, (i - 0.5 * bays) * pitch, z, radius, spring, flutes)


def balustrade(b, mesh, x0, x1, y, z):
    """A row of small turned posts under a rail."""
    height, radius = b.between(0.5, 0.9), b.between(0.03, 0.07)
    profile = [(radius * b.between(0.5, 1.2), height * i / 5) for i in range(6)]
    count = max(2, min(20, int((x1 - x0) / (4 * radius))))
    for i in range(count):
        mesh.lathe((x0 + (i + 0.5) * (x1 - x0) / count, y, z), profile, 6)
    mesh.block((0.5 * (x0 + x1), y + height + 0.03, z), (x1 - x0, 0.06, 2.5 * radius))


def cornice(b, mesh, length, y, z):
    """Mouldings along x: steps and rounds that stand out of a wall at z."""
    out = 0.0
    for _ in range(b.random.randint(2, 4)):
        size = b.between(0.03, 0.12)
        out += b.between(0.2, 0.8) * size
        if b.chance(0.5):
            mesh.block((0, y + 0.5 * size, z + 0.5 * out), (length, size, out))
        else:
            def half_round(u, v, y=y, out=out, size=size):
                angle = math.pi * (v - 0.5)
                return (length * (u - 0.5), y + 0.5 * size * (1 + math.sin(angle)), z + out + 0.5 * size * math.cos(angle))
            mesh.surface(half_round, 1, 8)
        y += size


def relief(b, width, height, **placement):
    """A panel with an ornament in relief: waves, leaves of a rosette, or knobs."""
    kind, depth = b.random.choice(["waves", "rosette", "knobs"]), b.between(0.02, 0.1)
    around, rows, columns = b.random.randint(4, 9), b.random.randint(1, 4), b.random.randint(1, 6)
    phase = b.between(0, 6.3)

    def rise(u, v):
        if kind == "waves":
            return 0.5 + 0.5 * math.sin(2 * math.pi * columns * u + 2 * math.sin(2 * math.pi * rows * v) + phase)
        x, y = 2 * (u * columns % 1) - 1, 2 * (v * rows % 1) - 1
        far = math.hypot(x, y)
        edge = max(0.0, 1 - far * far)
        return edge if kind == "knobs" else edge * (0.5 + 0.5 * math.cos(around * math.atan2(y, x) + phase))

    mesh = Mesh().surface(lambda u, v: (width * (u - 0.5), height * v, depth * rise(u, v)), 48, 32)
    b.add(mesh, **placement)


def curtain(b, x, y, z, width, drop):
    """Cloth that hangs from (x, y, z), gathered at the middle or not."""
    folds, depth, gather = b.random.randint(3, 9), b.between(0.03, 0.1), b.between(0.0, 0.6) if b.chance(0.5) else 0.0

    def point(u, v):
        narrow = 1 - gather * math.exp(-((v - 0.4) / 0.2) ** 2)
        return (x + width * (u - 0.5) * narrow, y - drop * (1 - v), z + depth * math.sin(2 * math.pi * folds * u + 0.7 * v))

    b.add(Mesh().surface(point, 8 * folds, 10))


def shelf(b, x, z):
    """Boards with rows of thin books and gaps."""
    width, rows, step, depth = b.between(0.8, 2.0), b.random.randint(2, 5), b.between(0.3, 0.45), b.between(0.2, 0.35)
    frame, books = Mesh(), Mesh()
    for side in (-0.5, 0.5):
        frame.block((side * width, 0.5 * rows * step, 0), (0.03, rows * step, depth))
    for row in range(rows + 1):
        frame.block((0, row * step, 0), (width, 0.03, depth))
    for row in range(rows):
        at = -0.48 * width
        while at < 0.42 * width:
            thick, tall = b.between(0.02, 0.07), step * b.between(0.5, 0.85)
            if b.chance(0.85):
                books.block((at + 0.5 * thick, row * step + 0.015 + 0.5 * tall, 0.03), (thick, tall, depth * b.between(0.5, 0.9)))
            at += 1.02 * thick
    angle = turn((0.0, 1.0, 0.0), b.random.choice([0.0, 90.0, 180.0]) + b.between(-5, 5))
    for mesh in (frame, books):
        b.add(mesh, translation=[x, 0.0, z], rotation=angle)


def grille(b, x, z):
    """Thin bars, as in windows and gates: uprights, some of them turned, and rails across."""
    bars, pitch, thick, height = b.random.randint(8, 20), b.between(0.06, 0.16), b.between(0.012, 0.03), b.between(0.8, 2.0)
    mesh = Mesh()
    for i in range(bars):
        mesh.block(((i - 0.5 * bars) * pitch, 0.5 * height, 0), (thick, height, thick), 45.0 if b.chance(0.5) else 0.0)
    for _ in range(b.random.randint(2, 5)):
        mesh.block((-0.5 * pitch, b.between(0.1, 1.0) * height, 0), (bars * pitch, 1.5 * thick, thick))
    b.add(mesh, translation=[x, 0.0, z], rotation=turn((0.0, 1.0, 0.0), b.between(-60, 60)))


def vault(b, width, depth, height):
    """A barrel over the hall, with ribs."""
    rise, mesh = b.between(0.3, 0.5) * width, Mesh()

    def inside(u, v):
        angle = math.pi * u
        return (0.5 * width * math.cos(angle), height + rise * math.sin(angle), depth * (v - 0.5))

    mesh.surface(inside, 24, 6)
    b.add(mesh)
    ribs, thick = b.random.randint(0, 5), b.between(0.1, 0.25)
    for i in range(ribs):
        z, rib = depth * ((i + 0.5) / ribs - 0.5), Mesh()

        def face(u, v, z=z):
            angle = math.pi * u
            return ((0.5 * width - thick) * math.cos(angle), height + (rise - thick) * math.sin(angle), z + thick * (v - 0.5))

        rib.surface(face, 24, 1)
        for side in (-0.5, 0.5):
            def flank(u, v, z=z + side * thick, outwards=side > 0):
                angle, r = math.pi * (u if outwards else 1 - u), thick * (1 - v)
                return ((0.5 * width - r) * math.cos(angle), height + (rise - r) * math.sin(angle), z)
            rib.surface(flank, 24, 1)
        b.add(rib)


def arch_row(b, length, height, thickness, colour, degrees, place):
    """A wall of arches with columns, mouldings and reliefs, turned about the vertical axis and moved."""
    bays = b.random.randint(2, 6)
    pitch, upper = length / bays, Mesh()
    pier = pitch * b.between(0.15, 0.4)
    spring = height * b.between(0.35, 0.6)
    arch_wall(upper, bays, pitch, pier, spring, height, thickness, b.chance(0.4))
    cornice(b, upper, length, height * b.between(0.85, 0.95), 0.0)
    if b.chance(0.5):
        colonnade(b, upper, bays, pitch, spring, 0.35 * pier, 0.4 * pier)
    if b.chance(0.4):
        balustrade(b, upper, -0.5 * length, 0.5 * length, 0.0, -0.5 * thickness)
    rotation = turn((0.0, 1.0, 0.0), degrees)
    b.add(upper, colour, translation=place, rotation=rotation)
    radians = math.radians(degrees)
    for i in range(bays + 1):
        if b.chance(0.4):
            x, z = (i - 0.5 * bays) * pitch, 0.02
            at = (place[0] + x * math.cos(radians) + z * math.sin(radians), height * 0.55,
                  place[2] - x * math.sin(radians) + z * math.cos(radians))
            relief(b, 0.8 * pier, 0.25 * height, translation=[round(c, 4) for c in at], rotation=rotation)


FURNITURE = [grille, grille, fence, shelf, turned, turned, cards, rock, boxes, table]


def building(seed):
    """Arches on two or three sides, open to the sky or under a vault; the camera near to or far from them."""
    b = Builder(seed, f"building {seed}", [0.0, 0.0, 0.0])
    covered = b.chance(0.5)
    bright = b.between(0.5, 2.5)
    b.sky([round(bright * c, 3) for c in (0.75, 1.0, 1.4)])
    width, depth, height = b.between(3, 8), b.between(4, 12), b.between(2.5, 6)
    x, z, thickness = 0.5 * width, 0.5 * depth, b.between(0.2, 0.7)
    stone = b.material()
    wall(b, (-x - 4, 0, z + 1), (width + 8, 0, 0), (0, 0, -depth - 6), b.material())
    arch_row(b, depth, height, thickness, stone, 90.0, [round(-x, 3), 0.0, 0.0])
    arch_row(b, depth, height, thickness, stone, -90.0, [round(x, 3), 0.0, 0.0])
    if b.chance(0.7):
        arch_row(b, width, height, thickness, b.material(), 0.0, [0.0, 0.0, round(-z, 3)])
    behind = b.material()
    for side in (-1, 1):
        # Walls behind the arches, so that these open to aisles.
        start, along = ((-x - 3, 0, z), (0, 0, -depth)) if side < 0 else ((x + 3, 0, -z), (0, 0, depth))
        wall(b, start, along, (0, height * b.between(0.6, 1.4), 0), behind)
    wall(b, (-x - 3, 0, -z - 2.5), (width + 6, 0, 0), (0, 1.3 * height, 0), behind)
    if b.chance(0.6):
        strength = b.between(4, 20)
        place = b.between(-6, 6), b.between(3, 9), b.between(-5, 5)
        b.scene.sun((strength, 0.93 * strength, 0.8 * strength), place, (0.0, 0.0, 0.0))
    if covered:
        vault(b, width, depth, height)
    for _ in range(b.random.randint(1, 3) if covered else b.random.randint(0, 1)):
        size = b.between(0.1, 0.5)
        place = (b.between(-0.7, 0.7) * x, height * b.between(0.5, 0.95), b.between(-0.8, 0.5) * z)
        b.lamp(Mesh().block(place, (size, size, size), b.between(0, 90)), b.between(3, 10) / size)
    for _ in range(b.random.randint(0, 4)):
        place = b.between(-0.7, 0.7) * x, height * b.between(0.5, 0.95), b.between(-0.9, 0.5) * z
        curtain(b, *place, b.between(0.5, 1.6), height * b.between(0.2, 0.5))
    far = b.chance(0.5)
    camera = (b.between(-0.6, 0.6) * x, b.between(0.7, 0.6 * height), z - 0.4 if far else b.between(-0.5, 0.5) * z)
    scatter(b, b.random.randint(3, 12), 0.9 * width, 0.9 * depth, camera, FURNITURE, clear=1.0)
    walk(b, camera, (b.between(-0.9, 0.9) * x, b.between(0.2, 0.7) * height, camera[2] - b.between(1, 0.8 * depth)))
    return b.scene
