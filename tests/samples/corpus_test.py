#!/usr/bin/python3
"""Tests of samples/corpus: corpus_test.py WALR [unittest options], where WALR is the built program."""
import contextlib
import dataclasses
import io
import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest
from unittest import mock

import numpy as np

WALR = pathlib.Path(sys.argv.pop(1)).resolve()
os.environ["WALR_BUILD"] = str(WALR.parents[1])
sys.dont_write_bytecode = True
sys.path[:0] = [str(pathlib.Path(__file__).resolve().parents[2] / "samples" / folder) for folder in ("corpus", "results")]
import corpus
import corpus_page
import entries
import figures
import index_page
import intervals
import judging
import places
import rate_entries
import rates
import rates_page
import records
import rendering
import results
from markdown_text import verdict

TINY = entries.Entry("tiny", entries.BUILT_IN / "stair.gltf", (64, 36), (2, 4), 1, reference_samples=4, part="daily")


class Table(unittest.TestCase):
    def test_parts_fit_their_time(self):
        for part, held_back in (("daily", False), ("nightly", True), ("figures", False)):
            known = entries.figures() if part == "figures" else entries.corpus()
            chosen = [e for e in known.values() if part == "nightly" or e.part == part]
            methods = {"daily": [m for m in entries.METHODS if m not in entries.SLOW], "nightly": entries.METHODS,
                       "figures": entries.TIMES}[part]
            self.assertTrue(chosen)
            seconds = sum(sum(row[1:]) for row in entries.costs(chosen, methods))
            self.assertLess(seconds / 3600, entries.LIMITS[part], part)
            self.assertEqual(any(e.held_back for e in chosen), held_back)

    def test_covers_what_the_corpus_promises(self):
        every = list(entries.corpus().values())
        self.assertEqual({e.size for e in every}, {(640, 360), (960, 540), (1920, 1080)})
        self.assertEqual({e.samples for e in every}, {1, 4, 16})
        for entry in every:
            self.assertEqual(entry.reference_samples % 2, 0, "halves need an even number of samples")
            if entry.part == "nightly":
                self.assertGreaterEqual(entry.judged[1] - entry.judged[0] + 1, 8, entry.name)
        share = sum(e.held_back for e in every) / len(every)
        self.assertTrue(0.3 < share < 0.37, share)

    def test_the_figures_need_no_file_from_elsewhere(self):
        every = entries.figures().values()
        for entry in every:
            self.assertEqual((entry.scene.parent, entry.size, entry.samples, entry.held_back), (entries.BUILT_IN, (960, 540), 1, False))
            self.assertTrue(entry.scene.exists(), entry.scene)

        def pictures(entry):
            return {(entry.scene, entry.camera, entry.size, frame) for frame in range(entry.judged[0], entry.judged[1] + 1)}

        held_back = set().union(*(pictures(e) for e in entries.corpus().values() if e.held_back))
        self.assertEqual(held_back & set().union(*map(pictures, every)), set())

    def test_a_first_look_judges_fewer_frames_of_the_same_noise(self):
        entry = dataclasses.replace(TINY, judged=(12, 19))
        self.assertEqual((entry.restricted(4, 0).judged, entry.restricted(4, 0).frames), ((12, 15), (4, 15)))
        self.assertEqual(entry.restricted(99, 3), dataclasses.replace(entry, seed=3))
        self.assertEqual(entry.restricted(None, 0), entry)
        with self.assertRaises(SystemExit), contextlib.redirect_stderr(io.StringIO()):
            corpus.main(["list", "--judged", "0"])

    def test_costs_are_those_of_the_settings(self):
        # 4 frames of 100 x 10 pixels with 3 samples and a G-buffer; 2 references of 8 samples in a fifth of the pixels.
        entry = entries.Entry("e", TINY.scene, (100, 10), (2, 3), 5, samples=3, reference_samples=8)
        self.assertEqual(entry.noisy_paths(), 4 * 1000 * 4)
        self.assertEqual(entry.reference_paths(), 2 * 200 * 8)
        again = dataclasses.replace(entry, name="f", samples=16)
        rows = entries.costs([entry, again], ["walr"])
        self.assertAlmostEqual(rows[0][1] * entries.PATHS_PER_SECOND, 16000)
        self.assertAlmostEqual(rows[0][2] * entries.PATHS_PER_SECOND, 3200)
        self.assertEqual(rows[1][2], 0.0, "the references are those of the first entry")

    def test_the_key_changes_with_what_pixels_depend_on_and_with_nothing_else(self):
        settings = TINY.settings()
        known = entries.key(settings, "version")
        self.assertEqual(known, entries.key(dict(reversed(settings.items())), "version"))
        self.assertNotEqual(known, entries.key(settings, "other version"))
        other = {"size": (65, 36), "judged": (2, 5), "one_square_in": 2, "samples": 2, "reference_samples": 8, "camera": "x", "seed": 1}
        for name, value in other.items():
            self.assertNotEqual(known, entries.key(dataclasses.replace(TINY, **{name: value}).settings(), "version"), name)
        for name, value in {"name": "another", "part": "nightly", "held_back": True}.items():
            self.assertEqual(known, entries.key(dataclasses.replace(TINY, **{name: value}).settings(), "version"), name)
        with tempfile.TemporaryDirectory() as folder:
            scene = pathlib.Path(folder) / TINY.scene.name
            scene.write_bytes(TINY.scene.read_bytes() + b" ")
            self.assertNotEqual(known, entries.key(dataclasses.replace(TINY, scene=scene).settings(), "version"))
        more = dataclasses.replace(TINY, samples=4, seed=3)
        self.assertEqual(TINY.reference_settings(), more.reference_settings())


