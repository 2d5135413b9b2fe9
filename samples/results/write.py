#!/usr/bin/python3
"""Writes the pages of results, the tables of README.md and of the integration guide, and the plots, from the recorded figures in data/.

    write.py                        writes all of them anew
    write.py --check                fails if a page differs from what the figures give
    write.py corpus NAME FOLDER     records a run of samples/corpus/corpus.py; NAME is the height of its pictures, such as 1080
    write.py cycles FOLDER          records the comparison of methods in FOLDER/bench.json, and its pictures
    write.py gpu FOLDER             records the times in FOLDER/gpu_report.json

Each of the last three then writes everything anew. figures.py, reflections.py and samples/corpus/rates.py record what they measure
themselves. Plots need matplotlib.
Estimated GPU times, bytes and memory come from samples/estimate/shader_figures.json, which `cmake --build build --target update_costs` writes.
"""
import pathlib
import sys

sys.dont_write_bytecode = True
HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE / "writer"), str(HERE.parent / "corpus")]
import corpus_page
import cycles_page
import figures_page
import gpu_page
import index_page
import rates_page
import records
import reflections_page

PROJECT = HERE.parents[1]
README, GUIDE = PROJECT / "README.md", PROJECT / "integration" / "docs" / "advanced.md"
"""Documents with a marked part that is written here."""
BEGIN, END = (f"<!-- Written by samples/results/write.py: {place} -->\n" for place in ("begin", "end"))


def replaced(file, text):
    """A document with another marked part."""
    whole = file.read_text(encoding="utf-8")
    if whole.count(BEGIN) != 1 or whole.count(END) != 1:
        sys.exit(f"{file}: needs one line '{BEGIN.strip()}' and one '{END.strip()}' around the part that is written from the figures")
    begin, end = whole.index(BEGIN) + len(BEGIN), whole.index(END)
    return whole[:begin] + "\n" + text + "\n" + whole[end:]


def runs():
    """The recorded runs of the corpus by name."""
    return {name: records.load(f"corpus_{name}") for name in records.corpus_names()}


def first_run(kept):
    """The run behind README.md."""
    found = [run for run in kept.values() if run["part"] == "figures"]
    return found[0] if found else sys.exit("data/ holds no run of this repository's scenes: samples/results/figures.py measures them")


def documents():
    """Text of every document by its file."""
    cycles, gpu, rates, reflections = (records.load(name) for name in ("cycles", "gpu", "rates", "reflections"))
    remarks, kept = records.load("places"), runs()
    heights, first = list(kept.values()), first_run(kept)
    return {README: replaced(README, figures_page.readme_part(first, gpu)),
            GUIDE: replaced(GUIDE, rates_page.primary_hits_table(rates["ratios"])),
            HERE / "README.md": index_page.page(heights, first, cycles, gpu, rates, reflections),
            HERE / "METHODS.md": figures_page.page(first, gpu),
            HERE / "CYCLES.md": cycles_page.page(cycles, gpu),
            HERE / "GPU.md": gpu_page.page(gpu),
            HERE / "RATES.md": rates_page.page(rates),
            HERE / "REFLECTIONS.md": reflections_page.page(reflections),
            **{HERE / f"CORPUS_{name}.md": corpus_page.page(run, f"data/corpus_{name}.json", f"images/places_{name}.webp", remarks[name])
               for name, run in kept.items()}}


def wrong():
    """Reasons why the documents are not what the figures give."""
    found = [f"{path}: not what the figures give; run samples/results/write.py" for path, text in documents().items()
             if not path.exists() or path.read_text(encoding="utf-8") != text]
    for name, remarks in records.load("places").items():
        places = [records.place_name(place) for place in corpus_page.shown_places(records.load(f"corpus_{name}"))]
        found += [f"data/places.json: {place} is not among the worst places at {name} lines" for place in remarks if place not in places]
    return found


def write():
    import plots

    for path, text in documents().items():
        path.write_text(text, encoding="utf-8")
    plots.pareto(first_run(runs()), records.load("gpu"))
    plots.sizes(list(runs().values()))
    plots.rates(records.load("rates"))


def main(arguments):
    if arguments == ["--check"]:
        sys.exit("\n".join(wrong()) or 0)
    if len(arguments) == 3 and arguments[0] == "corpus":
        records.record_corpus(*arguments[1:], corpus_page.shown_places)
    elif len(arguments) == 2 and arguments[0] in ("cycles", "gpu"):
        records.record_bench(*arguments)
        if arguments[0] == "cycles":
            import plots
            plots.crops(arguments[1], "crops.png", plots.CYCLES)
    elif arguments:
        sys.exit(__doc__)
    write()


if __name__ == "__main__":
    main(sys.argv[1:])
