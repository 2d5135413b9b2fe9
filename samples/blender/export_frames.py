"""Renders frames of a Blender scene with Cycles, for `walr denoise`.

    blender -b scene.blend --python samples/blender/export_frames.py -- \\
        --output DIR --frames A-B [--size WIDTHxHEIGHT] [--spp N] [--reference-spp M] [--camera NAME] \\
        [--cycles-device DEVICE]

writes to DIR, in the layout of samples/docs/sequences.md ("Blender Cycles"):

    noisy_FFFF.exr   1 sample per pixel (--spp), with the passes that the denoiser needs and those of whole pictures
    specular_FFFF.exr
                     roughness, and how far reflected things are from the surface, if materials have glossy lobes
    ref_FFFF.exr     the same frame with M samples per pixel (--reference-spp)
    cameras.json     the camera of every frame; those of frames from earlier runs are kept

Pixels are sampled at their centres: the pixel filter is 0.01 pixel wide. Each frame has its own random seed, and
references never share a seed with noisy frames. Clamping, denoising and adaptive sampling are turned off. Existing
files are kept, so that an interrupted run can be resumed. The scene file itself is not changed.

Blender's vectors hold the motion of the camera and of objects in the image, but no change of depth. `walr denoise`
computes the change of depth from the camera alone, which is wrong for moving objects: the script prints their names.

After each file the script prints the remaining time, and at the end the `walr denoise` command for the frames.
"""

import argparse
import json
import math
import pathlib
import shlex
import sys
import time

import bpy

# Cycles ignores the width of its box filter.
FILTER = "GAUSSIAN"
FILTER_WIDTH = 0.01
REFERENCE_SEED = 1000003
MOST_SAMPLES = 1 << 24
# Passes of Cycles by the names of their settings. All but the guides add up to the combined pass.
PASSES = [
    "combined", "z", "normal", "vector", "diffuse_direct", "diffuse_indirect", "diffuse_color", "glossy_direct",
    "glossy_indirect", "glossy_color", "transmission_direct", "transmission_indirect", "transmission_color",
    "volume_direct", "volume_indirect", "emit", "environment"
]
PASSES_OF_SPECULAR = ["combined", "glossy_direct", "glossy_color", "emit"]
# Shaders with a glossy lobe, and nodes that let a ray pass or hand on other shaders.
LOBES = {"BSDF_PRINCIPLED", "BSDF_GLOSSY", "BSDF_ANISOTROPIC", "BSDF_METALLIC", "BSDF_GLASS"}
PASSED = {"BSDF_TRANSPARENT", "MIX_SHADER", "ADD_SHADER", "GROUP", "GROUP_INPUT", "REROUTE"}
# Materials and worlds of Blender 5 always have nodes, and Blender 6 no longer knows the setting.
ALWAYS_NODES = bpy.app.version >= (5, 0, 0)


def fail(message):
    # After an exception in a script Blender still exits with 0; sys.exit makes the failure visible to the caller.
    print(f"export_frames.py: {message}", file=sys.stderr)
    sys.exit(1)


def pair(text, separator, option, example):
    parts = text.split(separator)
    if len(parts) != 2 or not all(part.isdigit() for part in parts):
        fail(f"{option} {text}: give two numbers, as in {option} {example}")
    return int(parts[0]), int(parts[1])


def samples(text):
    value = int(text)
    if not 0 <= value <= MOST_SAMPLES:
        raise argparse.ArgumentTypeError(f"give 0 to {MOST_SAMPLES}")
    return value


