#!/usr/bin/python3
"""Writes the measurements of `walr bench` into the project's documents.

    update_results.py methods FOLDER    takes the comparison of methods from FOLDER/bench.json, and its pictures
    update_results.py costs FOLDER      takes only the bytes, taps and memory of these methods, after a change of no result
    update_results.py gpu FOLDER        takes the times on a GPU from FOLDER/gpu_report.json
    update_results.py                   writes the documents again from results.json
    update_results.py --check           fails if a document differs from what results.json gives

The values in the documents are stored in results.json next to this script. From it, the script writes the marked part of
README.md, samples/bench/RESULTS.md and GPU.md beside it, and the plot samples/images/pareto.png. Images need matplotlib.
Estimated GPU times come from samples/estimate/shader_figures.json, which `cmake --build build --target update_costs` writes.
"""
import json
import pathlib
import re
import sys

from gpu_page import PAGE_SIZES, gpu_page, keep_gpu, milliseconds

HERE = pathlib.Path(__file__).resolve().parent
PROJECT = HERE.parent.parent
KEPT = HERE / "results.json"
FIGURES_FILE = PROJECT / "samples" / "estimate" / "shader_figures.json"
MACHINES_FILE = PROJECT / "samples" / "estimate" / "machines.json"
IMAGES = PROJECT / "samples" / "images"
BEGIN = "<!-- Written by samples/bench/update_results.py: begin -->\n"
END = "<!-- Written by samples/bench/update_results.py: end -->\n"
FIGURES = ("rmse", "ssim", "flip", "flicker", "vmaf")
LABELS = {"rmse": "RMSE", "ssim": "SSIM", "flip": "FLIP", "flicker": "flicker"}
DECIMALS = {"rmse": 4, "ssim": 3, "flip": 3, "flicker": 4}
RESPONSES = ("first_frame_rmse", "settled_rmse", "settled_flicker", "light_frames", "light_lag", "recovery_frames")
GPU_SIZE = "{} x {}".format(*PAGE_SIZES[0])
UNFILTERED = ("accumulate", "none")
CROPPED = ("walr", "walr_paper", "bmfr", "svgf", "flr", "flnr:full", "joint_bilateral")


# The values of a benchmark that are stored.

def mean(values):
    values = list(values)
    return sum(values) / len(values)


def rounded(value, decimals=6):
    return value if value is None else round(value, decimals)


def origin(data):
    """Commit, command and device of the measurements. Where the sequences lay does not belong to the command."""
    command = re.sub(r"(--sequences )\S*/", r"\1SEQUENCES/", data["command"])
    return {"commit": data["commit"][:12], "compiler": f"{data['compiler']}, {data['build_type']}", "command": command,
            "device": data["device"]["name"], "driver": data["device"]["driver"], "software": data["device"]["software"]}


def costs_at_1080p(variant):
    cost = next((c for c in variant["costs"] if (c["width"], c["height"]) == (1920, 1080)), None)
    if cost is None:
        sys.exit(f"bench.json has no costs of {variant['name']} at 1920 x 1080")
    return {"bytes": round(cost["bytes_read_per_pixel"] + cost["bytes_written_per_pixel"], 1), "taps": rounded(cost["taps_per_pixel"], 1),
            "megabytes": round((cost["persistent_bytes"] + cost["transient_peak_bytes"]) / 1e6, 1)}


def keep_methods(data):
    """The values of a comparison of methods that the documents show."""
    kept = {**origin(data), "vmaf": data["vmaf"]["by"], "noise": {}, "methods": {}}
    for variant in data["variants"]:
        if not variant["sweep"]:
            kept["methods"][variant["name"]] = {**costs_at_1080p(variant), "sequences": {}}
    for sequence in data["sequences"]:
        noise = [f["reference_noise"] for f in sequence["frames"]]
        kept["noise"][sequence["name"]] = None if None in noise else rounded(mean(noise))
        for run in sequence["runs"]:
            if run["variant"] in kept["methods"]:
                figures = {m: rounded(run["mean_after_4"][m]) for m in FIGURES}
                figures["time"] = run["ratio"] and [rounded(run["ratio"][k], 3) for k in ("median", "p5", "p95")]
                kept["methods"][run["variant"]]["sequences"][sequence["name"]] = figures
    for response in data["responses"]:
        if response["variant"] in kept["methods"]:
            kept["methods"][response["variant"]]["response"] = {**{k: rounded(response[k]) for k in RESPONSES},
                                                                "trail": rounded(response["trail_by_age"][0])}
    return kept