class RemainingTime(unittest.TestCase):
    def test_follows_the_work_and_not_the_number_of_files(self):
        now = [0.0]
        remaining = rendering.Remaining(100.0, lambda: now[0])
        self.assertEqual(remaining.text(), "unknown")
        remaining.skipped(40.0)
        now[0] = 600.0
        remaining.worked(10.0)
        self.assertEqual(remaining.text(), "0:50 h")


class Intervals(unittest.TestCase):
    def setUp(self):
        self.random = np.random.default_rng(5)

    def blocks(self, count, spread, share=0.3):
        """Squared errors of two methods in the same blocks: places differ widely, methods at a place less."""
        place = np.exp(spread * self.random.standard_normal(count))
        return [place * np.exp(share * self.random.standard_normal(count)) for _ in range(2)]

    def test_a_difference_of_zero_is_called_one_in_five_per_cent_of_trials(self):
        trials = 2000
        for count, spread in ((11, 1.0), (21, 0.5), (21, 1.5)):
            found = [intervals.log_ratio_interval([self.blocks(count, spread)]) for _ in range(trials)]
            called = sum(verdict(f, 0) != "undecided" for f in found)
            # The standard deviation of the share is 0.5 %.
            self.assertTrue(0.03 < called / trials < 0.07, (count, spread, called / trials))

    def test_the_interval_of_a_ratio_covers_it(self):
        trials, truth = 1000, math.log(1.2)
        covered = 0
        for _ in range(trials):
            a, b = self.blocks(20, 1.0)
            _, low, high = intervals.log_ratio_interval([(1.2 * a, b)])
            covered += low <= truth <= high
        self.assertTrue(0.93 < covered / trials < 0.97, covered / trials)

    def test_the_interval_of_a_level_covers_it(self):
        # The error of one method: its blocks are independent and lognormal, with a mean of exp(1/8).
        trials, covered = 1000, 0
        for _ in range(trials):
            p = np.exp(0.5 * self.random.standard_normal(40))
            _, low, high = intervals.log_ratio_interval([(p, np.ones(40))])
            covered += low <= 1 / 8 <= high
        # Skewed sums are covered a little less often than 95 %.
        self.assertTrue(0.91 < covered / trials < 0.97, covered / trials)

    def test_several_sequences_are_averaged_and_narrow_the_interval(self):
        trials, called, narrower = 1000, 0, 0
        for _ in range(trials):
            pairs = [self.blocks(12, 1.0) for _ in range(6)]
            estimate, low, high = intervals.log_ratio_interval(pairs)
            singles = [intervals.log_ratio_interval([pair]) for pair in pairs]
            self.assertAlmostEqual(estimate, np.mean([s[0] for s in singles]))
            called += not low <= 0 <= high
            narrower += high - low < np.median([s[2] - s[1] for s in singles])
        self.assertTrue(0.03 < called / trials < 0.07, called / trials)
        self.assertGreater(narrower, 0.99 * trials)

    def test_a_constant_ratio_has_no_uncertainty(self):
        p = np.arange(1.0, 9.0)
        for value in intervals.log_ratio_interval([(2 * p, p)]):
            self.assertAlmostEqual(value, math.log(2))

    def test_there_is_no_interval_from_too_little(self):
        p = np.ones(4)
        self.assertIsNone(intervals.log_ratio_interval([(p, p)]))
        self.assertIsNone(intervals.log_ratio_interval([(np.array([1, 1, 1, 1, -9.0]), np.ones(5))]))
        self.assertEqual(verdict(None), "undecided")

    def test_students_quantiles_are_those_of_tables(self):
        for freedom, quantile in ((2, 4.303), (3, 3.182), (5, 2.571), (10, 2.228), (30, 2.042), (120, 1.980)):
            self.assertAlmostEqual(intervals.student_quantile(freedom), quantile, delta=0.035 * quantile if freedom < 4 else 0.01)


