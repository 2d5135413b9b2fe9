#!/usr/bin/env python3
"""Opens walr-host's window on a virtual screen, operates it by mouse and keyboard, and checks the pixels of the screen.

    host_window_test.py SCENARIO WALR_HOST SCENES SCREENSHOT.png

What the window shows must be, bit for bit, what runs without a window write, the panel beside it must hold text, times
and the memory chart, and the program must end without a word from the validation layer when it is asked to.
"""

import base64
import contextlib
import json
import os
import pathlib
import re
import signal
import struct
import subprocess
import sys
import tempfile
import time

from virtual_screen import PATIENCE, FileDrop, Hands, WindowManager, read_png, virtual_screen, wait_for, write_png

WIDTH, HEIGHT = 160, 90
PANEL_WIDTH = 420
# What the program writes to its standard error. Libraries may write there, too: some versions of GLFW look for Wayland first and say
# that there is none. A message of the validation layer changes the exit code.
OWN_WORDS = re.compile(r"^(walr-host: |warning: |no display: |built without windows )", re.MULTILINE)
REFUSAL_COLOUR = (110, 50, 20)  # Of the ground of the message.
FINDINGS_COLOUR = (80, 20, 90)


def find_picture(screen, picture):
    """Position of the whole image on the screen in pixels; None if it is not there."""
    for y in range(len(screen) - len(picture) + 1):
        position = screen[y].find(picture[0])
        while position >= 0:
            if position % 3 == 0 and all(
                    screen[y + i][position:position + len(row)] == row for i, row in enumerate(picture)):
                return position // 3, y
            position = screen[y].find(picture[0], position + 1)
    return None


def distance(a, b):
    """Mean difference of two images, in levels of 255."""
    return sum(abs(x - y) for row, other in zip(a, b) for x, y in zip(row, other)) / (len(a) * len(a[0]))


