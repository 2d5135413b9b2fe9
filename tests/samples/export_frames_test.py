#!/usr/bin/python3
"""Tests samples/blender/export_frames.py with a stand-in for Blender that records what the script asks for.

    export_frames_test.py SCRIPT
"""
import contextlib
import io
import json
import pathlib
import runpy
import sys
import tempfile
import types
import unittest

SCRIPT = sys.argv.pop()


class Matrix(list):
    """A matrix of the identity's rows that depends on the frame."""

    def normalized(self):
        return self

    inverted = copy = normalized


def matrix(x):
    return Matrix([[1, 0, 0, x], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])


class Thing(types.SimpleNamespace):
    """An object of the scene that may move from frame to frame."""

    def evaluated_get(self, _):
        return self

    def calc_matrix_camera(self, _, **__):
        return matrix(0)

    @property
    def matrix_world(self):
        return matrix(self.scene.frame if self.moves else 0)


class Objects(list):
    def get(self, name):
        return next((o for o in self if o.name == name), None)


class Made(list):
    """A collection of Blender that makes its members."""

    def __init__(self, kind):
        super().__init__()
        self.kind = kind

    def new(self, *arguments):
        self.append(self.kind(*arguments))
        return self[-1]

    add = new


class Socket(types.SimpleNamespace):
    @property
    def is_linked(self):
        return bool(self.links)


class Sockets(list):
    """Sockets of a node by number or name."""

    def __init__(self, node, names):
        super().__init__(Socket(node=node, name=name, type="SHADER" if name in SHADERS else "VALUE", default_value=0.0, links=[])
                         for name in names)

    def __getitem__(self, key):
        return super().__getitem__(key) if isinstance(key, int) else next(each for each in self if each.name == key)

    def __contains__(self, name):
        return any(each.name == name for each in self)


# Names of sockets that hold shaders, and the nodes by their type: inputs and outputs.
SHADERS = {"Shader", "BSDF", "Emission", "Surface", "Volume", "Background"}
NODES = {
    "ShaderNodeBsdfTransparent": ("BSDF_TRANSPARENT", ["Color"], ["BSDF"]),
    "ShaderNodeLightPath": ("LIGHT_PATH", [], ["Is Camera Ray", "Ray Length"]),
    "ShaderNodeMath": ("MATH", ["Value", "Value"], ["Value"]),
    "ShaderNodeCombineXYZ": ("COMBXYZ", ["X", "Y", "Z"], ["Vector"]),
    "ShaderNodeEmission": ("EMISSION", ["Color", "Strength"], ["Emission"]),
    "ShaderNodeBsdfAnisotropic": ("BSDF_ANISOTROPIC", ["Color", "Roughness", "Anisotropy", "Normal"], ["BSDF"]),
    "ShaderNodeMixShader": ("MIX_SHADER", ["Fac", "Shader", "Shader"], ["Shader"]),
    "ShaderNodeBsdfDiffuse": ("BSDF_DIFFUSE", ["Color"], ["BSDF"]),
    "ShaderNodeBsdfPrincipled": ("BSDF_PRINCIPLED", ["Roughness", "Normal", "Alpha"], ["BSDF"]),
    "ShaderNodeOutputMaterial": ("OUTPUT_MATERIAL", ["Surface", "Volume"], []),
    "ShaderNodeVolumeScatter": ("VOLUME_SCATTER", [], ["Volume"]),
    "ShaderNodeTexture": ("TEX_IMAGE", [], ["Color"]),
    "ShaderNodeBackground": ("BACKGROUND", ["Color"], ["Background"]),
    "ShaderNodeAddShader": ("ADD_SHADER", ["Shader", "Shader"], ["Shader"]),
    "ShaderNodeGroupOutput": ("GROUP_OUTPUT", ["Shader"], []),
    "ShaderNodeGroup": ("GROUP", [], ["Shader"]),
}


class Node(types.SimpleNamespace):
    def __init__(self, kind):
        super().__init__()
        self.type, inputs, outputs = NODES[kind]
        self.inputs, self.outputs = Sockets(self, inputs), Sockets(self, outputs)


class Links:
    def new(self, source, target):
        for link in target.links:
            self.remove(link)
        link = types.SimpleNamespace(from_socket=source, to_socket=target)
        source.links.append(link)
        target.links.append(link)

    def remove(self, link):
        link.from_socket.links.remove(link)
        link.to_socket.links.remove(link)