class Judging(unittest.TestCase):
    def test_the_noise_of_a_reference_does_not_count_as_error(self):
        random = np.random.default_rng(1)
        truth = np.full((400, 400, 3), 0.4)
        halves = [truth + 0.02 * random.standard_normal(truth.shape) for _ in range(2)]
        reference = (halves[0] + halves[1]) / 2
        perfect = judging.clean_square(truth, reference, halves[0])
        # Its mean is 0 within four standard errors.
        self.assertLess(abs(perfect.mean()), 4 * perfect.std() / 400)
        wrong = judging.clean_square(truth + 0.05, reference, halves[0]).mean()
        expected = (judging.tone_map(0.45) - judging.tone_map(0.4)) ** 2
        self.assertAlmostEqual(wrong / expected, 1.0, delta=0.02)

    def test_values_that_are_not_finite_are_the_largest_error(self):
        reference = np.array([[[3.0, 3.0, 3.0]]])
        for value in (math.nan, math.inf, -math.inf):
            self.assertAlmostEqual(judging.clean_square(np.full((1, 1, 3), value), reference, reference)[0, 0], 0.75**2)

    def test_edges_are_steps_and_turns_and_not_slanted_planes(self):
        x = np.arange(40.0)
        plane = np.tile(1 / (1.0 - 0.02 * x), (20, 1))  # Inverse depth is linear on a plane.
        normal = np.tile([0.0, 0.0, 1.0], (20, 40, 1))
        self.assertTrue((judging.edge_distance(plane, normal) == 8).all())
        step = plane.copy()
        step[:, 20:] *= 1.5
        distance = judging.edge_distance(step, normal)
        self.assertEqual(distance[10, 16:24].tolist(), [3, 2, 1, 0, 0, 1, 2, 3])
        turned = normal.copy()
        turned[:, 20:] = [1.0, 0.0, 0.0]
        self.assertEqual(judging.edge_distance(plane, turned)[10, 16:24].tolist(), [3, 2, 1, 0, 0, 1, 2, 3])

    def test_window_means_leave_out_pixels_that_do_not_count(self):
        values, counts = np.arange(36.0).reshape(6, 6), np.ones((6, 6), bool)
        counts[2, 3] = False
        mean = judging.window_mean(values, counts, 1)
        around = [values[y, x] for y in (1, 2, 3) for x in (2, 3, 4) if (y, x) != (2, 3)]
        self.assertAlmostEqual(mean[2, 3], np.mean(around))
        self.assertAlmostEqual(mean[0, 0], np.mean([0, 1, 6, 7]))

    def test_the_worst_tiles_lie_in_different_squares(self):
        square, judged = np.zeros((128, 128)), np.ones((128, 128), bool)
        square[0:32, 0:32], square[0:32, 32:64], square[96:128, 64:96], square[0:32, 64:96] = 9, 8, 7, 99
        judged[0:32, 64:96] = False
        self.assertEqual(places.worst_tiles(square, judged, 2), [(0, 0), (64, 96)])


