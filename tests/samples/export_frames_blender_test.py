"""Tests what samples/blender/export_frames.py tells of reflections, in Blender itself, where it is known: over a mirror.

    blender -b --factory-startup --python-exit-code 1 --python export_frames_blender_test.py -- SAMPLES

SAMPLES is the project's folder of that name. A camera looks straight down at a mirror, so that a reflected ray stays in
its quadrant of the picture. Above each quadrant, there is something else. In the picture's middle lies a rough thing below
a rougher one that is all hole.
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
MIDDLE = 0.25  # Half side of the rough thing.
CEILING = 6.0
SIDE = 64
# The pixel filter moves samples by up to a hundredth of a pixel, which is 1 / 3200 of the picture's half side: the distance
# changes by less than that share of itself.
TOLERANCE = 1e-3


def sheet(x, y, z, material, size=100.0):
    """A square that covers a quadrant, or with 0, 0 the middle of all of them."""
    bpy.ops.mesh.primitive_plane_add(size=size, location=(0.5 * size * x, 0.5 * size * y, z))
    if material is not None:
        bpy.context.object.data.materials.append(material)


def principled(name, **values):
    material, tree, _ = with_output(name)
    node = next(node for node in tree.nodes if node.type == "BSDF_PRINCIPLED")
    for key, value in values.items():
        node.inputs[key].default_value = value
    return material


def with_output(name):
    """A material, its nodes, and the output node to link shaders to."""
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    tree = material.node_tree
    return material, tree, next(node for node in tree.nodes if node.type == "OUTPUT_MATERIAL")


def fog():
    material, tree, output = with_output("fog")
    tree.links.remove(output.inputs["Surface"].links[0])
    tree.links.new(tree.nodes.new("ShaderNodeVolumeScatter").outputs[0], output.inputs["Volume"])
    return material


def matte():
    material, tree, output = with_output("matte")
    tree.links.new(tree.nodes.new("ShaderNodeBsdfDiffuse").outputs[0], output.inputs["Surface"])
    return material


def lobes():
    """Three quarters of a lobe of roughness .2 and a quarter of one of 1, in a group of nodes."""
    group = bpy.data.node_groups.new("lobes", "ShaderNodeTree")
    if hasattr(group, "interface"):  # Since Blender 4.
        group.interface.new_socket("Shader", in_out="OUTPUT", socket_type="NodeSocketShader")
    else:
        group.outputs.new("NodeSocketShader", "Shader")
    mix = group.nodes.new("ShaderNodeMixShader")
    mix.inputs["Fac"].default_value = 0.25
    for place, roughness in ((1, 0.2), (2, 1.0)):
        lobe = group.nodes.new("ShaderNodeBsdfAnisotropic")
        lobe.inputs["Roughness"].default_value = roughness
        group.links.new(lobe.outputs[0], mix.inputs[place])
    group.links.new(mix.outputs[0], group.nodes.new("NodeGroupOutput").inputs[0])
    material, tree, output = with_output("lobes")
    node = tree.nodes.new("ShaderNodeGroup")
    node.node_tree = group
    tree.links.new(node.outputs[0], output.inputs["Surface"])
    return material


def only_in_an_instance(thing, library):
    """Puts a thing into a file of its own, which the scene links."""
    collection = bpy.data.collections.new("store")
    collection.objects.link(thing)
    bpy.data.libraries.write(str(library), {collection})
    bpy.data.objects.remove(thing)
    bpy.data.collections.remove(collection)
    with bpy.data.libraries.load(str(library), link=True) as (_, linked):
        linked.collections = ["store"]
    instance = bpy.data.objects.new("instance", None)
    instance.instance_type, instance.instance_collection = "COLLECTION", linked.collections[0]
    bpy.context.collection.objects.link(instance)


def build(library):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    bpy.ops.object.camera_add(location=(0.0, 0.0, EYE))
    scene.camera = bpy.context.object
    scene.render.resolution_x = scene.render.resolution_y = SIDE
    sheet(0, 0, 0.0, principled("mirror", Metallic=1.0, Roughness=0.0))
    sheet(0, 0, 0.001, lobes(), 2.0 * MIDDLE)
    sheet(0, 0, 0.1, principled("film", Alpha=0.0, Roughness=0.9), 4.0 * MIDDLE)
    sheet(-1, 1, CEILING, None)
    only_in_an_instance(bpy.context.object, library)
    sheet(-1, -1, CEILING - 1.0, principled("hole", Alpha=0.0))
    sheet(-1, -1, CEILING, matte())
    sheet(1, -1, CEILING, principled("lamp", Roughness=1.0))
    bpy.ops.mesh.primitive_cube_add(size=1.0, location=(1.0, -1.0, CEILING - 1.0))
    bpy.context.object.data.materials.append(fog())
    # Shines on what reflects, and is no mesh.
    bpy.ops.object.light_add(type="AREA", location=(1.0, -1.0, CEILING - 2.0))
    bpy.context.object.data.keyframe_insert("energy", frame=1)


def main():
    with tempfile.TemporaryDirectory() as folder:
        build(pathlib.Path(folder) / "library.blend")
        sys.argv = ["blender", "--", "--output", folder, "--frames", "1"]
        runpy.run_path(str(SAMPLES / "blender" / "export_frames.py"), run_name="__main__")
        channels = exr.read(pathlib.Path(folder) / "specular_0001.exr")
        projection = json.loads((pathlib.Path(folder) / "cameras.json").read_text(encoding="utf-8"))["frames"][0]["projection"]

    def channel(*names):
        return next(values for key, values in channels.items() if key.endswith(names))

    x = (2.0 * (numpy.arange(SIDE) + 0.5) / SIDE - 1.0) / projection[0]
    right, up = numpy.meshgrid(x, -x)
    away = EYE * numpy.maximum(numpy.abs(right), numpy.abs(up))
    inside, outside = away < 0.9 * MIDDLE, away > 1.1 * MIDDLE
    # Since Blender 5, the second name.
    roughness = channel("Emit.R", "Emission.R") / channel("Emit.G", "Emission.G")
    off = max(numpy.abs(roughness[inside] - 0.4).max(), numpy.abs(roughness[outside]).max())
    assert off < 1e-6, f"roughness differs by up to {off}"  # Of half the last digit of a float, and sums of three numbers.

    nearness, reflected = (channel(f"GlossDir.{c}", f"Glossy Direct.{c}") for c in "RG")
    assert (reflected[outside] > 0.5).all(), "every pixel reflects something, or the sky"
    expected = CEILING * numpy.sqrt(1.0 + right * right + up * up)
    sky = (right > 0.0) & (up > 0.0)
    assert (nearness[outside & sky] == 0.0).all(), "nothing is reflected where there is only sky"
    met = outside & ~sky
    wrong = numpy.abs(reflected[met] / nearness[met] / expected[met] - 1.0)
    assert wrong.max() < TOLERANCE, f"distances differ from those of the geometry by up to {wrong.max()}"
    print(f"roughness agrees within {off:.1e}, distances within {wrong.max():.1e}")


main()
