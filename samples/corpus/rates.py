#!/usr/bin/python3
"""Error against rays per pixel: renders the same frames with 1/9 to 64 rays per pixel, from one primary hit or from four,
denoises and judges them.

    rates.py [--cache DIR]    render and denoise what is missing, judge; writes samples/results/data/rates.json and all pages of results

An interrupted run resumes where it was. It traces 800 million paths, and takes about an hour of two idle cores. samples/docs/corpus.md
says how errors and intervals are made. Needs numpy, Pillow and matplotlib (Debian: python3-matplotlib)."""
import argparse
import datetime
import json
import math
import pathlib
import subprocess
import sys

sys.dont_write_bytecode = True
import corpus
import entries as table
import intervals
import judging
import numpy as np
import rate_entries
import rates_page
import records
import rendering
import results
from judging import exr

PLAIN = "plain"
"""Name of the plain alternative: walr on smaller frames, interpolated."""
METHODS = tuple(column for column in rates_page.COLUMNS if column != PLAIN)
CYCLES = [table.SHARED / "sequences" / name for name in ("sponza", "cornell_fence")]
FRAMES = range(rate_entries.JUDGED[0], rate_entries.JUDGED[1] + 1)


def results_folder(cache, entry):
    """The folder for what this program makes of an entry. Another program's results are not taken for its own."""
    return cache.folder / "rates" / f"{cache.sequence(entry).name}-{cache.program[:16]}"


def bench(walr, cache, entry, methods):
    """Folder with the results of `walr bench`; what has been run is not run again."""
    sequence = cache.sequence(entry)
    output = results_folder(cache, entry)
    pictures = output / "pictures" / sequence.name
    if all((pictures / f"{m}_{frame:04d}.npy").exists() for m in methods for frame in FRAMES):
        return pictures
    corpus.run_bench(walr, sequence, output, ["--methods", ",".join(methods)])
    return pictures


def interpolated(small, small_guides, guides, side):
    """A picture of full size from one that is smaller by `side`: of the 16 nearest pixels those on the same plane, by distance,
    depth and normal. Guides: (depth, normal)."""
    depth, normal = guides
    rows, columns = np.mgrid[:depth.shape[0], :depth.shape[1]]
    y, x = ((n + 0.5) / side - 0.5 for n in (rows, columns))
    top, left = np.floor(y).astype(int), np.floor(x).astype(int)
    total, weights = 0.0, 1e-12
    for dy in range(-1, 3):
        for dx in range(-1, 3):
            place = np.clip(top + dy, 0, small.shape[0] - 1), np.clip(left + dx, 0, small.shape[1] - 1)
            near = np.clip(1 - np.abs(top + dy - y), 0.001, 1) * np.clip(1 - np.abs(left + dx - x), 0.001, 1)
            cosine = np.clip((small_guides[1][place] * normal).sum(axis=2), 0, 1)
            weight = near * cosine**16 * np.exp(-50 * np.abs(small_guides[0][place] / depth - 1)) + 1e-9 * near
            total, weights = total + weight[:, :, None] * small[place], weights + weight
    return total / weights[:, :, None]


def denoised(walr, sequence, output, options):
    """Results of `walr denoise` by frame; what has been denoised is not denoised again."""
    files = {frame: output / f"denoised_{frame:04d}.exr" for frame in FRAMES}
    if not all(file.exists() for file in files.values()):
        table.run_walr(walr, "denoise", sequence, "--output", output, *options)
    return {frame: exr.layer(exr.read(file), "Indirect") for frame, file in files.items()}


def plain_pictures(walr, cache, entry, side, full):
    """Results of the plain alternative by frame. full: the sequence with guides of full size."""
    sequence = cache.sequence(entry)
    lights = denoised(walr, sequence, results_folder(cache, entry), [])
    pictures = {}
    for frame in FRAMES:
        small, large = (exr.read(folder / f"noisy_{frame:04d}.exr") for folder in (sequence, full))
        guides = [(images["Depth.Z"].astype(float), exr.layer(images, "Normal", "XYZ")) for images in (small, large)]
        pictures[frame] = interpolated(lights[frame], *guides, side)
    return pictures


def fine_pictures(walr, cache, entry, method):
    """Results on frames of twice the size, averaged over 2 x 2 pixels, by frame. method: METHOD or METHOD:PRESET."""
    name, _, preset = method.partition(":")
    return denoised(walr, cache.sequence(entry), results_folder(cache, entry) / method.replace(":", "_"),
                    ["--average", "2", "--method", name, *(["--preset", preset] if preset else [])])


class Squares:
    """Squared errors and numbers of judged pixels of every square of the image, over the judged frames."""

    def __init__(self, sequence, pictures):
        self.truths = {frame: judging.frame_truth(sequence, pictures, frame) for frame in FRAMES}
        self.blocks, self.count = judging.block_of_pixels(self.truths[FRAMES[0]].judged.shape)

    def sums(self, image_of, error=judging.clean_square):
        squares, pixels = np.zeros(self.count), np.zeros(self.count)
        for frame, truth in self.truths.items():
            square = error(image_of(frame), truth.reference, truth.half)
            squares += np.bincount(self.blocks[truth.judged], square[truth.judged], minlength=self.count)
            pixels += np.bincount(self.blocks[truth.judged], minlength=self.count)
        return squares, pixels

    def noise(self):
        def square(_, reference, half):
            return (judging.half_noise(reference, half) ** 2).mean(axis=2)

        squares, pixels = self.sums(lambda frame: None, square)
        return math.sqrt(squares.sum() / pixels.sum())


