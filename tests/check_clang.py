#!/usr/bin/env python3
"""Compiles every source of a build with clang, because the sources must be free of warnings under gcc and clang.

    check_clang.py BUILD_FOLDER    reads BUILD_FOLDER/compile_commands.json

Warnings are errors under clang 14, the version that the project supports. Other versions may have further warnings.
"""
import concurrent.futures
import json
import os
import pathlib
import shlex
import subprocess
import sys


STRICT_MAJOR_VERSION = "14"


def clang_command(entry, strict):
    """The recorded command with clang as compiler and without output."""
    words = [word for word in shlex.split(entry["command"]) if word != "-Werror"]
    while os.path.basename(words[0]) in ("ccache", "sccache"):
        words = words[1:]
    output = words.index("-o")
    words[output : output + 2] = []
    return ["clang++", "-fsyntax-only", *(["-Werror"] if strict else []), *words[1:]]


def main():
    version = subprocess.run(["clang++", "-dumpversion"], capture_output=True, text=True, check=True).stdout.strip()
    strict = version.split(".")[0] == STRICT_MAJOR_VERSION

    def check(entry):
        run = subprocess.run(clang_command(entry, strict), cwd=entry["directory"], capture_output=True, text=True)
        return entry["file"], run.returncode, run.stderr

    entries = json.loads((pathlib.Path(sys.argv[1]) / "compile_commands.json").read_text())
    sources = [entry for entry in entries if entry["file"].endswith(".cpp")]
    if not sources:
        sys.exit("compile_commands.json lists no source")
    failed = 0
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for file, code, messages in pool.map(check, sources):
            if code != 0:
                failed += 1
                print(f"{file}:\n{messages}")
    print(f"{len(sources) - failed} of {len(sources)} sources are clean under clang {version}")
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