class Commands(unittest.TestCase):
    def refused(self, *arguments):
        with self.assertRaises(SystemExit) as caught, contextlib.redirect_stderr(io.StringIO()) as text:
            corpus.main([str(a) for a in arguments])
        return text.getvalue() + str(caught.exception)

    def test_a_run_of_nothing_leaves_results_as_they_are(self):
        gone = {"gone": dataclasses.replace(TINY, scene=pathlib.Path("gone.gltf"))}
        with tempfile.TemporaryDirectory() as folder, mock.patch.object(entries, "corpus", lambda: gone):
            text = self.refused("run", "--walr", WALR, "--cache", folder, "--output", folder, "--entries", "gone")
            self.assertEqual(list(pathlib.Path(folder).iterdir()), [])
        self.assertIn("gone.gltf", text)
        self.assertIn("no entry left", text)

    def test_the_programs_own_message_is_shown(self):
        with self.assertRaises(SystemExit) as caught:
            entries.run_walr(WALR, "render", "--spp", "many")
        self.assertIn("Value many", str(caught.exception))


def run(*arguments):
    with contextlib.redirect_stdout(io.StringIO()) as text:
        corpus.main([str(a) for a in arguments])
    return text.getvalue()


class EndToEnd(unittest.TestCase):
    """Renders, runs and judges a sequence of 64 x 36 pixels."""

    @classmethod
    def setUpClass(cls):
        cls.holder = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.holder.name)
        cls.table, entries.corpus = entries.corpus, lambda: {"tiny": TINY}
        cls.square, judging.SQUARE = judging.SQUARE, 12
        cls.options = ["run", "--walr", WALR, "--cache", cls.folder / "cache", "--methods", "bmfr,none", "--variant", "same=walr",
                       "--keep-pictures"]
        cls.log = run(*cls.options, "--output", cls.folder / "first")
        cls.kept = json.loads((cls.folder / "first" / "results.json").read_text())

    @classmethod
    def tearDownClass(cls):
        entries.corpus, judging.SQUARE = cls.table, cls.square
        cls.holder.cleanup()

    def test_figures_are_those_of_walr_bench(self):
        sequence = next((self.folder / "cache" / "bench").glob("tiny-*"))
        bench = json.loads((sequence / "bench.json").read_text())["sequences"][0]
        noise = {f["frame"]: f["reference_noise"] for f in bench["frames"]}
        for one in bench["runs"]:
            frames = [f for f in one["frames"] if f["rmse"] is not None]
            self.assertEqual([f["frame"] for f in frames], [2, 3, 4])
            mine = self.kept["entries"]["tiny"]["methods"][one["variant"]]
            # Pixels that count differ a little from frame to frame; results are stored as half floats.
            clean = np.mean([f["rmse"] ** 2 - noise[f["frame"]] ** 2 for f in frames])
            self.assertAlmostEqual(mine["rmse"][0] ** 2 / clean, 1.0, delta=0.01)
            self.assertAlmostEqual(mine["flip"][0], np.mean([f["flip"] for f in frames]), delta=1e-3)
            self.assertAlmostEqual(mine["ssim"][0], np.mean([f["ssim"] for f in frames]), delta=1e-3)

    def test_verdicts_are_right_where_the_answer_is_known(self):
        ratios = {m: f["rmse"] for m, f in self.kept["summary"].items()}
        self.assertEqual(ratios["same"], [1.0, 1.0, 1.0])
        self.assertEqual(verdict(ratios["none"]), "worse")
        self.assertIn("| `none` |", (self.folder / "first" / "RESULTS.md").read_text())
        self.assertTrue((self.folder / "first" / self.kept["places"][0]["file"]).exists())
        self.assertIn("are the same", run("agree", self.folder / "first", self.folder / "first"))

    def test_a_page_shows_the_same_from_what_is_recorded(self):
        overview = self.folder / "first" / "places.webp"
        self.assertTrue(overview.exists())
        page = (self.folder / "first" / "RESULTS.md").read_text(encoding="utf-8")
        self.assertEqual(corpus_page.page(records.keep_corpus(self.kept), "results.json", overview.name), page)
        self.assertIn("--part daily --methods walr,bmfr,none --variant same=walr", page)
        self.assertIn(self.kept["date"], page)

    def test_a_comparison_of_methods_is_recorded_from_walr_bench(self):
        sequence = next((self.folder / "cache" / "bench").glob("tiny-*"))
        with mock.patch.object(records, "DATA", self.folder):
            records.record_bench("cycles", sequence)
            kept = records.load("cycles")
        bench = json.loads((sequence / "bench.json").read_text())
        self.assertEqual(set(kept["methods"]), {"walr", "bmfr", "none", "same"})
        measured = bench["sequences"][0]
        for measured_run in measured["runs"]:
            recorded = kept["methods"][measured_run["variant"]]["sequences"][measured["name"]]
            for metric in ("rmse", "ssim", "flip", "flicker"):
                self.assertIsNotNone(recorded[metric])
                # Six decimals are recorded.
                self.assertAlmostEqual(recorded[metric], measured_run["mean_after_4"][metric], delta=0.5e-6)
        self.assertIn(f" --sequences SEQUENCES/{sequence.name} ", kept["command"])

    def test_nothing_is_done_twice_and_what_is_missing_is_done_again(self):
        cache = rendering.Cache(self.folder / "cache", WALR)
        sequence = cache.sequence(TINY)
        times = {f.name: f.stat().st_mtime_ns for f in sequence.glob("*.exr")}
        self.assertEqual(sorted(times), sorted(cache.files(TINY)))
        removed = sequence / "noisy_0003.exr"
        before = removed.read_bytes()
        removed.unlink()
        log = run(*self.options, "--output", self.folder / "again")
        self.assertIn("noisy_0003.exr", log)
        self.assertNotIn("noisy_0002.exr", log)
        self.assertEqual(removed.read_bytes(), before)
        times.pop("noisy_0003.exr")
        self.assertEqual(times, {n: (sequence / n).stat().st_mtime_ns for n in times})
        self.assertEqual(json.loads((self.folder / "again" / "results.json").read_text()), self.kept)

    def test_another_seed_has_other_frames_and_the_same_references(self):
        cache = rendering.Cache(self.folder / "cache", WALR)
        run(*self.options, "--output", self.folder / "seeded", "--seed", "1", "--render-only")
        other = dataclasses.replace(TINY, seed=1)
        self.assertNotEqual(cache.sequence(TINY), cache.sequence(other))
        first, second = ((cache.sequence(e) / "ref_0003.exr") for e in (TINY, other))
        self.assertTrue(first.samefile(second))
        first, second = ((cache.sequence(e) / "noisy_0003.exr").read_bytes() for e in (TINY, other))
        self.assertNotEqual(first, second)