def judged(walr, cache, scene, log):
    """Sums of squares by rate and method, and the noise of the references, of what has been rendered. None without the sequence of
    1 ray, which the others are compared with."""
    found, plain, fine = ({rate: e for rate, e in kind.items() if cache.complete(e)} for kind in rate_entries.of_scene(scene))
    if "1" not in found:
        return None
    full = cache.sequence(found["1"])
    squares, sums = None, {}
    for rate, entry in sorted(found.items(), key=lambda item: item[0] != "1"):
        methods = METHODS if rate_entries.rays(rate) >= 1 else rate_entries.TAKE_SPARSE
        pictures = bench(walr, cache, entry, methods)
        squares = squares or Squares(full, pictures)
        sums[rate] = {m: squares.sums(lambda frame: np.load(pictures / f"{m}_{frame:04d}.npy").astype(float)) for m in methods}
        log(f"{scene}: {rate} judged")
    for rate, entry in ((rate, e) for rate, e in plain.items() if rate in sums):
        pictures = plain_pictures(walr, cache, entry, rate_entries.PLAIN[rate], full)
        sums[rate][PLAIN] = squares.sums(lambda frame: pictures[frame])
    for rate, entry in fine.items():
        sums[rate] = {}
        for method in rate_entries.FINE_METHODS if entry.light_rate == "1" else rate_entries.TAKE_SPARSE:
            pictures = fine_pictures(walr, cache, entry, method)
            sums[rate][method] = squares.sums(lambda frame: pictures[frame])
        log(f"{scene}: {rate} judged")
    return sums, squares.noise()


def clean_rmse(mean):
    """RMSE without the noise of the references, from the means of `walr denoise --json`. Nothing is taken off where it is unknown."""
    return math.sqrt(max(mean["rmse"] ** 2 - (mean["reference_noise"] or 0.0) ** 2, 0.0))


def cycles_errors(walr, output, log):
    """RMSE of sequences of Cycles by sequence, rate and method, after the fourth frame: all samples, and a share of them
    (`walr denoise --light-rate`). Sequences that are absent are left out."""
    found = {}
    for sequence in (s for s in CYCLES if s.exists()):
        for rate in ("1", *rate_entries.SPARSE):
            for method in rate_entries.TAKE_SPARSE:
                report = output / "report.json"
                table.run_walr(walr, "denoise", sequence, "--output", output / "denoised", "--method", method, "--light-rate", rate,
                               "--json", report)
                error = clean_rmse(json.loads(report.read_text())["mean_after_4"])
                found.setdefault(sequence.name, {}).setdefault(rate, {})[method] = results.rounded(error)
            log(f"{sequence.name} of Cycles: {rate} judged")
    return found


def figures(all_sums):
    """RMSE by scene, rate and method, and the ratio to walr at 1 ray with its interval, over all scenes with that rate."""

    def root(interval):
        return interval and [results.rounded(math.exp(0.5 * v)) for v in interval]

    scenes = {scene: {rate: {m: (root(intervals.log_ratio_interval([p])) or [None])[0] for m, p in methods.items()}
                      for rate, methods in sums.items()} for scene, sums in all_sums.items()}
    ratios = {}
    for rate in rates_page.order({rate for sums in all_sums.values() for rate in sums}):
        having = [sums for sums in all_sums.values() if rate in sums]
        ratios[rate] = {"scenes": len(having)}
        for method in (m for m in having[0][rate] if all(m in sums[rate] for sums in having)):
            pairs = [(sums[rate][method][0], sums["1"]["walr"][0]) for sums in having]
            ratios[rate][method] = root(intervals.log_ratio_interval(pairs))
    return scenes, ratios


def run(arguments):
    cache = rendering.Cache(arguments.cache, arguments.walr)
    groups = [rate_entries.of_scene(scene) for scene in rate_entries.SCENES]
    wanted = [e for kinds in groups for entries in kinds for e in entries.values()]
    for scene in sorted({e.scene for e in wanted if not e.scene.exists()}):
        print(f"left out, because there is no file: {scene}", file=sys.stderr)
    wanted = [e for e in wanted if e.scene.exists()]
    if not arguments.rendered_only:
        rendering.render_all(sorted(wanted, key=lambda e: e.samples), cache, lambda text: print(text, flush=True))
    all_sums, noise = {}, {}
    for scene in rate_entries.SCENES:
        if found := judged(arguments.walr, cache, scene, lambda text: print(text, flush=True)):
            all_sums[scene], noise[scene] = found
        else:
            print(f"{scene}: left out, because its sequence of 1 ray has not been rendered", file=sys.stderr)
    if not all_sums:
        sys.exit("no scene has been rendered at 1 ray, so there is nothing to compare with")
    scenes, ratios = figures(all_sums)
    cycles = cycles_errors(arguments.walr, cache.folder / "rates", lambda text: print(text, flush=True))
    records.save("rates", {"date": datetime.date.today().isoformat(), "commit": corpus.commit(),
                           "noise": {s: results.rounded(n) for s, n in noise.items()}, "scenes": scenes, "ratios": ratios,
                           "cycles": cycles})
    subprocess.run([sys.executable, records.RESULTS / "write.py"], check=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--cache", default=corpus.default_cache(), help="folder for frames and results; default: %(default)s")
    parser.add_argument("--walr", type=lambda file: pathlib.Path(file).resolve(), help="the program; default: %(default)s",
                        default=table.BUILD / "bin" / "walr")
    parser.add_argument("--rendered-only", action="store_true", help="judge what has been rendered, and leave out the rest")
    run(parser.parse_args())


if __name__ == "__main__":
    main()