class Host:
    """The program: without a window it writes the expected images, with one it shows them."""

    def __init__(self, program, scene, folder, screenshot, size=(WIDTH, HEIGHT)):
        self.program, self.scene, self.folder, self.screenshot = program, scene, folder, screenshot
        self.size = size

    def command(self, frames, options):
        return [self.program, self.scene, "--frames", frames, "--size", f"{self.size[0]}x{self.size[1]}", *options]

    def pictures(self, frames, *options):
        """Images of the frames, by frame number."""
        with tempfile.TemporaryDirectory(dir=self.folder) as folder:
            subprocess.run([*self.command(frames, options), "--headless", "--output", folder], check=True,
                           stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            return {int(file.stem[-4:]): read_png(file) for file in pathlib.Path(folder).glob("*.png")}

    def known(self, option, *more):
        """The names that an option accepts, from the program's message about an unknown name."""
        run = subprocess.run([*self.command("0-0", [option, "?", *more]), "--headless", "--output", self.folder / "none"],
                             capture_output=True, text=True, check=False)
        listed = re.search(r"\{(.*)\}|known presets: (.*)", run.stderr)
        if listed:
            return [name.strip() for name in (listed[1] or listed[2]).split(",")]
        return re.findall(r"'([^']*)'", run.stderr)[1:]

    @contextlib.contextmanager
    def window(self, screen, frames, *options, more=(), meanwhile=lambda: None):
        """The window, after `meanwhile` was called and it has reached the last frame and stopped there. It has `more`
        options than the picture that it shows."""
        last = int(frames.split("-")[1])
        expected = self.pictures(frames, *options)[last]
        if len({bytes(row) for row in expected}) < self.size[1] // 2:
            sys.exit("the expected image has too few distinct rows to be found")
        process = subprocess.Popen([*self.command(frames, options), *more, "--once", "--validate"],
                                   env={**os.environ, "DISPLAY": screen.display}, stdout=subprocess.DEVNULL,
                                   stderr=subprocess.PIPE, text=True)
        try:
            def shown():
                if process.poll() is not None:
                    sys.exit(f"the program ended: {process.stderr.read()}")
                return find_picture(screen.rows(), expected)

            meanwhile()
            place = wait_for(shown, "the picture in the window")
            print(f"the picture stands at {place}")
            # What the panel tells of the frame follows with the next drawing.
            time.sleep(1.0)
            yield Window(screen, place, self.size)
            process.send_signal(signal.SIGTERM)
            code = process.wait(timeout=PATIENCE)
            complaint = process.stderr.read()
            if code != 0 or OWN_WORDS.search(complaint):
                sys.exit(f"the program ended with {code}: {complaint}")
        except SystemExit:
            write_png(self.screenshot.with_suffix(".failed.png"), screen.rows())
            if process.poll() is not None:
                print(f"the program ended with {process.returncode}: {process.stderr.read()}")
            raise
        finally:
            if process.poll() is None:
                process.kill()
                process.wait()


class Window:
    """The window on the screen. Positions hold for Dear ImGui's default font and style."""

    LINE = 23  # From one widget to that below it.
    ITEM = 17  # From one item of a list to that below it.

    def __init__(self, screen, place, size):
        self.screen, self.place, self.size, self.hands = screen, place, size, Hands(screen)
        self.panel = place[0] + size[0]
        self.view_extras = 0

    def picture(self):
        return self.screen.rows(*self.place, *self.size)

    def at(self, x, y):
        return self.panel + x, y

    def pause(self):
        self.hands.click(*self.at(17, 18))

    def freeze(self):
        self.hands.click(*self.at(83, 18))

    def cut(self):
        self.hands.click(*self.at(186, 18))

    def reset_history(self):
        """Returns without waiting for the effect, so that the first image after the reset can be read."""
        self.hands.move(*self.at(280, 18))
        self.hands.press(True)
        self.hands.release_now()

    def scene_camera(self):
        self.hands.click(*self.at(18, 58))

    def orbit(self):
        self.hands.click(*self.at(133, 58))

    def fly(self):
        self.hands.click(*self.at(199, 58))

    def choose_view(self, name):
        views = ["denoised", "noisy", "reference", "split", "compare", "texture"]
        self.choose(108, views.index(name), len(views))
        # Below it come a texture's name, gain and bias, or the edges of the split.
        self.view_extras = {"texture": 3, "split": 1, "compare": 1}.get(name, 0)

    def choose_texture(self, index, count):
        self.choose(108 + self.LINE, index, count)

    def choose_method(self, index, count):
        self.choose(135 + self.LINE * self.view_extras, index, count)

    def choose_preset(self, index, count):
        self.choose(158 + self.LINE * self.view_extras, index, count)

    def choose(self, y, index, count):
        """Open the chooser whose middle is at a height, and take an item from its list; frozen, or times change too. Under load
        a click may be lost, so it is repeated, unless the chooser shows another item afterwards."""
        shown = self.chooser(y)
        for _ in range(3):
            top = wait_for(lambda: self.opened_list(y, count), f"a list of {count} items to open at {y}")
            border = self.rows()[top]
            self.hands.click(*self.at(100, top + 8 + 6 + index * self.ITEM))
            wait_for(lambda: self.rows()[top] != border, f"the list at {y} to close")
            if self.chooser(y) != shown:
                break

    def chooser(self, y):
        """What the chooser whose middle is at a height shows under the mouse."""
        self.hands.move(*self.at(100, y))
        return self.rows()[y - 8:y + 8]

    def opened_list(self, y, count):
        """Click at the chooser and return the first row of its list. A frame that ended meanwhile changes other rows, too:
        then the list is closed again, and the result is None."""
        before = self.settled_rows()
        self.hands.click(*self.at(100, y))
        end = time.monotonic() + 10.0
        while time.monotonic() < end:
            after = self.rows()
            changed = [i for i, (a, b) in enumerate(zip(before, after)) if a != b and abs(i - y) > 10]
            # Items lie 4 pixels apart, with 8 around all of them; an edge may lie under the mouse's own light.
            high = changed[-1] + 1 - changed[0] if changed else 0
            if abs(high - (16 - 4 + count * self.ITEM)) <= 3:
                return changed[0]
            time.sleep(0.02)
        self.hands.click(*self.at(100, y))
        return None

    def rows(self):
        """The panel."""
        return self.screen.rows(self.panel, 0, PANEL_WIDTH, 720)

    def settled_rows(self):
        """The panel, once nothing in it has changed for a second: a frame may take that long on a processor."""
        rows = [self.rows()]

        def same():
            time.sleep(0.25)
            rows.append(self.rows())
            return len(rows) > 4 and all(row == rows[-1] for row in rows[-5:]) and rows[-1]

        return wait_for(same, "the panel to come to rest")

    def must_show(self, picture, what):
        wait_for(lambda: self.picture() == picture, f"the window to show {what}")
        print(f"the window shows {what}")

    def check_panel(self):
        """The panel: text and widgets on a dark ground, bars of times, and rectangles of memory."""
        panel = self.screen.rows(self.panel, 0, PANEL_WIDTH, 700)
        pixels = [tuple(row[i:i + 3]) for row in panel for i in range(0, len(row), 3)]
        text = sum(min(p) > 200 for p in pixels)
        widgets = sum(p[2] > 100 and p[2] > p[0] + 40 for p in pixels)
        written = sum(any(min(row[i:i + 3]) > 200 for i in range(0, len(row), 3)) for row in panel)
        bars = sum(p[0] > 200 and p[1] > 150 and p[2] < 40 for p in pixels)
        counts = {p: 0 for p in pixels}
        for p in pixels:
            counts[p] += 1
        memory = [p for p, count in counts.items() if count > 200 and max(p) > 180 and 60 < min(p) < 120]
        print(f"panel: {text} pixels of text on {written} rows, {widgets} of widgets, {bars} of bars of times, "
              f"{len(memory)} colours of memory")
        # A label is some hundred pixels of text; the panel has more than twenty of them.
        if text < 2000 or widgets < 2000 or written < 200:
            sys.exit("the panel is not there")
        # All bars together are one of 120 x 17 pixels, and every texture has a colour of its own.
        if bars < 500 or len(memory) < 5:
            sys.exit("times or the memory chart are not there")


def start(host, screen, *options):
    """The first image is the requested one, and the panel is visible."""
    with host.window(screen, "0-3", *options) as window:
        window.check_panel()
        write_png(host.screenshot, screen.rows())


def split(host, screen):
    start(host, screen, "--method", "accumulate", "--view", "split")


def methods(host, screen):
    """Every method, and every preset of one method, can be chosen and gives the same image as without a window."""
    paper = "walr_paper"
    names, presets = host.known("--method"), host.known("--preset", "--method", paper)

    # What is chosen anew starts with the frame at hand; in the box, nothing moves in frames 0 to 3. The images are made before the
    # window opens, which then finds the compiled shaders in Mesa's cache.
    def picture(*options):
        return host.pictures("3-3", *options)[3]

    of_method = {name: picture("--method", name) for name in names}
    of_preset = {name: picture("--method", paper, "--preset", name) for name in presets[1:]}
    with host.window(screen, "0-3") as window:
        for index, name in [*enumerate(names)][1:] + [(0, names[0])]:
            window.choose_method(index, len(names))
            window.must_show(of_method[name], f"method {name}")
        window.choose_method(names.index(paper), len(names))
        for index, name in [*enumerate(presets)][1:]:
            window.choose_preset(index, len(presets))
            window.must_show(of_preset[name], f"preset {name}")
        write_png(host.screenshot, screen.rows())


def views(host, screen):
    """Every view can be chosen, and of the textures the first, the last and some in between."""
    preset = ("--method", "walr_paper", "--preset", "robust")  # Its list of textures needs no scrolling.
    textures = host.known("--view", *preset)
    chosen = sorted({0, textures.index("normal"), len(textures) - 1, *range(3, len(textures), 7)})
    expected = {index: host.pictures("3-3", "--view", textures[index], *preset)[3] for index in chosen}
    with host.window(screen, "0-3", *preset) as window:
        window.choose_view("texture")
        for index in chosen:
            window.choose_texture(index, len(textures))
            window.must_show(expected[index], f"texture '{textures[index]}'")
        write_png(host.screenshot, screen.rows())
        # A split view needs a reference: another frame is traced, with it, and stays for the views after it.
        before = window.picture()
        window.choose_view("split")
        wait_for(lambda: window.picture() != before, "the split view")
        time.sleep(1.0)
        together = window.picture()
        write_png(host.screenshot.with_suffix(".split.png"), screen.rows())
        apart = {}
        for name in ("noisy", "denoised", "reference"):
            before = window.picture()
            window.choose_view(name)
            wait_for(lambda: window.picture() != before, f"the {name} view")
            time.sleep(0.5)
            apart[name] = window.picture()
        left, right = WIDTH // 3, WIDTH - WIDTH // 3
        for y in range(HEIGHT):
            for name, first, end in (("noisy", 0, left), ("denoised", left + 1, right), ("reference", right + 1, WIDTH)):
                if together[y][3 * first:3 * end] != apart[name][y][3 * first:3 * end]:
                    sys.exit(f"row {y} of the split view does not show the {name} picture from {first} to {end}")
        print("the split view shows the three others side by side")


def play(host, screen):
    """Pause, camera cut, history reset, and a camera moved by the user."""
    albedo = host.pictures("0-11", "--view", "albedo")
    names, textures = host.known("--method"), host.known("--view", "--method", "accumulate")
    with host.window(screen, "0-11", "--view", "albedo") as window:
        window.pause()
        window.freeze()
        for _ in range(20):
            time.sleep(0.1)
            if window.picture() != albedo[11]:
                sys.exit("the animation goes on though it is paused")
        print("the window shows the last frame as long as it is paused")
        window.cut()
        window.must_show(albedo[5], "frame 5, half the animation ahead, after a camera cut")

        window.orbit()
        x, y = window.place
        window.hands.drag((x + 40, y + 45), (x + 120, y + 30))
        wait_for(lambda: window.picture() not in albedo.values(), "a drag to turn the camera around the scene")
        write_png(host.screenshot, screen.rows())
        window.scene_camera()
        window.must_show(albedo[5], "frame 5 again, after an orbit")
        window.fly()
        window.hands.move(x + 40, y + 45)
        window.hands.hold_key("w")
        wait_for(lambda: window.picture() not in albedo.values(), "key W to fly ahead")
        window.scene_camera()
        window.must_show(albedo[5], "frame 5 again, after a flight")

        # Tracing goes on while it is paused: samples add up, until the history is dropped.
        window.freeze()
        window.choose_view("denoised")
        window.choose_method(names.index("accumulate"), len(names))
        window.freeze()
        pictures = [window.picture()]
        while len(pictures) < 24:  # Of the first sixteen, each has more samples than the one before.
            pictures.append(wait_for(lambda: (now := window.picture()) != pictures[-1] and now, "the next frame"))
        settled = pictures[16:]
        mean = [bytes(sum(column) // len(settled) for column in zip(*rows)) for rows in zip(*settled)]
        usual = max(distance(picture, mean) for picture in settled)
        window.reset_history()
        # One sample is four times as noisy as the mean of sixteen.
        wait_for(lambda: distance(window.picture(), mean) > 2.0 * usual, "noise after a reset of the history")
        print(f"history resets: more than {2.0 * usual:.2f} levels from the settled picture, {usual:.2f} at most before")

        window.freeze()
        window.choose_view("texture")
        window.choose_texture(textures.index("albedo"), len(textures))
        window.freeze()
        window.must_show(albedo[5], "frame 5 as long as it is paused")
        window.pause()
        seen = set()

        def half_seen():
            now = window.picture()
            seen.update(number for number, picture in albedo.items() if picture == now)
            return len(seen) >= len(albedo) // 2

        wait_for(half_seen, "half of the animation's frames")
        print(f"the animation goes on: frames {sorted(seen)} were seen")


def refused(host, screen):
    """A choice that is refused leaves the picture, the panel says why, and the next one works."""
    sparse = ("--light-rate", "1/4", "--method", "accumulate", "--set", "accumulation.antilag=on")

    def explained(window):
        return any(bytes(REFUSAL_COLOUR) * 10 in row for row in window.rows())

    with host.window(screen, "0-3", *sparse) as window:
        before = window.picture()
        names = host.known("--method")
        window.hands.click(*window.at(200, 158))  # Closes the times and the memory, so that settings are in sight.
        window.hands.click(*window.at(200, 181))
        # Frozen, the panel stands still: what changes is the list alone.
        top = wait_for(lambda: window.opened_list(135, len(names)), "the list of methods")
        window.hands.click(*window.at(100, top + 8 + 6 + names.index("svgf") * Window.ITEM))
        window.hands.click(*window.at(250, 700))
        window.must_show(before, "the same picture after a click at a grey method")

        antilag_low, fireflies = 342, 388
        window.hands.click(*window.at(150, antilag_low))
        wait_for(lambda: explained(window), "the reason why antilag-low may not be above antilag-high")
        window.hands.move(*window.at(250, 640))  # The setting's description would lie over the picture.
        window.must_show(before, "the same picture after a setting that is refused")
        write_png(host.screenshot, screen.rows())
        window.hands.click(*window.at(200, fireflies))
        wait_for(lambda: not explained(window), "the reason to vanish after another setting")
    again = subprocess.run(host.command("0-3", ["--light-rate", "1/4", "--method", "svgf"]), capture_output=True, text=True,
                           env={**os.environ, "DISPLAY": screen.display}, timeout=PATIENCE, check=False)
    if again.returncode != 2 or "method 'svgf'" not in again.stderr:
        sys.exit(f"what the command line asks for is refused with {again.returncode}: {again.stderr}")


def lint(host, screen):
    """What looks wrong in the inputs is listed below the panel while they are checked. A scene without walls has no
    indirect light."""
    corners = struct.pack("<9f", -3, -3, 0, 3, -3, 0, 0, 4, 1)
    one_triangle = {
        "asset": {"version": "2.0"}, "scenes": [{"nodes": [0, 1]}],
        "nodes": [{"mesh": 0}, {"camera": 0, "translation": [0, 0, 2],
                                "extensions": {"KHR_lights_punctual": {"light": 0}}}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "cameras": [{"type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.1}}],
        "extensionsUsed": ["KHR_lights_punctual"],
        "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point"}]}},
        "accessors": [{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 3}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64," + base64.b64encode(corners).decode()}]}
    scene = host.folder / "triangle.gltf"
    scene.write_text(json.dumps(one_triangle))
    alone = Host(host.program, scene, host.folder, host.screenshot)

    def listed(window):
        return any(bytes(FINDINGS_COLOUR) * 10 in row for row in window.rows())

    with alone.window(screen, "0-3", "--direct", "noisy", more=("--lint",)) as window:
        wait_for(lambda: listed(window), "the finding that there is no light")
        write_png(host.screenshot, screen.rows())
        window.hands.click(*window.at(210, 81))
        wait_for(lambda: not listed(window), "the finding to vanish with the check of the inputs")


def drop(host, screen):
    """A scene that is dropped onto the window takes the place of the old one; a file that is none leaves it."""
    view = ("--view", "albedo")
    other = Host(host.program, host.scene.with_name("turntable.gltf"), host.folder, host.screenshot)
    # Until frame 12, nothing moves in it.
    expected = other.pictures("0-0", *view)[0]
    with host.window(screen, "0-3", *view) as window:
        window.check_panel()
        files = FileDrop(screen)
        files.drop(other.scene)
        window.must_show(expected, "the scene that was dropped onto it")
        broken = host.folder / "broken.glb"
        broken.write_bytes(b"glTF")
        files.drop(broken)
        time.sleep(1.0)
        window.must_show(expected, "the same scene after a file that is no scene")
        write_png(host.screenshot, screen.rows())


def resize(host, screen, *options, size=(80, 45)):
    """While objects, lights and camera move for 300 frames, the window changes its size and is minimised. The size of the
    picture is such that the frames take a software driver little longer than these changes."""
    host.size = size
    full = host.size[0] + PANEL_WIDTH
    manager = WindowManager(screen)
    # 48 frames of the animation at 24 frames a second become 300.
    fast = ("--fps", "150")

    def meanwhile():
        wait_for(manager.window, "the window")
        time.sleep(1.0)
        for width, height in ((900, 700), (full, 720), (430, 90), (421, 1), (1200, 400), (100, 60), (640, 720)):
            manager.resize(width, height)
            time.sleep(0.4)
            manager.minimise()
            time.sleep(0.2)
            manager.restore()
            time.sleep(0.2)
        for step in range(40):
            manager.resize(full + 5 * step, 720 - 8 * step)
            time.sleep(0.02)
        manager.resize(full, 720)

    with host.window(screen, "0-299", *fast, *options, meanwhile=meanwhile):
        write_png(host.screenshot, screen.rows())


def resize_on_device(host, screen):
    """The same with the path tracer as a pass of the graph."""
    # So few pixels and bounces that a software driver traces some frames a second.
    resize(host, screen, "--tracer", "gpu", "--bounces", "1", size=(48, 28))


def main():
    scenario, program, scenes, screenshot = sys.argv[1:]
    scene = "turntable.gltf" if scenario in ("play", "resize", "resize_on_device") else "box.gltf"
    with tempfile.TemporaryDirectory() as folder, virtual_screen(folder) as screen:
        host = Host(program, pathlib.Path(scenes) / scene, pathlib.Path(folder), pathlib.Path(screenshot))
        scenarios = {"split": split, "methods": methods, "views": views,
                     "play": play, "refused": refused, "lint": lint, "drop": drop, "resize": resize,
                     "resize_on_device": resize_on_device}
        scenarios[scenario](host, screen)


if __name__ == "__main__":
    main()
