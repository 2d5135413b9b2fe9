#!/usr/bin/env python3
"""Runs a program with a window on a virtual screen, waits until the window shows an image, and asks the program to end.

usage: check_window.py IMAGE.png COMMAND...    {display} in COMMAND stands for the screen
"""
import pathlib
import signal
import subprocess
import sys
import tempfile

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "samples"))
import virtual_screen
from host_window_test import find_picture

virtual_screen.PATIENCE = 300.0  # The first start on a machine compiles all pipelines.

expected = virtual_screen.read_png(sys.argv[1])
with tempfile.TemporaryDirectory() as folder, virtual_screen.virtual_screen(folder) as screen:
    command = [argument.replace("{display}", screen.display) for argument in sys.argv[2:]]
    process = subprocess.Popen(command)
    try:
        def shown():
            if process.poll() is not None:
                sys.exit(f"the program ended with {process.returncode}")
            return find_picture(screen.rows(), expected)

        print(f"the image stands at {virtual_screen.wait_for(shown, 'the image in the window')}")
        process.send_signal(signal.SIGTERM)
        code = process.wait(timeout=virtual_screen.PATIENCE)
        if code != 0:
            sys.exit(f"asked to end, the program ended with {code}")
    finally:
        if process.poll() is None:
            process.kill()
            process.wait()
