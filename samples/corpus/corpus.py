#!/usr/bin/python3
"""The corpus: renders sequences, runs every method on them, and tells what differs by more than chance.

    corpus.py list [--part PART]                  what belongs to the corpus, and what it costs
    corpus.py run --output DIR [--part PART]      render what is missing, run the methods, judge; resumes where it was interrupted
    corpus.py agree DIR DIR                       whether two runs rank the methods alike

samples/docs/corpus.md describes all of it; samples/results/write.py records a run in the project. Needs numpy and Pillow, which come with Debian's python3-matplotlib.
"""
import argparse
import datetime
import hashlib
import json
import os
import pathlib
import shutil
import subprocess
import sys

sys.dont_write_bytecode = True
HERE = pathlib.Path(__file__).resolve().parent
sys.path.append(str(HERE.parent / "results" / "writer"))
import corpus_page
import entries as table
import judging
import places
import records
import rendering
import results
from PIL import Image

BASELINE = "walr"
OVERVIEW = "places.webp"


def default_cache():
    return pathlib.Path(os.environ.get("XDG_CACHE_HOME") or pathlib.Path.home() / ".cache") / "walr-corpus"


def chosen(arguments):
    """The entries that a command is about."""
    known = table.figures() if arguments.part == "figures" else table.corpus()
    if arguments.entries:
        names = arguments.entries.split(",")
        unknown = [n for n in names if n not in known]
        if unknown:
            sys.exit(f"there is no entry {', '.join(unknown)}; known: {', '.join(known)}")
        found = [known[n] for n in names]
    else:
        found = [e for e in known.values() if arguments.part == "nightly" or e.part == arguments.part]
        found = [e for e in found if arguments.held_back or not e.held_back]
    missing = sorted({str(e.scene) for e in found if not e.scene.exists()})
    if missing:
        print(f"left out, because there is no file: {', '.join(missing)}", file=sys.stderr)
    return [e.restricted(arguments.judged, arguments.seed) for e in found if e.scene.exists()]


def variants(arguments):
    """Names of everything that is compared, and the options of `walr bench` for it."""
    of_part = {"daily": [m for m in table.METHODS if m not in table.SLOW], "nightly": table.METHODS, "figures": list(table.TIMES)}
    methods = arguments.methods.split(",") if arguments.methods else of_part[arguments.part]
    methods = [BASELINE] + [m for m in methods if m != BASELINE]
    options = ["--methods", ",".join(methods)]
    for variant in arguments.variant:
        options += ["--variant", variant]
    return methods + [v.split("=", 1)[0] for v in arguments.variant], options


def list_entries(arguments):
    names, _ = variants(arguments)
    rows = table.costs(chosen(arguments), names)
    print(f"{'entry':26} {'size':>10} {'spp':>4} {'frames':>7} {'judged':>7} {'squares':>8} {'noisy':>7} {'refs':>7} {'bench':>7}")
    for entry, noisy, references, bench in rows:
        squares = round(entry.pixels / judging.SQUARE**2 / entry.one_square_in)
        print(f"{entry.name:26} {'x'.join(map(str, entry.size)):>10} {entry.samples:4} {'-'.join(map(str, entry.frames)):>7} "
              f"{'-'.join(map(str, entry.judged)):>7} {squares:8} {noisy:6.0f}s {references:6.0f}s {bench:6.0f}s"
              f"{'  held back' if entry.held_back else ''}")
    total = sum(sum(row[1:]) for row in rows) / 3600
    print(f"all: {total:.2f} h on two idle cores; the limit of the {arguments.part} part is {table.LIMITS[arguments.part]:.2f} h")


def run_bench(walr, sequence, output, options):
    """Runs `walr bench` without timing, and keeps every picture in `output`. options: what is compared."""
    table.run_walr(walr, "bench", "--sequences", sequence, "--output", output, *options, "--batch", "20", "--repeat", "0",
                   "--all-pictures", "--no-html")


