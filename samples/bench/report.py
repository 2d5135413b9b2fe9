#!/usr/bin/python3
"""Draws the report of a benchmark.

    report.py FOLDER    reads FOLDER/bench.json and FOLDER/pictures, writes report.html, bench.csv and pareto.svg into FOLDER

`walr bench` writes a copy of this script to the folder of bench.json and runs it. Needs matplotlib (Debian:
python3-matplotlib, which depends on Pillow). The page is self-contained: plots are inlined as SVG, images as WebP;
images of results are lossless.
"""
import base64
import csv
import html
import io
import itertools
import math
import sys

import numpy as np
from PIL import Image
from report_data import TABLE, Bench, number
from report_plots import (conditioning_figure, frames_figure, hard_cases_figure, pareto_figure, phases_figure, plt,
                          response_figure, svg)


def image(pixels, **options):
    """An HTML image of RGB values in 0..1. Lossless, unless the WebP options select otherwise."""
    data = (np.clip(pixels, 0, 1) * 255 + 0.5).astype(np.uint8)
    buffer = io.BytesIO()
    Image.fromarray(data).save(buffer, format="WEBP", **(options or {"lossless": True}))
    source = base64.b64encode(buffer.getvalue()).decode()
    return f'<img src="data:image/webp;base64,{source}" alt="">'


def exposure(reference):
    """The power of two that scales an image's bright parts (the 90 % quantile) to about 1."""
    bright = np.percentile(reference, 90)
    return 2.0 ** round(-math.log2(bright)) if bright > 0 else 1.0


def displayed(linear, exposed=1.0):
    """Exposure, tone map x/(1+x), then sRGB. Non-finite pixels become magenta."""
    bad = ~np.isfinite(linear).all(axis=2)
    value = exposed * np.nan_to_num(np.maximum(linear, 0), nan=0.0, posinf=1e30)
    value = value / (1 + value)
    value = np.where(value <= 0.0031308, 12.92 * value, 1.055 * np.power(value, 1 / 2.4) - 0.055)
    value[bad] = (1, 0, 1)
    return value