def parse_arguments():
    own = sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else []
    parser = argparse.ArgumentParser(prog="export_frames.py", description="Renders frames for walr denoise")
    parser.add_argument("--output", required=True, type=pathlib.Path, help="output folder, created if it is missing")
    parser.add_argument("--frames", required=True, help="A-B: first and last frame number, both included")
    parser.add_argument("--size", help="WIDTHxHEIGHT in pixels; default: the scene's")
    parser.add_argument("--spp", type=samples, default=1, help="samples per pixel of the noisy frames; default 1")
    parser.add_argument("--reference-spp", type=samples, default=0, help="samples per pixel of references; 0: none")
    parser.add_argument("--camera", help="name of the camera object; default: the scene's")
    # Cycles itself reads this option from the command line.
    parser.add_argument("--cycles-device", help="where Cycles renders, as OPTIX or CPU; default: as in the preferences")
    arguments = parser.parse_args(own)
    first, last = pair(arguments.frames, "-", "--frames", "1-24") if "-" in arguments.frames else (
        pair(f"{arguments.frames}-{arguments.frames}", "-", "--frames", "1-24"))
    if first > last:
        fail(f"--frames {arguments.frames}: the first frame is greater than the last")
    arguments.frames = range(first, last + 1)
    if arguments.size:
        arguments.size = pair(arguments.size, "x", "--size", "640x360")
    if arguments.spp < 1:
        fail("--spp 0: give at least one sample per pixel")
    return arguments


def choose_camera(scene, name):
    if name is not None:
        camera = scene.objects.get(name)
        if camera is None or camera.type != "CAMERA":
            known = ", ".join(o.name for o in scene.objects if o.type == "CAMERA") or "none"
            fail(f"--camera {name}: the scene has no such camera; its cameras: {known}")
        scene.camera = camera
    if scene.camera is None:
        fail("the scene has no camera; add one or choose one with --camera")
    if scene.camera.data.type != "PERSP":
        fail(f"camera '{scene.camera.name}' is not a perspective camera")
    if scene.camera.data.dof.use_dof:
        print(f"warning: depth of field of '{scene.camera.name}' is turned off: every pixel must show a single point")
        scene.camera.data.dof.use_dof = False


def set_up(scene, size):
    render = scene.render
    render.engine = "CYCLES"
    if size:
        render.resolution_x, render.resolution_y = size
    render.resolution_percentage = 100
    render.use_border = False
    render.use_multiview = False
    render.use_stamp = False
    render.use_compositing = False
    render.use_sequencer = False
    # With motion blur Cycles writes no vectors.
    render.use_motion_blur = False
    render.film_transparent = False
    # Blender 5 asks for the kind of image before the format, and makes every pass a part of its own by default.
    if hasattr(render.image_settings, "media_type"):
        render.image_settings.media_type = "MULTI_LAYER_IMAGE"
    if hasattr(render.image_settings, "use_exr_interleave"):
        render.image_settings.use_exr_interleave = True
    render.image_settings.file_format = "OPEN_EXR_MULTILAYER"
    render.image_settings.color_depth = "32"
    render.image_settings.exr_codec = "ZIP"

    cycles = scene.cycles
    cycles.pixel_filter_type = FILTER
    cycles.filter_width = FILTER_WIDTH
    cycles.use_animated_seed = False
    cycles.use_adaptive_sampling = False
    cycles.use_denoising = False
    cycles.sample_clamp_direct = 0.0
    cycles.sample_clamp_indirect = 0.0
    cycles.light_sampling_threshold = 0.0
    cycles.time_limit = 0.0
    # A view layer may have a number of samples of its own.
    cycles.use_layer_samples = "IGNORE"

    layers = [layer for layer in scene.view_layers if layer.use]
    for layer in layers:
        for name in choose_passes(layer, PASSES):
            print(f"warning: this version of Blender has no pass {name}: composites will lack it")
        layer.cycles.denoising_store_passes = False
    return layers


def choose_passes(layer, chosen):
    """Returns the names of those that this version of Blender has not."""
    missing = []
    for name in PASSES:
        # The settings of passes that only Cycles has are its own.
        owners = [owner for owner in (layer, layer.cycles) if hasattr(owner, f"use_pass_{name}")]
        missing += [] if owners else [name]
        for owner in owners:
            setattr(owner, f"use_pass_{name}", name in chosen)
    return missing


def shader_trees():
    """The nodes of all materials and of their groups."""
    groups = [group for group in bpy.data.node_groups if group.bl_idname == "ShaderNodeTree"]
    owners = [material for material in bpy.data.materials if ALWAYS_NODES or material.use_nodes]
    return [owner.node_tree for owner in owners if owner.node_tree is not None] + groups


