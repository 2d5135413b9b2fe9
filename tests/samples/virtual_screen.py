"""A virtual screen (Xvfb) for programs with windows: reads its pixels, and simulates mouse and keyboard.

Needs Pillow, which comes with Debian's python3-matplotlib.
"""

import contextlib
import ctypes
import os
import pathlib
import struct
import subprocess
import sys
import time

from PIL import Image

PATIENCE = 120.0  # Seconds. A software device is slow while other tests run.


def wait_for(condition, what):
    """Waits until `condition` returns a true value, and returns it."""
    end = time.monotonic() + PATIENCE
    while time.monotonic() < end:
        result = condition()
        if result:
            return result
        time.sleep(0.02)
    return sys.exit(f"gave up waiting for {what}")


def read_png(path):
    """An 8-bit RGB PNG as rows of bytes."""
    picture = Image.open(path)
    assert picture.mode == "RGB", path
    data, stride = picture.tobytes(), 3 * picture.width
    return [data[at:at + stride] for at in range(0, len(data), stride)]


def write_png(path, rows):
    Image.frombytes("RGB", (len(rows[0]) // 3, len(rows)), b"".join(rows)).save(path)


class Screen:
    """A screen of 1280 x 800 pixels. A row is bytes: red, green and blue of each pixel."""

    def __init__(self, display, buffer):
        self.display, self.buffer = display, buffer
        # The frame buffer is an XWD file.
        with open(buffer, "rb") as file:
            header = struct.unpack(">25I", file.read(100))
        size, self.width, self.height, bits, self.stride, colours = (header[i] for i in (0, 4, 5, 11, 12, 19))
        assert bits == 32, header
        self.start = size + 12 * colours

    def rows(self, x=0, y=0, width=None, height=None):
        """The pixels of a rectangle; without one, of the whole screen."""
        width, height = width or self.width, height or self.height
        rows = []
        with open(self.buffer, "rb") as file:
            for line in range(y, y + height):
                file.seek(self.start + line * self.stride + 4 * x)
                data = file.read(4 * width)
                row = bytearray(3 * width)
                row[0::3], row[1::3], row[2::3] = data[2::4], data[1::4], data[0::4]
                rows.append(bytes(row))
        return rows


@contextlib.contextmanager
def virtual_screen(folder):
    """Xvfb, with its frame buffer as a file in a folder."""
    read_end, write_end = os.pipe()
    server = subprocess.Popen(
        ["Xvfb", "-displayfd", str(write_end), "-screen", "0", "1280x800x24", "-fbdir", str(folder), "-nolisten", "tcp"],
        pass_fds=[write_end], stderr=subprocess.DEVNULL)
    try:
        os.close(write_end)
        display = os.read(read_end, 32).decode().strip()
        yield Screen(f":{display}", pathlib.Path(folder) / "Xvfb_screen0")
    finally:
        server.terminate()
        server.wait()


class ClientMessage(ctypes.Structure):
    """XClientMessageEvent"""
    _fields_ = [("type", ctypes.c_int), ("serial", ctypes.c_ulong), ("send_event", ctypes.c_int),
                ("display", ctypes.c_void_p), ("window", ctypes.c_ulong), ("message_type", ctypes.c_ulong),
                ("format", ctypes.c_int), ("data", ctypes.c_long * 5)]


class SelectionRequest(ctypes.Structure):
    """XSelectionRequestEvent"""
    _fields_ = [("type", ctypes.c_int), ("serial", ctypes.c_ulong), ("send_event", ctypes.c_int),
                ("display", ctypes.c_void_p), ("owner", ctypes.c_ulong), ("requestor", ctypes.c_ulong),
                ("selection", ctypes.c_ulong), ("target", ctypes.c_ulong), ("property", ctypes.c_ulong),
                ("time", ctypes.c_ulong)]


class Selection(ctypes.Structure):
    """XSelectionEvent"""
    _fields_ = [("type", ctypes.c_int), ("serial", ctypes.c_ulong), ("send_event", ctypes.c_int),
                ("display", ctypes.c_void_p), ("requestor", ctypes.c_ulong), ("selection", ctypes.c_ulong),
                ("target", ctypes.c_ulong), ("property", ctypes.c_ulong), ("time", ctypes.c_ulong)]


class Event(ctypes.Union):
    """XEvent"""
    _fields_ = [("type", ctypes.c_int), ("message", ClientMessage), ("request", SelectionRequest),
                ("selection", Selection), ("padding", ctypes.c_long * 24)]


class Client:
    """A program of its own on the screen, which sees the windows of others. There is no window manager."""

    def __init__(self, screen):
        self.x11 = ctypes.CDLL("libX11.so.6")
        for function, result in (("XOpenDisplay", ctypes.c_void_p), ("XInternAtom", ctypes.c_ulong),
                                 ("XCreateSimpleWindow", ctypes.c_ulong), ("XDefaultRootWindow", ctypes.c_ulong)):
            getattr(self.x11, function).restype = result
        self.display = ctypes.c_void_p(self.x11.XOpenDisplay(screen.display.encode()))
        self.root = ctypes.c_ulong(self.x11.XDefaultRootWindow(self.display))
        self.own = self.x11.XCreateSimpleWindow(self.display, self.root, 0, 0, 1, 1, 0, 0, 0)

    def atom(self, name):
        return self.x11.XInternAtom(self.display, name.encode(), 0)

    def window(self):
        """The uppermost window of another program; None if there is none."""
        root, parent, count = ctypes.c_ulong(), ctypes.c_ulong(), ctypes.c_uint()
        children = ctypes.POINTER(ctypes.c_ulong)()
        self.x11.XQueryTree(self.display, self.root, ctypes.byref(root), ctypes.byref(parent), ctypes.byref(children),
                            ctypes.byref(count))
        others = [children[i] for i in range(count.value) if children[i] != self.own]
        return others[-1] if others else None


class WindowManager(Client):
    """Resizes, minimises and restores the window of a program."""

    NORMAL, ICONIC = 1, 3  # States of windows (ICCCM).

    def resize(self, width, height):
        self.x11.XResizeWindow(self.display, ctypes.c_ulong(self.window()), width, height)
        self.x11.XFlush(self.display)

    def minimise(self):
        self.x11.XUnmapWindow(self.display, ctypes.c_ulong(self.window()))
        self.state(self.ICONIC)

    def restore(self):
        self.x11.XMapWindow(self.display, ctypes.c_ulong(self.window()))
        self.state(self.NORMAL)

    def state(self, value):
        words, kind = (ctypes.c_ulong * 2)(value, 0), ctypes.c_ulong(self.atom("WM_STATE"))
        self.x11.XChangeProperty(self.display, ctypes.c_ulong(self.window()), kind, kind, 32, 0, words, 2)
        self.x11.XFlush(self.display)


class FileDrop(Client):
    """Drops a file onto a program's window, as a file manager does: the XDND protocol, version 5."""

    REQUEST, NOTIFY, MESSAGE = 30, 31, 33  # Kinds of events.

    def tell(self, target, name, *data):
        event = Event()
        event.message = ClientMessage(self.MESSAGE, 0, 1, self.display.value, target, self.atom(name), 32,
                                      (ctypes.c_long * 5)(self.own, *data))
        self.x11.XSendEvent(self.display, ctypes.c_ulong(target), 0, ctypes.c_long(0), ctypes.byref(event))
        self.x11.XFlush(self.display)

    def drop(self, file):
        """Returns once the program has taken the file's name."""
        target = self.window()
        kind, selection = self.atom("text/uri-list"), self.atom("XdndSelection")
        self.x11.XSetSelectionOwner(self.display, ctypes.c_ulong(selection), ctypes.c_ulong(self.own), ctypes.c_ulong(0))
        self.tell(target, "XdndEnter", 5 << 24, kind, 0, 0)
        self.tell(target, "XdndPosition", 0, 20 << 16 | 20, 0, self.atom("XdndActionCopy"))
        self.tell(target, "XdndDrop", 0, 0, 0, 0)
        event = Event()

        def asked():
            while self.x11.XPending(self.display):
                self.x11.XNextEvent(self.display, ctypes.byref(event))
                if event.type == self.REQUEST:
                    return True
            return False

        wait_for(asked, "the program to ask for the name of the file")
        request = event.request
        uri = (pathlib.Path(file).resolve().as_uri() + "\r\n").encode()
        kind, target = ctypes.c_ulong(request.target), ctypes.c_ulong(request.requestor)
        self.x11.XChangeProperty(self.display, target, ctypes.c_ulong(request.property), kind, 8, 0, uri, len(uri))
        answer = Event()
        answer.selection = Selection(self.NOTIFY, 0, 1, self.display.value, request.requestor, request.selection,
                                     request.target, request.property, request.time)
        self.x11.XSendEvent(self.display, target, 0, ctypes.c_long(0), ctypes.byref(answer))
        self.x11.XFlush(self.display)


class Hands:
    """Simulated mouse and keyboard of a virtual screen, through the XTEST extension."""

    def __init__(self, screen):
        self.x11, self.test = ctypes.CDLL("libX11.so.6"), ctypes.CDLL("libXtst.so.6")
        self.x11.XOpenDisplay.restype = ctypes.c_void_p
        self.display = ctypes.c_void_p(self.x11.XOpenDisplay(screen.display.encode()))

    def settle(self):
        """Waits until the program has drawn a frame: it would miss a press and its release within one frame."""
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

    def release_now(self):
        """Releases the button without waiting for the effect."""
        self.test.XTestFakeButtonEvent(self.display, 1, 0, 0)
        self.x11.XFlush(self.display)

    def drag(self, start, end):
        self.move(*start)
        self.press(True)
        self.move(*end)
        self.press(False)

    def hold_key(self, character):
        code = self.x11.XKeysymToKeycode(self.display, ctypes.c_ulong(ord(character)))
        self.test.XTestFakeKeyEvent(self.display, code, 1, 0)
        self.settle()
        self.test.XTestFakeKeyEvent(self.display, code, 0, 0)
        self.settle()
