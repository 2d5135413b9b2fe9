"""The corpus: which scenes are rendered at which sizes and numbers of samples, and what that costs."""
import dataclasses
import hashlib
import json
import os
import pathlib
import subprocess
import sys
import tempfile

PROJECT = pathlib.Path(__file__).resolve().parents[2]
BUILD = pathlib.Path(os.environ.get("WALR_BUILD", PROJECT / "build"))
"""The folder of the build, whose programs and scenes are used unless an option names others."""
BUILT_IN = BUILD / "samples" / "scenes"
SHARED = pathlib.Path(os.environ.get("WALR_SHARED") or "$WALR_SHARED")
"""Folder of scenes and sequences that are not part of the project. Without the environment variable its name stands in their
paths, so that messages about absent files say what to set."""

PATHS_PER_SECOND = 400e3
"""Paths that `walr render` traces in a second on two idle cores. Scenes differ by about a factor of two."""
LIMITS = {"daily": 20 / 60, "nightly": 10.0, "figures": 1.0}
"""Hours that a part may take on two idle cores."""
WARM_UP = 8
"""Frames before the first judged one, in which history builds up: the longest history of `walr` is 8 frames."""


@dataclasses.dataclass(frozen=True)
class Entry:
    """One sequence of the corpus. Every sequence is jittered, and its references are means over the pixel's area."""

    name: str
    scene: pathlib.Path
    size: tuple  # Width and height in pixels.
    judged: tuple  # First and last frame with a reference.
    one_square_in: int  # One in so many squares of 64 x 64 pixels has a reference.
    samples: int = 1  # Per pixel of the noisy frames.
    reference_samples: int = 256  # Per pixel; half of them is one of two independent halves.
    part: str = "nightly"  # "daily", "nightly" or "figures".
    held_back: bool = False  # No sweep may look at it; it is reported apart.
    camera: str = ""  # The first one if empty.
    seed: int = 0  # Of the noisy frames.
    specular: bool = False  # Materials reflect, and specular light is judged.

    @property
    def frames(self):
        """First and last frame that is rendered."""
        return max(0, self.judged[0] - WARM_UP), self.judged[1]

    @property
    def pixels(self):
        return self.size[0] * self.size[1]

    def restricted(self, judged, seed):
        """The same entry with another seed, and with only the first `judged` frames that have a reference, if that is not None."""
        first, last = self.judged
        return dataclasses.replace(self, seed=seed, judged=(first, last if judged is None else min(last, first + judged - 1)))

    def reference_settings(self):
        """What the references depend on. Noisy frames of other seeds and numbers of samples share them."""
        return {"scene": self.scene.name, "contents": hashlib.sha256(self.scene.read_bytes()).hexdigest(), "size": list(self.size),
                "judged": list(self.judged), "one_square_in": self.one_square_in, "reference_samples": self.reference_samples,
                "camera": self.camera, **({"specular": True} if self.specular else {})}

    def settings(self):
        """What the frames of the sequence depend on, without the renderer."""
        return {**self.reference_settings(), "frames": list(self.frames), "samples": self.samples, "seed": self.seed}

    def noisy_paths(self):
        """Paths for the noisy frames. `walr render` counts a frame's G-buffer as one path per pixel."""
        return (self.frames[1] - self.frames[0] + 1) * self.pixels * (self.samples + 1)

    def reference_paths(self):
        return (self.judged[1] - self.judged[0] + 1) * self.pixels * self.reference_samples / self.one_square_in

    def noisy_options(self, frames, jitter=True):
        """The options of `walr render` for noisy frames alone. frames: first and last one."""
        width, height = self.size
        options = ["--frames", "{}-{}".format(*frames), "--size", f"{width}x{height}", "--spp", str(self.samples)]
        options += ["--jitter"] if jitter else []
        return options + (["--camera", self.camera] if self.camera else []) + (["--seed", str(self.seed)] if self.seed else [])

    def render_options(self):
        """The options of `walr render`."""
        return self.noisy_options(self.frames) + [
            "--reference-spp", str(self.reference_samples), "--reference-frames", "{}-{}".format(*self.judged),
            "--reference-pixel", "area", "--reference-one-square-in", str(self.one_square_in), *self.light_options()]

    def light_options(self):
        return ["--specular"] if self.specular else []


def key(settings, renderer):
    """The name of the folder for what was rendered with these settings by this renderer."""
    text = json.dumps([settings, renderer], sort_keys=True)
    return hashlib.sha256(text.encode()).hexdigest()[:16]


def run_walr(walr, *arguments):
    """Runs the program, and ends with what it says if it fails."""
    done = subprocess.run(list(map(str, (walr, *arguments))), capture_output=True, text=True)
    if done.returncode:
        sys.exit(f"{' '.join(map(str, (walr, *arguments)))} failed:\n{done.stderr[-2000:]}")


def renderer_version(walr, scene, camera="", *options):
    """The version of the renderer as far as this scene shows it: a hash of two tiny pictures and a reference of it, with these options
    more.

    A change of the program that changes no pixel keeps what has been rendered; one that changes pixels does not."""
    with tempfile.TemporaryDirectory() as folder:
        run_walr(walr, "render", scene, "--output", folder, "--frames", "9-10", "--size", "48x27", "--spp", "2", "--jitter",
                 "--reference-spp", "2", "--reference-pixel", "area", *(["--camera", camera] if camera else []), *options)
        files = sorted(pathlib.Path(folder).glob("*.exr"))
        return hashlib.sha256(b"".join(file.read_bytes() for file in files)).hexdigest()[:16]