def keep_costs(data, kept):
    """The comparison that is kept, with the costs of another run and its commit."""
    costs = {v["name"]: costs_at_1080p(v) for v in data["variants"] if not v["sweep"]}
    missing = [name for name in kept["methods"] if name not in costs]
    if missing:
        sys.exit(f"bench.json lacks {listed(missing)}")
    methods = {name: {**method, **costs[name]} for name, method in kept["methods"].items()}
    return {**kept, "costs_commit": data["commit"][:12], "methods": methods}


# The documents.

def number(value, decimals):
    return "-" if value is None else f"{value:.{decimals}f}".removeprefix("0")


def table(header, rows):
    lines = [header, ["---"] * len(header), *rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines) + "\n"


def listed(words):
    words = list(words)
    return words[0] if len(words) == 1 else ", ".join(words[:-1]) + " and " + words[-1]


def times(method):
    """Median, 5 % and 95 % quantile of a method's time ratio to the baseline, mean over the sequences; None without a timer."""
    ratios = [s["time"] for s in method["sequences"].values()]
    return None if None in ratios else [mean(r[i] for r in ratios) for i in range(3)]


def over_sequences(method, figure):
    return mean(s[figure] for s in method["sequences"].values())


def processor_note(kept):
    return f" This is a processor's time, not a GPU's ({kept['device']})." if kept["software"] else ""


def headline(kept):
    """The methods of README.md, each with its default preset."""
    return {n: m for n, m in kept["methods"].items() if ":" not in n and n != "accumulate"}


def gpu_time(gpu, name):
    """Time of a frame of 1920 x 1080 on the GPU, in milliseconds, as text."""
    return number(milliseconds(gpu, name, GPU_SIZE), 2)


def gpu_term(gpu):
    return f"""* **GPU time**: milliseconds of a frame of 1920 x 1080 on an {gpu['device']}, by GPU timestamps, median."""


def readme_part(kept, gpu):
    """A small table, its terms, and one plot."""
    sequences = list(kept["noise"])
    rows = []
    for name, method in headline(kept).items():
        rows.append([f"`{name}`", *(number(method["sequences"][s]["rmse"], 4) for s in sequences),
                     number(over_sequences(method, "flip"), 3), number(over_sequences(method, "flicker"), 4), gpu_time(gpu, name),
                     f"{method['bytes']:.0f}"])
    return (table(["method", *(f"RMSE, `{s}`" for s in sequences), "FLIP", "flicker", "GPU time, ms", "bytes per pixel"], rows) + f"""
* **Method**: each with its default settings, on the same frames. `none` is the noisy input.
* **RMSE**: root mean square error of the light without albedo, after the tone map x / (1 + x), which gives
  values from 0 to 1; lower is better.
* **FLIP**: difference that a person would see (Andersson et al. 2020), 0 to 1; lower is better. Mean over both sequences.
* **Flicker**: how much the error changes from one frame to the next on the same surface point, in the units of RMSE; lower is
  better. Mean over both sequences.
{gpu_term(gpu)} Spread, larger
  sizes, passes and bandwidth: [samples/bench/GPU.md](samples/bench/GPU.md).
* **Bytes per pixel**: what the passes of one frame read and write at 1920 x 1080, counted from the compiled graph. It holds on any
  device. A texel counts once a pass, so the wide window of `joint_bilateral` looks cheap here.

![RMSE against GPU time](samples/images/pareto.png)

*Lower left is better. Grey line: Pareto front. RMSE is the mean over both sequences.*

All figures, presets and pictures of the hardest places: [samples/bench/RESULTS.md](samples/bench/RESULTS.md).
""")


