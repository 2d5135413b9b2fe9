#!/usr/bin/python3
"""Draws the report of a benchmark.

    report.py FOLDER    reads FOLDER/bench.json and FOLDER/pictures, writes FOLDER/report.html and FOLDER/pareto.svg

`walr bench` leaves a copy of this script beside what it measured and runs it. Needs matplotlib (Debian:
python3-matplotlib). The page is self-contained: plots are inlined as SVG, pictures as PNG.
"""
import base64
import html
import io
import json
import math
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402

# Okabe and Ito's colours, which the colour-blind tell apart; the baseline is black.
COLOURS = {"walr": "#000000", "bmfr": "#0072B2", "svgf": "#D55E00", "flr": "#009E73", "joint_bilateral": "#CC79A7",
           "accumulate": "#E69F00", "none": "#999999"}
SPARE_COLOURS = ["#56B4E9", "#8C6D31", "#7F3C8D", "#B2182B", "#4D9221"]
MARKERS = "osD^vP*X"
ERRORS = [("rmse", "RMSE"), ("flip", "FLIP"), ("ssim", "1 - SSIM"), ("flicker", "flicker")]
TABLE = [("rmse", "RMSE", 4), ("psnr", "PSNR", 2), ("ssim", "SSIM", 4), ("flip", "FLIP", 4),
         ("relative_mse", "relMSE", 4), ("flicker", "flicker", 5)]
plt.rcParams.update({"font.size": 9, "axes.spines.top": False, "axes.spines.right": False, "axes.grid": True,
                     "grid.color": "#e6e6e6", "grid.linewidth": 0.6, "axes.axisbelow": True, "svg.fonttype": "none",
                     "legend.frameon": False})


class Bench:
    """A benchmark's figures by name."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        self.json = json.loads((self.folder / "bench.json").read_text())
        self.variants = {v["name"]: v for v in self.json["variants"]}
        self.sequences = {s["name"]: s for s in self.json["sequences"]}
        self.runs = {(s["name"], r["variant"]): r for s in self.json["sequences"] for r in s["runs"]}
        self.methods = [v["name"] for v in self.json["variants"] if not v["sweep"]]
        # Without a spatial filter, methods would stretch every scale.
        self.filters = [n for n in self.methods if self.variants[n]["method"] not in ("none", "accumulate")]
        self.baseline = self.json["baseline"]
        self.better = {m["name"]: m["better"] for m in self.json["metrics"]}

    def mean(self, sequence, variant, metric):
        """Mean after the warm-up; over all sequences where `sequence` is None."""
        if sequence is None:
            values = [self.mean(s, variant, metric) for s in self.sequences]
            return None if None in values else sum(values) / len(values)
        return self.runs[sequence, variant]["mean_after_4"][metric]

    def error(self, sequence, variant, metric):
        value = self.mean(sequence, variant, metric)
        return 1 - value if metric == "ssim" and value is not None else value

    def ratio(self, sequence, variant):
        """Median, 5 % and 95 % of the time over the baseline's; geometric means where `sequence` is None."""
        if sequence is None:
            all_ratios = [self.ratio(s, variant) for s in self.sequences]
            if None in all_ratios:
                return None
            return tuple(math.exp(sum(math.log(r[i]) for r in all_ratios) / len(all_ratios)) for i in range(3))
        ratio = self.runs[sequence, variant]["ratio"]
        return ratio and (ratio["median"], ratio["p5"], ratio["p95"])

    def cost(self, sequence, variant):
        """The plan's costs at the sequence's size, or at the first one's."""
        s = self.sequences[sequence] if sequence else next(iter(self.sequences.values()))
        return next(c for c in self.variants[variant]["costs"] if (c["width"], c["height"]) == (s["width"], s["height"]))

    def bytes_per_pixel(self, sequence, variant):
        cost = self.cost(sequence, variant)
        return cost["bytes_read_per_pixel"] + cost["bytes_written_per_pixel"]

    def floor(self, sequence):
        """Noise of the reference as an RMSE, mean over frames; None where it is not known."""
        if sequence is None:
            floors = [self.floor(s) for s in self.sequences]
            return None if None in floors else sum(floors) / len(floors)
        values = [f["reference_noise"] for f in self.sequences[sequence]["frames"]]
        return None if None in values else sum(values) / len(values)

    def picture(self, sequence, name, frame):
        path = self.folder / "pictures" / sequence / f"{name}_{frame:04d}.npy"
        return np.load(path).astype(np.float32)

    def colour(self, variant):
        v = self.variants[variant]
        if v["name"] != v["method"] and not v["preset"]:
            own = [n for n in self.methods if self.variants[n]["name"] != self.variants[n]["method"]
                   and not self.variants[n]["preset"]]
            if variant in own:
                return SPARE_COLOURS[own.index(variant) % len(SPARE_COLOURS)]
        return COLOURS.get(v["method"], SPARE_COLOURS[hash(v["method"]) % len(SPARE_COLOURS)])

    def dash(self, variant):
        return "--" if self.variants[variant]["preset"] else "-"


