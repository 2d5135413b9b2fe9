"""Run a program on a virtual screen.

usage: on_virtual_screen.py FOLDER_OF_VIRTUAL_SCREEN_PY PROGRAM [ARGUMENT...]
"""
import os
import subprocess
import sys
import tempfile

sys.path.insert(0, sys.argv[1])
from virtual_screen import virtual_screen  # noqa: E402

with tempfile.TemporaryDirectory() as folder, virtual_screen(folder) as screen:
    environment = os.environ | {"DISPLAY": screen.display, "QT_QPA_PLATFORM": "xcb"}
    result = subprocess.run(sys.argv[2:], env=environment, check=False).returncode
sys.exit(result)