def standing(runs, baseline, figures):
    """States in which metrics the baseline is best, and how far it is behind in the others; only methods with a spatial filter count."""
    ahead, others = [], []
    for figure in figures:
        values = {n: run[figure] for n, run in runs.items() if n not in UNFILTERED}
        best = (max if figure == "ssim" else min)(values, key=values.get)
        if best == baseline:
            ahead.append(LABELS[figure])
        else:
            change = 100 * (values[baseline] / values[best] - 1)
            others.append(f"`{best}` has the best {LABELS[figure]}, from which that of `{baseline}` differs by {change:+.1f} %")
    return "; ".join(([f"`{baseline}` has the best {listed(ahead)} of all methods"] if ahead else []) + others)


def estimated_times(static):
    """Estimated GPU time in us by method, from the shaders' static figures."""
    return {e["variant"]: e["microseconds"] for e in static["estimates"]}


def estimate_term(static):
    gpu = next(m["gpu"] for m in json.loads(MACHINES_FILE.read_text())["machines"] if m["name"] == static["machine"])
    return f"""* **Estimated GPU time**: microseconds of a frame of {static['width']} x {static['height']} on one GPU, {gpu}.
  It is an estimate by a static model, and no measurement: for each pass the largest of what the plan's bytes, the instructions and
  the fetches of the compiled shader, and its waits take at the GPU's peak rates (see `tests/costs/README.md`). It is that of
  the shaders of this commit, also where the other columns were measured at an earlier one."""


def methods_table(kept, static, gpu):
    estimates = estimated_times(static)
    header = ["method"]
    for sequence in kept["noise"]:
        header += [f"`{sequence}`: RMSE", *list(LABELS.values())[1:]]
    rows = []
    for name, method in kept["methods"].items():
        time = times(method)
        rows.append([f"`{name}`", *(number(s[f], DECIMALS[f]) for s in method["sequences"].values() for f in LABELS),
                     "-" if time is None else f"{time[0]:.2f} ({time[1]:.2f} to {time[2]:.2f})", gpu_time(gpu, name),
                     number(estimates.get(name), 0), f"{method['bytes']:.0f}",
                     "-" if method["taps"] is None else f"{method['taps']:.0f}", f"{method['megabytes']:.0f}"])
    return table(header + ["relative time", "GPU time, ms", "estimated GPU time, us", "bytes per pixel", "taps per pixel", "memory, MB"], rows)


def response_section(kept):
    shown = {n: m["response"] for n, m in kept["methods"].items() if "response" in m}
    if not shown:
        return ""

    def frames(count):
        return "not by the end" if count is None else str(count)

    rows = [[f"`{n}`", number(r["first_frame_rmse"], 4), number(r["settled_rmse"], 4), number(r["settled_flicker"], 4),
             frames(r["light_frames"]), f"{r['light_lag']:.1f}", frames(r["recovery_frames"]), f"{r['trail']:.3f}"]
            for n, r in shown.items()]
    return "\n## Response to change\n\nSynthetic scenes of 192 x 108 pixels whose exact light is known.\n\n" + table(
        ["method", "first frame, RMSE", "settled, RMSE", "settled, flicker", "light goes down, frames", "light moves, frames",
         "disocclusion, frames", "trail, share"], rows) + """
* **First frame**: there is no history. **Settled**: the history is as long as it gets.
* **Light goes down**: a light is dimmed to a tenth; frames until at most a tenth of the difference remains.
* **Light moves**: lag of a light that moves over a static wall; the result is nearest to the truth of so many frames ago.
* **Disocclusion**: a slab moves and uncovers a wall; frames until the wall's error there exceeds
  its error elsewhere by at most a quarter.
* **Trail**: share of the slab's light that remains on the wall in the first frame after the disocclusion. Below 0 the wall is too dark
  there. `none` keeps nothing of the slab: its value is noise.
"""


