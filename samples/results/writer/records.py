"""The recorded figures in samples/results/data: what of each measurement is kept, and its files."""
import datetime
import json
import pathlib
import re

from gpu_page import keep_gpu
from markdown_text import verdict

RESULTS = pathlib.Path(__file__).resolve().parents[1]
DATA = RESULTS / "data"
IMAGES = RESULTS / "images"
FIGURES = ("rmse", "ssim", "flip", "flicker")
RESPONSES = ("first_frame_rmse", "settled_rmse", "settled_flicker", "light_frames", "light_lag", "recovery_frames")


def mean(values):
    values = list(values)
    return sum(values) / len(values)


def rounded(value, decimals=6):
    return value if value is None else round(value, decimals)


# Files.

def as_text(value, depth=2, indent=1):
    """JSON with a line for every member down to a depth, so that differences between versions are readable."""
    def lines(members, brackets):
        return brackets[0] + "\n" + ",\n".join(" " * indent + member for member in members) + "\n" + " " * (indent - 1) + brackets[1]

    if depth and isinstance(value, dict) and value:
        return lines((f"{json.dumps(k)}: {as_text(v, depth - 1, indent + 1)}" for k, v in value.items()), "{}")
    if depth and isinstance(value, list) and value and isinstance(value[0], dict):
        return lines((as_text(v, 0) for v in value), "[]")
    return json.dumps(value, separators=(",", ":"))


def load(name):
    return json.loads((DATA / f"{name}.json").read_text(encoding="utf-8"))


def save(name, kept, depth=2):
    (DATA / f"{name}.json").write_text(as_text(kept, depth) + "\n", encoding="utf-8")


def corpus_names():
    """The names of the recorded runs of the corpus, by the height of their pictures."""
    return sorted((file.stem.removeprefix("corpus_") for file in DATA.glob("corpus_*.json")),
                  key=lambda name: (int("0" + re.sub(r"\D.*", "", name)), name))


def day_of(file):
    """The day on which a measurement was written."""
    return datetime.date.fromtimestamp(file.stat().st_mtime).isoformat()


# What is kept of `walr bench` and `walr gpu-report`.

def keep_methods(data):
    """The values of a comparison of methods that the pages show."""
    # Where the sequences lay does not belong to the command.
    command = re.sub(r"(--sequences )\S*/", r"\1SEQUENCES/", data["command"])
    kept = {"commit": data["commit"][:12], "compiler": f"{data['compiler']}, {data['build_type']}", "command": command,
            "device": data["device"]["name"], "driver": data["device"]["driver"], "software": data["device"]["software"],
            "noise": {}, "methods": {}}
    for variant in data["variants"]:
        kept["methods"][variant["name"]] = {"sequences": {}}
    for sequence in data["sequences"]:
        noise = [f["reference_noise"] for f in sequence["frames"]]
        kept["noise"][sequence["name"]] = None if None in noise else rounded(mean(noise))
        for run in sequence["runs"]:
            if run["variant"] in kept["methods"]:
                figures = {m: rounded(run["mean_after_4"][m]) for m in FIGURES}
                figures["time"] = run["ratio"] and [rounded(run["ratio"][k], 3) for k in ("median", "p5", "p95")]
                kept["methods"][run["variant"]]["sequences"][sequence["name"]] = figures
    for response in data["responses"]:
        if response["variant"] in kept["methods"]:
            kept["methods"][response["variant"]]["response"] = {**{k: rounded(response[k]) for k in RESPONSES},
                                                                "trail": rounded(response["trail_by_age"][0])}
    return kept


def record_bench(name, folder):
    """Takes a measurement of these programs from its folder. name: cycles or gpu."""
    file = pathlib.Path(folder) / ("gpu_report.json" if name == "gpu" else "bench.json")
    data = json.loads(file.read_text(encoding="utf-8"))
    save(name, {"date": day_of(file), **(keep_gpu if name == "gpu" else keep_methods)(data)})


# What is kept of runs of the corpus.

def keep_corpus(kept):
    """The figures of a run that the pages show."""
    baseline = kept["baseline"]

    def of_method(figures):
        ratio = figures.get("ratio")
        return {"rmse": figures["rmse"], **({"ratio": {"rmse": ratio["rmse"]}} if ratio else {})}

    def of_class(part):
        return {"share": part["share"], "rmse": {baseline: part["rmse"][baseline]},
                "ratio": {m: r for m, r in part["ratio"].items() if verdict(r) == "better"}}

    entries = {name: {**entry, "methods": {m: of_method(f) for m, f in entry["methods"].items()},
                      "splits": {s: {c: of_class(p) for c, p in classes.items()} for s, classes in entry["splits"].items()}}
               for name, entry in kept["entries"].items()}
    places = []
    for place in kept["places"]:
        shown = {baseline, place["best_other"]} - {None}
        places.append({**{k: v for k, v in place.items() if k != "file"}, "rmse": {m: v for m, v in place["rmse"].items() if m in shown}})
    return {**kept, "entries": entries, "places": places}


def place_name(place):
    return f"{place['entry']} {place['frame']}: {place['x']}, {place['y']}"


def record_corpus(name, folder, shown_places, more=None):
    """Takes a run of the corpus from its folder, with the picture of its worst places. Remarks on places that are no longer among
    the worst are removed. more: further figures to keep."""
    kept = {**keep_corpus(json.loads((pathlib.Path(folder) / "results.json").read_text(encoding="utf-8"))), **(more or {})}
    save(f"corpus_{name}", kept)
    (IMAGES / f"places_{name}.webp").write_bytes((pathlib.Path(folder) / "places.webp").read_bytes())
    remarks, shown = load("places"), [place_name(p) for p in shown_places(kept)]
    remarks[name] = {place: remark for place, remark in remarks.get(name, {}).items() if place in shown}
    save("places", remarks)
    for place in shown:
        if place not in remarks[name]:
            print(f"data/places.json says nothing of {place}: look at images/places_{name}.webp and describe it")
