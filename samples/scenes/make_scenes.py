#!/usr/bin/env python3
"""Writes the built-in scenes, as the build does: box.gltf, turntable.gltf, kitchen.gltf, stair.gltf,
garden.gltf, gloss.gltf, kitchen_gloss.gltf, mirrors.gltf.

    make_scenes.py FOLDER

Needs Python only. Units and conventions are those of samples/render/load_scene.h: metres, +Y up, radiometric
light units, 24 frames a second.
"""

import argparse
import pathlib
import sys

sys.dont_write_bytecode = True
from box_scenes import make_box, make_turntable
from garden_scene import make_garden
from gloss_scene import make_gloss, make_mirrors
from kitchen_scene import make_kitchen, make_kitchen_gloss
from stair_scene import make_stair

SCENES = {"box": make_box, "turntable": make_turntable, "kitchen": make_kitchen, "stair": make_stair, "garden": make_garden,
          "gloss": make_gloss, "kitchen_gloss": make_kitchen_gloss, "mirrors": make_mirrors}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path, help="an existing folder")
    folder = parser.parse_args().folder
    for name, make in SCENES.items():
        (folder / f"{name}.gltf").write_text(make().text(), encoding="utf-8")


if __name__ == "__main__":
    main()
