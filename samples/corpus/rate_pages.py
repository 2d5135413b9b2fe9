"""RATES.md and rates.png from rates.json."""
import pathlib
import sys

from rate_entries import FINE, RESAMPLED_FRAMES, TAKE_SPARSE, rays

HERE = pathlib.Path(__file__).resolve().parent
PAGE, PLOT = HERE / "RATES.md", HERE / "rates.png"
COLUMNS = ("walr", "walr:fast", "walr_paper", "walr_paper:robust", "flr", "bmfr", "svgf", "joint_bilateral", "accumulate", "none", "plain")
HEADINGS = {"none": "input", "walr:fast": "fast", "plain": "plain alternative"}
RESAMPLED = "1, resampled"
EXPLANATION = """# Error against rays per pixel

Written by `samples/corpus/rates.py` from `rates.json`. The same frames of 384 x 216 pixels, jittered, with ever more rays of
indirect light per pixel; one ray is one path. Below 1 the light is sparse (`walr render --light-rate`), and only methods that take
sparse light are there. RMSE after the tone map x / (1 + x), free of the references' noise, over three frames in half of the squares
of 64 x 64 pixels; references have 128 samples per pixel over its area. Eight frames of history come before the judged
ones. Method settings are the defaults at every rate; `fast` is a preset of `walr`, the same as its default at sparse light.

* **input**: the noisy frames; **accumulate**: temporal accumulation alone.
* **plain alternative**: trace at a half or a third of the size on each side, denoise there with `walr`, and interpolate by depth and
  normal.
* **4 hits**: each pixel of the picture has four primary hits, and each of them a quarter of the rays. The frames have twice the size on
  each side; a row says the rays per pixel of the picture. Their results are averaged over 2 x 2 pixels (`walr denoise --average 2`).
  The other rows have one primary hit per pixel, from which all of its rays go out.
* **1, resampled**: one ray per pixel, with paths reused over up to {resampled} frames as in ReSTIR GI without spatial reuse.

Errors are x 10^4. The ratio is that to `walr` at 1 ray, the geometric mean over the scenes that have the rate, with its interval of
95 % ([corpus](../docs/corpus.md)). -: not possible, or not run.
"""


CYCLES = """
## Frames of Cycles

Two sequences that Blender's Cycles rendered at one sample per pixel, 384 x 216: all samples, and a share of them
(`walr denoise --light-rate`). RMSE without the references' noise, mean over the frames after the fourth, and in brackets its
ratio to that of the same method at 1.

"""


def order(rates):
    return sorted(rates, key=lambda rate: (rays(rate), rate))


def row(cells):
    return "| " + " | ".join(cells) + " |\n"


def header(first):
    return row([first, *(HEADINGS.get(c, f"`{c}`") for c in COLUMNS)]) + row(["---"] * (len(COLUMNS) + 1))


def page(kept):
    text = EXPLANATION.format(resampled=RESAMPLED_FRAMES) + "\n![RMSE against rays per pixel](rates.png)\n\n## Ratios\n\n"
    text += header("rays per pixel (scenes)")
    for rate, methods in kept["ratios"].items():
        cells = [methods.get(c) and "{:.2f} ({:.2f} to {:.2f})".format(*methods[c]) or "-" for c in COLUMNS]
        text += row([f"{rate} ({methods['scenes']})", *cells])
    for scene, rates in kept["scenes"].items():
        text += f"\n## {scene}\n\nRoot mean square of the references' own noise: {1e4 * kept['noise'][scene]:.0f}.\n\n"
        text += header("rays per pixel")
        for rate in order(rates):
            found = rates[rate]
            values = {c: found[c][0] for c in COLUMNS if found.get(c)}
            best = min(values.values())
            shown = [f"{1e4 * values[c]:.1f}" if c in values else "-" for c in COLUMNS]
            text += row([rate, *(f"**{s}**" if values.get(c) == best else s for c, s in zip(COLUMNS, shown))])
    return text + (cycles_page(kept["cycles"]) if kept.get("cycles") else "")


def cycles_page(sequences):
    text = CYCLES + row(["sequence", "rays per pixel", *(f"`{m}`" for m in TAKE_SPARSE)]) + row(["---"] * (len(TAKE_SPARSE) + 2))
    for sequence, rates in sequences.items():
        for rate in order(rates):
            cells = [f"{1e4 * rates[rate][m]:.1f} (" + (f"{rates[rate][m] / rates['1'][m]:.3f}" if rates["1"][m] else "-") + ")"
                     for m in TAKE_SPARSE]
            text += row([f"`{sequence}`", rate, *cells])
    return text


def plot(kept):
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot
    figure, panels = pyplot.subplots(2, 2, figsize=(10, 7), constrained_layout=True)
    for panel, (scene, rates) in zip(panels.flat, kept["scenes"].items()):
        for method in COLUMNS:
            points = [(rays(r), 1e4 * rates[r][method][0]) for r in order(rates)
                      if r != RESAMPLED and r not in FINE and rates[r].get(method)]
            if not points:
                continue
            style = "--" if method in ("none", "accumulate", "plain") else "-"
            line, = panel.plot(*zip(*points), style, marker="o", markersize=3, label=HEADINGS.get(method, method))
            if rates.get(RESAMPLED, {}).get(method):
                panel.plot(1, 1e4 * rates[RESAMPLED][method][0], marker="x", color=line.get_color())
        points = [(rays(r), 1e4 * rates[r]["walr"][0]) for r in order(rates) if r in FINE]
        if points:
            panel.plot(*zip(*points), ":", marker="^", markersize=4, color="black", label="walr, 4 hits")
        panel.set(title=scene, xscale="log", yscale="log", xlabel="rays per pixel (x: resampled)", ylabel="RMSE x 10^4")
        panel.grid(alpha=0.3, which="both")
    panels.flat[0].legend(fontsize=7)
    figure.savefig(PLOT, dpi=90, metadata={"Software": None})


def write(kept, check=False):
    text = page(kept)
    if not check:
        PAGE.write_text(text, encoding="utf-8")
        plot(kept)
    elif PAGE.read_text(encoding="utf-8") != text:
        sys.exit(f"{PAGE}: not what rates.json gives; run samples/corpus/rates.py page")
