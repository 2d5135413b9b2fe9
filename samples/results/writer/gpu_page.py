"""The page of times measured on a GPU, from what `walr gpu-report` wrote."""
from markdown_text import filled, listed, number, over, table

PAGE_SIZES = ((1920, 1080), (2560, 1440), (3840, 2160))
CONTENT = "scene"  # Paths traced, one a pixel; the report also has a synthetic content.
PASSES_OF = ("walr", "flr")
"""Methods whose passes the page lists."""


def spread(entry, decimals=4):
    return [round(entry[k], decimals) for k in ("median", "p5", "p95")]


def largest(bounds):
    """An estimate in microseconds: the largest of its bounds; None without an estimate."""
    return bounds["microseconds"] if bounds else None


def keep_gpu(data):
    """The values of a report that the page shows."""
    device, clocks = data["device"], data["clocks"]["readings"]
    kept = {"device": device["name"], "driver": device["driver"], "commit": data["commit"][:12],
            "compiler": f"{data['compiler']}, {data['build_type']}", "command": data["command"], "model": data["model"]["gpu"],
            "clocks": [[c["when"], c["core_mhz"], c["memory_mhz"]] for c in clocks],
            "validated": len(data["validation"]["methods"]), "messages": len(data["validation"]["messages"]),
            "probes": {p["name"]: {"description": p["description"], "ms": spread(p["milliseconds"]),
                                   "gb_per_s": p["bytes_per_second"] and round(p["bytes_per_second"] / 1e9, 1),
                                   "fetches": p["fetches_per_second"] and round(p["fetches_per_second"] / 1e9, 1),
                                   "ns": p["seconds_per_fetch"] and round(p["seconds_per_fetch"] * 1e9)}
                       for p in data["bandwidth"]["probes"]},
            "methods": {}}
    for times in data["times"]:
        size = f"{times['width']} x {times['height']}"
        if times["content"] != CONTENT:
            continue
        kept["content"] = times["description"]
        for method in times["methods"]:
            entry = kept["methods"].setdefault(method["variant"], {"sizes": {}, "agreement": []})
            if method["why_not"]:
                entry["sizes"][size] = {"why_not": method["why_not"]}
                continue
            passes = [{"name": p["name"], "ms": round(p["milliseconds"]["median"], 4), "mb": round(p["bytes"] / 1e6, 1),
                       "us": [largest(p[k]) and round(largest(p[k]), 1) for k in ("estimate", "attainable_estimate")]}
                      for p in method["passes"]]
            estimate = method["estimated_microseconds"]
            entry["sizes"][size] = {"ms": spread(method["milliseconds"]), "us": estimate and round(estimate, 2),
                                    "mb": round(sum(p["mb"] for p in passes), 1)}
            if method["variant"] in PASSES_OF:
                entry["sizes"][size]["passes"] = passes
    for result in data["results"]["agreements"]:
        agreement = [result["sequence"], result["rmse"], result["reference_rmse"], result["rms_difference"], result["suspicious"]]
        kept["methods"][result["variant"]]["agreement"].append(agreement)
    return kept


def milliseconds(kept, method, size="{} x {}".format(*PAGE_SIZES[0])):
    """Median time of a method's frame at a size; None if it was not measured."""
    times = kept["methods"].get(method, {"sizes": {}})["sizes"].get(size, {})
    return times["ms"][0] if "ms" in times else None


def gpu_time(kept, name):
    """Time of a frame of 1920 x 1080, in milliseconds, as text."""
    return number(milliseconds(kept, name), 2)


def gpu_term(kept):
    return f"""* **GPU time**: milliseconds of a frame of 1920 x 1080 on an {kept['device']}, by GPU timestamps, median."""


def times_table(kept):
    sizes = [f"{w} x {h}" for w, h in PAGE_SIZES]
    rows = []
    for name, method in kept["methods"].items():
        row = [f"`{name}`"]
        for size in sizes:
            times = method["sizes"].get(size, {})
            row.append("{:.3f} ({:.3f} to {:.3f})".format(*times["ms"]) if "ms" in times else "-")
        first = method["sizes"][sizes[0]]
        walr = milliseconds(kept, "walr", sizes[0])
        if "ms" in first:
            row += [over(first["ms"][0], walr), over(first["mb"], first["ms"][0], 0), over(1e3 * first["ms"][0], first["us"])]
        else:
            row += ["-"] * 3
        rows.append(row)
    return table(["method", *(f"{s}, ms" for s in sizes), "over `walr`", "plan's GB/s", "measured over estimate"], rows)


