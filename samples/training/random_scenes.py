"""Random scenes to train on: rooms, streets and buildings. No built-in or measured scene is among them."""
import pathlib
import random
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "scenes"))
from architecture import building
from gltf_writer import Mesh
from scene_builder import Builder, walk, wall
from things import arcade, house, scatter

ROOMS_AND_STREETS = 226
"""So many seeds are rooms, and streets every third; the seeds from here on are buildings."""


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


def random_scene(seed):
    """The scene of a seed as the text of a glTF file."""
    if seed >= ROOMS_AND_STREETS:
        return building(seed).text()
    return (outdoor if seed % 3 == 2 else indoor)(seed).text()