class Tree:
    bl_idname = "ShaderNodeTree"

    def __init__(self):
        self.nodes, self.links = Made(Node), Links()

    def add(self, kind, target=None, **values):
        """A node whose first output is linked to a socket, with values or links as inputs."""
        node = self.nodes.new(f"ShaderNode{kind}")
        for name, value in values.items():
            if isinstance(value, Socket):
                self.links.new(value, node.inputs[name])
            else:
                node.inputs[name].default_value = value
        if target is not None:
            self.links.new(node.outputs[0], target)
        return node


class Material(types.SimpleNamespace):
    """Without nodes, as new ones are until Blender 5. A user gets a Principled BSDF with them."""

    def __init__(self, name="", old=False):
        setting = {"sample_as_light": True} if old else {"emission_sampling": "AUTO"}
        super().__init__(name=name, is_grease_pencil=False, cycles=types.SimpleNamespace(**setting), node_tree=None)

    @property
    def use_nodes(self):
        return self.node_tree is not None

    @use_nodes.setter
    def use_nodes(self, _):
        if self.node_tree is None:
            self.node_tree = Tree()
            self.surface = self.node_tree.add("OutputMaterial").inputs["Surface"]
            self.node_tree.add("BsdfPrincipled", self.surface, Roughness=0.5, Alpha=1.0)


class World(types.SimpleNamespace):
    def __init__(self, name):
        super().__init__(name=name, use_nodes=False, cycles=types.SimpleNamespace(sampling_method="AUTOMATIC"),
                         node_tree=Tree())
        self.node_tree.add("Background")


def since_five(kind):
    """Materials or worlds that have nodes from the start, and know nothing of the setting, as those of Blender 6."""
    class SinceFive(kind):
        def __init__(self, *arguments):
            super().__init__(*arguments)
            self.use_nodes = True
            self.complete = True

        def __getattribute__(self, name):
            if name == "use_nodes":
                raise AttributeError(name)
            return super().__getattribute__(name)

        def __setattr__(self, name, value):
            if name == "use_nodes" and hasattr(self, "complete"):
                raise AttributeError(name)
            super().__setattr__(name, value)

    return SinceFive


def material(**values):
    """A Principled BSDF."""
    made = Material()
    made.use_nodes = True
    for name, value in values.items():
        made.node_tree.nodes[-1].inputs[name].default_value = value
    return made


def shade(socket, camera, length):
    """What a ray meets at a shader's input, as a list of weights and closures."""
    if not socket.links:
        return []
    source = socket.links[0].from_socket
    node = source.node

    def value(target):
        if not target.links:
            return target.default_value
        origin = target.links[0].from_socket
        if origin.node.type == "LIGHT_PATH":
            return {"Is Camera Ray": float(camera), "Ray Length": length}[origin.name]
        if origin.node.type == "MATH":
            assert origin.node.operation == "DIVIDE"
            return value(origin.node.inputs[0]) / value(origin.node.inputs[1])
        if origin.node.type == "COMBXYZ":
            return tuple(map(value, origin.node.inputs))
        return origin.node.type

    if node.type == "ADD_SHADER":
        return [each for shader in node.inputs for each in shade(shader, camera, length)]
    if node.type == "MIX_SHADER":
        share = value(node.inputs["Fac"])
        parts = [(1.0 - share, node.inputs[1]), (share, node.inputs[2])]
        return [(part * weight, closure) for part, shader in parts if part
                for weight, closure in shade(shader, camera, length)]
    return [(1.0, (node.type, *(value(each) for each in node.inputs if each.name in ("Roughness", "Anisotropy", "Color"))))]


class Refusing(types.SimpleNamespace):
    """Image settings of Blender 5, which know the format only after the kind of image."""

    def __setattr__(self, name, value):
        if name == "file_format" and self.media_type != "MULTI_LAYER_IMAGE":
            raise TypeError("enum not found")
        super().__setattr__(name, value)


def layer(name, direct_volume):
    passes = ["combined", "z", "normal", "vector", "emit", "environment"]
    passes += [f"{light}_{part}" for light in ("diffuse", "glossy", "transmission") for part in ("direct", "indirect", "color")]
    volumes = {"use_pass_volume_direct": False, "use_pass_volume_indirect": False} if direct_volume else {}
    asked = {f"use_pass_{name}": False for name in passes}
    return types.SimpleNamespace(name=name, use=True, material_override="clay", **asked,
                                 cycles=types.SimpleNamespace(denoising_store_passes=True, **volumes))


