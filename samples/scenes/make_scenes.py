#!/usr/bin/env python3
"""Writes the built-in scenes to the folder of this script: box.gltf, turntable.gltf, kitchen.gltf, stair.gltf, garden.gltf.

    make_scenes.py           write the files
    make_scenes.py --check   fail if the files differ from what this script writes

Needs Python only. Units and conventions are those of samples/render/load_scene.h: metres, +Y up, radiometric
light units, 24 frames a second.
"""

import argparse
import pathlib
import sys

sys.dont_write_bytecode = True
from box_scenes import make_box, make_turntable
from garden_scene import make_garden
from kitchen_scene import make_kitchen
from stair_scene import make_stair

SCENES = {"box": make_box, "turntable": make_turntable, "kitchen": make_kitchen, "stair": make_stair, "garden": make_garden}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true", help="compare the files with what this script would write")
    check = parser.parse_args().check
    folder = pathlib.Path(__file__).resolve().parent
    stale = []
    for name, make in SCENES.items():
        file = folder / f"{name}.gltf"
        text = make().text()
        if not check:
            file.write_text(text, encoding="utf-8")
        elif not file.exists() or file.read_text(encoding="utf-8") != text:
            stale.append(file.name)
    if stale:
        sys.exit(f"{', '.join(stale)}: differs from what {pathlib.Path(__file__).name} writes; run it again")


if __name__ == "__main__":
    main()
