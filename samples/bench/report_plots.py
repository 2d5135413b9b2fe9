"""The plots of a benchmark's report, for report.py. Needs matplotlib."""
import io
import math

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

from report_data import COLOURS, ERRORS, SPARE_COLOURS, pareto  # noqa: E402

MARKERS = "osD^vP*X"
plt.rcParams.update({"font.size": 9, "axes.spines.top": False, "axes.spines.right": False, "axes.grid": True,
                     "grid.color": "#e6e6e6", "grid.linewidth": 0.6, "axes.axisbelow": True, "svg.fonttype": "none",
                     "legend.frameon": False})


def svg(figure, salt):
    """The figure as an inline SVG element. The salt makes the ids of several figures on one page distinct."""
    buffer = io.StringIO()
    with plt.rc_context({"svg.hashsalt": salt}):
        figure.savefig(buffer, format="svg", bbox_inches="tight", metadata={"Date": None})
    plt.close(figure)
    text = buffer.getvalue()
    return text[text.index("<svg"):]


def plain(value, _=None):
    """A number on an axis without an exponent."""
    return f"{value:.4g}"


def place_labels(axes, points, colour):
    """Names next to their points, moved up where one would cover another name or point."""
    taken = [axes.transData.transform(p) for p in points.values()]
    for name, (x, y) in sorted(points.items(), key=lambda item: item[1][1]):
        px, py = axes.transData.transform((x, y))
        offset = 0
        while any(-12 < qx - px < 12 + 7 * len(name) and abs(py + offset - qy) < 10 and (qx, qy) != (px, py) for qx, qy in taken):
            offset += 10
        taken.append((px + 5, py + offset))
        axes.annotate(name, (x, y), xytext=(5, offset * 72 / axes.figure.dpi + 4), textcoords="offset points",
                      color=colour(name), fontsize=8, arrowprops=dict(arrowstyle="-", lw=0.4, color="#999999")
                      if offset else None)


def error_axes(axes, points, colour, marker, widen, spreads=None):
    """Error against cost: one point per method. Points on the Pareto front are filled and joined by a line.

    points: cost and error by name; colour, marker: functions of the name, of which the latter returns an index; widen: factor
    by which the cost axis extends beyond the last point, to leave room for names; spreads: 5 and 95 % quantile of the cost by
    name."""
    front = sorted(pareto(points), key=points.get)
    axes.set_xscale("log")
    axes.xaxis.set_major_locator(matplotlib.ticker.LogLocator(subs=(1, 2, 5)))
    axes.xaxis.set_major_formatter(matplotlib.ticker.FuncFormatter(plain))
    axes.xaxis.set_minor_locator(matplotlib.ticker.NullLocator())
    xs, ys = zip(*points.values())
    low, high = min(xs) / 1.5, max(xs) * widen
    corners = [points[n] for n in front]
    axes.step([x for x, _ in corners] + [high], [y for _, y in corners] + [corners[-1][1]], where="post", color="#bbbbbb", lw=1,
              zorder=1)
    for name, (x, y) in points.items():
        if spreads:
            axes.plot(spreads[name], [y, y], color=colour(name), lw=0.8, alpha=0.5)
        axes.plot(x, y, MARKERS[marker(name) % len(MARKERS)], color=colour(name), ms=6, mfc=colour(name) if name in front else "white")
    axes.set_xlim(low, high)
    margin = 0.12 * (max(ys) - min(ys) or max(ys))
    axes.set_ylim(min(ys) - 1.5 * margin, max(ys) + 2 * margin)
    axes.figure.canvas.draw()
    place_labels(axes, points, colour)


def pareto_axes(axes, bench, sequence, metric, title, against):
    """One plot of error against cost."""
    ratios = {n: bench.ratio(sequence, n) for n in bench.filters}
    costs = {n: {"time": ratios[n] and ratios[n][0], "bytes": bench.bytes_per_pixel(sequence, n), "estimate": bench.estimate(n)}[against]
             for n in bench.filters}
    points = {n: (cost, bench.error(sequence, n, metric)) for n, cost in costs.items()}
    points = {n: p for n, p in points.items() if None not in p}
    if not points:
        axes.set_visible(False)
        return
    methods = list(COLOURS)
    error_axes(axes, points, bench.colour, lambda n: methods.index(m) if (m := bench.variants[n]["method"]) in COLOURS else 0,
               2.6 if against == "time" else 1.7, {n: r[1:] for n, r in ratios.items() if r} if against == "time" else None)
    floor = bench.floor(sequence) if metric == "rmse" else None
    if floor and axes.get_ylim()[0] < floor < axes.get_ylim()[1]:
        axes.axhline(floor, color="#999999", ls=":", lw=1)
        axes.text(axes.get_xlim()[0] * 1.05, floor, "noise of the reference", fontsize=7, color="#777777", va="bottom")
    axes.set_title(title, loc="left", fontsize=9, fontweight="bold")
    axes.set_xlabel({"time": f"time over {bench.baseline}'s" + (" (processor)" if bench.json["device"]["software"] else ""),
                     "bytes": "bytes moved per pixel, from the plan",
                     "estimate": f"ESTIMATED us at 1080p, {bench.json['estimate']['machine']}; no measurement"}[against])
    axes.set_ylabel(dict(ERRORS)[metric])


