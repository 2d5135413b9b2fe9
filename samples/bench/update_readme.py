#!/usr/bin/python3
"""Puts measured figures into the project's README.

    update_readme.py FOLDER    takes what `walr bench` left in FOLDER: keeps its bench.json as results.json beside this
                               script, draws pareto.png and crops.png in samples/images, and rewrites the marked part of
                               README.md
    update_readme.py --check   fails unless the marked part of README.md is what results.json gives
"""
import json
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
PROJECT = HERE.parent.parent
RESULTS = HERE / "results.json"
README = PROJECT / "README.md"
PLOT = PROJECT / "samples" / "images" / "pareto.png"
CROPS = PROJECT / "samples" / "images" / "crops.png"
CROPPED = ["walr", "walr:paper", "bmfr", "svgf", "flr", "joint_bilateral"]
BEGIN = "<!-- Written by samples/bench/update_readme.py: begin -->\n"
END = "<!-- Written by samples/bench/update_readme.py: end -->\n"
COLUMNS = [("rmse", "RMSE", 4), ("ssim", "SSIM", 3), ("flip", "FLIP", 3), ("flicker", "flicker", 4)]


def figure(value, decimals):
    return "-" if value is None else f"{value:.{decimals}f}".removeprefix("0")


def cost_at(variant, width, height):
    return next(c for c in variant["costs"] if (c["width"], c["height"]) == (width, height))


def taps(cost):
    return "-" if cost["taps_per_pixel"] is None else f"{cost['taps_per_pixel']:.0f}"


def megabytes(cost):
    return (cost["persistent_bytes"] + cost["transient_peak_bytes"]) / 1e6


def time_range(ratios):
    median, p5, p95 = (sum(r[key] for r in ratios) / len(ratios) for key in ("median", "p5", "p95"))
    return f"{median:.2f} ({p5:.2f} to {p95:.2f})"


def comparison(data, means):
    """One sentence a sequence: the best filter in each figure, and where the baseline stands beside it."""
    baseline = data["baseline"]
    filters = [v["name"] for v in data["variants"] if not v["sweep"] and v["method"] not in ("none", "accumulate")]
    lines = []
    for sequence in data["sequences"]:
        parts = []
        for metric, label, _ in COLUMNS:
            sign = -1 if metric == "ssim" else 1
            value = {n: means[sequence["name"], n][metric] for n in filters}
            best = min(filters, key=lambda n: sign * value[n])
            if best == baseline:
                parts.append(f"{label} `{baseline}` itself")
            else:
                change = 100 * (value[baseline] / value[best] - 1)
                parts.append(f"{label} `{best}` (`{baseline}` {change:+.1f} %)")
        lines.append(f"* Best on `{sequence['name']}`: " + ", ".join(parts) + ".")
    return "\n".join(lines)


def vmaf_note(data, means):
    """VMAF of every method, where it was measured."""
    if not data["vmaf"]["by"]:
        return ""
    parts = []
    for variant in data["variants"]:
        scores = [means[s["name"], variant["name"]]["vmaf"] for s in data["sequences"]]
        parts.append(f"`{variant['name']}` " + " and ".join(f"{score:.1f}" for score in scores))
    program, model = data["vmaf"]["by"].rsplit(", ", 1)
    version = " ".join(program.split()[:3])
    return f"* VMAF, which hardly sees fine noise ({version}, {model}): " + ", ".join(parts) + ".\n"


def response_table(data):
    """How the methods answer to change, on synthetic scenes."""
    if not data["responses"]:
        return ""
    header = ["method", "first frame RMSE", "settled RMSE", "settled flicker", "light gone", "light lags", "recovered", "trail"]
    rows = ["| " + " | ".join(header) + " |", "| " + " | ".join(["---"] * len(header)) + " |"]

    def frames(count):
        return "not by the end" if count is None else str(count)

    for r in data["responses"]:
        rows.append("| " + " | ".join([f"`{r['variant']}`", figure(r["first_frame_rmse"], 4), figure(r["settled_rmse"], 4),
                                       figure(r["settled_flicker"], 4), frames(r["light_frames"]), f"{r['light_lag']:.1f}",
                                       frames(r["recovery_frames"]), f"{r['trail_by_age'][0]:.3f}"]) + " |")
    return ("\n".join(rows) + "\n\n*Response to change, on synthetic scenes of 192 x 108 with a known answer. Frames until a tenth of a "
            "light that went down to a tenth is left; frames by which light lags that moves over a still wall; frames until the "
            "error behind a moving slab is within a quarter of what it is elsewhere; share of the slab's light that its trail "
            "keeps in the first frame, of which `none` shows the floor.*\n\n")


