"""The scenes kitchen and kitchen_gloss: a cluttered interior whose only light is the sky behind one barred window."""

import math

from gltf_writer import Gltf, Mesh

POT = [(0.0, 0.0), (0.11, 0.0), (0.12, 0.02), (0.12, 0.14), (0.125, 0.145), (0.113, 0.145), (0.108, 0.02), (0.0, 0.012)]
BOWL = [(0.0, 0.0), (0.04, 0.0), (0.075, 0.03), (0.09, 0.07), (0.086, 0.07), (0.07, 0.034), (0.0, 0.008)]
CUP = [(0.0, 0.0), (0.03, 0.0), (0.037, 0.08), (0.033, 0.08), (0.027, 0.006), (0.0, 0.006)]
PLATE = [(0.0, 0.0), (0.07, 0.0), (0.12, 0.015), (0.118, 0.019), (0.068, 0.006), (0.0, 0.006)]
BOTTLE = [(0.0, 0.0), (0.035, 0.0), (0.037, 0.16), (0.014, 0.22), (0.014, 0.28), (0.0, 0.28)]

# Metallic and linear roughness of what reflects in kitchen_gloss. Copper's colour is then its reflectance.
GLOSS = {"tin": (1.0, 0.25), "copper": (1.0, 0.2), "clay": (0.0, 0.15), "china": (0.0, 0.12), "green glass": (0.0, 0.05),
         "painted": (0.0, 0.35), "oak": (0.0, 0.45)}


def chair():
    """A chair of 0.42 x 0.95 x 0.42 m that faces -Z, its back of slats at +Z."""
    mesh = Mesh().block((0, 0.45, 0), (0.42, 0.03, 0.42))
    for x in (-0.19, 0.19):
        mesh.block((x, 0.22, -0.19), (0.035, 0.44, 0.035))
        mesh.block((x, 0.475, 0.195), (0.035, 0.95, 0.03))
    for i in range(5):
        mesh.block((-0.12 + 0.06 * i, 0.69, 0.195), (0.018, 0.42, 0.012))
    return mesh.block((0, 0.92, 0.195), (0.36, 0.05, 0.02)).block((0, 0.48, 0.195), (0.36, 0.03, 0.02))


def fork(x, z):
    """A fork that lies along Z at the height of the table top."""
    mesh = Mesh().block((x, 0.785, z + 0.05), (0.008, 0.003, 0.12)).block((x, 0.785, z - 0.03), (0.022, 0.003, 0.03))
    for i in range(4):
        mesh.block((x - 0.009 + 0.006 * i, 0.785, z - 0.065), (0.0025, 0.003, 0.04))
    return mesh


def cloth():
    """A cloth on the table top that hangs in folds over the edge towards the camera."""

    def point(u, v):
        x = -0.35 + 0.7 * u
        along = 0.55 * v
        flat = min(along, 0.25)
        drop = max(along - 0.25, 0.0)
        fold = 0.02 * math.sin(9 * math.pi * u) * min(drop / 0.1, 1.0)
        return (x + 0.1 * drop * math.sin(4 * u), 0.782 - 0.97 * drop, 0.21 + flat + fold + 0.25 * min(drop, 0.06))

    return Mesh().surface(lambda u, v: point(1 - u, v), 40, 20)


def room(scene):
    """A room of 4 x 2.5 x 4 m; the window leaves x = -2, y 0.95 to 1.95, z -0.9 to 0.3 open."""
    plaster = scene.material("plaster", (0.76, 0.72, 0.64))
    shell = Mesh()
    shell.quad((-2, 2.5, -2), (4, 0, 0), (0, 0, 4))
    shell.quad((-2, 0, -2), (4, 0, 0), (0, 2.5, 0))
    shell.quad((2, 0, 2), (-4, 0, 0), (0, 2.5, 0))
    shell.quad((2, 0, -2), (0, 0, 4), (0, 2.5, 0))
    shell.quad((-2, 0, 2), (0, 0, -4), (0, 0.95, 0))
    shell.quad((-2, 1.95, 2), (0, 0, -4), (0, 0.55, 0))
    shell.quad((-2, 0.95, 2), (0, 0, -1.7), (0, 1.0, 0))
    shell.quad((-2, 0.95, -0.9), (0, 0, -1.1), (0, 1.0, 0))
    scene.mesh("walls and ceiling", shell, plaster)
    floor = Mesh()
    floor.quad((-2, 0, 2), (4, 0, 0), (0, 0, -4))
    scene.mesh("floor", floor, scene.material("clay", (0.5, 0.24, 0.15)))
    bars = Mesh().block((-1.99, 1.45, -0.3), (0.03, 0.03, 1.2)).block((-1.93, 0.93, -0.3), (0.2, 0.04, 1.3))
    for i in range(8):
        bars.block((-1.99, 1.45, -0.83 + 0.15 * i), (0.014, 1.0, 0.014))
    scene.mesh("window bars and sill", bars, scene.material("iron", (0.2, 0.2, 0.22)))
    # The bright sky is a panel behind the window: lamps are sampled, while a constant sky is found by chance only.
    panel = Mesh()
    panel.quad((-2.4, 0.5, 0.8), (0, 0, -2.2), (0, 1.9, 0))
    scene.mesh("bright sky", panel, scene.material("bright sky", (0.0, 0.0, 0.0), emission=(15.0, 17.0, 20.0)))