def pareto(points):
    """Names of the points that none beats in both coordinates; smaller is better."""
    return [name for name, (x, y) in points.items()
            if not any(a <= x and b <= y and (a, b) != (x, y) for a, b in points.values())]


def svg(figure, salt):
    """The figure as an inline SVG element. The salt keeps ids of several figures on a page apart."""
    buffer = io.StringIO()
    with plt.rc_context({"svg.hashsalt": salt}):
        figure.savefig(buffer, format="svg", bbox_inches="tight", metadata={"Date": None})
    plt.close(figure)
    text = buffer.getvalue()
    return text[text.index("<svg"):]


def png(pixels, scale=1):
    """An image element of RGB values in 0..1, each pixel enlarged by a whole factor."""
    data = (np.clip(pixels, 0, 1) * 255 + 0.5).astype(np.uint8)
    data = np.repeat(np.repeat(data, scale, axis=0), scale, axis=1)
    buffer = io.BytesIO()
    plt.imsave(buffer, data, format="png")
    source = base64.b64encode(buffer.getvalue()).decode()
    return f'<img src="data:image/png;base64,{source}" alt="">'


def exposure(reference):
    """The power of two that brings a picture's bright parts near 1."""
    bright = np.percentile(reference, 90)
    return 2.0 ** round(-math.log2(bright)) if bright > 0 else 1.0


def displayed(linear, exposed=1.0):
    """Exposure, tone map x/(1+x), then sRGB. What is not finite shows as magenta."""
    bad = ~np.isfinite(linear).all(axis=2)
    value = exposed * np.nan_to_num(np.maximum(linear, 0), nan=0.0, posinf=1e30)
    value = value / (1 + value)
    value = np.where(value <= 0.0031308, 12.92 * value, 1.055 * np.power(value, 1 / 2.4) - 0.055)
    value[bad] = (1, 0, 1)
    return value


