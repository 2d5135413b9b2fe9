"""The page of errors by size, scene and samples, from all runs of the corpus that are kept and from those by rays per pixel."""
import entries
from corpus_page import lines_of
from markdown_text import filled, listed, mark, number, table, verdict

BASELINE = "walr"
METHODS = [m for m in entries.METHODS if m != BASELINE]
LEAST_LEAD = 0.02
"""A method is listed as ahead of the baseline if its error is smaller by more than this share."""
EXPLANATION = """# Errors by size, scene and samples

Written by `samples/results/write.py` from the figures of {heights} lines. [How they were measured](README.md#what-was-measured).
All frames are jittered and rendered by `walr render`, those of `sponza` and `cornell_fence`, too: [the page of Cycles](CYCLES.md)
has other sequences of these names.

* **Lines**: height of the picture in pixels. **Samples**: samples per pixel.
* **`walr`**: RMSE of the default preset, in units of the tone-mapped value x / (1 + x), 0 to 1, free of the references' noise.
* **Other methods**: ratio of their RMSE to that of `walr`. &lt;: better than `walr` beyond the interval of 95 %; &gt;: worse;
  ~: undecided; no mark: no interval was computed. -: not measured.

"""


def cells_of(entry):
    """The cells of a sequence of the corpus: RMSE of the baseline, and ratios of the others."""
    methods = entry["methods"]
    cells = [number(methods[BASELINE]["rmse"][0])]
    for method in METHODS:
        ratio = methods.get(method, {}).get("ratio", {}).get("rmse")
        cells.append(f"{ratio[0]:.2f} {mark(ratio)}" if ratio else "-")
    return cells


def corpus_rows(records):
    rows = []
    for kept in records:
        for name, entry in kept["entries"].items():
            shown = f"`{name}`" + (" (held back)" if entry["held_back"] else "")
            rows.append(((entry["size"][1], entry["scene"], entry["samples"], shown), cells_of(entry)))
    return rows


def rate_rows(rates, lines):
    """Rows of rates.json with a whole number of samples per pixel."""
    rows = []
    for scene, by_rate in rates["scenes"].items():
        for rate, methods in by_rate.items():
            if not rate.isdigit():
                continue
            baseline = methods[BASELINE]
            cells = [f"{methods[m] / baseline:.2f}" if methods.get(m) else "-" for m in METHODS]
            rows.append(((lines, scene, int(rate), f"`{scene}`"), [number(baseline), *cells]))
    return rows


def errors_table(records, rates, lines):
    rows = sorted(corpus_rows(records) + rate_rows(rates, lines))
    return table(["lines", "sequence", "samples", f"`{BASELINE}`", *(f"`{m}`" for m in METHODS)],
                 [[str(height), shown, str(samples), *cells] for (height, _, samples, shown), cells in rows])


def behind_table(records):
    """Where a method is ahead of the baseline beyond the interval and by more than LEAST_LEAD."""
    rows = []
    for kept in records:
        for name, entry in kept["entries"].items():
            ahead = {m: entry["methods"][m]["ratio"]["rmse"] for m in METHODS if m in entry["methods"]}
            ahead = {m: r for m, r in ahead.items() if verdict(r) == "better" and r[0] < 1 - LEAST_LEAD}
            if ahead:
                rows.append([f"`{name}`", ", ".join(f"`{m}` by {100 * (1 - r[0]):.0f} %" for m, r in sorted(ahead.items()))])
    return table(["sequence", f"methods ahead of `{BASELINE}`"], rows) if rows else "There are none.\n"


def gain(ratio):
    """Share of another method's error that the baseline takes off; negative if it adds to it."""
    return 1 - 1 / ratio


def gains_table(records):
    """Gains of the baseline over each other method on the sequences held back, against those on the others."""
    rows = []
    for kept in records:
        for method in (m for m in METHODS if not m.startswith(BASELINE + ":")):
            open_ratio, held = (kept[part].get(method, {}).get("rmse") for part in ("summary", "held_back_summary"))
            if open_ratio and held:
                of_open, of_held = gain(open_ratio[0]), gain(held[0])
                rows.append([lines_of(kept), f"`{method}`", f"{100 * of_open:.1f} %", f"{100 * of_held:.1f} %",
                             f"{of_held / of_open:.2f}" if of_open else "-"])
    return table(["lines", "method", f"`{BASELINE}` errs less by, other sequences", "held back", "ratio"], rows)


def page(records, rates, lines):
    """records: figures of all records of the corpus; lines: height of the pictures of rates.json."""
    heights = listed(map(str, [lines, *map(lines_of, records)]))
    return (EXPLANATION.format(heights=heights) + errors_table(records, rates, lines) +
            "\n## Where `walr` is behind\n\n" + filled(
                "Methods whose RMSE is smaller than that of `walr` beyond the interval, and by more than "
                f"{100 * LEAST_LEAD:.0f} %. Sequences of {lines} lines have no intervals and are left out.") + "\n" + behind_table(records) +
            "\n## Sequences held back\n\n" + filled(
                "No setting was chosen by them. The ratio is the gain of `walr` on them over its gain on the others; from 1 on, the "
                "whole gain holds elsewhere, too. Small gains are uncertain: the pages of the sizes give their intervals.") +
            "\n" + gains_table(records))