def refusals(kept):
    """Why methods have no time at a size."""
    return "".join(f"* `{name}` has no time at {size}: {times['why_not']}.\n"
                   for name, method in kept["methods"].items() for size, times in method["sizes"].items() if "why_not" in times)


def passes_table(kept, method):
    sizes = [f"{w} x {h}" for w, h in PAGE_SIZES]
    named = {}
    for size in sizes:
        for p in kept["methods"][method]["sizes"][size].get("passes", []):
            named.setdefault(p["name"], {})[size] = p
    # The last size has all passes: larger pictures have more iterations.
    order = [p["name"] for p in kept["methods"][method]["sizes"][sizes[-1]]["passes"]]
    rows = []
    for name in order:
        entry = named[name]
        first = entry.get(sizes[0])
        row = [name, *(f"{1e3 * entry[s]['ms']:.1f}" if s in entry else "-" for s in sizes)]
        if first:
            row += [f"{first['mb']:.1f}", over(first["mb"], first["ms"], 0), over(1e3 * first["ms"], first["us"][1])]
        rows.append(row + ["-"] * (7 - len(row)))
    return table(["pass", *(f"{s}, us" for s in sizes), "plan's MB", "plan's GB/s", "measured over estimate"], rows)


def probes_table(kept):
    def shown(value):
        return "-" if value is None else f"{value:,}"

    rows = [[name, f"{p['ms'][0]:.3f}", shown(p["gb_per_s"]), shown(p["fetches"]), shown(p["ns"]), p["description"]]
            for name, p in kept["probes"].items()]
    return table(["probe", "ms", "GB/s", "billion fetches/s", "ns a fetch", "what it does"], rows)


def agreement_text(kept):
    """Which results differ from a processor's, and how much the others do at most."""
    found = [(f"`{name}` on the sequence '{sequence}'", rmse, difference, differs) for name, method in kept["methods"].items()
             for sequence, rmse, _, difference, differs in method["agreement"]]
    differing = [which for which, _, _, differs in found if differs]
    alike = [(difference / rmse, which) for which, rmse, difference, differs in found if not differs]
    text = (f"{len(alike)} of {len(found)} results differ from a processor's by at most a tenth of their own error in the root mean "
            "square, and are finite")
    if differing:
        text += f"; not so: {listed(differing)}"
    if alike:
        share, most = max(alike)
        text += f". Of these, that of {most} differs most, by {100 * share:.1f} % of its error"
    return filled(text + ".")


def page(kept):
    rates = sorted({f"{core:.0f} and {memory:.0f}" for _, core, memory in kept["clocks"]})
    clocks = f"{'; '.join(rates)} in {len(kept['clocks'])} readings before, between and after the measurements"
    messages = "no message" if kept["messages"] == 0 else f"{kept['messages']} messages"
    passes = "".join(f"## Passes of `{method}`\n\n{passes_table(kept, method)}\n" for method in PASSES_OF)
    return f"""# Times on a GPU

Written by `samples/results/write.py` from `data/gpu.json`. Measured with [`walr gpu-report`](../docs/gpu-report.md) on
{kept['device']}, driver {kept['driver']}; commit {kept['commit']} ({kept['compiler']}):

    {kept['command']}

Clock rates of core and memory in MHz, by nvidia-smi: {clocks}.
All {kept['validated']} methods and presets ran under the Khronos validation layer with synchronization validation: {messages}.

## Methods

Frames: {kept['content']}. Median, and in brackets the 5 % and 95 % quantile.

{times_table(kept)}
* **Over `walr`**, **plan's GB/s** and **measured over estimate** are those at the first size.
* **Plan's GB/s**: bytes of the plan, each texel once a pass, over the measured time.
* **Estimate**: that of the static model (see `tests/costs/README.md`), at peak rates; {kept['model']}.
{refusals(kept)}
What was tried to make `walr` faster here, and what it gained: [what we learnt](../../passes/LEARNT.md#speed-and-checks-on-gpus).

{passes}The estimates of passes are those at measured rates of memory and fetches.

## Memory and texture units

A buffer and a texture of 256 MiB.

{probes_table(kept)}
## Results

The last frame of short sequences of 192 x 108 pixels, after the tone map x / (1 + x), is compared with the known truth and with the same
frame from a processor, computed by Mesa's lavapipe.

{agreement_text(kept)}"""
