#!/usr/bin/python3
"""The figures of REFLECTIONS.md, from scenes of this repository alone: renders them with specular light, denoises that with all methods
that take it, scores the results by roughness, and writes the page and its picture.

    reflections.py [--cache DIR] [--walr FILE]

Takes about half an hour on two idle cores, tells what is left, and goes on where it was interrupted. Needs numpy, Pillow and
matplotlib (Debian: python3-matplotlib).
"""
import datetime
import json

import figures
import entries
import plots
import records
import rendering

LOW, HIGH = (384, 216), (960, 540)


def sequence(name, scene, size, **settings):
    """An entry whose last frames are judged: two of them in few squares where pictures are large."""
    judged, squares, samples = ((15, 19), 1, 128) if size == LOW else ((18, 19), 6 if size == HIGH else 24, 96)
    return entries.built_in(name, scene, size, judged, squares, reference_samples=samples, specular=True, **settings)


def chosen():
    return [sequence("gloss_216", "gloss", LOW), sequence("gloss_216_4", "gloss", LOW, samples=4),
            sequence("gloss_still_216", "gloss", LOW, camera="mirror"), sequence("gloss_540", "gloss", HIGH),
            sequence("gloss_1080", "gloss", entries.FULL_HD), sequence("kitchen_gloss_216", "kitchen_gloss", LOW, camera="floor"),
            sequence("kitchen_gloss_540", "kitchen_gloss", HIGH, camera="floor"), sequence("mirrors_216", "mirrors", LOW)]


def kept_of(run):
    """Figures of a run. Its errors, "clean" and by roughness, are without the noise of the references."""
    figures = {metric: records.rounded(run["mean"][metric]) for metric in records.FIGURES}
    judged = [frame for frame in run["frames"] if "clean_square" in frame]
    return {**figures, "clean": root_of_mean(frame["clean_square"] for frame in judged),
            "by_roughness": list(map(root_of_mean, zip(*(frame["clean_square_by_roughness"] for frame in judged))))}


def root_of_mean(squares):
    """None if a square is. The mean of squares without noise may be negative by chance."""
    squares = list(squares)
    return None if None in squares else records.rounded(max(records.mean(squares), 0) ** 0.5)


def record(bench, found):
    """Keeps the figures of `walr bench`. found: the entries by the names of their sequences."""
    data = json.loads((bench / "bench.json").read_text(encoding="utf-8"))
    kept = {"date": datetime.date.today().isoformat(), "commit": data["commit"][:12], "sequences": {}}
    for measured in data["sequences"]:
        entry = found[measured["name"]]
        frames = [frame for frame in measured["frames"] if frame["reference_noise"] is not None]
        kept["sequences"][entry.name] = {
            "scene": entry.scene.stem, "camera": entry.camera, "size": list(entry.size), "samples": entry.samples,
            "noise": records.rounded(records.mean(frame["reference_noise"] for frame in frames)),
            "methods": {run["variant"]: kept_of(run) for run in measured["runs"]}}
    records.save("reflections", kept, 3)


def measure(cache, walr):
    cache = rendering.Cache(cache, walr)
    rendering.render_all(chosen(), cache, lambda text: print(text, flush=True))
    found = {cache.sequence(entry).name: entry for entry in chosen()}
    bench = cache.folder / "reflections"
    print("comparing the methods; about a third of the time is left", flush=True)
    entries.run_walr(walr, "bench", "--light", "specular", "--sequences", *map(cache.sequence, chosen()), "--output", bench,
                     "--repeat", "0", "--no-html")
    record(bench, found)
    plots.crops(bench, "reflections.png", plots.REFLECTIONS, 1)


if __name__ == "__main__":
    figures.run(__doc__, measure)
