"""The scene stair: a dark space under a stair with a small lamp that swings, and that is switched off in frame 30."""

import math

from gltf_writer import Gltf, Mesh, turn

STEPS = 12
OFF = 30


def stair():
    """Open steps that rise towards -X, between two stringers, with thin balusters on the near side."""
    mesh = Mesh()
    for i in range(STEPS):
        x, y = 1.6 - 0.27 * i, 0.19 * (i + 1)
        mesh.block((x, y, -0.7), (0.3, 0.04, 1.0))
        mesh.block((x, y + 0.47, -0.22), (0.02, 0.9, 0.02))
    return mesh


def beam(mesh, start, end, size, z):
    """A beam without end faces along the line from `start` to `end` in the plane of this z; `size`: its extent along Y and Z. The
    end has the larger X."""
    along = (end[0] - start[0], end[1] - start[1], 0.0)
    back = tuple(-c for c in along)
    mesh.quad((*start, z - size / 2), along, (0.0, 0.0, size))
    mesh.quad((start[0], start[1] + size, z + size / 2), along, (0.0, 0.0, -size))
    mesh.quad((*start, z + size / 2), along, (0.0, size, 0.0))
    mesh.quad((*end, z - size / 2), back, (0.0, size, 0.0))


def make_stair():
    """Crates, bottles and a bucket beside a lamp of 5 cm; the sky is dim and shines through one door far behind."""
    scene = Gltf("stair", [0.5, 0.62, 0.9])
    plaster = scene.material("plaster", (0.66, 0.62, 0.55))
    shell = Mesh()
    shell.quad((-2.5, 0, 2.5), (5, 0, 0), (0, 0, -3.9))
    shell.quad((-2.5, 2.9, -1.4), (5, 0, 0), (0, 0, 3.9))
    shell.quad((-2.5, 0, -1.4), (5, 0, 0), (0, 2.9, 0))
    shell.quad((-2.5, 0, 2.5), (0, 0, -3.9), (0, 2.9, 0))
    shell.quad((2.5, 0, 2.5), (-5, 0, 0), (0, 2.9, 0))
    # The door leaves x = 2.5, y 0 to 2, z 0.6 to 1.4 open.
    shell.quad((2.5, 0, -1.4), (0, 0, 2.0), (0, 2.9, 0))
    shell.quad((2.5, 0, 1.4), (0, 0, 1.1), (0, 2.9, 0))
    shell.quad((2.5, 2.0, 0.6), (0, 0, 0.8), (0, 0.9, 0))
    scene.mesh("hall", shell, plaster)
    wood = scene.material("pine", (0.6, 0.42, 0.24))
    scene.mesh("steps and balusters", stair(), wood)
    beams = Mesh()
    beam(beams, (-1.5, 2.33), (1.75, 0.05), 0.08, -1.2)
    beam(beams, (-1.5, 2.33), (1.75, 0.05), 0.08, -0.22)
    beam(beams, (-1.5, 3.33), (1.75, 1.05), 0.05, -0.22)
    scene.mesh("stringers and rail", beams, wood)
    crates = Mesh().block((-1.75, 0.25, -1.0), (0.5, 0.5, 0.5), 12.0).block((-1.1, 0.2, -1.1), (0.4, 0.4, 0.4), -20.0)
    crates.block((-1.7, 0.68, -1.0), (0.36, 0.36, 0.36), 35.0)
    scene.mesh("crates", crates, scene.material("crate", (0.55, 0.5, 0.4)))
    broom = Mesh().block((-0.55, 0.7, -1.32), (0.025, 1.4, 0.025)).block((-0.55, 0.06, -1.3), (0.3, 0.12, 0.06))
    scene.mesh("broom", broom, scene.material("blue", (0.2, 0.34, 0.7)))
    bucket = Mesh().lathe((-0.4, 0.0, -0.6), [(0.0, 0.0), (0.11, 0.0), (0.15, 0.28), (0.14, 0.28), (0.1, 0.012), (0.0, 0.012)], 20)
    scene.mesh("bucket", bucket, scene.material("zinc", (0.5, 0.52, 0.55)))
    profile = [(0.0, 0.0), (0.037, 0.0), (0.037, 0.17), (0.014, 0.23), (0.014, 0.3), (0.0, 0.3)]
    bottle = scene.shape("bottle", Mesh().lathe((0, 0, 0), profile, 14), scene.material("green glass", (0.13, 0.36, 0.16)))
    for i in range(6):
        scene.place(f"bottle {i + 1}", bottle, translation=[round(-1.35 + 0.11 * i, 6), 0.0, round(-0.62 - 0.06 * (i % 2), 6)])

    # The lamp hangs on a cord and swings across the space under the stair. It is off when its bulb has shrunk to nothing.
    lamp = scene.node({"name": "lamp", "translation": [-0.75, 1.6, -0.75], "rotation": [0.0, 0.0, 0.0, 1.0]})
    shade = Mesh().block((0, -0.2, 0), (0.006, 0.4, 0.006)).lathe((0, -0.5, 0), [(0.09, 0.0), (0.03, 0.1), (0.0, 0.1)], 16)
    scene.mesh("cord and shade", shade, scene.material("enamel", (0.3, 0.08, 0.06)), parent=lamp)
    glow = scene.material("bulb", (0.0, 0.0, 0.0), emission=(150.0, 105.0, 60.0))
    bulb = scene.mesh("bulb", Mesh().block((0, 0, 0), (0.05, 0.05, 0.05)), glow, parent=lamp, translation=[0.0, -0.47, 0.0])
    frames = range(48)
    scene.animate(lamp, "rotation", [turn((0.0, 0.0, 1.0), round(24.0 * math.sin(2 * math.pi * i / 32), 6)) for i in frames])
    scene.animate(bulb, "scale", [(1.0, 1.0, 1.0) if i < OFF else (0.0, 0.0, 0.0) for i in frames])
    scene.camera([(round(0.55 - 0.02 * i, 6), 1.15, round(2.2 - 0.008 * i, 6)) for i in frames],
                 [(round(-0.55 - 0.008 * i, 6), 0.75, -0.9) for i in frames])
    return scene