def shrunk(pixels, widest=640):
    """The image, reduced by an integer factor to at most this width in pixels, by averaging."""
    factor = max(1, math.ceil(pixels.shape[1] / widest))
    h, w = (n // factor * factor for n in pixels.shape[:2])
    return pixels[:h, :w].reshape(h // factor, factor, w // factor, factor, -1).mean(axis=(1, 3))


def table(header, rows, caption=""):
    cells = "".join(f"<th>{h}</th>" for h in header)
    body = "".join("<tr>" + "".join(f"<td>{c}</td>" for c in row) + "</tr>" for row in rows)
    return f"<table><caption>{caption}</caption><tr>{cells}</tr>{body}</table>"


def methods_table(bench, sequence):
    best = {}
    for metric, _, _ in TABLE:
        values = {n: bench.mean(sequence, n, metric) for n in bench.filters if bench.mean(sequence, n, metric) is not None}
        if values:
            best[metric] = (max if bench.better[metric] == "higher" else min)(values, key=values.get)
    rows = []
    for name in bench.methods:
        row = [html.escape(name)]
        for metric, _, decimals in TABLE:
            text = number(bench.mean(sequence, name, metric), decimals)
            row.append(f"<b>{text}</b>" if best.get(metric) == name else text)
        if sequence:
            run = bench.runs[sequence, name]
            row.append(number(run["worst_after_4"]["rmse"], 4))
            bad = sum(f["non_finite"] for f in run["frames"])
            row.append(f'<b class="bad">{bad}</b>' if bad else "0")
        ratio = bench.ratio(sequence, name)
        row.append(f"{ratio[0]:.2f} <small>({ratio[1]:.2f} to {ratio[2]:.2f})</small>" if ratio else "-")
        if bench.absolute and sequence:
            row.append(number(bench.milliseconds(sequence, name), 3))
        row += [f"{bench.bytes_per_pixel(sequence, name):.0f}", number(bench.estimate(name), 0)]
        rows.append(row)
    header = ["method"] + [label for _, label, _ in TABLE] + (["worst RMSE", "non-finite"] if sequence else [])
    times = ["time ratio (5 to 95 %)"] + (["ms"] if bench.absolute and sequence else [])
    return table(header + times + ["bytes/pixel", "ESTIMATED GPU us"], rows,
                 f"{html.escape(sequence or 'Mean over the sequences')}: means over frames after the fourth; "
                 "bold: the best method with a spatial filter")


ROUGHNESS_BOUNDS = ("0", ".1", ".2", ".3", ".4", ".6", "1")
"""Of the classes of `rmse_by_roughness`."""


def roughness_table(bench, sequence):
    """Errors of specular light by linear roughness, and the noise of the reference."""
    rows = [[html.escape(n)] + [number(v, 4) for v in bench.runs[sequence, n].get("rmse_by_roughness_after_4", [None] * 6)]
            for n in bench.methods]
    rows.append(["noise of the reference", *(number(v, 4) for v in bench.floor_by_roughness(sequence))])
    return table(["method"] + [f"{a} to {b}" for a, b in itertools.pairwise(ROUGHNESS_BOUNDS)], rows,
                 f"{html.escape(sequence)}: RMSE by linear roughness, means over frames after the fourth")


def against_baseline(bench):
    """The baseline against every other method: difference of the means, and in how many frames the baseline is better."""
    rows = []
    for name in bench.methods:
        if name == bench.baseline or bench.variants[name]["method"] == "none":
            continue
        for sequence in bench.sequences:
            row = [html.escape(name), html.escape(sequence)]
            for metric, _, _ in TABLE:
                pairs = [(a[metric], b[metric]) for a, b in zip(bench.runs[sequence, bench.baseline]["frames"][4:],
                                                                bench.runs[sequence, name]["frames"][4:])
                         if a[metric] is not None and b[metric] is not None]
                if not pairs:
                    row.append("-")
                    continue
                higher = bench.better[metric] == "higher"
                wins = sum((a > b) if higher else (a < b) for a, b in pairs)
                mine, other = (sum(p[i] for p in pairs) / len(pairs) for i in (0, 1))
                change = f"{mine - other:+.2f} dB" if metric == "psnr" else f"{100 * (mine / other - 1):+.1f} %"
                style = "good" if (mine > other) == higher else "bad"
                row.append(f'<span class="{style}">{change}</span> <small>{wins}/{len(pairs)}</small>')
            rows.append(row)
    return table(["against", "sequence"] + [label for _, label, _ in TABLE], rows,
                 f"{bench.baseline} against the others: difference of the means, and in how many frames "
                 f"{bench.baseline} is better. The frames of a sequence are correlated")


def hardest_places(bench, sequence, frame, count=3):
    """Top left corners, and the size, of the non-overlapping squares in which the filters' mean FLIP is largest."""
    flip = np.mean([bench.picture(sequence, n + ".errors", frame)[:, :, 2] for n in bench.filters], axis=0)
    size = min(max(8, flip.shape[0] // 5), *flip.shape)
    total = np.pad(np.nan_to_num(flip).cumsum(0).cumsum(1), ((1, 0), (1, 0)))
    sums = total[size:, size:] - total[:-size, size:] - total[size:, :-size] + total[:-size, :-size]
    places = []
    while len(places) < count and sums.max() > 0:
        y, x = np.unravel_index(sums.argmax(), sums.shape)
        places.append((int(x), int(y)))
        sums[max(0, y - size + 1):y + size, max(0, x - size + 1):x + size] = 0
    return places, size


def figure_element(pixels, caption, **options):
    return f"<figure>{image(shrunk(pixels), **options)}<figcaption>{html.escape(caption)}</figcaption></figure>"


def crops_table(pictures, places, size, shown):
    """One row per place and one column per picture; `shown` maps values to colours."""
    rows = ["<tr><th></th>" + "".join(f"<th>{html.escape(n)}</th>" for n, _ in pictures) + "</tr>"]
    for index, (x, y) in enumerate(places):
        rows.append(f"<tr><td>{index + 1}</td>" + "".join(
            f"<td>{image(shown(p[y:y + size, x:x + size]))}</td>" for _, p in pictures) + "</tr>")
    return "<div class=crops><table>" + "".join(rows) + "</table></div>"


def signed_colours(values, top):
    """Red above 0, blue below 0, grey for NaN."""
    coloured = plt.get_cmap("RdBu_r")(np.clip(0.5 + 0.5 * np.nan_to_num(values) / top, 0, 1))[:, :, :3]
    coloured[np.isnan(values)] = 0.5
    return coloured


def change_crops(changes, places, size, top):
    """The places in the images of the change of every method's error along motion."""
    return ("<p>The same places: change of the error in luminance from the previous frame along motion, divided by the square root of "
            f"2. Red: brighter. Blue: darker. Full colour at {top:.2g}. Grey: not visible in the previous frame. Flicker, trails and "
            "seams that do not stay with their surface show here.</p>" +
            crops_table(changes.items(), places, size, lambda values: signed_colours(values, top)))


def with_squares(pixels, places, size):
    pixels = pixels.copy()
    for x, y in places:
        right, bottom = min(x + size, pixels.shape[1]) - 1, min(y + size, pixels.shape[0]) - 1
        for edge in (np.s_[y:bottom, x], np.s_[y:bottom, right], np.s_[y, x:right], np.s_[bottom, x:right]):
            pixels[edge] = (1, 0.9, 0)
    return pixels


def pictures_section(bench, sequence, frame):
    """The places with the largest errors, enlarged; then every method's image next to its error maps."""
    reference, noisy = (bench.picture(sequence, n, frame) for n in ("_reference", "_noisy"))
    exposed = exposure(reference)
    places, size = hardest_places(bench, sequence, frame)
    results = {n: bench.picture(sequence, n, frame) for n in bench.filters}
    errors = {n: np.nan_to_num(bench.picture(sequence, n + ".errors", frame), nan=1.0) for n in bench.filters}
    # One scale for all methods, so that their maps are comparable. SSIM is shown as 1 - SSIM.
    maps = [("RMSE", {n: e[:, :, 0] for n, e in errors.items()}), ("1 - SSIM", {n: 1 - e[:, :, 1] for n, e in errors.items()}),
            ("FLIP", {n: e[:, :, 2] for n, e in errors.items()})]
    tops = {label: max(float(np.percentile(list(m.values()), 99.5)), 1e-6) for label, m in maps}
    parts = [f"<h3>{html.escape(sequence)}, frame {frame}</h3><p>The squares are the places where the filters' mean FLIP "
             f"is largest. Exposure for display: {exposed:g}.</p>",
             crops_table([("reference", reference), ("noisy", noisy), *results.items()], places, size,
                         lambda pixels: displayed(pixels, exposed))]
    changes = {n: c[:, :, 0] for n in bench.filters if (c := bench.change(sequence, n, frame)) is not None}
    if changes:
        top = max(float(np.nanpercentile(np.abs(list(changes.values())), 99.5)), 1e-6)
        parts.append(change_crops(changes, places, size, top))
    parts += ["<div class=cards>", figure_element(with_squares(displayed(reference, exposed), places, size),
                                                 "reference, with the places of largest error"),
             figure_element(displayed(noisy, exposed), "noisy"), "</div>"]
    for name, result in results.items():
        figures = next(f for f in bench.runs[sequence, name]["frames"] if f["frame"] == frame)
        parts += [f"<h4>{html.escape(name)} <small>RMSE {number(figures['rmse'], 4)}, SSIM {number(figures['ssim'], 4)}, "
                  f"FLIP {number(figures['flip'], 4)}</small></h4><div class=cards>",
                  figure_element(displayed(result, exposed), "result")]
        for label, values in maps:
            coloured = plt.get_cmap("magma")(np.clip(values[name] / tops[label], 0, 1))[:, :, :3]
            parts.append(figure_element(coloured, f"{label}, 0 to {tops[label]:.2g}", quality=80))
        if name in changes:
            parts.append(figure_element(signed_colours(changes[name], top), f"change along motion, -{top:.2g} to {top:.2g}",
                                        quality=80))
        parts.append("</div>")
    return "".join(parts)


def response_section(bench):
    """How methods respond to change, on synthetic scenes."""
    never = "not by the end"
    rows = [[html.escape(r["variant"]), number(r["first_frame_rmse"], 4), number(r["settled_rmse"], 4),
             number(r["settled_flicker"], 5), never if r["light_frames"] is None else r["light_frames"],
             number(r["light_lag"], 1), never if r["recovery_frames"] is None else r["recovery_frames"],
             number(r["trail_by_age"][0], 3), number(r["cut"]["left"], 3), number(r["untold_cut"]["left"], 3)]
            for r in bench.json["responses"]]
    return svg(response_figure(bench), "response") + table(
        ["method", "first frame RMSE", "settled RMSE", "settled flicker", "light gone, frames", "light lag, frames",
         "recovered, frames", "trail in the first frame", "left after a cut", "left after an unreported cut"], rows,
        "Static wall whose light is dimmed to a tenth, or moves over it; slab that moves in front of the wall; another wall "
        "after a camera cut. Settled: history has reached its full length. Light gone: at most a tenth of the removed light "
        "remains. Light lag: age of the truth that is nearest to the result. Recovered: the error after a disocclusion "
        "exceeds that of never hidden pixels by at most a quarter. Trail: share of the slab's light that remains. Left: "
        "share of the previous image that remains")


# The counters that the tables of hard cases show, and their labels.
SHOWN_COUNTERS = {"regularised-fits": "helped", "clamped-channels": "clamped"}


def hard_case_cell(r):
    """An error with the number of invalid values and of stabilised fits. All counters are in the tooltip."""
    text = "-" if r["error"] is None else f"{r['error']:.3g}"
    text += f' <b class="bad">{r["non_finite_out"]} non-finite</b>' if r["non_finite_out"] else ""
    text += f" <small>{r['negative_out']} below 0</small>" if r["negative_out"] else ""
    counted = {name: value for name, value in r["counters"].items() if value}
    # Each iteration has a counter of its own.
    total = {kind: sum(v for n, v in counted.items() if n.startswith(kind)) for kind in SHOWN_COUNTERS}
    text += "".join(f" <small>{total[kind]} {label}</small>" for kind, label in SHOWN_COUNTERS.items() if total[kind])
    listed = html.escape(", ".join(f"{name} {value}" for name, value in counted.items()) or "nothing counted")
    return f'<span title="{listed}">{text}</span>'


def method_hard_cases_table(bench):
    """Every case through every method."""
    results = {(r["case"], r["variant"]): r for r in bench.json["method_hard_cases"]}
    cases, variants = (list(dict.fromkeys(k[i] for k in results)) for i in range(2))
    rows = [[html.escape(case)] + [hard_case_cell(results[case, v]) for v in variants] for case in cases]
    return table(["case"] + [html.escape(v) for v in variants], rows,
                 "Every method with its own settings, first frame of a history: relative root mean square error in linear "
                 "radiance; absolute error if there is no light. Helped: number of fits, of 4096, that were regularised. "
                 "Clamped: number of channels that were clamped at 0. The tooltip shows all counters")


def hard_cases_section(bench):
    """Error by epsilon for features that vary little, and all cases with the usual settings of every storage."""
    results = {(r["case"], r["storage"], r["regularisation"], r["epsilon"]): r for r in bench.json["hard_cases"]}
    cases, storages, solvers, epsilons = (list(dict.fromkeys(k[i] for k in results)) for i in range(4))
    usual = {"centred16": ("ridge", "1e-3"), "raw16": ("floor", "1e-3"), "raw11": ("floor", "1e-2"), "raw32": ("floor", "1e-5")}
    rows = []
    for case in cases:
        row = [html.escape(case)]
        for storage in storages:
            row.append(hard_case_cell(results[(case, storage) + usual[storage]]))
        row.append(results[(case, storages[0]) + usual[storages[0]]]["non_finite_in"])
        rows.append(row)
    return ("<p>The signal is linear in the normal, so that an exact regression has no bias. Noise is exponential. One frame "
            "without history, a window of 27 x 27 pixels.</p>" + svg(conditioning_figure(results, cases, storages, usual), "conditioning")
            + svg(hard_cases_figure(results, cases, storages, solvers, epsilons), "hard cases")
            + table(["case"] + [f"{s}, {usual[s][0]} {usual[s][1]}" for s in storages] + ["non-finite in the input"], rows,
                    "Relative root mean square error in linear radiance; absolute error if there is no light. Helped: number "
                    "of fits, of 4096, whose pivots were raised. Clamped: number of channels that were clamped at 0. The "
                    "tooltip shows all counters")
            + method_hard_cases_table(bench))


def costs_section(bench):
    sizes = [(c["width"], c["height"]) for c in bench.variants[bench.baseline]["costs"]]
    rows = []
    for name in bench.methods:
        row = [html.escape(name)]
        costs = {(c["width"], c["height"]): c for c in bench.variants[name]["costs"]}
        for size in sizes:
            cost = costs.get(size)
            row.append("-" if cost is None else
                       f"{cost['bytes_read_per_pixel'] + cost['bytes_written_per_pixel']:.0f} <small>B/px</small> "
                       f"{cost['persistent_bytes'] / 1e6:.0f} + {cost['transient_peak_bytes'] / 1e6:.0f} "
                       f"<small>(of {cost['transient_unaliased_bytes'] / 1e6:.0f}) MB</small>")
        rows.append(row)
    return table(["method"] + [f"{w} x {h}" for w, h in sizes], rows,
                 "B/px: bytes read and written per pixel with perfect caches. MB: memory of histories + transient memory with "
                 "aliasing (without aliasing). All from the plan, without the host's own textures")


STYLE = """
body { font: 14px/1.5 "DejaVu Sans", Helvetica, Arial, sans-serif; color: #222; max-width: 1180px; margin: 2em auto; padding: 0 1em }
h1 { font-size: 1.7em } h2 { margin-top: 2em; border-bottom: 1px solid #ccc } h4 { margin: 1em 0 .2em }
table { border-collapse: collapse; margin: 1em 0; font-variant-numeric: tabular-nums } caption { text-align: left; color: #666; padding: .3em 0 }
td, th { padding: .15em .7em; text-align: right; border-bottom: 1px solid #eee; white-space: nowrap } td:first-child, th:first-child { text-align: left }
small { color: #777 } .warning { background: #fff3cd; padding: .6em 1em; border-left: 4px solid #e0a800 }
.good { color: #00704a } .bad { color: #b02a00 } .cards { display: flex; flex-wrap: wrap; gap: 8px } figure { margin: 0 }
.cards img, .crops img { image-rendering: pixelated } figcaption { font-size: .8em; color: #666 }
.crops table { table-layout: fixed; width: 100% } .crops img { width: 100% } .crops td:first-child, .crops th:first-child { width: 1.2em } .crops td, .crops th { padding: 1px 2px; border: 0; font-size: .8em; text-align: center } svg { width: 100%; height: auto }
.cards figure { width: 24% } .cards img { width: 100% } dt { font-weight: bold }
"""


LIGHTS = {"indirect": "diffuse indirect light, over pixels with a diffuse lobe",
          "specular": "specular light, over pixels with a specular lobe"}
"""What the errors are of, by the value of `light`."""


def estimate_note(estimate):
    """What an estimated GPU time is."""
    return html.escape(
        f"ESTIMATED GPU us: microseconds of a frame of 1920 x 1080 on {estimate['gpu']}, by a static model from the shaders that "
        f"{estimate['compiler']} compiles for {estimate['family']} and from the GPU's peak rates. It is an estimate, and no measurement.")


def sequences_sections(bench, names):
    """Measurements on the sequences: errors, costs, plots over frames and by pass."""
    out = ["<h2>Errors and costs</h2>"]
    for sequence in ([None] if len(names) > 1 else []) + names:
        out.append(methods_table(bench, sequence))
    if bench.json["light"] == "specular":
        out += [roughness_table(bench, sequence) for sequence in names]
    out.append(f"<p>{estimate_note(bench.json['estimate'])}</p>")
    out.append(f"<h2>{html.escape(bench.baseline)} against the others</h2>" + against_baseline(bench))
    out.append("<h2>Error against cost</h2><p>Filled: on the Pareto front (no other method is better in both). Bars: 5 to "
               "95 % quantile of the time ratios.</p>")
    for sequence in ([None] if len(names) > 1 else []) + names:
        out.append(svg(pareto_figure(bench, sequence), f"pareto {sequence}"))
    out.append("<h2>Over the frames</h2><p>Logarithmic scales. The change of luminance should equal that of the "
               "reference: a smaller one is lag, a larger one is flicker.</p>")
    for sequence in names:
        out.append(f"<h3>{html.escape(sequence)}</h3>" + svg(frames_figure(bench, sequence), f"frames {sequence}"))
    out.append("<h2>Time by pass</h2>")
    for sequence in names:
        figure = phases_figure(bench, {n: bench.runs[sequence, n] for n in bench.methods})
        out.append(f"<h3>{html.escape(sequence)}</h3>" + (svg(figure, f"phases {sequence}") if figure else "no timer"))
    return out


def page(bench):
    data, device = bench.json, bench.json["device"]
    out = [f"<!doctype html><html lang=en><meta charset=utf-8><title>walr bench</title><style>{STYLE}</style>",
           "<h1>Speed against error</h1>"]
    out.append("<p>" + html.escape(
        f"{device['name']}, driver {device['driver']}. Commit {data['commit']}, {data['compiler']}, {data['build_type']}. "
        + (f"Timer: resolution {device['timestamp_ns']:g} ns. " if device["timestamp_ns"] else "The device has no timer. ")
        + f"Tone map {data['tone_map']}. {data['repetitions']} timed repetitions after one that warms up.") + "</p>"
        f"<p><code>{html.escape(data['command'])}</code></p>")
    if device["software"]:
        out.append("<p class=warning>The device is a CPU implementation of Vulkan. Times are given only as ratios to "
                   f"{bench.baseline} within this run, and do not predict those of a GPU. Bytes and memory come from the "
                   "plan and hold on any device.</p>")
    odd = [f"{v} on {s}" for (s, v), r in bench.runs.items() if not r["reproducible"]]
    if odd:
        out.append(f"<p class=warning>Repetitions are not bit-identical: {html.escape(', '.join(odd))}.</p>")
    names = list(bench.sequences)
    if names:
        out += sequences_sections(bench, names)
    out.append("<h2>Traffic and memory</h2>" + costs_section(bench))
    if data["responses"]:
        out.append("<h2>Response to change</h2>" + response_section(bench))
    if data["hard_cases"]:
        out.append("<h2>Hard cases of the arithmetic</h2>" + hard_cases_section(bench))
    if names:
        out.append("<h2>Pictures</h2><p>Light in the frame with the largest disocclusion, and in the last one. "
                   "This choice depends on the input alone.</p>")
    for sequence in names:
        for frame in bench.sequences[sequence]["picture_frames"]:
            out.append(pictures_section(bench, sequence, frame))
    out.append("<h2>Metrics</h2><dl>" + "".join(
        f"<dt>{html.escape(m['name'])}</dt><dd>{html.escape(m['description'])}</dd>" for m in data["metrics"]) + "</dl>"
        f"<p>Errors are those of the demodulated {LIGHTS[data['light']]}. Non-finite "
        "values count as the largest possible error and are shown in magenta.</p></html>")
    return "\n".join(out)


def csv_table(bench):
    """Means, worst values, times and costs: a header, then one row per sequence and variant."""
    metrics = [m["name"] for m in bench.json["metrics"]]
    costs = ("persistent_bytes", "transient_unaliased_bytes", "transient_peak_bytes")
    yield ["sequence", "variant", *(n for m in metrics for n in (m, "worst_" + m)), "non_finite", "time_ratio_median",
           "time_ratio_p5", "time_ratio_p95", "bytes_per_pixel", *costs, "estimated_microseconds_1080p"]
    for (sequence, variant), run in bench.runs.items():
        cost = bench.cost(sequence, variant)
        yield [sequence, variant,
               *(run[kind][m] for m in metrics for kind in ("mean_after_4", "worst_after_4")),
               sum(f["non_finite"] for f in run["frames"]), *(bench.ratio(sequence, variant) or [None] * 3),
               bench.bytes_per_pixel(sequence, variant), *(cost[c] for c in costs), bench.estimate(variant)]


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    bench = Bench(sys.argv[1])
    with open(bench.folder / "bench.csv", "w", newline="", encoding="utf-8") as file:
        csv.writer(file, lineterminator="\n").writerows(csv_table(bench))
    (bench.folder / "report.html").write_text(page(bench), encoding="utf-8")
    if not bench.sequences:
        return
    everything = None if len(bench.sequences) > 1 else next(iter(bench.sequences))
    (bench.folder / "pareto.svg").write_text(svg(pareto_figure(bench, everything, ("rmse",)), "pareto"), encoding="utf-8")


if __name__ == "__main__":
    main()