def furniture(scene, wood, metal):
    table = Mesh().block((0, 0.76, 0), (1.5, 0.04, 0.9))
    for x in (-0.68, 0.68):
        for z in (-0.38, 0.38):
            table.block((x, 0.37, z), (0.06, 0.74, 0.06))
    scene.mesh("table", table, wood)
    shape = scene.shape("chair", chair(), scene.material("painted", (0.25, 0.42, 0.38)))
    for i, (x, z, degrees) in enumerate(((-0.35, 0.75, 8), (0.45, 0.8, -15), (0.95, -0.15, 80), (-0.4, -0.72, 175))):
        half = math.radians(degrees) / 2
        scene.place(f"chair {i + 1}", shape, translation=[x, 0, z], rotation=[0, round(math.sin(half), 6), 0, round(math.cos(half), 6)])
    counter = Mesh().block((0.1, 0.89, -1.7), (3.6, 0.04, 0.62))
    for i in range(6):
        counter.block((-1.4 + 0.6 * i, 0.44, -1.72), (0.585, 0.84, 0.54))
        counter.block((-1.4 + 0.6 * i, 0.7, -1.44), (0.2, 0.015, 0.02))
    scene.mesh("counter", counter, wood)
    scene.mesh("shelf", Mesh().block((0.5, 1.5, -1.88), (1.8, 0.025, 0.22)).block((0.5, 1.83, -1.88), (1.8, 0.025, 0.22)), wood)
    rail = Mesh().block((-0.95, 1.62, -1.95), (0.9, 0.012, 0.012))
    for i in range(7):
        x = -1.3 + 0.115 * i
        rail.block((x, 1.5, -1.94), (0.008, 0.22 + 0.02 * (i % 3), 0.005)).block((x, 1.36, -1.94), (0.05, 0.07, 0.006))
    scene.mesh("rail with ladles", rail, metal)


def crockery(scene, metal):
    white = scene.material("china", (0.8, 0.8, 0.77))
    with_handles = Mesh().lathe((0, 0, 0), POT, 20).block((0.16, 0.12, 0), (0.09, 0.012, 0.02)).block((-0.16, 0.12, 0), (0.09, 0.012, 0.02))
    pot = scene.shape("pot", with_handles, metal)
    copper = scene.shape("copper pot", Mesh().lathe((0, 0, 0), POT, 20), scene.material("copper", (0.72, 0.35, 0.2)))
    cup, plate, bowl = (scene.shape(n, Mesh().lathe((0, 0, 0), p, 14), white) for n, p in (("cup", CUP), ("plate", PLATE), ("bowl", BOWL)))
    bottle = scene.shape("bottle", Mesh().lathe((0, 0, 0), BOTTLE, 14), scene.material("green glass", (0.12, 0.3, 0.14)))
    places = [(pot, -1.1, 0.91, -1.6, 1.0), (copper, -0.7, 0.91, -1.7, 0.8), (pot, 0.2, 0.91, -1.65, 1.25),
              (copper, 0.75, 0.91, -1.55, 0.7), (bowl, -0.35, 0.91, -1.55, 1.3), (bottle, 1.1, 0.91, -1.75, 1.0),
              (bottle, 1.22, 0.91, -1.65, 0.9), (bowl, 0.05, 0.78, -0.12, 1.5), (pot, 0.45, 0.78, -0.15, 0.9),
              (bottle, -0.12, 0.78, -0.3, 1.0)]
    places += [(plate, x, 0.783, z, 1.0) for x, z in ((-0.5, 0.05), (0.5, 0.22), (-0.45, -0.28))]
    places += [(cup, -0.25 + 0.17 * i, 1.515 + 0.33 * (i % 2), -1.87, 1.0) for i in range(9)]
    places += [(cup, 0.22, 0.78, 0.1, 1.0), (cup, -0.66, 0.78, -0.1, 1.0)]
    for i, (shape, x, y, z, scale) in enumerate(places):
        scene.place(f"crockery {i + 1}", shape, translation=[round(x, 6), y, z], scale=[scale] * 3)
    cutlery = Mesh()
    for x, z in ((-0.66, 0.05), (0.34, 0.22), (-0.61, -0.28)):
        part = fork(x, z)
        first = len(cutlery.positions)
        cutlery.positions += part.positions
        cutlery.normals += part.normals
        cutlery.uvs += part.uvs
        cutlery.indices += [first + i for i in part.indices]
        cutlery.block((x + 0.31, 0.785, z), (0.016, 0.003, 0.22), 4.0)
    scene.mesh("cutlery", cutlery, metal)


def make_kitchen():
    """Pots, cutlery, chairs and cloth in a room with one barred window."""
    scene = Gltf("kitchen", [0.5, 0.6, 0.7])
    room(scene)
    metal = scene.material("tin", (0.55, 0.55, 0.57))
    furniture(scene, scene.material("oak", (0.52, 0.36, 0.2)), metal)
    crockery(scene, metal)
    scene.mesh("cloth", cloth(), scene.material("linen", (0.7, 0.2, 0.18)))
    frames = range(48)
    scene.camera([(round(0.9 - 0.022 * i, 6), round(1.42 - 0.002 * i, 6), round(1.75 - 0.008 * i, 6)) for i in frames],
                 [(round(0.1 - 0.006 * i, 6), 0.85, -0.6) for i in frames])
    return scene


def make_kitchen_gloss():
    """The kitchen with pots, cutlery and ladles of metal, and varnish on its floor, wood and china."""
    scene = make_kitchen()
    scene.document["scenes"][0]["name"] = "kitchen_gloss"
    materials = {material["name"]: material["pbrMetallicRoughness"] for material in scene.document["materials"]}
    for name, (metallic, roughness) in GLOSS.items():
        materials[name].update(metallicFactor=metallic, roughnessFactor=roughness)
    frames = range(48)
    scene.camera([(round(1.92 - 0.022 * i, 6), 1.15, -0.75) for i in frames],
                 [(-1.3, 0.42, round(-0.94 + 0.01 * i, 6)) for i in frames], "floor")
    return scene