def blender(layers=("ViewLayer",), moves=False, five=False, volume=True, materials=(), groups=()):
    """The module bpy and its scene."""
    scene = types.SimpleNamespace(frame=0, rendered=[], asked=[], cycles=types.SimpleNamespace())
    scene.frame_set = lambda frame: setattr(scene, "frame", frame)
    lens = types.SimpleNamespace(type="PERSP", dof=types.SimpleNamespace(use_dof=False))
    camera = Thing(name="Camera", type="CAMERA", data=lens, scene=scene, moves=True)
    ball = types.SimpleNamespace(materials=[])
    scene.objects = Objects([camera, Thing(name="Ball", type="MESH", data=ball, scene=scene, moves=moves,
                                                 material_slots=[types.SimpleNamespace(material=None)])])
    scene.camera = camera
    settings = Refusing(media_type="IMAGE", use_exr_interleave=False) if five else types.SimpleNamespace()
    scene.render = types.SimpleNamespace(resolution_x=64, resolution_y=36, pixel_aspect_x=1, pixel_aspect_y=1,
                                         image_settings=settings)
    scene.view_layers = [layer(name, volume) for name in layers]

    def render(write_still):
        assert write_still
        scene.rendered.append((scene.frame, scene.cycles.samples, scene.cycles.seed))
        scene.asked.append({name for name, value in vars(scene.view_layers[0]).items() if name.startswith("use_pass_") and value})
        pathlib.Path(scene.render.filepath).write_text("pixels", encoding="utf-8")

    bpy = types.ModuleType("bpy")
    bpy.app = types.SimpleNamespace(version=(5, 2, 0) if five else (4, 3, 0))
    bpy.context = types.SimpleNamespace(scene=scene, mode="EDIT_MESH", evaluated_depsgraph_get=lambda: None)
    made = Made(since_five(Material) if five else Material)
    made.extend(materials)
    lamp = types.SimpleNamespace(energy=100.0, animation_data_clear=lambda: setattr(lamp, "animated", False), animated=True)
    bpy.data = types.SimpleNamespace(materials=made, lights=[lamp], objects=scene.objects, node_groups=groups,
                                     worlds=Made(since_five(World) if five else World), libraries=["linked.blend"])

    def make_local(type):
        assert type == "ALL" and bpy.context.mode == "OBJECT"
        bpy.data.libraries.clear()

    bpy.ops = types.SimpleNamespace(
        render=types.SimpleNamespace(render=render),
        object=types.SimpleNamespace(make_local=make_local, mode_set=lambda mode: setattr(bpy.context, "mode", mode)))
    return bpy, scene


