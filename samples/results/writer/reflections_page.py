"""The page of errors of specular light, from what reflections.py measured."""
import json

import costs_text
from cycles_page import DECIMALS, LABELS
from markdown_text import filled, number, over, table
from records import mean

CLASSES = ("0 to .1", ".1 to .2", ".2 to .3", ".3 to .4", ".4 to .6", ".6 to 1")
"""Of linear roughness: those of `rmse_by_roughness` in bench.json."""
FILTERS = ("walr", "svgf", "svgf:paper")


def errors_table(kept):
    rows = []
    for name, sequence in kept["sequences"].items():
        for method, figures in sequence["methods"].items():
            rows.append([f"`{name}`", str(sequence["size"][1]), str(sequence["samples"]), f"`{method}`",
                         *(number(figures[metric], DECIMALS[metric]) for metric in LABELS), number(sequence["noise"])])
    return table(["sequence", "lines", "samples", "method", *LABELS.values(), "noise of the reference"], rows)


def roughness_table(kept):
    rows = []
    for name, sequence in kept["sequences"].items():
        errors = {method: figures["by_roughness"] for method, figures in sequence["methods"].items()}
        for method in FILTERS:
            rows.append([f"`{name}`", f"`{method}`", *(over(a, b) for a, b in zip(errors[method], errors["accumulate"]))])
    return table(["sequence", "method", *CLASSES], rows)


def standing(kept):
    """How often the default is ahead of its rival, and by how much in the mean."""
    ratios = {}
    for name, sequence in kept["sequences"].items():
        ratios[name] = sequence["methods"]["walr"]["clean"] / sequence["methods"]["svgf"]["clean"]
    ahead = sum(ratio < 1 for ratio in ratios.values())
    return (f"The error of `walr` is below that of `svgf` in {ahead} of {len(ratios)} sequences; their ratio is {mean(ratios.values()):.2f} "
            f"in the mean, from {min(ratios.values()):.2f} to {max(ratios.values()):.2f}.")


def costs_table():
    found = costs_text.static_costs()
    rows = []
    for method in ("walr", "svgf", "accumulate"):
        for lights, name in (("diffuse", method), ("specular", f"{method} specular"), ("both", f"{method} both")):
            cost = found[name]
            rows.append([f"`{method}`", lights, number(cost["microseconds"], 0), over(cost["microseconds"], found[method]["microseconds"]),
                         number(cost["bytes"], 0), over(cost["bytes"], found[method]["bytes"])])
    return table(["method", "lights", "estimated GPU time, us", "over diffuse alone", "bytes per pixel", "over diffuse alone"], rows)


def page(kept):
    return f"""# Reflections

Written by `samples/results/write.py` from `data/reflections.json`, which `samples/results/reflections.py` measured on {kept['date']} at
commit {kept['commit']}. The scenes are built in; the camera moves, except in `gloss_still_216`, where only a thing in front of the
mirrors does.

{filled(standing(kept) + " These errors, and those by roughness, are roots of mean "
        "products of the errors against both halves of the references' samples, which are free of the references' noise.")}
## Errors by sequence

{errors_table(kept)}
Values are means over the judged frames, over pixels with a specular lobe. [CYCLES.md](CYCLES.md) defines the metrics. Flicker
follows the surface, so that an image that moves over it counts where it is wrong.

## Errors by linear roughness

RMSE over that of `accumulate`, which is the input of every filter here; above 1, filtering harms. A dash stands where a sequence
has no such surface, or where the error is too small to tell from chance.

{roughness_table(kept)}
## What both lights cost

{costs_table()}
Estimates and bytes are those of a picture of {resolution()}; [CYCLES.md](CYCLES.md) says what they are. Nothing of it was
measured on a GPU.

## The worst places

![the places of largest error](images/reflections.png)

*One place of each sequence's last frame, where the methods' mean FLIP is largest. Below each: change of the error in luminance from the
frame before, along the surface's motion. Red: brighter. Blue: darker. Grey: the surface was not visible before. Magenta: no reference.*
"""


def resolution():
    static = json.loads(costs_text.FIGURES_FILE.read_text())
    return f"{static['width']} x {static['height']}"
