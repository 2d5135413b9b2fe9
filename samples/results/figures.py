#!/usr/bin/python3
"""The figures of README.md, from scenes of this repository alone: renders them, denoises them with all methods, scores the results,
and writes the table and the plot of the README and all pages of results.

    figures.py [--cache DIR] [--walr FILE]

Takes less than an hour on two idle cores (corpus.py list --part figures predicts it); tells what is left, and goes on where it was
interrupted. Times on a GPU are the recorded ones. Needs numpy, Pillow and matplotlib (Debian: python3-matplotlib).
samples/docs/corpus.md says how errors are made.
"""
import argparse
import json
import pathlib

import write
import corpus
import entries
import records
from corpus_page import shown_places
from figures_page import SHOWN

NAME = "540"
"""Of the record: the height of the pictures."""


def means_of(kept):
    """Means over all sequences of a run, by method and metric."""
    found = {}
    for method in next(iter(kept["entries"].values()))["methods"]:
        for metric in SHOWN:
            values = [entry["methods"][method][metric] for entry in kept["entries"].values()]
            mean = None if None in values else records.mean(value[0] for value in values)
            found.setdefault(method, {})[metric] = records.rounded(mean)
    return found


def measure(cache, walr):
    """Renders, denoises and scores what has not been done yet, and records it."""
    seconds = sum(sum(row[1:]) for row in entries.costs(entries.figures().values(), list(entries.TIMES)))
    print(f"about {seconds / 60:.0f} minutes on two idle cores, less what an earlier run has done", flush=True)
    output = pathlib.Path(cache) / "figures"
    corpus.main(["run", "--part", "figures", "--output", str(output), "--cache", str(cache), "--walr", str(walr)])
    kept = json.loads((output / "results.json").read_text(encoding="utf-8"))
    records.record_corpus(NAME, output, shown_places, {"means": means_of(kept)})


def run(description, measure):
    """Measures with the cache and the program that the command line names, and writes all pages."""
    parser = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--cache", default=corpus.default_cache(), help="folder for frames and judgements; default: %(default)s")
    parser.add_argument("--walr", type=lambda file: pathlib.Path(file).resolve(), help="the program; default: %(default)s",
                        default=entries.PROJECT / "build" / "bin" / "walr")
    arguments = parser.parse_args()
    if not arguments.walr.exists():
        parser.error(f"there is no program {arguments.walr}: build it (cmake --build build --target walr), or name one with --walr")
    measure(arguments.cache, arguments.walr)
    write.main([])


if __name__ == "__main__":
    run(__doc__, measure)
