"""The page of errors by rays per pixel."""
from markdown_text import number, table
from rate_entries import RESAMPLED_FRAMES, TAKE_SPARSE, rays

COLUMNS = ("walr", "walr_paper", "walr_paper:robust", "flr", "bmfr", "svgf", "joint_bilateral", "accumulate", "none", "plain")
HEADINGS = {"none": "input", "plain": "plain alternative"}
RESAMPLED = "1, resampled"
LEAST_LEAD = 0.02
"""A method is listed as ahead of `walr` if its error is smaller by at least this share."""
EXPLANATION = """# Error against rays per pixel

Written by `samples/results/write.py` from `data/rates.json`. Measured by `samples/corpus/rates.py` on {date} at commit {commit}.

The same frames of 384 x 216 pixels, jittered, with ever more rays of indirect light per pixel; one ray is one path. Below 1 the light
is sparse (`walr render --light-rate`), and only methods that take sparse light are there. RMSE after the tone map x / (1 + x), free of
the references' noise, over three frames in half of the squares of 64 x 64 pixels; references have 128 samples per pixel over its area.
Eight frames of history come before the judged ones. Method settings are the defaults at every rate.

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


def by_column(first, rows):
    return table([first, *(HEADINGS.get(c, f"`{c}`") for c in COLUMNS)], rows)


def ratios_table(ratios):
    return by_column("rays per pixel (scenes)", [
        [f"{rate} ({methods['scenes']})", *(methods.get(c) and "{:.2f} ({:.2f} to {:.2f})".format(*methods[c]) or "-" for c in COLUMNS)]
        for rate, methods in ratios.items()])


def primary_hits_table(ratios):
    """What more primary hits gain, for the integration guide."""
    rows = [[rate, *(number(ratios[of]["walr"][0], 2) if "walr" in ratios[of] else "-" for of in (rate, f"{rate}, 4 hits"))]
            for rate in ratios if f"{rate}, 4 hits" in ratios]
    return table(["rays for a pixel of the picture", "one primary hit", "four primary hits"], rows)


def scene_table(rates):
    rows = []
    for rate in order(rates):
        values = {c: rates[rate][c] for c in COLUMNS if rates[rate].get(c)}
        best = min(values.values())
        shown = [f"{1e4 * values[c]:.1f}" if c in values else "-" for c in COLUMNS]
        rows.append([rate, *(f"**{s}**" if values.get(c) == best else s for c, s in zip(COLUMNS, shown))])
    return by_column("rays per pixel", rows)


def leads_table(scenes):
    """Where a method errs less than `walr`."""
    rows = []
    for scene, rates in scenes.items():
        for rate in order(rates):
            leads = {m: 1 - error / rates[rate]["walr"] for m, error in rates[rate].items() if error}
            ahead = [f"{HEADINGS.get(m, f'`{m}`')} by {100 * lead:.0f} %" for m, lead in leads.items() if lead >= LEAST_LEAD]
            if ahead:
                rows.append([f"`{scene}`", rate, ", ".join(ahead)])
    return table(["scene", "rays per pixel", "methods ahead of `walr`"], rows) if rows else "There are none.\n"


def page(kept):
    text = EXPLANATION.format(resampled=RESAMPLED_FRAMES, date=kept["date"], commit=kept["commit"])
    text += "\n![RMSE against rays per pixel](images/rates.png)\n\n## Ratios\n\n" + ratios_table(kept["ratios"])
    text += f"\n## Where `walr` is behind\n\nBy {100 * LEAST_LEAD:.0f} % and more, without intervals.\n\n" + leads_table(kept["scenes"])
    for scene, rates in kept["scenes"].items():
        text += f"\n## {scene}\n\nRoot mean square of the references' own noise: {1e4 * kept['noise'][scene]:.0f}.\n\n" + scene_table(rates)
    return text + (cycles_page(kept["cycles"]) if kept["cycles"] else "")


def cycles_page(sequences):
    rows = []
    for sequence, rates in sequences.items():
        for rate in order(rates):
            cells = [f"{1e4 * rates[rate][m]:.1f} (" + (f"{rates[rate][m] / rates['1'][m]:.3f}" if rates["1"][m] else "-") + ")"
                     for m in TAKE_SPARSE]
            rows.append([f"`{sequence}`", rate, *cells])
    return CYCLES + table(["sequence", "rays per pixel", *(f"`{m}`" for m in TAKE_SPARSE)], rows)
