"""The scene garden: foliage of cut-out cards, a fence and a swing on chains, under a sun and a sky."""

import math

from gltf_writer import Gltf, Mesh, png, turn


def leaves(size=48):
    """Leaves around a twig, in the alpha channel. Rows from the top."""
    ellipses = [(0.5 + 0.3 * side * (0.4 + 0.6 * k), 0.12 + 0.13 * i, side * 0.7) for i in range(6) for k, side in ((1, -1), (1, 1))]

    def texel(x, y):
        u, v = (x + 0.5) / size, (y + 0.5) / size
        inside = abs(u - 0.5) < 0.02
        for cx, cy, lean in ellipses:
            a, b = u - cx, v - cy
            along, across = a * math.cos(lean) + b * math.sin(lean), -a * math.sin(lean) + b * math.cos(lean)
            inside = inside or (along / 0.2) ** 2 + (across / 0.065) ** 2 < 1
        return [70 + 60 * y // size, 120 + 30 * x // size, 40, 255 if inside else 0]

    return png(size, size, [sum((texel(x, y) for x in range(size)), []) for y in range(size)], 4)


def twig():
    """Six crossing cards that fan out from the origin, each 0.5 m long."""
    mesh = Mesh()
    for i in range(6):
        angle = math.radians(60 * i)
        out = (math.cos(angle), 0.35 + 0.25 * (i % 3), math.sin(angle))
        side = (-math.sin(angle), 0.2, math.cos(angle))
        mesh.quad(tuple(-0.25 * s for s in side), tuple(0.5 * s for s in side), tuple(0.5 * o for o in out))
    return mesh


def link():
    """A link of a chain: a ring of 5 cm in the plane of X and Y."""

    def point(u, v):
        around, tube = 2 * math.pi * v, 2 * math.pi * u
        radius = 0.02 + 0.0045 * math.cos(tube)
        return (0.8 * radius * math.cos(around), 1.25 * radius * math.sin(around), 0.0045 * math.sin(tube))

    return Mesh().surface(point, 5, 12, closed=True)


def tree(scene, bark, twig_shape, x, z, height, count):
    """A trunk and `count` twigs on a spiral over an ellipsoid crown."""
    scene.mesh("trunk", Mesh().lathe((x, 0, z), [(0.13, 0.0), (0.09, 0.6 * height), (0.03, height)], 10), bark)
    for i in range(count):
        share = (i + 0.5) / count
        angle = 2.399963 * i
        radius = 0.75 * math.sin(math.pi * share) ** 0.7
        position = [round(x + radius * math.cos(angle), 4), round(height * (0.5 + 0.6 * share), 4), round(z + radius * math.sin(angle), 4)]
        size = round(0.9 + 0.35 * math.sin(5.1 * i), 4)
        scene.place(f"twig {i + 1}", twig_shape, translation=position, rotation=turn((0.0, 1.0, 0.0), 137.5 * i % 360), scale=[size] * 3)


def make_garden():
    """Two trees, a hedge, a picket fence before a house wall, and a swing that moves on its chains."""
    scene = Gltf("garden", [0.9, 1.2, 1.7])
    scene.sun((9.0, 8.2, 6.8), (4.0, 5.0, 3.0), (0.0, 0.0, 0.0))
    ground = Mesh()
    ground.quad((-12, 0, 12), (24, 0, 0), (0, 0, -24))
    scene.mesh("lawn", ground, scene.material("lawn", (0.24, 0.36, 0.1)))
    house = Mesh().block((-1.0, 1.6, -4.6), (7.0, 3.2, 1.0)).block((-1.0, 3.3, -4.4), (7.4, 0.2, 1.7))
    for x in (-3.2, 0.6):
        house.block((x, 1.5, -4.08), (1.1, 0.08, 0.1)).block((x, 2.6, -4.08), (1.1, 0.08, 0.1))
        for side in (-0.5, 0.0, 0.5):
            house.block((x + side, 2.05, -4.08), (0.07, 1.1, 0.08))
    scene.mesh("house", house, scene.material("limewash", (0.78, 0.66, 0.5)))
    wood = scene.material("oak", (0.45, 0.33, 0.2))
    fence = Mesh()
    for i in range(30):
        fence.block((-3.5 + 0.16 * i, 0.4, -2.6), (0.06, 0.8, 0.02))
    fence.block((-1.2, 0.25, -2.62), (4.8, 0.06, 0.02)).block((-1.2, 0.6, -2.62), (4.8, 0.06, 0.02))
    scene.mesh("fence", fence, scene.material("white", (0.75, 0.75, 0.72)))
    bark = scene.material("bark", (0.3, 0.22, 0.15))
    leaf = scene.material("leaves", (1.0, 1.0, 1.0), picture=leaves(), alphaMode="MASK", alphaCutoff=0.5)
    shape = scene.shape("twig", twig(), leaf, textured=True)
    tree(scene, bark, shape, -1.6, -1.2, 2.4, 46)
    tree(scene, bark, shape, 2.6, -2.8, 2.8, 46)
    for i in range(16):
        scene.place(f"hedge {i + 1}", shape, translation=[round(1.0 + 0.2 * i, 4), 0.0, round(-2.0 + 0.25 * math.sin(2.0 * i), 4)],
                    rotation=turn((0.0, 1.0, 0.0), 77.0 * i % 360), scale=[1.1, 1.3, 1.1])

    # The swing: a frame of posts, and below its beam a node that turns about the beam with a seat and two chains.
    posts = Mesh().block((0.35, 2.05, 0.0), (1.6, 0.09, 0.09))
    for x in (-0.4, 1.1):
        posts.block((x, 1.0, 0.3), (0.08, 2.0, 0.08)).block((x, 1.0, -0.3), (0.08, 2.0, 0.08)).block((x, 2.0, 0.0), (0.08, 0.08, 0.68))
    scene.mesh("posts", posts, wood)
    swing = scene.node({"name": "swing", "translation": [0.35, 2.0, 0.0], "rotation": [0.0, 0.0, 0.0, 1.0]})
    ring = scene.shape("link", link(), scene.material("steel", (0.45, 0.45, 0.48)))
    for x in (-0.3, 0.3):
        for i in range(33):
            scene.place("link", ring, swing, translation=[x, round(-0.04 - 0.0415 * i, 4), 0.0],
                        rotation=turn((0.0, 1.0, 0.0), 90.0 * (i % 2)))
    scene.mesh("seat", Mesh().block((0.0, -1.43, 0.0), (0.7, 0.03, 0.24)), scene.material("red", (0.65, 0.1, 0.08)), parent=swing)
    frames = range(48)
    scene.animate(swing, "rotation", [turn((1.0, 0.0, 0.0), round(18.0 * math.sin(2 * math.pi * i / 40), 6)) for i in frames])
    scene.camera([(round(-1.0 + 0.028 * i, 6), 1.45, round(3.2 - 0.01 * i, 6)) for i in frames],
                 [(round(0.1 + 0.012 * i, 6), 1.15, -1.5) for i in frames])
    return scene