def bench(arguments, cache, entry, options):
    """Folder with the results of `walr bench` for an entry; what has been run is not run again."""
    sequence = cache.sequence(entry)
    output = cache.folder / "bench" / sequence.name
    if output.exists() and not (output / "pictures").exists():
        shutil.rmtree(output)  # Its pictures were removed after an earlier judgement, so that the runs must be repeated.
    run_bench(arguments.walr, sequence, output, options)
    return output


def judged(arguments, cache, entry, names, options):
    """Sums over blocks, noise of the references and worst places of an entry, and whether they were in the cache."""
    sequence = cache.sequence(entry)
    files = (HERE / "judging.py", HERE / "places.py", pathlib.Path(judging.exr.__file__))
    analysis = [hashlib.sha256(file.read_bytes()).hexdigest() for file in files] + [results.UNFILTERED]
    folder = cache.folder / "judged" / f"{sequence.name}-{table.key([options, analysis], cache.program)}"
    known = (folder / "facts.json").exists()
    if not known:
        output = bench(arguments, cache, entry, options)
        pictures = output / "pictures" / sequence.name
        frames = range(entry.judged[0], entry.judged[1] + 1)
        sums, noise = judging.judge(sequence, pictures, frames, names)
        folder.mkdir(parents=True, exist_ok=True)
        results.save_sums(folder / "sums.npz", sums.values)
        rivals = [m for m in names if m in table.TIMES and m.split(":")[0] not in (BASELINE, *results.UNFILTERED)]
        found = places.worst_places(sequence, pictures, frames, names, BASELINE, rivals, 3)
        for index, (_, sheet) in enumerate(found):
            sheet.save(folder / f"place_{index}.png")
        # Under its name only when it is whole, because it tells that everything else of the judgement is there.
        unfinished = folder / "unfinished.json"
        unfinished.write_text(json.dumps({"noise": noise, "places": [place for place, _ in found]}))
        unfinished.replace(folder / "facts.json")
        if not arguments.keep_pictures:
            shutil.rmtree(output / "pictures")
    facts = json.loads((folder / "facts.json").read_text())
    return folder, results.load_sums(folder / "sums.npz"), facts, known


def commit():
    done = subprocess.run(["git", "-C", str(HERE), "describe", "--always", "--dirty", "--abbrev=12"], capture_output=True, text=True)
    return done.stdout.strip() or "unknown"


def run(arguments):
    entries, (names, options) = chosen(arguments), variants(arguments)
    if not entries:
        sys.exit("there is no entry left to run")
    cache = rendering.Cache(arguments.cache, arguments.walr)
    rendering.render_all(entries, cache, lambda text: print(text, flush=True))
    if arguments.render_only:
        return
    output = pathlib.Path(arguments.output)
    output.mkdir(parents=True, exist_ok=True)
    costs = {entry.name: row for entry, *row in table.costs(entries, names)}
    remaining = rendering.Remaining(sum(row[2] for row in costs.values()))
    part = None if arguments.entries else arguments.part
    kept = {"commit": commit(), "date": datetime.date.today().isoformat(), "baseline": BASELINE, "part": part,
            "judged": arguments.judged, "seed": arguments.seed, "variants": arguments.variant, "entries": {}, "places": []}
    all_sums = {}
    for entry in entries:
        folder, all_sums[entry.name], facts, known = judged(arguments, cache, entry, names, options)
        (remaining.skipped if known else remaining.worked)(costs[entry.name][2])
        print(f"{entry.name}: judged; {remaining.text()} left", flush=True)
        kept["entries"][entry.name] = {
            "scene": entry.scene.stem, "size": list(entry.size), "samples": entry.samples, "judged": list(entry.judged),
            "reference_samples": entry.reference_samples, "held_back": entry.held_back,
            "reference_noise": results.rounded(facts["noise"] ** 0.5),
            **results.entry_results(all_sums[entry.name], names, BASELINE)}
        for index, place in enumerate(facts["places"]):
            kept["places"].append({"entry": entry.name, "file": f"{entry.name}_{index}.png",
                                   **{k: results.rounded(v, 3) if isinstance(v, float) else v for k, v in place.items() if k != "rmse"},
                                   "rmse": {m: results.rounded(v, 3) for m, v in place["rmse"].items()}})
            shutil.copy(folder / f"place_{index}.png", output / f"{entry.name}_{index}.png")
    kept["places"].sort(key=lambda place: -place["rmse"][BASELINE])
    open_entries = [e.name for e in entries if not e.held_back]
    held = [e.name for e in entries if e.held_back]
    for name, members in (("summary", open_entries), ("held_back_summary", held)):
        kept[name] = results.summary([all_sums[n] for n in members], names, BASELINE) if members else {}
    (output / "results.json").write_text(records.as_text(kept) + "\n")
    (output / "RESULTS.md").write_text(corpus_page.page(kept, "results.json", OVERVIEW), encoding="utf-8")
    sheets = [Image.open(output / place["file"]) for place in corpus_page.shown_places(kept)]
    if sheets:
        places.overview(sheets).save(output / OVERVIEW, quality=85)
    print(f"{output}: results.json, RESULTS.md, and pictures of the worst places")