VGA, QHD, FULL_HD = (640, 360), (960, 540), (1920, 1080)


def built_in(name, scene, *more, **settings):
    return Entry(name, BUILT_IN / f"{scene}.gltf", *more, **settings)


def shared(name, scene, *more, **settings):
    return Entry(name, SHARED / "scenes" / f"{scene}.glb", *more, **settings)


def corpus():
    """All entries by name. The lamp of `stair` swings until frame 29 and is off from frame 30 on."""
    quick = {"reference_samples": 128, "part": "daily"}
    entries = [
        built_in("kitchen_360", "kitchen", VGA, (8, 10), 5, **quick),
        built_in("kitchen_360_4spp", "kitchen", VGA, (8, 10), 5, samples=4, **quick),
        built_in("stair_swing_360", "stair", VGA, (10, 12), 5, **quick),
        built_in("stair_off_360", "stair", VGA, (31, 33), 5, **quick),
        built_in("garden_360", "garden", VGA, (8, 10), 5, **quick),
        built_in("turntable_360", "turntable", VGA, (20, 22), 5, **quick),

        built_in("kitchen_540", "kitchen", QHD, (12, 19), 6),
        built_in("kitchen_1080", "kitchen", FULL_HD, (12, 19), 24),
        built_in("kitchen_540_4spp", "kitchen", QHD, (12, 19), 6, samples=4),
        built_in("kitchen_540_16spp", "kitchen", QHD, (12, 19), 6, samples=16),
        built_in("stair_swing_540", "stair", QHD, (12, 19), 6),
        built_in("stair_swing_1080", "stair", FULL_HD, (12, 19), 24, held_back=True),
        built_in("stair_off_540", "stair", QHD, (28, 37), 6),
        built_in("stair_off_540_4spp", "stair", QHD, (28, 37), 6, samples=4, held_back=True),
        built_in("garden_540", "garden", QHD, (12, 19), 6),
        built_in("garden_1080", "garden", FULL_HD, (12, 19), 24, held_back=True),
        built_in("turntable_540", "turntable", QHD, (16, 23), 6, held_back=True),
        built_in("fence_540", "box", QHD, (12, 19), 6, camera="fence"),
        built_in("window_540", "box", QHD, (12, 19), 6, camera="window", held_back=True),
        shared("sponza_360", "sponza", VGA, (20, 27), 3),
        shared("sponza_1080", "sponza", FULL_HD, (20, 27), 24),
        shared("living_room_540", "living_room", QHD, (20, 27), 6, held_back=True),
        shared("living_room_1080", "living_room", FULL_HD, (20, 27), 24, held_back=True),
        shared("cornell_fence_540", "cornell_fence", QHD, (12, 19), 6, held_back=True),
        shared("cornell_fence_540_16spp", "cornell_fence", QHD, (12, 19), 6, samples=16, held_back=True),
    ]
    return {entry.name: entry for entry in entries}


def figures():
    """The entries behind the figures of README.md, by name: scenes of this repository under a sun, a sky and lamps, with leaves, a
    fence, and objects and a lamp that move."""
    few = {"part": "figures"}
    entries = [
        built_in("kitchen", "kitchen", QHD, (12, 15), 6, **few),
        built_in("garden", "garden", QHD, (12, 15), 6, **few),
        built_in("stair", "stair", QHD, (12, 15), 6, **few),
        built_in("turntable", "turntable", QHD, (28, 31), 6, **few),
        built_in("fence", "box", QHD, (12, 15), 6, camera="fence", **few),
    ]
    return {entry.name: entry for entry in entries}


TIMES = {
    "walr": 1.0, "walr_paper": 1.6, "bmfr": 0.9, "svgf": 2.2, "flr": 0.5, "accumulate": 0.2, "none": 0.03,
    "walr_paper:robust": 1.7, "joint_bilateral": 14.0, "flnr": 3.6,
}
"""Times of methods on two idle cores as multiples of that of `walr`."""
METHODS = [method for method in TIMES if method != "flnr"]
"""The methods that the daily and the nightly part compare. Those of the figures are all of TIMES."""
SLOW = ("walr_paper:robust", "joint_bilateral")
"""Methods that the daily part leaves out."""
WALR_PIXELS_PER_SECOND = 0.9e6
"""Pixels that `walr` denoises in a second on a software device with two idle cores."""
JUDGED_PIXELS_PER_SECOND = 0.5e6
"""Pixels of one method's result that are judged in a second: SSIM and FLIP of `walr bench`, and the splits."""


def bench_seconds(entry, methods):
    """Seconds to denoise and judge an entry on two idle cores. Methods that are not in TIMES count as `walr`."""
    frames = entry.frames[1] - entry.frames[0] + 1
    judged = entry.judged[1] - entry.judged[0] + 1
    denoised = sum(TIMES.get(method, 1.0) for method in methods) * frames * entry.pixels / WALR_PIXELS_PER_SECOND
    return denoised + len(methods) * judged * entry.pixels / JUDGED_PIXELS_PER_SECOND


def costs(entries, methods):
    """For every entry the seconds of noisy frames, of references that no earlier entry has, and of the benchmark."""
    known, rows = set(), []
    for entry in entries:
        references = (entry.scene, entry.size, entry.judged, entry.one_square_in, entry.reference_samples, entry.camera)
        rows.append((entry, entry.noisy_paths() / PATHS_PER_SECOND,
                     0.0 if references in known else entry.reference_paths() / PATHS_PER_SECOND, bench_seconds(entry, methods)))
        known.add(references)
    return rows
