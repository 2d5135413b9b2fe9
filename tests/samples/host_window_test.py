#!/usr/bin/env python3
"""Opens walr-host's window on a virtual screen and looks at what the screen shows.

    host_window_test.py WALR_HOST SCENE SCREENSHOT.png [OPTION...]

The picture in the window must be, bit for bit, the one that a run without a window writes, the panel beside it must hold
text and widgets, a mouse must be able to work them, and the program must end without a word from the validation layer
when it is asked to.
"""

import ctypes
import os
import pathlib
import signal
import struct
import subprocess
import sys
import tempfile
import time
import zlib

WIDTH, HEIGHT = 160, 90
LAST_FRAME = 3
PATIENCE = 120.0  # Seconds; a software device beside other tests is slow.


def read_png(path):
    """An 8-bit RGB PNG as rows of bytes."""
    data = path.read_bytes()
    assert data[:8] == b"\x89PNG\r\n\x1a\n", path
    position, packed = 8, b""
    while position < len(data):
        length, kind = struct.unpack(">I4s", data[position:position + 8])
        body = data[position + 8:position + 8 + length]
        if kind == b"IHDR":
            width, height, depth, colour = struct.unpack(">IIBB", body[:10])
            assert (depth, colour) == (8, 2), (depth, colour)
        elif kind == b"IDAT":
            packed += body
        position += 12 + length
    raw, rows, stride = zlib.decompress(packed), [], 3 * width
    above = bytearray(stride)
    for y in range(height):
        kind, line = raw[y * (stride + 1)], bytearray(raw[y * (stride + 1) + 1:(y + 1) * (stride + 1)])
        for i in range(stride):
            left, up, corner = (line[i - 3] if i >= 3 else 0), above[i], (above[i - 3] if i >= 3 else 0)
            nearest = min((abs(up - corner), 0, left), (abs(left - corner), 1, up), (abs(left + up - 2 * corner), 2, corner))
            line[i] = (line[i] + (0, left, up, (left + up) // 2, nearest[2])[kind]) & 0xFF
        rows.append(bytes(line))
        above = line
    return rows


def write_png(path, rows):
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    header = struct.pack(">IIBBBBB", len(rows[0]) // 3, len(rows), 8, 2, 0, 0, 0)
    packed = zlib.compress(b"".join(b"\0" + row for row in rows))
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", packed) + chunk(b"IEND", b""))


def read_screen(path):
    """The frame buffer of Xvfb, an XWD file of 32-bit pixels, as rows of RGB bytes."""
    data = path.read_bytes()
    header = struct.unpack(">25I", data[:100])
    size, width, height, bits, stride, colours = header[0], header[4], header[5], header[11], header[12], header[19]
    assert bits == 32, header
    start = size + 12 * colours
    rows = []
    for y in range(height):
        line = data[start + y * stride:start + y * stride + 4 * width]
        row = bytearray(3 * width)
        row[0::3], row[1::3], row[2::3] = line[2::4], line[1::4], line[0::4]
        rows.append(bytes(row))
    return rows


def find_picture(screen, picture):
    """Where the whole picture stands in the screen, pixels; nothing where it does not."""
    for y in range(len(screen) - len(picture) + 1):
        position = screen[y].find(picture[0])
        while position >= 0:
            if position % 3 == 0 and all(
                    screen[y + i][position:position + len(row)] == row for i, row in enumerate(picture)):
                return position // 3, y
            position = screen[y].find(picture[0], position + 1)
    return None


def wait_for(condition, what):
    end = time.monotonic() + PATIENCE
    while time.monotonic() < end:
        result = condition()
        if result:
            return result
        time.sleep(0.2)
    return sys.exit(f"gave up waiting for {what}")


def check_panel(screen, left):
    """The panel: light text and blue widgets on a dark ground, over its whole height."""
    panel = [row[3 * left:3 * (left + 400)] for row in screen[:700]]
    pixels = [tuple(row[i:i + 3]) for row in panel for i in range(0, len(row), 3)]
    text = sum(min(p) > 200 for p in pixels)
    widgets = sum(p[2] > 100 and p[2] > p[0] + 40 for p in pixels)
    written = sum(any(min(row[i:i + 3]) > 200 for i in range(0, len(row), 3)) for row in panel)
    print(f"panel: {text} pixels of text on {written} rows, {widgets} of widgets")
    # A label is some hundred pixels of text; the panel has more than twenty of them.
    if text < 2000 or widgets < 2000 or written < 200:
        sys.exit("the panel is not there")


class Mouse:
    """A mouse on a virtual screen, by the XTEST extension."""

    def __init__(self, display):
        self.x11, self.test = ctypes.CDLL("libX11.so.6"), ctypes.CDLL("libXtst.so.6")
        self.x11.XOpenDisplay.restype = ctypes.c_void_p
        self.display = ctypes.c_void_p(self.x11.XOpenDisplay(f":{display}".encode()))

    def settle(self):
        """Until the program has drawn with what was done: a press and its release in one drawing are none."""
        self.x11.XFlush(self.display)
        time.sleep(0.3)

    def move(self, x, y):
        self.test.XTestFakeMotionEvent(self.display, -1, x, y, 0)
        self.settle()

    def press(self, down):
        self.test.XTestFakeButtonEvent(self.display, 1, int(down), 0)
        self.settle()

    def click(self, x, y):
        self.move(x, y)
        self.press(True)
        self.press(False)


def work_panel(mouse, place, picture_now):
    """Work the panel. Places are those of Dear ImGui's default font and style."""
    left = place[0] + WIDTH
    freeze, cut, reset = (left + 83, 18), (left + 186, 18), (left + 280, 18)
    orbit, paper = (left + 133, 58), (left + 87, 135)

    def must_change(what, act):
        before = picture_now()
        act()
        wait_for(lambda: picture_now() != before, f"the picture to change after: {what}")
        print(f"the picture has changed after: {what}")

    must_change("preset 'paper'", lambda: mouse.click(*paper))
    must_change("no longer frozen", lambda: mouse.click(*freeze))
    # The animation plays now: what these change cannot be told from it, but it must go on, without a complaint.
    for place_to_click in (cut, reset, orbit):
        mouse.click(*place_to_click)
    mouse.move(place[0] + 40, place[1] + 45)
    mouse.press(True)
    mouse.move(place[0] + 120, place[1] + 30)
    mouse.press(False)
    must_change("a drag around the scene", lambda: None)


def main():
    program, scene, screenshot = sys.argv[1:4]
    common = [program, scene, "--frames", f"0-{LAST_FRAME}", "--size", f"{WIDTH}x{HEIGHT}", "--validate", *sys.argv[4:]]
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        subprocess.run([*common, "--headless", "--output", folder], check=True, stdout=subprocess.DEVNULL)
        expected = read_png(folder / f"frame_{LAST_FRAME:04d}.png")
        if len({bytes(row) for row in expected}) < HEIGHT // 2:
            sys.exit("the picture to look for has too little in it")

        read_end, write_end = os.pipe()
        screen_server = subprocess.Popen(
            ["Xvfb", "-displayfd", str(write_end), "-screen", "0", "1280x800x24", "-fbdir", str(folder), "-nolisten", "tcp"],
            pass_fds=[write_end], stderr=subprocess.DEVNULL)
        try:
            os.close(write_end)
            display = os.read(read_end, 32).decode().strip()
            window = subprocess.Popen([*common, "--once"], env={**os.environ, "DISPLAY": f":{display}"},
                                      stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
            try:
                def shown():
                    if window.poll() is not None:
                        sys.exit(f"the program ended: {window.stderr.read()}")
                    screen = read_screen(folder / "Xvfb_screen0")
                    place = find_picture(screen, expected)
                    return (screen, place) if place else None

                screen, place = wait_for(shown, "the picture in the window")
                # What the panel tells of the frame follows with the next drawing.
                time.sleep(1.0)
                screen = read_screen(folder / "Xvfb_screen0")
                write_png(pathlib.Path(screenshot), screen)
                print(f"the picture stands at {place}")
                check_panel(screen, place[0] + WIDTH)

                def picture_now():
                    rows = read_screen(folder / "Xvfb_screen0")[place[1]:place[1] + HEIGHT]
                    return b"".join(row[3 * place[0]:3 * (place[0] + WIDTH)] for row in rows)

                if "--method" not in sys.argv:
                    work_panel(Mouse(display), place, picture_now)
                    write_png(pathlib.Path(screenshot).with_suffix(".worked.png"), read_screen(folder / "Xvfb_screen0"))
                window.send_signal(signal.SIGTERM)
                code = window.wait(timeout=PATIENCE)
                complaint = window.stderr.read()
                if code != 0 or complaint:
                    sys.exit(f"the program ended with {code}: {complaint}")
            finally:
                if window.poll() is None:
                    window.kill()
                    window.wait()
        finally:
            screen_server.terminate()
            screen_server.wait()


if __name__ == "__main__":
    main()