def agree(arguments):
    first, second = (json.loads((pathlib.Path(f) / "results.json").read_text()) for f in (arguments.first, arguments.second))
    for run_results in (first, second):
        order, ratios = results.ranking(run_results)
        print(", ".join("{} {:.3f} ({:.3f} to {:.3f})".format(m, *ratios[m]) for m in order))
    contradicted = results.disagreements(first, second)
    for better, worse in contradicted:
        print(f"{better} is ahead of {worse} in the first run beyond the intervals, and behind it in the second")
    if contradicted:
        sys.exit(1)
    print("the rankings are the same" if results.ranking(first)[0] == results.ranking(second)[0] else
          "the rankings differ only where intervals overlap")


def positive(text):
    number = int(text)
    if number < 1:
        raise argparse.ArgumentTypeError("must be at least 1")
    return number


def parse(arguments):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(dest="command", required=True)
    for name in ("list", "run"):
        command = commands.add_parser(name)
        command.add_argument("--part", choices=tuple(table.LIMITS), default="daily",
                             help="nightly is the whole corpus; figures are the sequences behind README.md")
        command.add_argument("--entries", help="names of entries, separated by commas, instead of a part")
        command.add_argument("--held-back", action="store_true", help="also the entries that no sweep may look at")
        command.add_argument("--methods", help="METHOD or METHOD:PRESET, separated by commas; default: all, daily without the slowest")
        command.add_argument("--variant", action="append", default=[], help="NAME=METHOD[:PRESET][,SETTING=VALUE]..., as for walr bench")
        command.add_argument("--judged", type=positive, metavar="N", help="judge only the first N frames of each sequence")
        command.add_argument("--seed", type=int, default=0, help="seed of the noisy frames; references are shared")
    command.add_argument("--output", required=True, help="folder for results.json, RESULTS.md and pictures")
    command.add_argument("--cache", default=default_cache(), help="folder for frames and judgements; default: %(default)s")
    command.add_argument("--walr", type=lambda file: pathlib.Path(file).resolve(), help="the program; default: %(default)s",
                         default=table.BUILD / "bin" / "walr")
    command.add_argument("--render-only", action="store_true", help="only render")
    command.add_argument("--keep-pictures", action="store_true", help="keep every result in the cache, about 3 GB for 1920 x 1080")
    command = commands.add_parser("agree")
    command.add_argument("first")
    command.add_argument("second")
    return parser.parse_args(arguments)


def main(arguments=None):
    parsed = parse(arguments)
    {"list": list_entries, "run": run, "agree": agree}[parsed.command](parsed)


if __name__ == "__main__":
    main()