def pareto_figure(bench, sequence, metrics=("rmse", "flip")):
    title = sequence or "mean over the sequences"
    figure, axes = plt.subplots(len(metrics), 3, figsize=(15, 3.6 * len(metrics)), squeeze=False)
    figure.subplots_adjust(hspace=0.38, wspace=0.22)
    for row, metric in enumerate(metrics):
        for column, against in enumerate(("time", "bytes", "estimate")):
            pareto_axes(axes[row][column], bench, sequence, metric, f"{title}: {dict(ERRORS)[metric]} against {against}" if column < 2 else
                        "against estimated GPU time",
                        against)
    return figure


def frames_figure(bench, sequence):
    """Errors over frames, and the change of luminance together with that of the reference."""
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
                axis.plot(*zip(*points), color="#999999", ls=":", lw=2, label="reference")
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
    """The name that the passes of several iterations share."""
    return pass_name.rstrip("0123456789 ")


def phases_figure(bench, timings):
    """Stacked bars of the median time of every pass, by variant, of the timed variants."""
    names = [n for n in bench.methods if n in timings and timings[n]["passes"]]
    if bench.baseline not in names:
        return None
    software = bench.json["device"]["software"]
    unit = timings[bench.baseline]["milliseconds"]["median"] if software else 1.0
    totals = {n: sum(p["median"] for p in timings[n]["passes"]) / unit for n in names}
    figure, axes = plt.subplots(figsize=(11, 0.45 * len(names) + 1.2))
    kinds = list(dict.fromkeys(kind(p["name"]) for n in names for p in timings[n]["passes"]))
    shades = plt.get_cmap("tab20").colors
    shades = shades[1::2] + shades[::2]  # The light ones first, because labels are drawn on them.
    limit = 1.25 * max(t for n, t in totals.items() if t <= 3 * totals[bench.baseline])
    for row, name in enumerate(names):
        left = 0.0
        for item in timings[name]["passes"]:
            width = item["median"] / unit
            axes.barh(row, width, left=left, color=shades[kinds.index(kind(item["name"])) % 20], height=0.7,
                      edgecolor="white", linewidth=0.6,
                      label=kind(item["name"]) if kind(item["name"]) not in axes.get_legend_handles_labels()[1] else None)
            if width > 0.009 * limit * len(item["name"]) and left + width < limit:
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


def response_figure(bench):
    """Remaining light after dimming, and error and trail after a disocclusion, by frames since the change."""
    responses = [r for r in bench.json["responses"] if r["variant"] in bench.filters]
    figure, axes = plt.subplots(1, 3, figsize=(13, 3.6))
    figure.subplots_adjust(wspace=0.25)
    for axis, (key, title, label) in zip(axes, (
            ("light_left", "a light is dimmed", "share that remains"),
            ("error_by_age", "disocclusion", "relative RMSE"),
            ("trail_by_age", "trail behind a bright slab", "share of its light that remains"))):
        for r in responses:
            axis.plot(range(len(r[key])), r[key], color=bench.colour(r["variant"]), ls=bench.dash(r["variant"]),
                      lw=2 if r["variant"] == bench.baseline else 1.1, label=r["variant"])
        axis.set_title(title, loc="left", fontsize=9, fontweight="bold")
        axis.set_xlabel("frames since the change")
        axis.set_ylabel(label)
    axes[0].axhline(0.1, color="#999999", ls=":", lw=1)
    axes[0].legend(fontsize=7.5)
    return figure


def conditioning_figure(results, cases, storages, usual):
    """Error over the variation of the features. The smaller it is, the worse the condition of the fit."""
    prefix = "normals vary by "
    amplitudes = sorted((float(c.removeprefix(prefix)), c) for c in cases if c.startswith(prefix))
    figure, axes = plt.subplots(1, 2, figsize=(11, 3.4), sharey=True)
    figure.subplots_adjust(wspace=0.08)
    # The same solver for all shows which storages need a larger epsilon.
    for axis, setting, title in ((axes[0], usual.__getitem__, "each storage's usual epsilon"),
                                 (axes[1], lambda storage: (usual[storage][0], "1e-5"), "epsilon of 1e-5 for all")):
        for index, storage in enumerate(storages):
            axis.loglog([a for a, _ in amplitudes], [results[(c, storage) + setting(storage)]["error"] for _, c in amplitudes],
                        "o-", ms=3, lw=1.2, color=SPARE_COLOURS[index], label=storage)
        axis.set_title(title, loc="left", fontsize=9, fontweight="bold")
        axis.set_xlabel("normals vary by")
    axes[0].set_ylabel("relative error")
    axes[0].legend(fontsize=7)
    return figure


def hard_cases_figure(results, cases, storages, solvers, epsilons):
    """Error over epsilon for features that vary little: one row per solver, one line per storage."""
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
    return figure