def give_nodes(shining):
    """Makes a material or a world use nodes."""
    if not ALWAYS_NODES:
        shining.use_nodes = True


def show_specular(scene, layers):
    """Turns the scene into one whose passes tell how rough a surface is, and how far from it things are that it reflects.

    What the camera sees reflects as its glossy lobes do, and shines with their roughness in red and with 1 in green. What
    is reflected shines with one over the length of the ray in red and with 1 in green, the sky with 1 in green only. Of
    either light, red over green is the mean.
    """
    # What is linked or being edited cannot be changed.
    if bpy.context.mode != "OBJECT":
        bpy.ops.object.mode_set(mode="OBJECT")
    if bpy.data.libraries:
        bpy.ops.object.make_local(type="ALL")
    scene.cycles.max_bounces = 1
    scene.cycles.use_fast_gi = False
    for light in bpy.data.lights:
        light.animation_data_clear()
        light.energy = 0.0
    # Those that are only in instances, too.
    for thing in bpy.data.objects:
        if hasattr(thing.data, "materials"):
            give_material(thing)
    for material in bpy.data.materials:
        if not material.is_grease_pencil:
            give_nodes(material)
            aim_no_rays_at(material)
    for tree in shader_trees():
        show_lobes(tree)
    scene.world = bpy.data.worlds.new("Specular")
    give_nodes(scene.world)
    aim_no_rays_at(scene.world)
    background = next(node for node in scene.world.node_tree.nodes if node.type == "BACKGROUND")
    background.inputs["Color"].default_value = (0.0, 1.0, 0.0, 1.0)
    for layer in layers:
        layer.material_override = None
        choose_passes(layer, PASSES_OF_SPECULAR)


def give_material(thing):
    """Cycles shows a thing without a material in grey."""
    if not thing.data.materials:
        thing.data.materials.append(bpy.data.materials.new("Specular"))
    for slot in thing.material_slots:
        slot.material = slot.material or bpy.data.materials.new("Specular")


def aim_no_rays_at(shining):
    """Only reflected rays may find what shines: Cycles would weigh them against rays that it aims at a light."""
    # Materials until Blender 3.4, later ones, worlds.
    for setting, value in ("sample_as_light", False), ("emission_sampling", "NONE"), ("sampling_method", "NONE"):
        if hasattr(shining.cycles, setting):
            setattr(shining.cycles, setting, value)


def show_lobes(tree):
    """Replaces every shader of a tree of nodes for show_specular, but those that let a ray pass."""
    transparent = tree.nodes.new("ShaderNodeBsdfTransparent").outputs[0]
    for node in [each for each in tree.nodes if each.type == "OUTPUT_MATERIAL" and each.inputs["Volume"].is_linked]:
        tree.links.remove(node.inputs["Volume"].links[0])
        if not node.inputs["Surface"].is_linked:
            tree.links.new(transparent, node.inputs["Surface"])
    shaders = [(node, [link.to_socket for output in node.outputs if output.type == "SHADER" for link in output.links])
               for node in tree.nodes if node.type not in PASSED]
    path = tree.nodes.new("ShaderNodeLightPath")
    red, reflected = add_light(tree)
    nearness = tree.nodes.new("ShaderNodeMath")
    nearness.operation = "DIVIDE"
    nearness.inputs[0].default_value = 1.0
    tree.links.new(path.outputs["Ray Length"], nearness.inputs[1])
    tree.links.new(nearness.outputs[0], red)
    for node, targets in shaders:
        if not targets:
            continue
        replaced = add_mix(tree, reflected, add_lobe(tree, node) if node.type in LOBES else None)
        tree.links.new(path.outputs["Is Camera Ray"], replaced.inputs["Fac"])
        if "Alpha" in node.inputs:
            replaced = add_mix(tree, transparent, replaced.outputs[0])
            copy_input(tree, node.inputs["Alpha"], replaced.inputs["Fac"])
        for target in targets:
            tree.links.new(replaced.outputs[0], target)


