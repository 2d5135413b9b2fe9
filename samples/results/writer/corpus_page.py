"""The page of a run of the corpus, from its figures."""
from markdown_text import indented, mark, number, ratio_text, table, verdict, with_interval
from records import place_name

METRIC_NAMES = {"rmse": "RMSE", "ssim": "1 - SSIM", "flip": "FLIP", "flicker": "flicker"}
SPLIT_NAMES = {"edge": "pixels to the nearest geometric edge", "noise": "noise of the input", "age": "age of the surface, frames",
               "darkness": "luminance"}


def summary_table(kept, summary, entries):
    rows = []
    for method, figures in summary.items():
        verdicts = [verdict(e["methods"][method]["ratio"]["rmse"]) for e in entries.values()]
        counts = " / ".join(str(verdicts.count(v)) for v in ("better", "undecided", "worse"))
        rows.append([f"`{method}`", *(ratio_text(figures[m]) for m in METRIC_NAMES), counts])
    return table([f"method, against `{kept['baseline']}`", *METRIC_NAMES.values(), "better / undecided / worse by RMSE"], rows)


def entries_table(kept):
    methods = [kept["baseline"], *(kept["summary"] or kept["held_back_summary"])]
    rows = []
    for name, entry in sorted(kept["entries"].items(), key=lambda item: (item[1]["size"][1], item[1]["samples"], item[0])):
        row = [f"`{name}`" + (" (held back)" if entry["held_back"] else ""), str(entry["size"][1]), str(entry["samples"]),
               str(entry["judged"][1] - entry["judged"][0] + 1), str(entry["blocks"]), number(entry["reference_noise"])]
        for method in methods:
            figures = entry["methods"][method]
            error = figures["rmse"]
            if method == kept["baseline"]:
                row.append(with_interval(error))
            else:
                row.append("-" if error is None else f"{number(error[0])} {mark(figures['ratio']['rmse'])}")
        rows.append(row)
    return table(["sequence", "lines", "samples", "frames", "squares", "noise of reference", *(f"`{m}`" for m in methods)], rows)


def splits_table(kept, split):
    """Means over the sequences of the share and the error of each class, and what is better than the baseline there."""
    rows = []
    for name in next(iter(kept["entries"].values()))["splits"][split]:
        parts = {n: e["splits"][split][name] for n, e in kept["entries"].items()}
        share = sum(p["share"] for p in parts.values()) / len(parts)
        errors = [p["rmse"][kept["baseline"]] for p in parts.values() if p["rmse"][kept["baseline"]] is not None]
        ahead = {}
        for entry, part in parts.items():
            for method, ratio in part["ratio"].items():
                if verdict(ratio) == "better" and method not in kept_variants(kept):
                    ahead.setdefault(method, []).append(f"`{entry}` {ratio[0]:.2f}")
        better = "; ".join(f"`{m}`: {', '.join(e)}" for m, e in ahead.items())
        rows.append([name, f"{100 * share:.0f} %", number(sum(errors) / len(errors)) if errors else "-", better or "none"])
    baseline = kept["baseline"]
    return table([SPLIT_NAMES[split], "share of pixels", f"RMSE of `{baseline}`", f"better than `{baseline}`, ratio of RMSE"], rows)


def kept_variants(kept):
    return [v.split("=", 1)[0] for v in kept["variants"]]


def shown_places(kept, count=10):
    """The worst places, each once: sequences of one scene and size that differ in samples per pixel share theirs."""
    shown = {}
    for place in kept["places"]:
        entry = kept["entries"][place["entry"]]
        shown.setdefault((entry["scene"], tuple(entry["size"]), place["frame"], place["x"], place["y"]), place)
    return list(shown.values())[:count]


def places_table(kept):
    rows = []
    for rank, place in enumerate(shown_places(kept), 1):
        other = place["best_other"]
        rows.append([str(rank), f"`{place['entry']}`", f"{place['frame']}: {place['x']}, {place['y']}", number(place["rmse"][kept["baseline"]]),
                     f"`{other}` {number(place['rmse'][other])}" if other else "-",
                     *(place[split] for split in SPLIT_NAMES)])
    return table(["", "sequence", "frame: x, y", f"RMSE of `{kept['baseline']}`", "best other method", "pixels to an edge", "noise", "age",
                  "luminance"], rows)


def lines_of(kept):
    """The heights of a run's pictures, as text."""
    return " and ".join(str(height) for height in sorted({e["size"][1] for e in kept["entries"].values()}))


def command(kept):
    """The command that makes a run's figures."""
    if kept["part"] == "figures":
        return "samples/results/figures.py"
    methods = next(iter(kept["entries"].values()))["methods"]
    variants = kept_variants(kept)
    part = f"--part {kept['part']}" if kept["part"] else f"--entries {','.join(kept['entries'])}"
    held_back = any(e["held_back"] for e in kept["entries"].values())
    return " ".join(["samples/corpus/corpus.py run --output DIR", part, *(["--held-back"] if kept["part"] and held_back else []),
                     f"--methods {','.join(m for m in methods if m not in variants)}", *(f"--variant {v}" for v in kept["variants"]),
                     *(f"--{option} {kept[option]}" for option in ("judged", "seed") if kept[option])])


def remarks_list(kept, remarks):
    found = ((rank, remarks.get(place_name(place))) for rank, place in enumerate(shown_places(kept), 1))
    return "".join(f"* **{rank}**, {remark}\n" for rank, remark in found if remark)


def page(kept, figures, overview, remarks=None):
    """figures, overview: the files with the figures and with the picture of the worst places, relative to the page. remarks: what is
    wrong at a place, by its name."""
    entries = kept["entries"]
    open_entries = {n: e for n, e in entries.items() if not e["held_back"]}
    held = {n: e for n, e in entries.items() if e["held_back"]}
    variants = "".join(f"* `{v.split('=', 1)[0]}` is `{v.split('=', 1)[1]}`.\n" for v in kept["variants"])
    parts = [f"""# Errors at {lines_of(kept)} lines

Written by `samples/results/write.py` from `{figures}`. [The manual](../docs/corpus.md) defines every column. Measured on
{kept['date']} at commit {kept['commit']} with

{indented(command(kept))}

* A ratio below 1 is better than `{kept['baseline']}`. The interval of 95 % is in brackets. **Bold**: 1 is outside the interval.
* RMSE and flicker are without the noise of the references. FLIP and SSIM contain it, alike for all methods.
{variants}"""]
    if open_entries:
        parts.append("\n## Methods\n\nGeometric means over the sequences that are not held back.\n\n" + summary_table(kept, kept["summary"], open_entries))
    if held:
        parts.append("\n## Methods, on the sequences held back\n\n" + summary_table(kept, kept["held_back_summary"], held))
    parts.append(f"\n## RMSE by sequence\n\n&lt;: better than `{kept['baseline']}` beyond the interval of the difference; &gt;: worse; "
                 "~: undecided. -: not above the noise of the reference.\n\n" + entries_table(kept))
    parts.append("\n## Where the error is\n")
    for split in SPLIT_NAMES:
        parts.append("\n" + splits_table(kept, split))
    described = remarks_list(kept, remarks or {})
    parts.append("\n## The worst places\n\nTiles of 32 x 32 pixels in the middle judged frame of each sequence. The picture shows them in "
                 "the order of the table, five in a column.\n\n" + places_table(kept) +
                 (f"\nWhat is wrong with `{kept['baseline']}` there:\n\n{described}" if described else "") +
                 f"\n![the worst places]({overview})\n")
    return "".join(parts)