def results_page(kept, static, gpu):
    noise = listed(f"{number(v, 4)} on `{s}`" for s, v in kept["noise"].items() if v is not None)
    standings = "".join(f"* On `{s}` " + standing({n: m["sequences"][s] for n, m in kept["methods"].items() if not n.startswith("walr:")}, "walr", list(LABELS)) + ".\n"
                        for s in kept["noise"]) + "  Other presets of `walr` are not counted here.\n"
    vmaf = ""
    if kept["vmaf"]:
        program, model = kept["vmaf"].rsplit(", ", 1)
        vmaf = ("\n## VMAF\n\nA video metric, 0 to 100; higher is better. It is insensitive to fine noise, so no method should be judged by it "
                f"alone. {' '.join(program.split()[:3])}, {model}.\n\n" +
                table(["method", *(f"`{s}`" for s in kept["noise"])],
                      [[f"`{n}`", *(f"{s['vmaf']:.1f}" for s in m["sequences"].values())] for n, m in kept["methods"].items()]))
    return f"""# Speed against error

Written by `samples/bench/update_results.py` from `results.json`. Two sequences rendered with Blender Cycles, 384 x 216, 1 sample per
pixel, moving camera; references of 1,400 to 2,100 samples per pixel. Values are means over the frames after the fourth, over pixels
with a diffuse lobe. A method's name means its default preset; `METHOD:PRESET` names another one.

{methods_table(kept, static, gpu)}
* **RMSE**, **SSIM** (structural similarity, Wang et al. 2004; higher is better) and **FLIP** (Andersson et al. 2020, 67 pixels per
  degree) are taken after the tone map x / (1 + x). **Flicker** is the root mean square change of the error in luminance along
  motion, without disocclusions, over the square root of 2: white noise of standard deviation s has flicker s.
  RMSE and flicker are in units of the tone-mapped value, 0 to 1; SSIM and FLIP have no unit.
* **Relative time**: time of a frame over that of `walr` on the same frame in the same run; median, and in brackets the 5th to the 95th
  percentile; mean over both sequences.{processor_note(kept)}
{gpu_term(gpu)} More of it: [GPU.md](GPU.md).
{estimate_term(static)}
* **Bytes**, **taps** and **memory** are those of the compiled graph at 1920 x 1080 and hold on any device. Bytes: every texel that a
  pass reads or writes, once. Taps: fetches of light, of its history and of averages of it. Memory: histories and
  transient textures, which alias each other, without the textures of the host.
* The references have noise of their own. As an RMSE it is {noise}.
{standings}
![the places of largest error](../images/crops.png)

*The two places of each sequence's last frame in which the methods' mean FLIP is largest. Below each: change of the error in luminance
from the frame before, along motion. Red: brighter. Blue: darker. Grey: the surface was not visible in the frame before. Flicker,
trails, and seams that do not stay with their surface show there.*
{response_section(kept)}{vmaf}
## How it was measured

At commit {kept['commit']} ({kept['compiler']}) on {kept['device']}, {kept['driver']}, with

    {kept['command']}
""" + costs_note(kept)


def costs_note(kept):
    if "costs_commit" not in kept:
        return ""
    return f"\nBytes, taps and memory are those of commit {kept['costs_commit']}. No change between the two commits alters a picture of these sequences.\n"


def replaced(readme, text):
    begin, end = readme.index(BEGIN) + len(BEGIN), readme.index(END)
    return readme[:begin] + "\n" + text + "\n" + readme[end:]


def documents(kept):
    """Text of every document by its file."""
    readme = PROJECT / "README.md"
    static = json.loads(FIGURES_FILE.read_text())
    return {readme: replaced(readme.read_text(encoding="utf-8"), readme_part(kept["methods"], kept["gpu"])),
            HERE / "RESULTS.md": results_page(kept["methods"], static, kept["gpu"]),
            HERE / "GPU.md": gpu_page(kept["gpu"], table)}


# Pictures.