class Figures(unittest.TestCase):
    """The command behind README.md, with a sequence of 64 x 36 pixels and five methods."""

    def test_measures_records_and_writes_and_does_nothing_twice(self):
        methods = {"walr": 1.0, "walr_paper": 1.6, "svgf": 2.2, "accumulate": 0.2, "none": 0.03}
        tiny = dataclasses.replace(TINY, part="figures")
        with tempfile.TemporaryDirectory() as folder, mock.patch.object(entries, "figures", lambda: {"tiny": tiny}), \
                mock.patch.object(entries, "TIMES", methods), mock.patch.object(judging, "SQUARE", 12):
            folder = pathlib.Path(folder)
            for file in records.DATA.glob("*.json"):
                if not file.name.startswith("corpus_540"):
                    (folder / file.name).write_bytes(file.read_bytes())
            with mock.patch.multiple(records, DATA=folder, IMAGES=folder):
                with contextlib.redirect_stdout(io.StringIO()) as text:
                    figures.measure(folder / "cache", WALR)
                kept = records.load("corpus_540")
                with contextlib.redirect_stdout(io.StringIO()) as again:
                    figures.measure(folder / "cache", WALR)
                self.assertEqual(records.load("corpus_540"), kept)
                documents = {file.relative_to(entries.PROJECT).as_posix(): text for file, text in figures.write.documents().items()}
            self.assertTrue((folder / "places_540.webp").exists())
        self.assertRegex(text.getvalue(), r"^about \d+ minutes on two idle cores")
        self.assertIn("left", text.getvalue())
        self.assertNotIn("all rendering", again.getvalue())
        self.assertEqual((kept["part"], list(kept["means"])), ("figures", list(methods)))
        one = kept["entries"]["tiny"]["methods"]
        readme, page = documents["README.md"], documents["samples/results/METHODS.md"]
        for method in ("walr", "svgf", "none"):
            row = next(line for line in readme.splitlines() if line.startswith(f"| `{method}` |")).split(" | ")
            # Both errors are recorded, and their ratio is printed, with a last digit that may be off by a half.
            error, least = one[method]["rmse"][0], one["walr"]["rmse"][0]
            ratio = error / least
            self.assertAlmostEqual(float(row[1]), ratio, delta=0.005 + ratio * 0.5e-6 * (1 / error + 1 / least))
            self.assertEqual(row[2:4], [f"{kept['means'][method][m]:.{d}f}".removeprefix("0") for m, d in (("flip", 3), ("flicker", 4))])
            self.assertIn(f"| `{method}` |", page)
        self.assertNotIn("| `accumulate` |", readme)
        self.assertIn("| `accumulate` |", page)
        self.assertIn("    samples/results/figures.py", documents["samples/results/CORPUS_540.md"])
        self.assertIn("(METHODS.md)", documents["samples/results/README.md"])
        self.assertEqual(set(figures.write.figures_page.pareto_points(kept, records.load("gpu"))), {"walr", "walr_paper", "svgf"})


