#!/usr/bin/python3
"""Puts what was measured on rendered scenes into samples/bench/SCENES.md.

    update_scenes.py FOLDER    takes what `walr bench --content` left in FOLDER for the sequences that the page tells how to
                               render: keeps what is shown as scenes.json beside this script, and writes SCENES.md
    update_scenes.py --check   fails unless SCENES.md is what scenes.json gives
"""
import json
import math
import pathlib
import sys

sys.dont_write_bytecode = True
from update_readme import figure as shown

HERE = pathlib.Path(__file__).resolve().parent
RESULTS = HERE / "scenes.json"
PAGE = HERE / "SCENES.md"
FIGURES = [("clean_rmse", "RMSE", 5), ("rmse", "as measured", 5), ("ssim", "SSIM", 4), ("flip", "FLIP", 4),
           ("flicker", "flicker", 5)]
COMPARED = ("clean_rmse", "ssim", "flip", "flicker")
INTRODUCTION = """# Larger pictures, jitter, moving objects

Written by `samples/bench/update_scenes.py` from what `walr bench --content` measured. The built-in scenes `box` (a walk through
a room) and `turntable` (objects that turn and slide), jittered, at 480 x 270, 960 x 540 and 1920 x 1080:

    walr render samples/scenes/SCENE.gltf --output SCENE_HEIGHT --frames 4-15 --size SIZE --jitter --reference-spp 256 \\
                --reference-frames 13-15 --reference-pixel area --reference-one-square-in N

with N = 1, 4 and 16 (`box_270` with 512 paths and references of frames 12 to 15): each size has the same number of pixels with a reference, and those are means over the pixel, as
anti-aliasing tends to. Figures are means over the frames with a reference. **RMSE** is without the references' own noise, which the
references tell: the root of the measured square less the noise's. The noise is told a few per cent too small, as the tone map
flattens the halves that it is told from, so that this is rather too high, by the same square for all methods. In the other
figures the noise is included, the same for all. Where squares of the picture have no reference SSIM and FLIP take it for right, which brings both nearer to
perfect, for all methods alike. Bold: the best. Time: median ratio to `walr` on the same frame in the same run, **a processor's,
not a GPU's**, with other programs beside it.
"""


def mean(values):
    return sum(values) / len(values)


def keep(data):
    """What of a report is shown."""
    methods = [v["name"] for v in data["variants"] if v["name"] in (v["method"], f"{v['method']}:{v['preset']}")]
    kept = {"commit": data["commit"], "device": data["device"]["name"], "sequences": {}, "contents": {}}
    for sequence in data["sequences"]:
        noise = {f["frame"]: f["reference_noise"] for f in sequence["frames"] if f["reference_noise"] is not None}
        runs = {}
        for run in sequence["runs"]:
            if run["variant"] not in methods:
                continue
            frames = [f for f in run["frames"] if f["rmse"] is not None]
            figures = {m: run["mean_after_4"][m] for m in ("rmse", "ssim", "flip", "flicker")}
            figures["clean_rmse"] = mean([math.sqrt(max(f["rmse"] ** 2 - noise[f["frame"]] ** 2, 0.0)) for f in frames])
            figures["time"] = run["ratio"]["median"]
            runs[run["variant"]] = {name: round(value, 6) for name, value in figures.items()}
        kept["sequences"][sequence["name"]] = {"size": [sequence["width"], sequence["height"]],
                                               "noise": round(mean(noise.values()), 6), "runs": runs}
    for entry in data["contents"]:
        kept["contents"][entry["variant"]] = {t["content"]: round(t["ratio"]["median"], 3) for t in entry["timings"]}
    return kept


def best_of(runs, figure):
    return (max if figure == "ssim" else min)(runs, key=lambda name: runs[name][figure])


def sequence_section(name, sequence, baseline):
    runs = sequence["runs"]
    lines = [f"## `{name}`", "", "| method | " + " | ".join(label for _, label, _ in FIGURES) + " | time |",
             "|" + " --- |" * (len(FIGURES) + 2)]
    for method, figures in runs.items():
        row = [f"`{method}`"]
        for figure, _, decimals in FIGURES:
            text = shown(figures[figure], decimals)
            row.append(f"**{text}**" if figure in COMPARED and best_of(runs, figure) == method else text)
        lines.append("| " + " | ".join(row + [f"{figures['time']:.2f}"]) + " |")
    behind = []
    for figure, label, _ in FIGURES:
        best = best_of(runs, figure)
        if figure in COMPARED and best != baseline:
            change = 100 * (runs[baseline][figure] / runs[best][figure] - 1)
            behind.append(f"{label} {change:+.1f} % against `{best}`")
    paper = 100 * (runs[baseline]["clean_rmse"] / runs["walr:paper"]["clean_rmse"] - 1)
    lines += ["", f"{sequence['size'][0]} x {sequence['size'][1]}; noise of the references .{round(sequence['noise'] * 1e4):04d}. "
              f"`{baseline}` is behind in: {', '.join(behind) or 'nothing'}. Its RMSE against `walr:paper`: {paper:+.0f} %."]
    return "\n".join(lines) + "\n"


def content_section(contents):
    names = list(next(iter(contents.values())))
    lines = ["## Time by content", "", "Median ratio of a method's time at 640 x 360 to its own before a plain wall with a slab (`wall`): "
             "bars of one pixel, eight pixels apart, before it; a cut in every frame, so that no history holds; no light; sky above, in "
             "more and more of the picture. On this device a pixel that ends early costs what its neighbours do; `sorted`, `walr` "
             "with `blocks.sort-tiles=on`, sorts tiles into those that may want the coarse fit, those that have converged and those "
             "of the sky, and dispatches over each list.", "", "| method | " + " | ".join(names) + " |", "|" + " --- |" * (len(names) + 1)]
    for method, ratios in contents.items():
        lines.append(f"| `{method}` | " + " | ".join(f"{ratios[n]:.2f}" for n in names) + " |")
    return "\n".join(lines) + "\n"


def page(data):
    sections = [sequence_section(name, sequence, "walr") for name, sequence in data["sequences"].items()]
    return (INTRODUCTION + f"\nMeasured at commit {data['commit'][:12]} on {data['device']}.\n\n" +
            "\n".join(sections + [content_section(data["contents"])]))


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    if sys.argv[1] == "--check":
        if PAGE.read_text(encoding="utf-8") != page(json.loads(RESULTS.read_text())):
            sys.exit("SCENES.md is not what scenes.json gives: run samples/bench/update_scenes.py")
        return
    data = keep(json.loads((pathlib.Path(sys.argv[1]) / "bench.json").read_text()))
    RESULTS.write_text(json.dumps(data, separators=(",", ":")) + "\n")
    PAGE.write_text(page(data), encoding="utf-8")


if __name__ == "__main__":
    main()