def add_light(tree):
    """The input for the red of a light whose green is 1, and the light."""
    colour = tree.nodes.new("ShaderNodeCombineXYZ")
    colour.inputs["Y"].default_value = 1.0
    light = tree.nodes.new("ShaderNodeEmission")
    tree.links.new(colour.outputs[0], light.inputs["Color"])
    return colour.inputs["X"], light.outputs[0]


def add_lobe(tree, node):
    """A white lobe that is as rough as the one of the node, and light that tells so."""
    lobe = tree.nodes.new("ShaderNodeBsdfAnisotropic")
    lobe.inputs["Color"].default_value = (1.0, 1.0, 1.0, 1.0)
    lobe.inputs["Anisotropy"].default_value = 0.0
    red, light = add_light(tree)
    for target in lobe.inputs["Roughness"], red:
        copy_input(tree, node.inputs["Roughness"], target)
    if node.inputs["Normal"].is_linked:
        copy_input(tree, node.inputs["Normal"], lobe.inputs["Normal"])
    both = tree.nodes.new("ShaderNodeAddShader")
    tree.links.new(lobe.outputs[0], both.inputs[0])
    tree.links.new(light, both.inputs[1])
    return both.outputs[0]


def add_mix(tree, first, second):
    mix = tree.nodes.new("ShaderNodeMixShader")
    tree.links.new(first, mix.inputs[1])
    if second is not None:
        tree.links.new(second, mix.inputs[2])
    return mix


def copy_input(tree, source, target):
    if source.is_linked:
        tree.links.new(source.links[0].from_socket, target)
    else:
        target.default_value = source.default_value


def numbers(matrix):
    """The 16 elements column by column, the project's order; Blender's matrices are indexed by row."""
    return [matrix[row][column] for column in range(4) for row in range(4)]


def view_matrix(scene, frame):
    scene.frame_set(frame)
    camera = scene.camera.evaluated_get(bpy.context.evaluated_depsgraph_get())
    return camera.matrix_world.normalized().inverted()


def describe_camera(scene, frame):
    previous = view_matrix(scene, frame - 1)
    view = view_matrix(scene, frame)
    camera = scene.camera.evaluated_get(bpy.context.evaluated_depsgraph_get())
    projection = camera.calc_matrix_camera(
        bpy.context.evaluated_depsgraph_get(), x=scene.render.resolution_x, y=scene.render.resolution_y,
        scale_x=scene.render.pixel_aspect_x, scale_y=scene.render.pixel_aspect_y)
    return {"frame": frame, "view": numbers(view), "prev_view": numbers(previous), "projection": numbers(projection)}


def name_moving_objects(scene, frames):
    def places(frame):
        scene.frame_set(frame)
        graph = bpy.context.evaluated_depsgraph_get()
        return {o.name: o.evaluated_get(graph).matrix_world.copy()
                for o in scene.objects if o.type in {"MESH", "CURVE", "SURFACE", "META", "FONT"}}

    # Every frame, because an object may be back at its place in the last one.
    moving, before = set(), places(frames.start - 1)
    for frame in frames:
        now = places(frame)
        moving |= {name for name in before if name in now and before[name] != now[name]}
        before = now
    moving = sorted(moving)
    if moving:
        print(f"warning: objects move ({', '.join(moving[:8])}{', ...' if len(moving) > 8 else ''}): walr denoise uses "
              "their motion in the image; let it find their change of depth with --motion-depth found")
    return bool(moving)


def write_cameras(file, scene, frames):
    known = json.loads(file.read_text(encoding="utf-8"))["frames"] if file.exists() else []
    cameras = {camera["frame"]: camera for camera in known}
    cameras.update((frame, describe_camera(scene, frame)) for frame in frames)
    document = {
        "convention": "column-major; view = world to camera, camera looks down -Z, +Y up; OpenGL clip space (z in -1..1); "
                      "world = Blender's; prev_view = view of the frame before",
        "frames": [cameras[frame] for frame in sorted(cameras)],
    }
    file.write_text(json.dumps(document, indent=1) + "\n", encoding="utf-8")