def section(data):
    """The marked part of the README."""
    means = {(s["name"], r["variant"]): r["mean_after_4"] for s in data["sequences"] for r in s["runs"]}
    ratios = {(s["name"], r["variant"]): r["ratio"] for s in data["sequences"] for r in s["runs"]}
    variants = [v for v in data["variants"] if not v["sweep"]]
    software = data["device"]["software"]
    header = ["method"]
    for sequence in data["sequences"]:
        header += [("`" + sequence["name"] + "` " if i == 0 else "") + c[1] for i, c in enumerate(COLUMNS)]
    header += ["time", "at 1080p: B/pixel", "taps", "MB"]
    rows = ["| " + " | ".join(header) + " |", "| " + " | ".join(["---"] * len(header)) + " |"]
    for variant in variants:
        name = variant["name"]
        row = [f"`{name}`"]
        for sequence in data["sequences"]:
            row += [figure(means[sequence["name"], name][m], d) for m, _, d in COLUMNS]
        shown = [ratios[s["name"], name] for s in data["sequences"]]
        row.append("-" if None in shown else time_range(shown))
        cost = cost_at(variant, 1920, 1080)
        row += [f"{cost['bytes_read_per_pixel'] + cost['bytes_written_per_pixel']:.0f}", taps(cost), f"{megabytes(cost):.0f}"]
        rows.append("| " + " | ".join(row) + " |")
    device = data["device"]
    noise = []
    for sequence in data["sequences"]:
        values = [f["reference_noise"] for f in sequence["frames"]]
        if None not in values:
            noise.append(f"{figure(sum(values) / len(values), 4)} on `{sequence['name']}`")
    text = "\n".join(rows) + "\n\n" + response_table(data)
    text += comparison(data, means) + "\n"
    text += f"* Time: median ratio to `{data['baseline']}` on the same frame in the same run, with 5 to 95 % of them"
    text += ("; **a processor's, not a GPU's**" if software else "") + f" ({device['name']}, {device['driver']}). "
    text += "Bytes moved per pixel, taps of light per pixel and memory (persistent and shared transient) are the plan's and hold on any device.\n"
    if noise:
        text += "* Noise of the references themselves, as an RMSE: " + ", ".join(noise) + ".\n"
    text += vmaf_note(data, means)
    text += (f"* Measured at commit {data['commit']} ({data['compiler']}, {data['build_type']}) with\n"
             f"  `{data['command']}`.\n\n"
             "![error against time and bytes](samples/images/pareto.png)\n\n"
             "*Mean over the sequences; filled: on the Pareto front, beaten by none in both.*\n\n"
             "![the hardest places](samples/images/crops.png)\n\n"
             "*The two places of each sequence's last frame in which the filters' mean FLIP is largest, and below each the change of "
             "the error in luminance from the frame before along motion: red brighter, blue darker, grey where nothing was there "
             "before. Flicker, trails and seams that do not stay with their surface show there.*\n")
    return text


def draw_crops(bench):
    """The hardest places of each sequence's last frame that was kept, and how errors change there along motion."""
    import numpy as np
    from report import displayed, exposure, hardest_places, signed_colours
    from report_plots import plt

    rows = []
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
    figure.savefig(CROPS, dpi=100, metadata={"Software": None})


def replaced(readme, text):
    begin, end = readme.index(BEGIN) + len(BEGIN), readme.index(END)
    return readme[:begin] + "\n" + text + "\n" + readme[end:]


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    readme = README.read_text(encoding="utf-8")
    if sys.argv[1] == "--check":
        if replaced(readme, section(json.loads(RESULTS.read_text()))) != readme:
            sys.exit("README.md is not what samples/bench/results.json gives: run samples/bench/update_readme.py")
        return
    sys.dont_write_bytecode = True
    import report_data
    import report_plots

    folder = pathlib.Path(sys.argv[1])
    data = json.loads((folder / "bench.json").read_text())
    RESULTS.write_text(json.dumps(data, separators=(",", ":")) + "\n")
    bench = report_data.Bench(folder)
    everything = None if len(bench.sequences) > 1 else data["sequences"][0]["name"]
    report_plots.pareto_figure(bench, everything, ("rmse",)).savefig(PLOT, dpi=110, bbox_inches="tight",
                                                               metadata={"Software": None})
    draw_crops(bench)
    README.write_text(replaced(readme, section(data)), encoding="utf-8")


if __name__ == "__main__":
    main()
