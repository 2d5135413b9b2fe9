"""Tests the distances of samples/blender/export_frames.py in Blender itself, where they are known: over a mirror.

    blender -b --factory-startup --python-exit-code 1 --python export_frames_blender_test.py -- SAMPLES

SAMPLES is the project's folder of that name. A camera looks straight down at a mirror, so that a reflected ray stays in
its quadrant of the picture. Above each quadrant, there is something else.
"""
import json
import pathlib
import runpy
import sys
import tempfile

import bpy
import numpy

SAMPLES = pathlib.Path(sys.argv[-1])
sys.path.insert(0, str(SAMPLES / "images"))
import exr  # noqa: E402

EYE = 2.0
CEILING = 6.0
SIDE = 64
# The pixel filter moves samples by up to a hundredth of a pixel, which is 1 / 3200 of the picture's half side: the distance
# changes by less than that share of itself.
TOLERANCE = 1e-3


def sheet(x, y, z, material):
    """A square of 100 x 100 units that covers a quadrant, or with 0, 0 all of them."""
    bpy.ops.mesh.primitive_plane_add(size=100.0, location=(50.0 * x, 50.0 * y, z))
    if material is not None:
        bpy.context.object.data.materials.append(material)


def principled(name, **values):
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    node = next(node for node in material.node_tree.nodes if node.type == "BSDF_PRINCIPLED")
    for key, value in values.items():
        node.inputs[key].default_value = value
    return material


def fog():
    material = bpy.data.materials.new("fog")
    material.use_nodes = True
    tree = material.node_tree
    output = next(node for node in tree.nodes if node.type == "OUTPUT_MATERIAL")
    tree.links.remove(output.inputs["Surface"].links[0])
    tree.links.new(tree.nodes.new("ShaderNodeVolumeScatter").outputs[0], output.inputs["Volume"])
    return material


def matte():
    material = bpy.data.materials.new("matte")
    material.use_nodes = True
    tree = material.node_tree
    output = next(node for node in tree.nodes if node.type == "OUTPUT_MATERIAL")
    tree.links.new(tree.nodes.new("ShaderNodeBsdfDiffuse").outputs[0], output.inputs["Surface"])
    return material


def build():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    bpy.ops.object.camera_add(location=(0.0, 0.0, EYE))
    scene.camera = bpy.context.object
    scene.render.resolution_x = scene.render.resolution_y = SIDE
    sheet(0, 0, 0.0, principled("mirror", Metallic=1.0, Roughness=0.0))
    sheet(-1, 1, CEILING, None)
    sheet(-1, -1, CEILING - 1.0, principled("hole", Alpha=0.0))
    sheet(-1, -1, CEILING, matte())
    sheet(1, -1, CEILING, principled("lamp", Roughness=1.0))
    bpy.ops.mesh.primitive_cube_add(size=1.0, location=(1.0, -1.0, CEILING - 1.0))
    bpy.context.object.data.materials.append(fog())
    # Shines on what reflects, and is no mesh.
    bpy.ops.object.light_add(type="AREA", location=(1.0, -1.0, CEILING - 2.0))


def main():
    build()
    with tempfile.TemporaryDirectory() as folder:
        sys.argv = ["blender", "--", "--output", folder, "--frames", "1"]
        runpy.run_path(str(SAMPLES / "blender" / "export_frames.py"), run_name="__main__")
        channels = exr.read(pathlib.Path(folder) / "distance_0001.exr")
        projection = json.loads((pathlib.Path(folder) / "cameras.json").read_text(encoding="utf-8"))["frames"][0]["projection"]
    red, green = (next(values for name, values in channels.items() if name.endswith(f"Combined.{c}")) for c in "RG")
    assert (green > 0.5).all(), "every pixel reflects something, or the sky"
    x = (2.0 * (numpy.arange(SIDE) + 0.5) / SIDE - 1.0) / projection[0]
    right, up = numpy.meshgrid(x, -x)
    expected = CEILING * numpy.sqrt(1.0 + right * right + up * up)
    sky = (right > 0.0) & (up > 0.0)
    assert (red[sky] == 0.0).all(), "nothing is reflected where there is only sky"
    wrong = numpy.abs(green[~sky] / red[~sky] / expected[~sky] - 1.0)
    assert wrong.max() < TOLERANCE, f"distances differ from those of the geometry by up to {wrong.max()}"
    print(f"distances agree within {wrong.max():.1e}")


main()
