#!/usr/bin/env python3
"""Compiles the sources of a build with clang, because the sources must be free of warnings under gcc and clang.

    check_clang.py BUILD_FOLDER WORKERS    reads BUILD_FOLDER/compile_commands.json

Warnings are errors under the oldest and the newest clang that the project supports. Other versions may have further warnings.
The headers that cost most are compiled once and then shared by all sources, which halves the time.
"""
import concurrent.futures
import json
import os
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile


STRICT_MAJOR_VERSIONS = ("14", "19")
# The headers that cost most. None of them depends on a macro that a source of this project defines. The last one is half of
# what a source of the library costs. This check cannot find a source that uses it without including it.
SHARED_HEADERS = """
algorithm array atomic charconv chrono cmath cstdint cstring deque filesystem fstream functional iomanip iostream iterator
limits map memory mutex numbers numeric optional random set span sstream stdexcept string string_view thread utility variant
vector
CLI/CLI.hpp glm/glm.hpp glm/gtc/matrix_transform.hpp glm/gtc/type_ptr.hpp gtest/gtest.h nlohmann/json.hpp
vulkan/vulkan_core.h
framegraph/declare/graph.h
""".split()
LIBRARY = ("framegraph", "passes", "integration")
GCC_ONLY = ("--param=", "-Wno-subobject-linkage")
# A shared header must be compiled with the same flags as the sources. These differ between targets, and no warning depends on
# them.
LEFT_OUT = ("-Werror", "-g", "-g1", "-fPIC", "-fPIE", "-fvisibility=hidden", "-pthread", "-DGTEST_HAS_PTHREAD=1")


def clang_command(entry, strict):
    """The recorded command with clang as compiler and without output."""
    words = [word for word in shlex.split(entry["command"]) if word not in LEFT_OUT and not word.startswith(GCC_ONLY)]
    while os.path.basename(words[0]) in ("ccache", "sccache"):
        words = words[1:]
    output = words.index("-o")
    words[output : output + 2] = []
    if any(word.endswith("cmake_pch.hxx") for word in words):  # Headers that gcc has compiled.
        words = [word for word in words if word not in ("-include", "-Winvalid-pch") and not word.endswith("cmake_pch.hxx")]
    return ["clang++", "-fsyntax-only", "-DGTEST_HAS_PTHREAD=1", *(["-Werror"] if strict else []), *words[1:]]


def compile_shared_headers(entry, folder):
    """Returns clang's options to use the shared headers, compiled with the flags of a source."""
    header = pathlib.Path(folder) / "shared.h"
    header.write_text("".join(f"#include <{name}>\n" for name in SHARED_HEADERS))
    compiled = f"{folder}/shared.pch"
    flags = [word for word in clang_command(entry, strict=False)
             if word not in ("-fsyntax-only", "-c", entry["file"]) and not word.startswith("-DWALR")]
    subprocess.run([*flags, "-x", "c++-header", "-fpch-instantiate-templates", str(header), "-o", compiled], check=True)
    return ["-include-pch", compiled]


def apart(entry):
    """The sources that an entry joins, as the preset `default` compiles them."""
    sources = re.findall('^#include "(.*)"', pathlib.Path(entry["file"]).read_text(), re.MULTILINE)
    return [entry | {"command": entry["command"].replace(entry["file"], source), "file": source} for source in sources]


def without_repetitions(entries, build):
    """Generated sources are alike, so one of each folder is enough. Joined sources, in folders of their own, are not alike."""
    kept, folders = [], set()
    for entry in entries:
        folder = pathlib.Path(entry["file"]).parent
        if folder.name == "Unity" and folder.relative_to(build).parts[0] in LIBRARY:
            kept += apart(entry)
            continue
        if folder.is_relative_to(build) and folder.name != "Unity" and folder in folders:
            continue
        folders.add(folder)
        kept.append(entry)
    return kept


def main():
    build, workers = pathlib.Path(sys.argv[1]), int(sys.argv[2])
    version = subprocess.run(["clang++", "-dumpversion"], capture_output=True, text=True, check=True).stdout.strip()
    strict = version.split(".")[0] in STRICT_MAJOR_VERSIONS

    entries = json.loads((build / "compile_commands.json").read_text())
    # Joined sources are checked together, but for those of the library: what one of them does not include must show somewhere.
    sources = without_repetitions([entry for entry in entries if entry["file"].endswith((".cpp", "_cxx.cxx"))], build)
    if not sources:
        sys.exit("compile_commands.json lists no source")
    with tempfile.TemporaryDirectory() as folder:
        shared = compile_shared_headers(sources[0], folder)

        def check(entry):
            command = clang_command(entry, strict)
            # The shared headers are compiled as C++20, which a source in another standard cannot read.
            headers = shared if "-std=c++20" in command else []
            run = subprocess.run([*command, *headers], cwd=entry["directory"], capture_output=True,
                                 text=True)
            return entry["file"], run.returncode, run.stderr

        failed = 0
        with concurrent.futures.ThreadPoolExecutor(workers) as pool:
            for file, code, messages in pool.map(check, sources):
                if code != 0:
                    failed += 1
                    print(f"{file}:\n{messages}")
    print(f"{len(sources) - failed} of {len(sources)} sources are clean under clang {version}")
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