def draw_plot(kept, gpu):
    from report_plots import COLOURS, error_axes, plt

    points = {n: (milliseconds(gpu, n, GPU_SIZE), over_sequences(m, "rmse")) for n, m in headline(kept).items()
              if n not in UNFILTERED and milliseconds(gpu, n, GPU_SIZE)}
    figure, axes = plt.subplots(figsize=(7, 3.6))
    error_axes(axes, points, COLOURS.__getitem__, list(COLOURS).index, 1.35)
    axes.set_xlabel(f"ms a frame of 1920 x 1080, {gpu['device']}")
    axes.set_ylabel("RMSE after the tone map")
    figure.savefig(IMAGES / "pareto.png", dpi=110, bbox_inches="tight", metadata={"Software": None})


def draw_crops(folder):
    """The places of largest error in each sequence's last stored frame, and the change of the error there along motion."""
    import numpy as np
    from report import displayed, exposure, hardest_places, signed_colours
    from report_data import Bench
    from report_plots import plt

    bench, rows = Bench(folder), []
    for sequence, facts in bench.sequences.items():
        frame = max(facts["picture_frames"])
        pictures = {n: bench.picture(sequence, n, frame) for n in ["_reference", "_noisy", *CROPPED]}
        changes = {n: bench.change(sequence, n, frame)[:, :, 0] for n in CROPPED}
        exposed = exposure(pictures["_reference"])
        top = float(np.nanpercentile(np.abs(list(changes.values())), 99.5))
        places, size = hardest_places(bench, sequence, frame, 2)
        for x, y in places:
            place = np.s_[y:y + size, x:x + size]
            rows.append({n: displayed(p[place], exposed) for n, p in pictures.items()})
            rows.append({n: signed_colours(c[place], top) for n, c in changes.items()})
    names = list(rows[0])
    figure, axes = plt.subplots(len(rows), len(names), figsize=(1.3 * len(names), 1.34 * len(rows)))
    for index, (row, line) in enumerate(zip(rows, axes)):
        for name, cell in zip(names, line):
            cell.set_axis_off()
            if name in row:
                cell.imshow(row[name], interpolation="nearest")
            if index == 0:
                cell.set_title(name.removeprefix("_"), fontsize=8)
    figure.subplots_adjust(0.005, 0.005, 0.995, 0.975, wspace=0.04, hspace=0.04)
    figure.savefig(IMAGES / "crops.png", dpi=100, metadata={"Software": None})


def save(kept):
    """One line per method or sequence, so that differences between versions are readable."""
    parts = []
    for name, part in kept.items():
        lines = []
        for key, value in part.items():
            if key == "methods":
                inner = ",\n".join(f"  {json.dumps(k)}:{json.dumps(v, separators=(',', ':'))}" for k, v in value.items())
                lines.append(f" {json.dumps(key)}:{{\n{inner}}}")
            else:
                lines.append(f" {json.dumps(key)}:{json.dumps(value)}")
        parts.append(f"{json.dumps(name)}:{{\n" + ",\n".join(lines) + "}")
    KEPT.write_text("{" + ",\n".join(parts) + "}\n")


def main():
    arguments = sys.argv[1:]
    sys.dont_write_bytecode = True
    kept = json.loads(KEPT.read_text())
    if arguments == ["--check"]:
        stale = [str(path) for path, text in documents(kept).items() if path.read_text(encoding="utf-8") != text]
        if stale:
            sys.exit(f"{listed(stale)}: not what results.json gives; run samples/bench/update_results.py")
        return
    keep = {"methods": (keep_methods, "bench.json"), "gpu": (keep_gpu, "gpu_report.json")}
    if len(arguments) == 2 and arguments[0] in keep:
        what, folder = arguments[0], pathlib.Path(arguments[1])
        kept_part, file = keep[what]
        kept[what] = kept_part(json.loads((folder / file).read_text()))
        save(kept)
        if what == "methods":
            draw_crops(folder)
    elif len(arguments) == 2 and arguments[0] == "costs":
        kept["methods"] = keep_costs(json.loads((pathlib.Path(arguments[1]) / "bench.json").read_text()), kept["methods"])
        save(kept)
    elif arguments:
        sys.exit(__doc__)
    for path, text in documents(kept).items():
        path.write_text(text, encoding="utf-8")
    draw_plot(kept["methods"], kept["gpu"])


if __name__ == "__main__":
    main()
