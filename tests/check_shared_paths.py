#!/usr/bin/env python3
"""Checks that the project needs nothing beside its own folder: no file but .ci/run names the folder `shared` there. What
optional data a test or script looks at, the environment variable WALR_SHARED tells (tests/shared_data.h).

    check_shared_paths.py PROJECT_FOLDER
    check_shared_paths.py --self-test       shows that it finds such files
"""
import pathlib
import re
import subprocess
import sys
import tempfile

ALLOWED = {".ci/run"}
NO_SOURCE = re.compile(r"(build.*|\.cache|\.git|__pycache__)")
"""Folders that are no part of the project, for copies of it without git (.gitignore)."""
# Not written in one piece, for this file may not name it either.
NAME = "shared"
BESIDE = re.compile(rf"""\.\.[/\\]+{NAME}(?![\w-]|\.\w)               # a path in any language
                      |(\.\.["']|parents?(\[\d+\])?)\s*[/,]\s*["']{NAME}["'/]  # Python: parent / "...", "..", "..." """, re.VERBOSE)


def files_of(root):
    """The tracked files; without git, all that are not in a folder that git would ignore."""
    try:
        listed = subprocess.run(["git", "-C", root, "ls-files", "-z", "--", "."], capture_output=True, check=True).stdout
        return [root / name for name in listed.decode().split("\0") if name and (root / name).is_file()]
    except (OSError, subprocess.CalledProcessError):
        return [f for f in root.rglob("*") if f.is_file() and not any(NO_SOURCE.fullmatch(p) for p in f.relative_to(root).parts[:-1])]


def violations(root):
    files = files_of(root)
    if not files:
        sys.exit(f"{root} contains no file")
    return [f"{name}:{number}: names the folder {NAME} beside the project; use the environment variable WALR_SHARED"
            for file in sorted(files) if (name := file.relative_to(root).as_posix()) not in ALLOWED
            for number, line in enumerate(file.read_text(encoding="utf-8", errors="replace").splitlines(), 1)
            if BESIDE.search(line)]


def self_test():
    bad = {"tests/CMakeLists.txt": f'set(DATA "${{PROJECT_SOURCE_DIR}}/../{NAME}")', "a.md": f"see `../{NAME}/scenes`.",
           "b.py": f'FOLDER = PROJECT.parent / "{NAME}" / "scenes"', "c.py": f'os.path.join(here, "..", "{NAME}")',
           "d.py": f"HERE.parents[2] / '{NAME}/scenes'", "e.json": f'"command": "run ../../{NAME}"', "f.bat": f"..\\{NAME}",
           "end.md": f"It lies in ../{NAME}."}
    good = {".ci/run": f"export WALR_SHARED=../{NAME}", "tests/g.cpp": f'#include "../{NAME}_data.h"', "h.md": "a shared library",
            "i.cpp": f'#include "../{NAME}.h"', "j.py": f'parser.add("{NAME}")', "build/k.txt": f"../{NAME}"}
    for with_git in (True, False):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            for name, text in {**bad, **good}.items():
                (root / name).parent.mkdir(parents=True, exist_ok=True)
                (root / name).write_text(f"first line\n{text}\n")
            if with_git:
                try:
                    subprocess.run(["git", "-C", root, "init", "--quiet"], check=True)
                    subprocess.run(["git", "-C", root, "add", *bad, *(name for name in good if not name.startswith("build"))], check=True)
                except FileNotFoundError:
                    continue
            found = [line.split(": ")[0] for line in violations(root)]
            if found != [f"{name}:2" for name in sorted(bad)]:
                sys.exit(f"{'with' if with_git else 'without'} git: found {found}")


def main():
    if sys.argv[1:] == ["--self-test"]:
        self_test()
    elif len(sys.argv) == 2:
        if found := violations(pathlib.Path(sys.argv[1]).resolve()):
            sys.exit("\n".join(found))
    else:
        sys.exit(__doc__)


if __name__ == "__main__":
    main()
