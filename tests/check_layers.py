#!/usr/bin/env python3
"""Checks which folder includes which: every folder may include only the folders and headers that its line in `ALLOWED`
names.

    check_layers.py SOURCE_FOLDER

Each folder of the frame graph is one step of its work. The verifier replays plans with a model of its own. It may
include the declarations and the plan, which it compares, and nothing of the compiler.

The folders of `passes` and `shaders` have the same names, and one rule is for both: passes/temporal and shaders/temporal
may use the folders that `ROOMS` names for "temporal".
"""
import pathlib
import posixpath
import re
import sys

# What the folders of `passes` and `shaders` may use beside themselves.
GUIDES = ("settings", "conventions", "stage", "guides")
ROOMS = {
    "settings": (),
    "conventions": ("settings",),
    "stage": ("settings", "conventions"),
    "guides": ("settings", "conventions", "stage"),
    "temporal": GUIDES,
    "regression": (*GUIDES, "temporal"),
    "filters": (*GUIDES, "temporal"),
    "network": (*GUIDES, "regression"),
    "lint": ("conventions", "stage"),
    "methods": (*GUIDES, "temporal", "regression", "filters", "network"),
}

ALLOWED = {
    "framegraph/declare": set(),
    "framegraph/plan": {"framegraph/declare"},
    "framegraph/check": {"framegraph/declare", "framegraph/plan"},
    "framegraph/compile": {"framegraph/declare", "framegraph/plan", "framegraph/check"},
    "framegraph/verify": {"framegraph/declare", "framegraph/plan"},
    "framegraph/inspect": {"framegraph/declare", "framegraph/plan", "framegraph/compile"},
    "framegraph/vulkan": {"framegraph/declare", "framegraph/plan"},
    "framegraph/tools": {"framegraph/declare"},
    **{f"passes/{room}": {"framegraph/declare", "framegraph/plan", f"shaders/{room}"}
       | {f"{top}/{other}" for other in others for top in ("passes", "shaders")}
       for room, others in ROOMS.items()},
    "integration": {"framegraph", "passes", "shaders"},
    **{f"samples/{name}": {"framegraph", "passes", "shaders", "integration", "samples/errors.h", "samples/json_text.h"}
       | {f"samples/{other}" for other in others}
       for name, others in {
           "image": (),
           "metrics": ("image",),
           "sequence": ("image",),
           "render": ("image", "sequence"),
           "denoise": ("image", "metrics", "sequence"),
           "estimate": (),
           "bench": ("image", "metrics", "sequence", "denoise", "estimate"),
           "command_line": ("sequence", "denoise"),
           "gpu_render": ("image", "metrics", "sequence", "render", "denoise"),
           "gpu_report": ("image", "metrics", "sequence", "render", "denoise", "estimate", "bench"),
           "cli": ("image", "sequence", "render", "denoise", "bench", "gpu_render", "gpu_report", "command_line"),
           "host": ("image", "sequence", "render", "denoise", "gpu_render", "command_line"),
           "embedding": (),
       }.items()},
    "samples": set(),
    **{f"shaders/{room}": {"shaders/common"} | {f"shaders/{other}" for other in others} for room, others in ROOMS.items()},
    "shaders/common": set(),
}
# The verifier may include the two data structures, but no function that the compiler uses to interpret them.
VERIFIER_HEADERS = {"framegraph/declare/graph.h", "framegraph/plan/plan.h"}
INCLUDE = re.compile(r'^\s*#\s*include\s*"([^"]+)"', re.MULTILINE)


def longest_prefix(path, folders):
    """The innermost of the folders that contains a path; None if none does."""
    return max((f for f in folders if path.startswith(f + "/")), key=len, default=None)


def included_by(source, name):
    """What a source includes, as paths from the root. Shaders name each other from `shaders`."""
    for included in INCLUDE.findall(source.read_text()):
        if name.startswith("shaders/"):
            base = posixpath.dirname(name) if included.startswith("../") or source.suffix == ".h" else "shaders"
            yield posixpath.normpath(posixpath.join(base, included))
        else:
            yield included


def violations(root):
    folders = set(ALLOWED) | {"tests"}
    sources = [p for pattern in ("*.h", "*.cpp", "*.c", "*.comp", "*.glsl") for top in {f.split("/")[0] for f in ALLOWED}
               for p in (root / top).rglob(pattern)]
    if not sources:
        sys.exit(f"{root} contains no source")
    for source in sorted(sources):
        name = source.relative_to(root).as_posix()
        folder = longest_prefix(name, ALLOWED)
        if folder is None:
            yield f"{name}: its folder has no line in {pathlib.Path(__file__).name}"
            continue
        for included in included_by(source, name):
            target = longest_prefix(included, folders)
            if target is None or target == folder:
                continue  # A system header in quotes, or a neighbour.
            if not any(place == allowed or place.startswith(allowed + "/")
                       for allowed in ALLOWED[folder] for place in (target, included)):
                yield f"{name}: {folder}/ may not include {included}"
            elif folder == "framegraph/verify" and included not in VERIFIER_HEADERS:
                yield f"{name}: the verifier may not include {included}, which the compiler uses"


def main():
    found = list(violations(pathlib.Path(sys.argv[1])))
    print("\n".join(found) if found else "Every include runs in the allowed direction.")
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
