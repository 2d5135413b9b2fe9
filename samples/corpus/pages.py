"""The page of a run, from its figures."""
import json

import results

METRIC_NAMES = {"rmse": "RMSE", "ssim": "1 - SSIM", "flip": "FLIP", "flicker": "flicker"}
SPLIT_NAMES = {"edge": "pixels to the nearest geometric edge", "noise": "noise of the input", "age": "age of the surface, frames",
               "darkness": "luminance"}


def as_text(kept):
    """JSON with one line per entry, place and method, so that differences between versions are readable."""
    parts = []
    for name, part in kept.items():
        if isinstance(part, dict):
            inner = ",\n".join(f"  {json.dumps(k)}: {json.dumps(v, separators=(',', ':'))}" for k, v in part.items())
            parts.append(f" {json.dumps(name)}: {{\n{inner}\n }}" if inner else f" {json.dumps(name)}: {{}}")
        elif name == "places":
            inner = ",\n".join(f"  {json.dumps(v, separators=(',', ':'))}" for v in part)
            parts.append(f" {json.dumps(name)}: [\n{inner}\n ]")
        else:
            parts.append(f" {json.dumps(name)}: {json.dumps(part)}")
    return "{\n" + ",\n".join(parts) + "\n}\n"


def table(header, rows):
    lines = [header, ["---"] * len(header), *rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines) + "\n"


def small(value):
    return "-" if value is None else f"{value:.4f}".removeprefix("0")


def ratio_text(ratio):
    """A ratio with its interval; bold if 1 is outside."""
    if ratio is None:
        return "-"
    text = f"{ratio[0]:.3f} ({ratio[1]:.3f} to {ratio[2]:.3f})"
    return text if results.verdict(ratio) == "undecided" else f"**{text}**"


def mark(ratio):
    return {"better": "&lt;", "worse": "&gt;", "undecided": "~"}[results.verdict(ratio)]


def summary_table(kept, summary, entries):
    rows = []
    for method, figures in summary.items():
        verdicts = [results.verdict(e["methods"][method]["ratio"]["rmse"]) for e in entries.values()]
        counts = " / ".join(str(verdicts.count(v)) for v in ("better", "undecided", "worse"))
        rows.append([f"`{method}`", *(ratio_text(figures[m]) for m in METRIC_NAMES), counts])
    return table([f"method, against `{kept['baseline']}`", *METRIC_NAMES.values(), "better / undecided / worse by RMSE"], rows)


def entries_table(kept):
    methods = [kept["baseline"], *kept["summary"]] if kept["summary"] else [kept["baseline"], *kept["held_back_summary"]]
    rows = []
    for name, entry in sorted(kept["entries"].items(), key=lambda item: (item[1]["size"][1], item[1]["samples"], item[0])):
        row = [f"`{name}`" + (" (held back)" if entry["held_back"] else ""), str(entry["size"][1]), str(entry["samples"]),
               str(entry["judged"][1] - entry["judged"][0] + 1), str(entry["blocks"]), small(entry["reference_noise"])]
        for method in methods:
            figures = entry["methods"][method]
            error = figures["rmse"]
            if method == kept["baseline"]:
                row.append("-" if error is None else f"{small(error[0])} ({small(error[1])} to {small(error[2])})")
            else:
                row.append("-" if error is None else f"{small(error[0])} {mark(figures['ratio']['rmse'])}")
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
                if results.verdict(ratio) == "better" and method not in kept_variants(kept):
                    ahead.setdefault(method, []).append(f"`{entry}` {ratio[0]:.2f}")
        better = "; ".join(f"`{m}`: {', '.join(e)}" for m, e in ahead.items())
        rows.append([name, f"{100 * share:.0f} %", small(sum(errors) / len(errors)) if errors else "-", better or "none"])
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
    for number, place in enumerate(shown_places(kept), 1):
        other = place["best_other"]
        rows.append([str(number), f"`{place['entry']}`", f"{place['frame']}: {place['x']}, {place['y']}", small(place["rmse"][kept["baseline"]]),
                     f"`{other}` {small(place['rmse'][other])}" if other else "-",
                     *(place[split] for split in SPLIT_NAMES)])
    return table(["", "sequence", "frame: x, y", f"RMSE of `{kept['baseline']}`", "best other method", "pixels to an edge", "noise", "age",
                  "luminance"], rows)


def page(kept, figures, overview):
    """figures, overview: names of the files with the figures and with the picture of the worst places, beside the page."""
    entries = kept["entries"]
    open_entries = {n: e for n, e in entries.items() if not e["held_back"]}
    held = {n: e for n, e in entries.items() if e["held_back"]}
    variants = "".join(f"* `{v.split('=', 1)[0]}` is `{v.split('=', 1)[1]}`.\n" for v in kept["variants"])
    scope = f"the {kept['part']} part" if kept["part"] else "chosen sequences"
    parts = [f"""# Errors over the corpus

Written by `samples/corpus/corpus.py` from `{figures}`. [The manual](../docs/corpus.md) defines every column.

Measured at commit {kept['commit']}: {scope}, seed {kept['seed']}.

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
    parts.append("\n## The worst places\n\nTiles of 32 x 32 pixels in the middle judged frame of each sequence. The picture shows them in "
                 "the order of the table, five in a column.\n\n" + places_table(kept) + f"\n![the worst places]({overview})\n")
    return "".join(parts)
