"""Runs a program for Windows under Wine on a virtual screen, with the validation layer.

    under_wine.py [--prints TEXT] WINE PREFIX FOLDER_OF_DLLS PROGRAM [ARGUMENT...]

PREFIX is the folder of Wine's registry and its drive C, which is made if it is missing. The exit code is the program's, or 1
if the program prints anything but TEXT.
"""
import argparse
import os
import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "samples"))
from virtual_screen import virtual_screen  # noqa: E402

parser = argparse.ArgumentParser()
parser.add_argument("--prints")
parser.add_argument("wine")
parser.add_argument("prefix", type=pathlib.Path)
parser.add_argument("libraries")
parser.add_argument("program", nargs=argparse.REMAINDER)
OPTIONS = parser.parse_args()

ENVIRONMENT = os.environ | {
    "WINEPREFIX": str(OPTIONS.prefix),
    "WINEPATH": "Z:" + OPTIONS.libraries.replace("/", "\\"),
    "WINEDEBUG": "-all",
    "WINEDLLOVERRIDES": "mscoree,mshtml=",  # Wine asks to download these, and no program here uses them.
    # Vulkan calls go to the loader of Linux, which adds the layer to every program. See tests/integration/host.
    "VK_INSTANCE_LAYERS": "VK_LAYER_KHRONOS_validation",
    "VK_LAYER_SYNCVAL_SHADER_ACCESSES_HEURISTIC": "true",
    "VK_LAYER_ENABLE_MESSAGE_LIMIT": "false",
}


def run(*command, output=None):
    return subprocess.run([OPTIONS.wine, *command], env=ENVIRONMENT, stdin=subprocess.DEVNULL, stdout=output, stderr=output,
                          check=False).returncode


# Wine's Vulkan needs a screen. Wine's server outlives a program and would hold a pipe open, so the output is a file.
with tempfile.TemporaryDirectory() as folder, virtual_screen(folder) as screen, tempfile.TemporaryFile() as output:
    ENVIRONMENT["DISPLAY"] = screen.display
    if not (OPTIONS.prefix / "system.reg").exists():
        OPTIONS.prefix.mkdir(parents=True, exist_ok=True)
        if run("wineboot", "--init", output=subprocess.DEVNULL) != 0:
            sys.exit(f"Wine cannot make {OPTIONS.prefix}")
    try:
        result = run(*OPTIONS.program, output=output)
    finally:
        run("wineboot", "--kill", output=subprocess.DEVNULL)
    output.seek(0)
    printed = output.read().decode(errors="replace")
print(printed, end="")
if OPTIONS.prints is not None and printed.strip() != OPTIONS.prints:
    sys.exit(f"expected: {OPTIONS.prints}")
sys.exit(result)