def render(scene, file, sample_count, seed):
    scene.cycles.samples = sample_count
    scene.cycles.seed = seed
    # A temporary name until the file is complete. It ends with .exr because Blender would append that otherwise.
    unfinished = file.with_name("unfinished.exr")
    scene.render.filepath = str(unfinished)
    bpy.ops.render.render(write_still=True)
    if not unfinished.exists():
        fail(f"Blender wrote no {unfinished}")
    unfinished.replace(file)


class RemainingTime:
    """Estimates the time until all files are rendered, from the mean time of the finished ones.

    Files with more samples take longer, so each number of samples has its own mean. Until one of them is finished, its
    mean follows from another one's in proportion to the samples.
    """

    def __init__(self, sample_counts):
        self.waiting = {count: sample_counts.count(count) for count in set(sample_counts)}
        self.times = {count: [] for count in self.waiting}

    def finished(self, sample_count, seconds):
        self.waiting[sample_count] -= 1
        self.times[sample_count].append(seconds)

    def mean(self, sample_count):
        known = {count: sum(times) / len(times) for count, times in self.times.items() if times}
        nearest = min(known, key=lambda count: abs(math.log(count / sample_count)))
        return known[nearest] * sample_count / nearest

    def text(self):
        seconds = math.ceil(sum(count * self.mean(samples) for samples, count in self.waiting.items() if count))
        minutes, seconds = divmod(seconds, 60)
        hours, minutes = divmod(minutes, 60)
        return f"{hours}:{minutes:02d}:{seconds:02d}" if hours else f"{minutes}:{seconds:02d}"


def render_all(scene, output, arguments, layers, specular):
    jobs = []
    for frame in arguments.frames:
        jobs.append((frame, output / f"noisy_{frame:04d}.exr", arguments.spp, frame + 1))
        if arguments.reference_spp:
            jobs.append((frame, output / f"ref_{frame:04d}.exr", arguments.reference_spp, REFERENCE_SEED + frame))
    # The last ones, because they change the scene. The seed is that of the light, for the same paths where it can be.
    last = [(frame, output / f"specular_{frame:04d}.exr", arguments.spp, frame + 1)
            for frame in arguments.frames if specular]
    existing = [file for _, file, _, _ in jobs + last if file.exists()]
    for file in existing:
        print(f"{file.name}: already exists, skipped")
    jobs, last = ([job for job in some if job[1] not in existing] for some in (jobs, last))
    remaining = RemainingTime([sample_count for _, _, sample_count, _ in jobs + last])
    for number, (frame, file, sample_count, seed) in enumerate(jobs + last, 1):
        if number == len(jobs) + 1:
            show_specular(scene, layers)
        start = time.monotonic()
        scene.frame_set(frame)
        render(scene, file, sample_count, seed)
        remaining.finished(sample_count, time.monotonic() - start)
        print(f"{file.name}: rendered, {number} of {len(jobs) + len(last)}, {remaining.text()} left", flush=True)


def denoise_command(output, layers, options):
    command = ["walr", "denoise", str(output), "--output", f"{output}-denoised", "--composite", "--png", *options]
    if len(layers) > 1:
        command += ["--view-layer", layers[0].name]
    return shlex.join(command)


def main():
    arguments = parse_arguments()
    scene = bpy.context.scene
    choose_camera(scene, arguments.camera)
    layers = set_up(scene, arguments.size)
    specular = any(node.type in LOBES for tree in shader_trees() for node in tree.nodes)
    if len(layers) > 1:
        print(f"warning: the scene has several view layers ({', '.join(layer.name for layer in layers)}): walr denoise "
              "reads one at a time, which --view-layer names")
    output = arguments.output.resolve()
    output.mkdir(parents=True, exist_ok=True)
    moving = name_moving_objects(scene, arguments.frames)
    write_cameras(output / "cameras.json", scene, arguments.frames)
    render_all(scene, output, arguments, layers, specular)
    options = (["--light", "all"] if specular else []) + (["--motion-depth", "found"] if moving else [])
    print(f"Finished. Denoise the frames with\n    {denoise_command(output, layers, options)}", flush=True)


main()
