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

    def add(self, *_):
        self.append(types.SimpleNamespace(inputs={"Value": types.SimpleNamespace(default_value=0.0)}, outputs=[]))
        return self[-1]

    new = add


def lobe(roughness, source=None):
    """A node of a glossy lobe whose roughness is a number or comes from another node."""
    socket = types.SimpleNamespace(default_value=roughness, is_linked=source is not None,
                                   links=[types.SimpleNamespace(from_socket=source)])
    return types.SimpleNamespace(type="BSDF_PRINCIPLED", inputs={"Roughness": socket},
                                 outputs=[types.SimpleNamespace(is_linked=True)])


def material(*nodes):
    links = []
    made = types.SimpleNamespace(new=lambda source, target: links.append((source, target)), all=links)
    return types.SimpleNamespace(use_nodes=True, node_tree=types.SimpleNamespace(nodes=Made(nodes), links=made))


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
    return types.SimpleNamespace(name=name, use=True, aovs=Made(), **{f"use_pass_{p}": False for p in passes},
                                 cycles=types.SimpleNamespace(denoising_store_passes=True, **volumes))


def blender(layers=("ViewLayer",), moves=False, five=False, volume=True, materials=()):
    """The module bpy and its scene."""
    scene = types.SimpleNamespace(frame=0, rendered=[], cycles=types.SimpleNamespace())
    scene.frame_set = lambda frame: setattr(scene, "frame", frame)
    lens = types.SimpleNamespace(type="PERSP", dof=types.SimpleNamespace(use_dof=False))
    camera = Thing(name="Camera", type="CAMERA", data=lens, scene=scene, moves=True)
    scene.objects = Objects([camera, Thing(name="Ball", type="MESH", scene=scene, moves=moves)])
    scene.camera = camera
    settings = Refusing(media_type="IMAGE", use_exr_interleave=False) if five else types.SimpleNamespace()
    scene.render = types.SimpleNamespace(resolution_x=64, resolution_y=36, pixel_aspect_x=1, pixel_aspect_y=1,
                                         image_settings=settings)
    scene.view_layers = [layer(name, volume) for name in layers]

    def render(write_still):
        assert write_still
        scene.rendered.append((scene.frame, scene.cycles.samples, scene.cycles.seed))
        pathlib.Path(scene.render.filepath).write_text("pixels", encoding="utf-8")

    bpy = types.ModuleType("bpy")
    bpy.context = types.SimpleNamespace(scene=scene, evaluated_depsgraph_get=lambda: None)
    bpy.data = types.SimpleNamespace(materials=materials)
    bpy.ops = types.SimpleNamespace(render=types.SimpleNamespace(render=render))
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
            self.run_script(bpy, "--frames", "1")
            chosen = scene.view_layers[0]
            for owner in (chosen, chosen.cycles):
                for name, value in vars(owner).items():
                    if name.startswith("use_pass_"):
                        self.assertTrue(value, name)
            self.assertFalse(chosen.cycles.denoising_store_passes)
            self.assertEqual(scene.render.image_settings.file_format, "OPEN_EXR_MULTILAYER")
            if five:
                self.assertTrue(scene.render.image_settings.use_exr_interleave)

    def test_warns_of_a_pass_that_blender_has_not(self):
        bpy, _ = blender(volume=False)
        self.assertIn("no use_pass_volume_direct", self.run_script(bpy, "--frames", "1"))

    def test_materials_write_their_roughness(self):
        bpy, scene = blender(materials=[material(lobe(0.25)), material(lobe(0.0, "a texture"))])
        self.assertNotIn("roughness", self.run_script(bpy, "--frames", "1"))
        number, texture = (each.node_tree for each in bpy.data.materials)
        for tree in number, texture:
            self.assertEqual(tree.nodes[-1].name, "Roughness")
        self.assertEqual(number.nodes[-1].inputs["Value"].default_value, 0.25)
        self.assertEqual(texture.links.all, [("a texture", texture.nodes[-1].inputs["Value"])])
        self.assertEqual([(aov.name, aov.type) for aov in scene.view_layers[0].aovs], [("Roughness", "VALUE")])
        self.run_script(bpy, "--frames", "2")
        self.assertEqual(len(number.nodes), 2)

    def test_several_lobes_have_no_roughness(self):
        bpy, scene = blender(materials=[material(lobe(0.25)), material(lobe(0.25), lobe(0.5))])
        self.assertIn("no pass of roughness", self.run_script(bpy, "--frames", "1"))
        self.assertEqual(scene.view_layers[0].aovs, [])
        self.assertEqual(len(bpy.data.materials[0].node_tree.nodes), 1)

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