class ExportFrames(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.output = pathlib.Path(self.folder.name).resolve() / "my frames"

    def run_script(self, bpy, *arguments):
        """What the script prints."""
        printed = io.StringIO()
        sys.modules["bpy"] = bpy
        sys.argv = ["blender", "--", "--output", str(self.output), *arguments]
        with contextlib.redirect_stdout(printed), contextlib.redirect_stderr(printed):
            runpy.run_path(SCRIPT, run_name="__main__")
        return printed.getvalue()

    def test_asks_for_every_pass(self):
        for five in (False, True):
            bpy, scene = blender(five=five)
            self.run_script(bpy, "--frames", "1", "--cycles-device", "CPU")  # An option of Cycles.
            chosen = scene.view_layers[0]
            for owner in (chosen, chosen.cycles):
                for name, value in vars(owner).items():
                    if name.startswith("use_pass_"):
                        self.assertTrue(value, name)
            self.assertFalse(chosen.cycles.denoising_store_passes)
            self.assertEqual(scene.cycles.use_layer_samples, "IGNORE")
            self.assertEqual(scene.render.image_settings.file_format, "OPEN_EXR_MULTILAYER")
            if five:
                self.assertTrue(scene.render.image_settings.use_exr_interleave)

    def test_warns_of_a_pass_that_blender_has_not(self):
        bpy, _ = blender(volume=False)
        self.assertIn("no pass volume_direct", self.run_script(bpy, "--frames", "1"))

    def test_specular_files_come_last(self):
        bpy, scene = blender(materials=[material(Roughness=0.25)])
        text = self.run_script(bpy, "--frames", "4-5", "--spp", "2", "--reference-spp", "64")
        self.assertIn("specular_0005.exr: rendered, 6 of 6, 0:00 left", text)
        self.assertEqual([(frame, count) for frame, count, _ in scene.rendered],
                         [(4, 2), (4, 64), (5, 2), (5, 64), (4, 2), (5, 2)])
        seeds = [seed for _, _, seed in scene.rendered]
        self.assertEqual((seeds[4], seeds[5]), (seeds[0], seeds[2]))
        asked = {f"use_pass_{name}" for name in ("combined", "glossy_direct", "glossy_color", "emit")}
        self.assertEqual(scene.asked[4:], [asked] * 2)
        self.assertGreater(len(scene.asked[3]), 10)
        self.assertTrue(text.rstrip().endswith("--composite --png --light all"), text)
        again, scene = blender(materials=[material(Roughness=0.25)])
        self.assertIn("specular_0004.exr: already exists, skipped", self.run_script(again, "--frames", "4-6"))
        self.assertEqual([frame for frame, _, _ in scene.rendered], [6, 6])

    def test_scenes_without_a_lobe_have_no_specular_files(self):
        matte = material()
        matte.node_tree.nodes.remove(matte.node_tree.nodes[-1])
        before = list(matte.node_tree.nodes)
        bpy, _ = blender(materials=[matte, Material()])
        text = self.run_script(bpy, "--frames", "1")
        self.assertEqual([file.name for file in sorted(self.output.iterdir())], ["cameras.json", "noisy_0001.exr"])
        self.assertTrue(text.rstrip().endswith("--composite --png"), text)
        self.assertEqual(matte.node_tree.nodes, before)

    def test_specular_files_show_lobes(self):
        plain = material(Roughness=0.25, Alpha=1.0)
        cutout = material(Roughness=0.75, Alpha=0.25)
        panes = material(Roughness=0.0, Alpha=1.0)  # Half of it glass, half a hole.
        tree = panes.node_tree
        pane = tree.nodes[-1].outputs[0]
        hole = tree.add("MixShader", panes.surface, Fac=0.5)
        tree.links.new(pane, hole.inputs[1])
        tree.add("BsdfTransparent", hole.inputs[2])
        textured = material(Alpha=1.0)
        tree = textured.node_tree
        tree.add("Texture", tree.nodes[-1].inputs["Roughness"])
        matte = Material()
        matte.use_nodes = True
        matte.node_tree.add("BsdfDiffuse", matte.surface)
        fog = Material(old=True)
        fog.use_nodes = True
        fog.node_tree.links.remove(fog.surface.links[0])
        fog.node_tree.add("VolumeScatter", fog.surface.node.inputs["Volume"])
        grouped = Material()
        grouped.use_nodes = True
        handed = grouped.node_tree.add("Group", grouped.surface)
        group = Tree()
        shared = group.add("GroupOutput").inputs["Shader"]
        group.add("BsdfPrincipled", shared, Roughness=0.5, Alpha=1.0)
        bpy, scene = blender(materials=[plain, cutout, panes, textured, matte, fog, grouped], groups=[group])
        self.run_script(bpy, "--frames", "1")

        def seen(surface, camera):
            return {closure[0]: (weight, *closure[1:]) for weight, closure in shade(surface, camera, 4.0)}

        def lobe(roughness, share=1.0):
            return {"BSDF_ANISOTROPIC": (share, (1.0, 1.0, 1.0, 1.0), roughness, 0.0), "EMISSION": (share, (roughness, 1.0, 0.0))}

        def hole(share):
            return {"BSDF_TRANSPARENT": (share, 0.0)}

        shine = {"EMISSION": (1.0, (0.25, 1.0, 0.0))}
        self.assertEqual(seen(plain.surface, True), lobe(0.25))
        self.assertEqual(seen(plain.surface, False), shine)
        self.assertEqual(seen(cutout.surface, True), lobe(0.75, 0.25) | hole(0.75))
        self.assertEqual(seen(cutout.surface, False), {"EMISSION": (0.25, (0.25, 1.0, 0.0))} | hole(0.75))
        self.assertEqual(seen(panes.surface, False), {"EMISSION": (0.5, (0.25, 1.0, 0.0))} | hole(0.5))
        self.assertEqual(seen(textured.surface, True), lobe("TEX_IMAGE"))
        self.assertEqual(seen(matte.surface, True), {})
        self.assertEqual(seen(matte.surface, False), shine)
        self.assertEqual(seen(fog.surface, False), hole(1.0))
        self.assertFalse(fog.surface.node.inputs["Volume"].is_linked)
        self.assertIs(grouped.surface.links[0].from_socket, handed.outputs[0])
        self.assertEqual(seen(shared, True), lobe(0.5))
        self.assertEqual(seen(shared, False), shine)
        # Lamps, the world, and a ball without a material.
        [lamp] = bpy.data.lights
        self.assertEqual((lamp.energy, lamp.animated), (0.0, False))
        ball = scene.objects[1]
        self.assertEqual(seen(ball.material_slots[0].material.surface, False), shine)
        self.assertEqual(scene.world.node_tree.nodes[0].inputs["Color"].default_value, (0.0, 1.0, 0.0, 1.0))
        self.assertEqual((plain.cycles.emission_sampling, fog.cycles.sample_as_light, scene.world.cycles.sampling_method),
                         ("NONE", False, "NONE"))
        self.assertEqual(scene.cycles.max_bounces, 1)
        self.assertIsNone(scene.view_layers[0].material_override)
        self.assertFalse(bpy.data.libraries)

    def test_since_blender_5_all_materials_have_nodes(self):
        given = since_five(Material)()
        ink = since_five(Material)()  # Of grease pencil, which has none.
        ink.is_grease_pencil, ink.node_tree = True, None
        bpy, scene = blender(five=True, materials=[given, ink])
        self.run_script(bpy, "--frames", "1")
        self.assertEqual(len(scene.rendered), 2)
        self.assertEqual({closure[0] for _, closure in shade(given.surface, True, 4.0)}, {"BSDF_ANISOTROPIC", "EMISSION"})

    def test_shows_the_remaining_time_and_the_command(self):
        bpy, scene = blender()
        text = self.run_script(bpy, "--frames", "4-5", "--reference-spp", "64")
        self.assertEqual([(frame, samples) for frame, samples, _ in scene.rendered], [(4, 1), (4, 64), (5, 1), (5, 64)])
        self.assertEqual(len({seed for _, _, seed in scene.rendered}), 4)
        self.assertRegex(text, r"noisy_0004.exr: rendered, 1 of 4, \d+:\d\d left")
        self.assertIn("ref_0005.exr: rendered, 4 of 4, 0:00 left", text)
        self.assertTrue(text.rstrip().endswith(
            f"    walr denoise '{self.output}' --output '{self.output}-denoised' --composite --png"), text)

    def test_the_command_fits_the_scene(self):
        bpy, _ = blender(layers=("Near things", "Far"), moves=True)
        text = self.run_script(bpy, "--frames", "1-2")
        self.assertIn("objects move (Ball)", text)
        self.assertTrue(text.rstrip().endswith("--motion-depth found --view-layer 'Near things'"), text)

    def test_the_command_denoises_reflections_beside_moving_objects(self):
        bpy, _ = blender(moves=True, materials=[material(Roughness=0.25)])
        text = self.run_script(bpy, "--frames", "1-2")
        self.assertTrue(text.rstrip().endswith("--composite --png --light all --motion-depth found"), text)

    def test_an_object_that_returns_has_moved(self):
        bpy, scene = blender(moves=True)
        scene.frame_set = lambda frame: setattr(scene, "frame", frame % 2)
        self.assertIn("objects move (Ball)", self.run_script(bpy, "--frames", "1-2"))

    def test_a_later_call_adds_frames(self):
        self.run_script(blender()[0], "--frames", "1-3")
        bpy, scene = blender()
        text = self.run_script(bpy, "--frames", "3-4")
        self.assertIn("noisy_0003.exr: already exists, skipped", text)
        self.assertEqual([frame for frame, _, _ in scene.rendered], [4])
        cameras = json.loads((self.output / "cameras.json").read_text(encoding="utf-8"))["frames"]
        self.assertEqual([camera["frame"] for camera in cameras], [1, 2, 3, 4])
        self.assertEqual(cameras[3]["view"][12], 4)
        self.assertEqual(cameras[3]["prev_view"][12], 3)

    def test_the_estimate_follows_the_samples(self):
        sys.modules["bpy"] = blender()[0]
        sys.argv = ["blender", "--", "--output", str(self.output), "--frames", "1"]
        with contextlib.redirect_stdout(io.StringIO()):
            names = runpy.run_path(SCRIPT)
        remaining = names["RemainingTime"]([1, 100, 1, 100])
        remaining.finished(1, 2.0)
        # One file of 1 sample, and two of 100 samples, which are taken to need 200 seconds each.
        self.assertEqual(remaining.text(), "6:42")
        remaining.finished(100, 3800.0)
        self.assertEqual(remaining.text(), "1:03:22")


unittest.main()
