"""The scenes box and turntable: one room with blocks, bars and moving objects."""

import math

from gltf_writer import Gltf, Mesh, png, turn


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