def shrunk(pixels, widest=640):
    """Averages whole blocks of pixels until the picture fits."""
    factor = max(1, math.ceil(pixels.shape[1] / widest))
    h, w = (n // factor * factor for n in pixels.shape[:2])
    return pixels[:h, :w].reshape(h // factor, factor, w // factor, factor, -1).mean(axis=(1, 3))


def plain(value, _=None):
    """A number on an axis without an exponent."""
    return f"{value:.4g}"


def number(value, decimals):
    return "-" if value is None else f"{value:.{decimals}f}"


def table(header, rows, caption=""):
    cells = "".join(f"<th>{h}</th>" for h in header)
    body = "".join("<tr>" + "".join(f"<td>{c}</td>" for c in row) + "</tr>" for row in rows)
    return f"<table><caption>{caption}</caption><tr>{cells}</tr>{body}</table>"


def place_labels(axes, points, bench):
    """Names beside their points, moved up or down where two would lie on each other."""
    taken = []
    for name, (x, y) in sorted(points.items(), key=lambda item: item[1][1]):
        px, py = axes.transData.transform((x, y))
        offset = 0
        while any(abs(px - qx) < 62 and abs(py + offset - qy) < 10 for qx, qy in taken):
            offset += 10
        taken.append((px, py + offset))
        axes.annotate(name, (x, y), xytext=(5, offset * 72 / axes.figure.dpi + 4), textcoords="offset points",
                      color=bench.colour(name), fontsize=8, arrowprops=dict(arrowstyle="-", lw=0.4, color="#999999")
                      if offset else None)


def pareto_axes(axes, bench, sequence, metric, title, against):
    """One plot of error against cost."""
    if against == "time":
        points = {n: (bench.ratio(sequence, n)[0], bench.error(sequence, n, metric)) for n in bench.filters
                  if bench.ratio(sequence, n)}
    else:
        points = {n: (bench.bytes_per_pixel(sequence, n), bench.error(sequence, n, metric)) for n in bench.filters}
    points = {n: p for n, p in points.items() if p[1] is not None}
    if not points:
        axes.set_visible(False)
        return
    front = sorted(pareto(points), key=lambda n: points[n])
    axes.set_xscale("log")
    axes.xaxis.set_major_locator(matplotlib.ticker.LogLocator(subs=(1, 2, 5)))
    axes.xaxis.set_major_formatter(matplotlib.ticker.FuncFormatter(plain))
    axes.xaxis.set_minor_locator(matplotlib.ticker.NullLocator())
    xs = [p[0] for p in points.values()]
    ys = [p[1] for p in points.values()]
    low, high = min(xs) / 1.5, max(xs) * (2.6 if against == "time" else 1.7)
    steps_x, steps_y = [], []
    for i, name in enumerate(front):
        x, y = points[name]
        steps_x += [x, points[front[i + 1]][0] if i + 1 < len(front) else high]
        steps_y += [y, y]
    axes.step(steps_x, steps_y, where="post", color="#bbbbbb", lw=1, zorder=1)
    for name, (x, y) in points.items():
        if against == "time":
            _, p5, p95 = bench.ratio(sequence, name)
            axes.plot([p5, p95], [y, y], color=bench.colour(name), lw=0.8, alpha=0.5)
        axes.plot(x, y, MARKERS[list(COLOURS).index(bench.variants[name]["method"]) % len(MARKERS)]
                  if bench.variants[name]["method"] in COLOURS else "o", color=bench.colour(name), ms=6,
                  mfc=bench.colour(name) if name in front else "white")
    axes.set_xlim(low, high)
    margin = 0.12 * (max(ys) - min(ys) or max(ys))
    axes.set_ylim(min(ys) - 1.5 * margin, max(ys) + 2 * margin)
    floor = bench.floor(sequence) if metric == "rmse" else None
    if floor and axes.get_ylim()[0] < floor < axes.get_ylim()[1]:
        axes.axhline(floor, color="#999999", ls=":", lw=1)
        axes.text(low * 1.05, floor, "noise of the reference", fontsize=7, color="#777777", va="bottom")
    axes.set_title(title, loc="left", fontsize=9, fontweight="bold")
    axes.set_xlabel(f"time over {bench.baseline}'s" + (" (processor)" if bench.json["device"]["software"] else "")
                    if against == "time" else "bytes moved per pixel, from the plan")
    axes.set_ylabel(dict(ERRORS)[metric])
    axes.figure.canvas.draw()
    place_labels(axes, points, bench)


def pareto_figure(bench, sequence, metrics=("rmse", "flip")):
    title = sequence or "mean over the sequences"
    figure, axes = plt.subplots(len(metrics), 2, figsize=(11, 3.6 * len(metrics)), squeeze=False)
    figure.subplots_adjust(hspace=0.38, wspace=0.22)
    for row, metric in enumerate(metrics):
        for column, against in enumerate(("time", "bytes")):
            pareto_axes(axes[row][column], bench, sequence, metric, f"{title}: {dict(ERRORS)[metric]} against {against}",
                        against)
    return figure


def frames_figure(bench, sequence):
    """Errors over frames, and the change of luminance beside the reference's own."""
    figure, axes = plt.subplots(3, 2, figsize=(11, 8.4))
    figure.subplots_adjust(hspace=0.42, wspace=0.2)
    panels = ERRORS + [("luminance_change", "luminance change")]
    for axis, (metric, label) in zip(axes.flat, panels):
        for name in bench.filters:
            frames = bench.runs[sequence, name]["frames"]
            points = [(f["frame"], f[metric]) for f in frames if f[metric] is not None]
            if not points:
                continue
            x, y = zip(*points)
            y = [1 - v for v in y] if metric == "ssim" else y
            axis.plot(x, y, color=bench.colour(name), ls=bench.dash(name), lw=2 if name == bench.baseline else 1.1,
                      label=name)
        if metric == "rmse" and bench.floor(sequence):
            facts = bench.sequences[sequence]["frames"]
            axis.plot([f["frame"] for f in facts], [f["reference_noise"] for f in facts], color="#999999", ls=":",
                      label="noise of the reference")
        if metric == "luminance_change":
            frames = bench.runs[sequence, bench.baseline]["frames"]
            points = [(f["frame"], f["reference_luminance_change"]) for f in frames
                      if f["reference_luminance_change"] is not None]
            if points:
                axis.plot(*zip(*points), color="#999999", ls=":", lw=2, label="the reference's own")
        for fact in bench.sequences[sequence]["frames"][1:]:
            if fact["history_reset"]:
                axis.axvline(fact["frame"], color="#dddddd", lw=3, zorder=0)
        axis.set_yscale("log")
        for formatter in (axis.yaxis.set_major_formatter, axis.yaxis.set_minor_formatter):
            formatter(matplotlib.ticker.FuncFormatter(plain))
        axis.yaxis.set_minor_locator(matplotlib.ticker.LogLocator(subs=(2, 5)))
        axis.tick_params(axis="y", which="both", labelsize=8)
        axis.set_title(label, loc="left", fontsize=9, fontweight="bold")
        axis.set_xlabel("frame")
        axis.xaxis.set_major_locator(matplotlib.ticker.MaxNLocator(integer=True))
    last = axes.flat[-1]
    last.axis("off")
    handles, labels = axes.flat[0].get_legend_handles_labels()
    more, names = axes.flat[4].get_legend_handles_labels()
    extra = [(h, n) for h, n in zip(more, names) if n not in labels]
    last.legend(handles + [h for h, _ in extra], labels + [n for _, n in extra], loc="center", ncol=2)
    return figure


def kind(pass_name):
    """What passes of several iterations have in common."""
    return pass_name.rstrip("0123456789 ")


def phases_figure(bench, sequence):
    """Stacked bars of the median time of every pass."""
    names = [n for n in bench.methods if bench.runs[sequence, n]["passes"]]
    if not names:
        return None
    software = bench.json["device"]["software"]
    unit = bench.runs[sequence, bench.baseline]["milliseconds"]["median"] if software else 1.0
    totals = {n: sum(p["median"] for p in bench.runs[sequence, n]["passes"]) / unit for n in names}
    figure, axes = plt.subplots(figsize=(11, 0.45 * len(names) + 1.2))
    kinds = list(dict.fromkeys(kind(p["name"]) for n in names for p in bench.runs[sequence, n]["passes"]))
    shades = plt.get_cmap("tab20").colors
    shades = shades[1::2] + shades[::2]  # The light ones first: they carry labels.
    limit = 1.25 * max(t for n, t in totals.items() if t <= 3 * totals[bench.baseline])
    for row, name in enumerate(names):
        left = 0.0
        for item in bench.runs[sequence, name]["passes"]:
            width = item["median"] / unit
            axes.barh(row, width, left=left, color=shades[kinds.index(kind(item["name"])) % 20], height=0.7,
                      edgecolor="white", linewidth=0.6,
                      label=kind(item["name"]) if kind(item["name"]) not in axes.get_legend_handles_labels()[1] else None)
            if width > 0.06 * limit and left + width / 2 < limit:
                axes.text(left + min(width, limit - left) / 2, row, item["name"], ha="center", va="center", fontsize=6.5,
                          clip_on=True)
            left += width
        cut = left > limit
        axes.text(limit * 0.99 if cut else left + 0.005 * limit, row, f"{left:.2f}" + (", cut off here" if cut else ""),
                  va="center", ha="right" if cut else "left", fontsize=8)
    axes.set_yticks(range(len(names)), names)
    axes.invert_yaxis()
    axes.set_xlim(0, limit)
    axes.legend(loc="upper left", bbox_to_anchor=(1.01, 1), fontsize=7.5)
    axes.grid(axis="y", visible=False)
    axes.set_xlabel(f"median time in units of {bench.baseline}'s (processor)" if software else "median time in ms")
    return figure


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
        row += [f"{bench.bytes_per_pixel(sequence, name):.0f}", number(bench.cost(sequence, name)["taps_per_pixel"], 0)]
        rows.append(row)
    header = ["method"] + [label for _, label, _ in TABLE] + (["worst RMSE", "not finite"] if sequence else [])
    return table(header + ["time ratio (5 to 95 %)", "bytes/pixel", "taps/pixel"], rows,
                 f"{html.escape(sequence or 'Mean over the sequences')}: means over frames after the fourth; "
                 "best filter in bold")


def against_baseline(bench):
    """The baseline against every other filter: by how much, and in how many frames, it is better or worse."""
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
                 f"{bench.baseline} is better. Frames of a sequence are not independent")


def hardest_places(bench, sequence, frame, count=3):
    """Corners and size of the squares in which the filters' mean FLIP is largest; squares do not overlap."""
    flip = np.mean([bench.picture(sequence, n + ".errors", frame)[:, :, 2] for n in bench.filters], axis=0)
    size = max(8, flip.shape[0] // 5)
    total = np.pad(np.nan_to_num(flip).cumsum(0).cumsum(1), ((1, 0), (1, 0)))
    sums = total[size:, size:] - total[:-size, size:] - total[size:, :-size] + total[:-size, :-size]
    places = []
    while len(places) < count and sums.max() > 0:
        y, x = np.unravel_index(sums.argmax(), sums.shape)
        places.append((int(x), int(y)))
        sums[max(0, y - size + 1):y + size, max(0, x - size + 1):x + size] = 0
    return places, size


def figure_element(pixels, caption):
    return f"<figure>{png(shrunk(pixels))}<figcaption>{html.escape(caption)}</figcaption></figure>"


def crops_table(pictures, places, size, exposed):
    """The places side by side, a row each, in every picture."""
    scale = max(1, round(112 / size))
    rows = ["<tr><th></th>" + "".join(f"<th>{html.escape(n)}</th>" for n, _ in pictures) + "</tr>"]
    for index, (x, y) in enumerate(places):
        rows.append(f"<tr><td>{index + 1}</td>" + "".join(
            f"<td>{png(displayed(p[y:y + size, x:x + size], exposed), scale)}</td>" for _, p in pictures) + "</tr>")
    return "<div class=crops><table>" + "".join(rows) + "</table></div>"


def with_squares(pixels, places, size):
    pixels = pixels.copy()
    for x, y in places:
        right, bottom = min(x + size, pixels.shape[1]) - 1, min(y + size, pixels.shape[0]) - 1
        for edge in (np.s_[y:bottom, x], np.s_[y:bottom, right], np.s_[y, x:right], np.s_[bottom, x:right]):
            pixels[edge] = (1, 0.9, 0)
    return pixels


def pictures_section(bench, sequence, frame):
    """The hardest places enlarged, then every method's picture beside its error maps."""
    reference, noisy = (bench.picture(sequence, n, frame) for n in ("_reference", "_noisy"))
    exposed = exposure(reference)
    places, size = hardest_places(bench, sequence, frame)
    results = {n: bench.picture(sequence, n, frame) for n in bench.filters}
    errors = {n: np.nan_to_num(bench.picture(sequence, n + ".errors", frame), nan=1.0) for n in bench.filters}
    # One scale for all methods, so that brightness compares; SSIM shows what it lacks to 1.
    maps = [("RMSE", {n: e[:, :, 0] for n, e in errors.items()}), ("1 - SSIM", {n: 1 - e[:, :, 1] for n, e in errors.items()}),
            ("FLIP", {n: e[:, :, 2] for n, e in errors.items()})]
    tops = {label: max(float(np.percentile(list(m.values()), 99.5)), 1e-6) for label, m in maps}
    parts = [f"<h3>{html.escape(sequence)}, frame {frame}</h3><p>The squares are the places where the filters' mean FLIP "
             f"is largest. Exposure for display: {exposed:g}.</p>",
             crops_table([("reference", reference), ("noisy", noisy), *results.items()], places, size, exposed),
             "<div class=cards>", figure_element(with_squares(displayed(reference, exposed), places, size),
                                                 "reference, with the hardest places"),
             figure_element(displayed(noisy, exposed), "noisy"), "</div>"]
    for name, result in results.items():
        figures = next(f for f in bench.runs[sequence, name]["frames"] if f["frame"] == frame)
        parts += [f"<h4>{html.escape(name)} <small>RMSE {number(figures['rmse'], 4)}, SSIM {number(figures['ssim'], 4)}, "
                  f"FLIP {number(figures['flip'], 4)}</small></h4><div class=cards>",
                  figure_element(displayed(result, exposed), "result")]
        for label, values in maps:
            coloured = plt.get_cmap("magma")(np.clip(values[name] / tops[label], 0, 1))[:, :, :3]
            parts.append(figure_element(coloured, f"{label}, 0 to {tops[label]:.2g}"))
        parts.append("</div>")
    return "".join(parts)


def sweep_section(bench, sweep):
    names = [v["name"] for v in bench.json["variants"] if v["sweep"] == sweep]
    labels = [n.split("=", 1)[1] for n in names]
    panels = [("rmse", "RMSE"), ("ssim", "1 - SSIM"), ("flip", "FLIP"), ("flicker", "flicker"), ("time", "time ratio"),
              ("bytes", "bytes/pixel")]
    figure, axes = plt.subplots(1, len(panels), figsize=(13, 2.3))
    figure.subplots_adjust(wspace=0.42)
    for axis, (metric, label) in zip(axes, panels):
        for index, sequence in enumerate(bench.sequences):
            if metric == "time":
                values = [bench.ratio(sequence, n) and bench.ratio(sequence, n)[0] for n in names]
            elif metric == "bytes":
                values = [bench.bytes_per_pixel(sequence, n) for n in names]
            else:
                values = [bench.error(sequence, n, metric) for n in names]
            values = [math.nan if v is None else v for v in values]
            axis.plot(labels, values, "o-", ms=4, lw=1.2, color=SPARE_COLOURS[index % 5], label=sequence)
            for i, name in enumerate(names):
                if bench.variants[name]["is_default"]:
                    axis.plot(labels[i], values[i], "o", ms=9, mfc="none", color="black")
        axis.set_title(label, loc="left", fontsize=9, fontweight="bold")
        axis.tick_params(axis="x", rotation=45, labelsize=7)
        axis.tick_params(axis="y", labelsize=7)
        axis.set_ylim(bottom=0)
    axes[0].legend(fontsize=6.5, loc="lower left")
    rows = []
    for name, label in zip(names, labels):
        row = [html.escape(label) + (" <small>(default)</small>" if bench.variants[name]["is_default"] else "")]
        for sequence in bench.sequences:
            row += [number(bench.mean(sequence, name, m), d) for m, _, d in TABLE if m in ("rmse", "ssim", "flip", "flicker")]
            ratio = bench.ratio(sequence, name)
            row.append(number(ratio and ratio[0], 2))
        row.append(f"{bench.bytes_per_pixel(None, name):.0f}")
        rows.append(row)
    header = ["value"]
    for sequence in bench.sequences:
        header += [f"{html.escape(sequence)} RMSE", "SSIM", "FLIP", "flicker", "time ratio"]
    return f"<h3>{html.escape(sweep)}</h3>" + svg(figure, sweep) + table(header + ["bytes/pixel"], rows,
                                                                         "circled: the default")


def response_section(bench):
    """How methods answer to change, on synthetic scenes."""
    responses = [r for r in bench.json["responses"] if r["variant"] in bench.filters]
    figure, axes = plt.subplots(1, 3, figsize=(13, 3.6))
    figure.subplots_adjust(wspace=0.25)
    for axis, (key, title, label) in zip(axes, (
            ("light_left", "a light goes down", "share of it left"),
            ("error_by_age", "disocclusion", "relative RMSE"),
            ("trail_by_age", "trail behind a bright slab", "share of its light left"))):
        for r in responses:
            axis.plot(range(len(r[key])), r[key], color=bench.colour(r["variant"]), ls=bench.dash(r["variant"]),
                      lw=2 if r["variant"] == bench.baseline else 1.1, label=r["variant"])
        axis.set_title(title, loc="left", fontsize=9, fontweight="bold")
        axis.set_xlabel("frames since")
        axis.set_ylabel(label)
    axes[0].axhline(0.1, color="#999999", ls=":", lw=1)
    axes[0].legend(fontsize=7.5)
    never = "never"
    rows = [[html.escape(r["variant"]), number(r["first_frame_rmse"], 4), number(r["settled_rmse"], 4),
             number(r["settled_flicker"], 5), never if r["light_frames"] is None else r["light_frames"],
             never if r["recovery_frames"] is None else r["recovery_frames"], number(r["trail_by_age"][0], 3)]
            for r in bench.json["responses"]]
    return svg(figure, "response") + table(
        ["method", "first frame RMSE", "settled RMSE", "settled flicker", "light gone, frames", "recovered, frames",
         "trail on the first frame"], rows,
        "a still wall, whose light goes down to a tenth; a slab that moves before it. Gone: no more than a tenth of the "
        "light is left. Recovered: the error is within a quarter of the wall's that nothing hid")


def hard_cases_section(bench):
    """Error by epsilon where features vary by little, and every case at every storage's usual settings."""
    results = {(r["case"], r["storage"], r["regularisation"], r["epsilon"]): r for r in bench.json["hard_cases"]}
    cases, storages, solvers, epsilons = (list(dict.fromkeys(k[i] for k in results)) for i in range(4))
    shown = [c for c in cases if c.startswith(("normals vary", "normals of a sphere"))]
    figure, axes = plt.subplots(len(solvers), len(shown), figsize=(14, 4.6), sharex=True, sharey=True, squeeze=False)
    figure.subplots_adjust(wspace=0.08, hspace=0.12)
    for row, solver in enumerate(solvers):
        for axis, case in zip(axes[row], shown):
            for index, storage in enumerate(storages):
                errors = [results[case, storage, solver, e]["error"] for e in epsilons]
                axis.loglog([float(e) for e in epsilons], [math.nan if e is None else e for e in errors], "o-", ms=3, lw=1.2,
                            color=SPARE_COLOURS[index], label=storage)
            if row == 0:
                axis.set_title(case, fontsize=8)
            else:
                axis.set_xlabel("epsilon")
        axes[row][0].set_ylabel(f"{solver}: relative error")
    axes[0][-1].legend(fontsize=7)
    usual = {"centred16": ("ridge", "1e-3"), "raw16": ("floor", "1e-3"), "raw11": ("floor", "1e-2"), "raw32": ("floor", "1e-5")}
    rows = []
    for case in cases:
        row = [html.escape(case)]
        for storage in storages:
            r = results[(case, storage) + usual[storage]]
            text = "-" if r["error"] is None else f"{r['error']:.3g}"
            text += f' <b class="bad">{r["non_finite_out"]} not finite</b>' if r["non_finite_out"] else ""
            row.append(text + (f" <small>{r['negative_out']} below 0</small>" if r["negative_out"] else ""))
        row.append(results[(case, storages[0]) + usual[storages[0]]]["non_finite_in"])
        rows.append(row)
    return ("<p>Signals that are linear in the normal, so that an exact regression has no bias; exponential noise; one frame "
            "without history; 27 x 27 pixels.</p>" + svg(figure, "hard cases")
            + table(["case"] + [f"{s}, {usual[s][0]} {usual[s][1]}" for s in storages] + ["not finite in"], rows,
                    "relative root mean square error, linear; absolute where there is no light"))


def costs_section(bench):
    sizes = [(c["width"], c["height"]) for c in next(iter(bench.variants.values()))["costs"]]
    rows = []
    for name in bench.methods:
        row = [html.escape(name)]
        for cost in bench.variants[name]["costs"]:
            row.append(f"{cost['bytes_read_per_pixel'] + cost['bytes_written_per_pixel']:.0f} <small>B/px</small> "
                       f"{cost['persistent_bytes'] / 1e6:.0f} + {cost['transient_peak_bytes'] / 1e6:.0f} "
                       f"<small>(of {cost['transient_unaliased_bytes'] / 1e6:.0f}) MB</small>")
        rows.append(row)
    return table(["method"] + [f"{w} x {h}" for w, h in sizes], rows,
                 "bytes moved per pixel with perfect caches; memory that persists + shared transient memory "
                 "(of what it would be unshared), all from the plan, without the host's own textures")


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


def sequences_sections(bench, names):
    """What was measured on the sequences: errors, costs, plots over frames and by pass."""
    out = ["<h2>Errors and costs</h2>"]
    for sequence in ([None] if len(names) > 1 else []) + names:
        out.append(methods_table(bench, sequence))
    out.append(f"<h2>{html.escape(bench.baseline)} against the others</h2>" + against_baseline(bench))
    out.append("<h2>Error against cost</h2><p>Filled: on the Pareto front, beaten by none in both. Bars: 5 to 95 % of the "
               "time ratios.</p>")
    for sequence in ([None] if len(names) > 1 else []) + names:
        out.append(svg(pareto_figure(bench, sequence), f"pareto {sequence}"))
    out.append("<h2>Over the frames</h2><p>All on a logarithmic scale. The change of luminance is best where it is the "
               "reference's own: below it lags, above it flickers.</p>")
    for sequence in names:
        out.append(f"<h3>{html.escape(sequence)}</h3>" + svg(frames_figure(bench, sequence), f"frames {sequence}"))
    out.append("<h2>Time by pass</h2>")
    for sequence in names:
        figure = phases_figure(bench, sequence)
        out.append(f"<h3>{html.escape(sequence)}</h3>" + (svg(figure, f"phases {sequence}") if figure else "no timer"))
    return out


def page(bench):
    data, device = bench.json, bench.json["device"]
    out = [f"<!doctype html><html lang=en><meta charset=utf-8><title>walr bench</title><style>{STYLE}</style>",
           "<h1>Speed against error</h1>"]
    bandwidth = device["copy_bytes_per_second"]
    empty = device["empty_pass_ms"]
    out.append("<p>" + html.escape(
        f"{device['name']}, driver {device['driver']}. Commit {data['commit']}, {data['compiler']}, {data['build_type']}. "
        + (f"Timer: steps of {device['timestamp_ns']:g} ns, an empty pass shows {1e3 * empty['median']:.1f} us. " if empty
           else "The device has no timer. ")
        + (f"Copies move {bandwidth / 1e9:.1f} GB/s (read and written). " if bandwidth else "")
        + f"Tone map {data['tone_map']}. {data['repetitions']} timed repetitions after one that warms up.") + "</p>"
        f"<p><code>{html.escape(data['command'])}</code></p>")
    if device["software"]:
        out.append("<p class=warning>A processor plays the GPU here. Times are given only as ratios to "
                   f"{bench.baseline} within this run, and they say nothing about a GPU; bytes and memory come from the "
                   "plan and hold on any device.</p>")
    odd = [f"{v} on {s}" for (s, v), r in bench.runs.items() if not r["reproducible"]]
    if odd:
        out.append(f"<p class=warning>Not the same bits in every repetition: {html.escape(', '.join(odd))}.</p>")
    names = list(bench.sequences)
    if names:
        out += sequences_sections(bench, names)
    out.append("<h2>Traffic and memory</h2>" + costs_section(bench))
    if data["responses"]:
        out.append("<h2>Response to change</h2>" + response_section(bench))
    if data["hard_cases"]:
        out.append("<h2>Hard cases of the arithmetic</h2>" + hard_cases_section(bench))
    sweeps = list(dict.fromkeys(v["sweep"] for v in data["variants"] if v["sweep"]))
    if sweeps:
        out.append("<h2>Sweeps</h2>" + "".join(sweep_section(bench, sweep) for sweep in sweeps))
    if names:
        out.append("<h2>Pictures</h2><p>Indirect light, chosen by the input alone: the frame with the largest disocclusion, "
                   "and the last one.</p>")
    for sequence in names:
        for frame in bench.sequences[sequence]["picture_frames"]:
            out.append(pictures_section(bench, sequence, frame))
    out.append("<h2>What the figures are</h2><dl>" + "".join(
        f"<dt>{html.escape(m['name'])}</dt><dd>{html.escape(m['description'])}</dd>" for m in data["metrics"]) + "</dl>"
        "<p>Errors are those of the demodulated diffuse indirect light, over pixels with a diffuse lobe. Values that are not "
        "finite count as the worst and show as magenta. Not measured: VMAF.</p></html>")
    return "\n".join(out)


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    bench = Bench(sys.argv[1])
    (bench.folder / "report.html").write_text(page(bench), encoding="utf-8")
    if not bench.sequences:
        return
    everything = None if len(bench.sequences) > 1 else next(iter(bench.sequences))
    (bench.folder / "pareto.svg").write_text(svg(pareto_figure(bench, everything, ("rmse",)), "pareto"), encoding="utf-8")


if __name__ == "__main__":
    main()