class Ranking(unittest.TestCase):
    def test_a_contradiction_is_an_opposite_order_beyond_both_intervals(self):
        def kept(bmfr, svgf):
            return {"baseline": "walr", "summary": {"bmfr": {"rmse": bmfr}, "svgf": {"rmse": svgf}, "none": {"rmse": [9, 8, 10]}}}

        ahead, behind = kept([1.1, 1.05, 1.15], [1.3, 1.2, 1.4]), kept([1.4, 1.3, 1.5], [1.2, 1.1, 1.25])
        self.assertEqual(results.ranking(ahead)[0], ["walr", "bmfr", "svgf"])
        self.assertEqual(results.disagreements(ahead, behind), [("bmfr", "svgf")])
        self.assertEqual(results.disagreements(ahead, kept([1.2, 1.0, 1.4], [1.19, 1.0, 1.4])), [])


class Listing(unittest.TestCase):
    def test_the_list_names_every_entry(self):
        command = [sys.executable, str(corpus.HERE / "corpus.py"), "list", "--part", "nightly", "--held-back"]
        text = subprocess.run(command, capture_output=True, text=True, check=True).stdout
        for name, entry in entries.corpus().items():
            if entry.scene.exists():
                self.assertIn(name, text)


class Leads(unittest.TestCase):
    def test_methods_ahead_beyond_the_interval_are_named_but_not_variants(self):
        def entry(**ratios):
            return {"methods": {"walr": {}, **{method: {"ratio": {"rmse": ratio}} for method, ratio in ratios.items()}}}

        record = {"variants": ["mine=walr,blocks.size=4"], "entries": {
            "fence": entry(flr=[0.9, 0.85, 0.95], mine=[0.5, 0.4, 0.6]), "box": entry(flr=[0.9, 0.7, 1.1], svgf=[1.2, 1.1, 1.3])}}
        self.assertEqual(index_page.leads([record]), ["`flr` on `fence` by 10 %"])


