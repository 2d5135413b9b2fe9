"""The scenes gloss and mirrors: a floor whose roughness rises from left to right and a still mirror that a ball moves past; and a
corridor between two mirrors."""

import math

from box_scenes import room, tile_normal_map
from gltf_writer import Gltf, Mesh, png, turn

SIZE, TILES = 96, 12


def picture(texel):
    """`texel`: RGB of a place from left to right, 0 to 1, and of a tile, which is metal or not."""
    tile = SIZE // TILES
    return png(SIZE, SIZE, [sum((texel((x + 0.5) / SIZE, (x // tile + y // tile) % 2 == 1) for x in range(SIZE)), [])
                            for y in range(SIZE)], 3)


def metal(color, roughness):
    return {"baseColorFactor": [*color, 1.0], "metallicFactor": 1.0, "roughnessFactor": roughness}


def ball(radius, part=1.0):
    """`part`: of its height, from below; less than 1 is a bowl."""

    def point(u, v):
        around, up = 2 * math.pi * u, math.pi * (part * v - 0.5)
        return (radius * math.cos(up) * math.sin(around), radius * math.sin(up), radius * math.cos(up) * math.cos(around))

    return Mesh().surface(point, 48, 24, closed=True)


def make_gloss():
    """Tiles of metal and of varnished stone; on them blocks, poles, a steel bowl and a bumpy plate; a golden ball; a mirror."""
    scene = Gltf("gloss", [1.6, 2.1, 2.8])
    room(scene, scene.material("plaster", (0.7, 0.69, 0.63)))
    color = scene.texture("tiles", picture(lambda place, is_metal: [215, 205, 190] if is_metal else [40, 70, 120]))
    # Green: roughness, blue: metallic.
    gloss = scene.texture("gloss", picture(lambda place, is_metal: [0, round(255 * place), 255 if is_metal else 0]))
    ramp = scene.material("ramp", (1.0, 1.0, 1.0), pbrMetallicRoughness={
        "baseColorTexture": {"index": color}, "metallicRoughnessTexture": {"index": gloss}})
    floor = Mesh()
    floor.quad((-1.98, 0.005, 2.48), (3.96, 0, 0), (0, 0, -4.96))
    scene.mesh("ramp", floor, ramp, textured=True)
    mirror = Mesh()
    mirror.quad((-1.4, 0.35, -2.48), (2.8, 0, 0), (0, 1.9, 0))
    scene.mesh("mirror", mirror, scene.material("mirror", (0, 0, 0), pbrMetallicRoughness=metal((0.95, 0.95, 0.95), 0.03)))
    for i, paint in enumerate(((0.7, 0.15, 0.1), (0.2, 0.5, 0.2), (0.15, 0.3, 0.7), (0.75, 0.6, 0.2))):
        x = -1.35 + 0.9 * i
        scene.mesh(f"block {i}", Mesh().block((x, 0.2, -0.3), (0.3, 0.4, 0.3), 20.0 * i), scene.material(f"paint {i}", paint))
        scene.mesh(f"pole {i}", Mesh().block((x + 0.42, 0.5, -0.5), (0.03, 1.0, 0.03)), scene.material(f"wood {i}", (0.8, 0.68, 0.4)))
    gold = scene.material("gold", (0, 0, 0), pbrMetallicRoughness=metal((1.0, 0.77, 0.34), 0.25))
    steel = metal((0.6, 0.6, 0.62), 0.2)
    scene.mesh("bowl", ball(0.35, 0.5), scene.material("steel", (0, 0, 0), pbrMetallicRoughness=steel), translation=[0.8, 0.36, 0.55])
    plate = Mesh()
    plate.quad((-1.1, 0.02, 1.0), (0.9, 0, 0), (0, 0, -0.6), tiles=(4.5, 3.0))
    bumps = {"index": scene.texture("bumps", tile_normal_map())}
    scene.mesh("bumpy plate", plate, scene.material("bumpy steel", (0, 0, 0), pbrMetallicRoughness=steel, normalTexture=bumps),
               textured=True)
    mover = scene.mesh("ball", ball(0.3), gold, translation=[-1.2, 0.75, -1.4])
    frames = 48
    scene.animate(mover, "translation", [(round(-1.2 + 0.05 * i, 6), 0.75, -1.4) for i in range(frames)])
    scene.animate(mover, "rotation", [turn((0.0, 1.0, 0.0), 4.0 * i) for i in range(frames)])
    steps = [max(0, i - 3) for i in range(frames)]
    scene.camera([(round(-0.5 + 0.02 * s, 6), 1.15, round(2.2 - 0.015 * s, 6)) for s in steps],
                 [(round(-0.1 + 0.008 * s, 6), 0.25, -0.6) for s in steps])
    scene.camera([(0.9, 1.25, 1.2)] * frames, [(-0.1, 1.05, -2.48)] * frames, "mirror")
    return scene


def make_mirrors():
    """A corridor of 2.4 x 2.4 x 8 m. Its side walls are mirrors that show each other from x = -1.2 and 1.2 on."""
    scene = Gltf("mirrors", [0.4, 0.5, 0.6])
    stone = scene.material("stone", (0.62, 0.6, 0.55))
    shell = Mesh()
    shell.quad((-1.2, 0, 4), (2.4, 0, 0), (0, 0, -8))
    shell.quad((-1.2, 2.4, -4), (2.4, 0, 0), (0, 0, 8))
    scene.mesh("floor and ceiling", shell, stone)
    for name, paint, corner, right in (("red end", (0.6, 0.14, 0.1), (-1.2, 0, -4), (2.4, 0, 0)),
                                       ("blue end", (0.15, 0.25, 0.6), (1.2, 0, 4), (-2.4, 0, 0))):
        end = Mesh()
        end.quad(corner, right, (0, 2.4, 0))
        scene.mesh(name, end, scene.material(name, paint))
    sides = Mesh()
    sides.quad((-1.2, 0, 4), (0, 0, -8), (0, 2.4, 0))
    sides.quad((1.2, 0, -4), (0, 0, 8), (0, 2.4, 0))
    scene.mesh("mirrors", sides, scene.material("mirror", (0, 0, 0), pbrMetallicRoughness=metal((0.9, 0.9, 0.9), 0.0)))
    lamps = Mesh()
    for z in (-2.6, 0.0, 2.6):
        lamps.quad((-0.8, 2.39, z - 0.7), (1.6, 0, 0), (0, 0, 1.4))
    scene.mesh("lamps", lamps, scene.material("lamp", (0.0, 0.0, 0.0), emission=(1.6, 1.45, 1.2)))
    for i, paint in enumerate(((0.75, 0.6, 0.2), (0.2, 0.5, 0.2), (0.7, 0.7, 0.68), (0.15, 0.3, 0.7))):
        x, z = 0.75 - 0.5 * (i % 2), 0.9 - 1.25 * i
        scene.mesh(f"plinth {i}", Mesh().block((x, 0.35, z), (0.4, 0.7, 0.4), 25.0 * i), stone)
        scene.mesh(f"ball {i}", ball(0.22), scene.material(f"paint {i}", paint), translation=[x, 0.92, z])
        scene.mesh(f"pole {i}", Mesh().block((x + 0.3, 1.2, z - 0.4), (0.04, 2.4, 0.04)), stone)
    frames = range(48)
    scene.camera([(round(-0.75 + 0.004 * i, 6), 1.3, round(3.2 - 0.025 * i, 6)) for i in frames],
                 [(round(-1.1 + 0.01 * i, 6), 0.95, -1.5) for i in frames])
    return scene
