"""The pictures of the results. Needs numpy and matplotlib, which come with Debian's python3-matplotlib."""
import pathlib
import sys

import figures_page
import numpy as np
import rates_page
from rate_entries import FINE, rays
from records import IMAGES

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "bench"))
from report import displayed, exposure, hardest_places, signed_colours
from report_data import Bench
from report_plots import COLOURS, error_axes, plt

CYCLES = ("walr", "walr_paper", "bmfr", "svgf", "flr", "flnr:full", "joint_bilateral")
REFLECTIONS = ("accumulate", "svgf", "walr")
"""Methods whose pictures are shown."""


def save(figure, name, dpi, **options):
    figure.savefig(IMAGES / name, dpi=dpi, metadata={"Software": None}, **options)
    plt.close(figure)


def pareto(kept, gpu):
    """Error against time on a GPU."""
    figure, axes = plt.subplots(figsize=(7, 3.6))
    error_axes(axes, figures_page.pareto_points(kept, gpu), COLOURS.__getitem__, list(COLOURS).index, 1.35)
    axes.set_xlabel(f"ms a frame of 1920 x 1080, {gpu['device']}")
    axes.set_ylabel(f"RMSE over that of {kept['baseline']}")
    save(figure, "pareto.png", 110, bbox_inches="tight")


def sizes(records):
    """RMSE of every method on every sequence of the corpus with one sample per pixel, a panel for each run."""
    figure, panels = plt.subplots(1, len(records), figsize=(10, 4), sharey=True, constrained_layout=True, squeeze=False)
    for panel, kept in zip(panels[0], records):
        shown = {n: e for n, e in kept["entries"].items() if e["samples"] == 1}
        for method, colour in COLOURS.items():
            points = [(x, e["methods"][method]["rmse"][0]) for x, e in enumerate(shown.values())
                      if e["methods"].get(method, {}).get("rmse")]
            if points:
                panel.plot(*zip(*points), "o" if method == "walr" else "_", color=colour, markersize=6 if method == "walr" else 14,
                           markeredgewidth=2, label="input" if method == "none" else method)
        panel.set(title=f"{max(e['size'][1] for e in shown.values())} lines", yscale="log", ylabel="RMSE after the tone map")
        panel.set_xticks(range(len(shown)), [name.rsplit("_", 1)[0] for name in shown], rotation=20)
        panel.grid(alpha=0.3, which="both", axis="y")
    panels[0][-1].legend(fontsize=7, loc="center left", bbox_to_anchor=(1, 0.5))
    save(figure, "sizes.png", 90)


def rates(kept):
    """Error against rays per pixel, a panel for each scene."""
    figure, panels = plt.subplots(2, 2, figsize=(10, 7), constrained_layout=True)
    for panel, (scene, found) in zip(panels.flat, kept["scenes"].items()):
        order = rates_page.order(found)
        for method in rates_page.COLUMNS:
            points = [(rays(r), 1e4 * found[r][method]) for r in order
                      if r != rates_page.RESAMPLED and r not in FINE and found[r].get(method)]
            if not points:
                continue
            style = "--" if method in ("none", "accumulate", "plain") else "-"
            line, = panel.plot(*zip(*points), style, marker="o", markersize=3, label=rates_page.HEADINGS.get(method, method))
            if found.get(rates_page.RESAMPLED, {}).get(method):
                panel.plot(1, 1e4 * found[rates_page.RESAMPLED][method], marker="x", color=line.get_color())
        points = [(rays(r), 1e4 * found[r]["walr"]) for r in order if r in FINE]
        if points:
            panel.plot(*zip(*points), ":", marker="^", markersize=4, color="black", label="walr, 4 hits")
        panel.set(title=scene, xscale="log", yscale="log", xlabel="rays per pixel (x: resampled)", ylabel="RMSE x 10^4")
        panel.grid(alpha=0.3, which="both")
    panels.flat[0].legend(fontsize=7)
    save(figure, "rates.png", 90)


def crops(folder, file, shown, count=2):
    """The places of largest error in the last stored frame of each sequence of `walr bench`, and the change of the error there along
    motion. shown: methods."""
    bench, rows = Bench(folder), []
    for sequence, facts in bench.sequences.items():
        frame = max(facts["picture_frames"])
        pictures = {n: bench.picture(sequence, n, frame) for n in ["_reference", "_noisy", *shown]}
        changes = {n: bench.change(sequence, n, frame)[:, :, 0] for n in shown}
        exposed = exposure(pictures["_reference"])
        top = float(np.nanpercentile(np.abs(list(changes.values())), 99.5))
        places, size = hardest_places(bench, sequence, frame, count)
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
    save(figure, file, 100)