class Rates(unittest.TestCase):
    def test_entries_trace_the_rays_that_their_names_tell(self):
        for scene in rate_entries.SCENES:
            found, plain, fine = rate_entries.of_scene(scene)
            for rate, entry in {**found, **plain, **fine}.items():
                frames = entry.frames[1] - entry.frames[0] + 1
                share = entry.pixels / (rate_entries.SIZE[0] * rate_entries.SIZE[1])
                traced = (entry.noisy_paths() / entry.pixels / frames - 1) * share
                self.assertAlmostEqual(traced, rate_entries.rays(rate), places=12, msg=entry.name)
            # A scene that is absent has no contents to make a key of; those of another one do as well.
            found = {rate: dataclasses.replace(e, scene=TINY.scene) for rate, e in found.items()}
            every = [*found.values(), *(dataclasses.replace(e, scene=TINY.scene) for e in [*plain.values(), *fine.values()])]
            self.assertEqual(len({entries.key(e.settings(), "") for e in every}), len(every))
            self.assertEqual(len({entries.key(e.reference_settings(), "") for e in found.values()}), 1)

    def test_interpolation_keeps_planes_apart(self):
        depth = np.where(np.arange(12) < 6, 1.0, 2.0) * np.ones((6, 1))
        normal = np.zeros((6, 12, 3)) + [0.0, 0.0, 1.0]
        small = depth[::2, ::2, None] * np.array([1.0, 2.0, 3.0])
        whole = rates.interpolated(small, (depth[::2, ::2], normal[::2, ::2]), (depth, normal), 2)
        # A pixel of the other plane weighs exp(-25) at most.
        np.testing.assert_allclose(whole, depth[:, :, None] * np.array([1.0, 2.0, 3.0]), rtol=1e-9)

    def test_what_has_not_been_rendered_is_left_out(self):
        class Rendered(rendering.Cache):
            """A cache that has some of the entries, of which none is ever read."""

            version, names = (lambda self, entry: ""), ()

            def complete(self, entry):
                return entry.name in self.names

        cache, denoised = Rendered("", WALR), []
        self.assertIsNone(rates.judged(WALR, cache, "box", print))
        cache.names = ("box_rate_1", "box_rate_1_4", "box_plain_1_9", "box_fine_4")
        whole = mock.patch.multiple(
            rates, bench=lambda *_: pathlib.Path(), Squares=lambda *_: mock.Mock(**{"sums.return_value": (1, 1), "noise.return_value": 0}),
            fine_pictures=lambda walr, cache, entry, method: denoised.append(entry.name), plain_pictures=lambda *_: denoised.append("plain"))
        with whole:
            sums, _ = rates.judged(WALR, cache, "box", lambda text: None)
        self.assertEqual(set(sums), {"1", "1/4", "4, 4 hits"})
        self.assertEqual(set(denoised), {"box_fine_4"})

    def test_ratios_are_over_scenes_that_have_the_method(self):
        random = np.random.default_rng(1)
        sums = {"walr": (random.uniform(1, 2, 20), np.ones(20)), "plain": (random.uniform(1, 2, 20), np.ones(20))}
        of_scenes = {"a": {"1": sums}, "b": {"1": {"walr": sums["walr"]}}}
        scenes, ratios = rates.figures(of_scenes)
        self.assertEqual(set(ratios["1"]), {"scenes", "walr"})
        expected = math.sqrt(sums["plain"][0].mean())
        self.assertAlmostEqual(scenes["a"]["1"]["plain"], expected, delta=1e-3 * expected)  # Rounded to four digits.

    def test_noise_above_the_error_leaves_none(self):
        self.assertAlmostEqual(rates.clean_rmse({"rmse": 0.5, "reference_noise": 0.3}), 0.4)
        self.assertEqual(rates.clean_rmse({"rmse": 0.3, "reference_noise": 0.5}), 0.0)
        self.assertEqual(rates.clean_rmse({"rmse": 0.3, "reference_noise": None}), 0.3)
        self.assertIn(" 0.0 (-) ", rates_page.cycles_page({"s": {"1": dict.fromkeys(rate_entries.TAKE_SPARSE, 0.0)}}))


if __name__ == "__main__":
    unittest.main()
