#!/usr/bin/python3
"""Puts measured sweeps of settings into samples/bench/SWEEPS.md.

    update_sweeps.py FOLDER...   takes what `walr bench --sweep` left in the folders: replaces their sweeps in sweeps.json
                                 beside this script, and writes SWEEPS.md
    update_sweeps.py --check     fails unless SWEEPS.md is what sweeps.json gives
"""
import json
import math
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
RESULTS = HERE / "sweeps.json"
PAGE = HERE / "SWEEPS.md"
FIGURES = [("rmse", "RMSE", 5), ("ssim", "SSIM", 4), ("flip", "FLIP", 4), ("flicker", "flicker", 5)]
WARM_UP = 4
INTRODUCTION = """# Sweeps of settings

Written by `samples/bench/update_sweeps.py` from what `walr bench --sweep NAME` measured on all frames of both sequences.
Figures are means over the frames after the fourth ([../README.md](../README.md#speed-against-error-walr-bench)). Bold: the
default at the commit that was measured. In brackets: RMSE against the default's, and in how many of these frames it is lower.
`both` is the geometric mean of the two. Time: median ratio to `walr` on the same frame in the same run, **a processor's, not a
GPU's**.
"""


def settings_changed(variant, default):
    return sorted(k for k, v in variant["settings"].items() if default["settings"].get(k) != v)


def keep(folder):
    """The sweeps of a folder, with what of them is shown."""
    data = json.loads((folder / "bench.json").read_text())
    by_name = {v["name"]: v for v in data["variants"]}
    sweeps = {}
    for variant in data["variants"]:
        if not variant["sweep"]:
            continue
        # What the sweep changes: the method with the same preset, if it was run, too.
        default = next((v for v in data["variants"] if not v["sweep"] and (v["method"], v["preset"]) ==
                        (variant["method"], variant["preset"])), variant)
        method = ":".join(filter(None, (variant["method"], variant["preset"])))
        sweep = sweeps.setdefault(variant["sweep"], {"method": method, "commit": data["commit"],
                                                     "device": data["device"]["name"], "settings": [], "values": []})
        for name in settings_changed(variant, by_name[default["name"]]):
            if name not in sweep["settings"]:
                sweep["settings"].append(name)
        value = {"label": variant["name"].split("=", 1)[1], "default": variant["is_default"], "sequences": {}}
        for sequence in data["sequences"]:
            run = next(r for r in sequence["runs"] if r["variant"] == variant["name"])
            value["sequences"][sequence["name"]] = {
                **{m: round(run["mean_after_4"][m], 6) for m, _, _ in FIGURES},
                "time": round(run["ratio"]["median"], 3),
                "frames": [round(f["rmse"], 6) for f in run["frames"][WARM_UP:]]}
        sweep["values"].append(value)
    return sweeps


def against_default(value, default, sequence):
    """Change of RMSE in percent, and in how many frames it is lower."""
    mine, its = value["sequences"][sequence], default["sequences"][sequence]
    lower = sum(a < b for a, b in zip(mine["frames"], its["frames"]))
    return f"{100 * (mine['rmse'] / its['rmse'] - 1):+.1f} %, {lower} of {len(its['frames'])}"


def section(name, sweep):
    default = next((v for v in sweep["values"] if v["default"]), None)
    sequences = list(sweep["values"][0]["sequences"])
    header = ["value"]
    for sequence in sequences:
        header += [f"`{sequence}` RMSE"] + [label for _, label, _ in FIGURES[1:]] + ["time"]
    header.append("both")
    lines = [f"## {name}", "", f"`{sweep['method']}`: " + ", ".join(f"`{s}`" for s in sweep["settings"]) +
             f". Measured at commit {sweep['commit'][:12]} on {sweep['device']}.", "",
             "| " + " | ".join(header) + " |", "|" + " --- |" * len(header)]
    for value in sweep["values"]:
        row = [f"**{value['label']}**" if value["default"] else value["label"]]
        for sequence in sequences:
            figures = value["sequences"][sequence]
            shown = [f"{figures[m]:.{d}f}".removeprefix("0") for m, _, d in FIGURES]
            if default is not None and value is not default:
                shown[0] += f" ({against_default(value, default, sequence)})"
            row += shown + [f"{figures['time']:.2f}"]
        both = math.exp(sum(math.log(value["sequences"][s]["rmse"]) for s in sequences) / len(sequences))
        lines.append("| " + " | ".join(row + [f"{both:.5f}".removeprefix("0")]) + " |")
    return "\n".join(lines) + "\n"


def page(sweeps):
    return INTRODUCTION + "\n" + "\n".join(section(name, sweeps[name]) for name in sorted(sweeps))


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    sweeps = json.loads(RESULTS.read_text()) if RESULTS.exists() else {}
    if sys.argv[1] == "--check":
        if PAGE.read_text(encoding="utf-8") != page(sweeps):
            sys.exit("SWEEPS.md is not what sweeps.json gives: run samples/bench/update_sweeps.py")
        return
    for folder in sys.argv[1:]:
        sweeps.update(keep(pathlib.Path(folder)))
    RESULTS.write_text(json.dumps(sweeps, separators=(",", ":")) + "\n")
    PAGE.write_text(page(sweeps), encoding="utf-8")


if __name__ == "__main__":
    main()
