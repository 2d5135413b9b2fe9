"""The first page of the results: what was measured, and the answers that readers look for first."""
import corpus_page
import figures_page
import gpu_page
from entries import BUILT_IN
from markdown_text import filled, indented, listed, number, table, verdict, with_interval

SHOWN = ("flr", "svgf", "bmfr", "walr_paper", "none")
"""Methods beside `walr` in the table of errors."""
RATES = ("1/9", "1/4", "1", "4", "64")
"""Rows of the table of rays per pixel."""


def errors_section(kept):
    """Errors of one run of the corpus, as an answer to a question."""
    lines = corpus_page.lines_of(kept)
    entries = {n: e for n, e in kept["entries"].items() if e["samples"] == 1}
    errors = {n: e["methods"]["walr"]["rmse"][0] for n, e in entries.items()}
    best, worst = min(errors, key=errors.get), max(errors, key=errors.get)
    gains = [e["methods"]["none"]["rmse"][0] / errors[n] for n, e in entries.items()]
    rows = [[f"`{n}`", with_interval(e["methods"]["walr"]["rmse"]), *(number(e["methods"][m]["rmse"][0]) for m in SHOWN)]
            for n, e in sorted(entries.items())]
    answer = filled(f"The RMSE of `walr` lies between {number(errors[best])} (`{best}`) and {number(errors[worst])} (`{worst}`) at one sample "
                    f"per pixel, {min(gains):.0f} to {max(gains):.0f} times below that of the input. It is taken after the tone map "
                    f"x / (1 + x), so that the range is 0 to 1; brackets hold intervals of 95 %. [All figures](CORPUS_{lines}.md).")
    absent = [f"`{n}`" for n, e in sorted(entries.items()) if not (BUILT_IN / f"{e['scene']}.gltf").exists()]
    note = "\n" + filled(f"The scenes of {listed(absent)} are not in this repository.") if absent else ""
    return (f"## What is the error at {lines} lines?\n\n{answer}\n" +
            table(["sequence", "`walr`", *("input" if m == "none" else f"`{m}`" for m in SHOWN)], rows) + note)


def leads(records):
    """Where a method errs less than the baseline, beyond the interval of their ratio."""
    return [f"`{method}` on `{name}` by {100 * (1 - figures['ratio']['rmse'][0]):.0f} %" for kept in records
            for name, entry in kept["entries"].items() for method, figures in entry["methods"].items()
            if method not in corpus_page.kept_variants(kept) and verdict(figures.get("ratio", {}).get("rmse")) == "better"]


def sizes_section(records):
    ahead = leads(records)
    behind = f"Ahead of `walr` beyond the interval: {listed(ahead)}." if ahead else "None is ahead of `walr` beyond the interval of a sequence."
    pages = listed(f"[{lines}](CORPUS_{lines}.md)" for lines in map(corpus_page.lines_of, records))
    ratios = listed(f"`{method}` {kept['summary'][method]['rmse'][0]:.2f} at {corpus_page.lines_of(kept)} lines"
                    for kept in records for method in ("svgf", "walr_paper"))
    return ("## Does that hold for other sizes, scenes and numbers of samples?\n\n" +
            filled(f"The error of other methods over that of `walr`, in the geometric mean of a size's sequences: {ratios}. "
                   f"{behind} Every sequence, and those held back, by lines: {pages}; by rays per pixel, at 216 lines: [rates](RATES.md).") + "\n![RMSE by sequence](images/sizes.png)\n")


def speed_section(first, gpu):
    return ("## How long does a frame take, and what does the time buy?\n\n" +
            filled(f"`walr` takes {gpu_page.gpu_time(gpu, 'walr')} ms for a frame of 1920 x 1080 on an {gpu['device']}. "
                   f"[Times by size and pass](GPU.md). The errors of the plot are those on "
                   f"{figures_page.frames_text(first)}. [All methods on them](METHODS.md).") +
            "\n![RMSE against GPU time](images/pareto.png)\n")


def rates_section(rates):
    rows = [[rate, *("-" if not rates["ratios"][rate].get(m) else f"{rates['ratios'][rate][m][0]:.2f}" for m in ("walr", "flr", "bmfr"))]
            for rate in RATES]
    return ("## What do more or fewer rays per pixel change?\n\n" +
            filled("RMSE as a ratio to that of `walr` with one ray per pixel, over four scenes of 384 x 216 pixels. "
                   "[All methods and rates](RATES.md).") + "\n" +
            table(["rays per pixel", "`walr`", "`flr`", "`bmfr`"], rows) + "\n![RMSE against rays per pixel](images/rates.png)\n")


def measured_section(records, cycles, gpu, rates, reflections):
    """What was measured, when, at which commit, and the commands."""
    runs = [(f"[errors at {corpus_page.lines_of(k)} lines](CORPUS_{corpus_page.lines_of(k)}.md)",
             f"{len(k['entries'])} sequences of `walr render`", k, corpus_page.command(k)) for k in records]
    runs += [("[errors of reflections](REFLECTIONS.md)", f"{len(reflections['sequences'])} sequences of `walr render`", reflections,
              "samples/results/reflections.py"),
             ("[errors by rays per pixel](RATES.md)", f"{len(rates['scenes'])} scenes at 216 lines, 1/9 to 64 rays", rates,
              "samples/corpus/rates.py"),
             ("[methods on frames of Cycles](CYCLES.md)", f"{len(cycles['noise'])} sequences at 216 lines, not in this repository", cycles,
              cycles["command"]),
             ("[times on a GPU](GPU.md)", gpu["device"], gpu, gpu["command"])]
    return ("## What was measured\n\n" +
            table(["page", "what", "day", "commit"], [[page, what, kept["date"], kept["commit"]] for page, what, kept, _ in runs]) +
            "\n" + filled("[Speed against error](METHODS.md) and the table of the README show the run at 540 lines. "
                          "All are errors of today's defaults: a change of a default measures again, or removes, what is here. The commands, in the order of the "
                          "table:") + "\n" +
            "\n\n".join(indented(command) for *_, command in runs) + "\n")


def page(records, first, cycles, gpu, rates, reflections):
    """records: the runs of the corpus, by height. first: the one behind README.md."""
    return ("# Results\n\n" + filled("Written by `samples/results/write.py` from the figures in `data/`. What each method does: "
                                     "[passes](../../passes/README.md). How errors are made: [corpus](../docs/corpus.md) and "
                                     "[bench](../docs/bench.md). What was tried: [what we learnt](../../passes/LEARNT.md).") + "\n" +
            "\n".join([errors_section(records[-1]), sizes_section(records), speed_section(first, gpu), rates_section(rates),
                       measured_section(records, cycles, gpu, rates, reflections)]))
