#!/usr/bin/python3
"""Tests of samples/results: the pages and what is recorded. They need nothing but Python."""
import json
import pathlib
import re
import sys
import tempfile
import unittest
from unittest import mock

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "samples" / "results"))
import write
from write import corpus_page, gpu_page, index_page, rates_page, records
from markdown_text import indented, mark, number, verdict


def ended(*arguments):
    """What a command of write.py exits with: 0, or its message."""
    try:
        write.main(list(arguments))
    except SystemExit as end:
        return end.code
    return None


class Check(unittest.TestCase):
    def test_the_committed_pages_are_what_the_figures_give(self):
        self.assertEqual(ended("--check"), 0)

    def test_a_figure_that_changes_makes_every_page_that_shows_it_stale(self):
        def altered(of, change):
            def load(name):
                kept = json.loads((records.DATA / f"{name}.json").read_text(encoding="utf-8"))
                if name == of:
                    change(kept)
                return kept
            with mock.patch.object(records, "load", load):
                return {pathlib.Path(line.split(":")[0]).relative_to(write.PROJECT).as_posix() for line in ended("--check").split("\n")}

        def time(kept):
            kept["methods"]["walr"]["sizes"]["1920 x 1080"]["ms"][0] = 9.0

        def error(kept):
            kept["entries"]["kitchen_1080"]["methods"]["walr"]["rmse"] = [0.5, 0.4, 0.6]

        def rate(kept):
            kept["ratios"]["4, 4 hits"]["walr"] = [0.5, 0.4, 0.6]

        def mirror(kept):
            kept["sequences"]["gloss_216"]["methods"]["svgf"]["by_roughness"][0] = 0.5

        pages = "samples/results/"
        self.assertEqual(altered("gpu", time), {"README.md", pages + "README.md", pages + "METHODS.md", pages + "CYCLES.md", pages + "GPU.md"})
        self.assertEqual(altered("corpus_1080", error), {pages + "README.md", pages + "CORPUS_1080.md"})
        self.assertEqual(altered("reflections", mirror), {pages + "REFLECTIONS.md"})
        self.assertEqual(altered("rates", rate), {"integration/docs/advanced.md", pages + "RATES.md"})

    def test_a_remark_on_a_place_that_is_no_longer_among_the_worst_is_found(self):
        def load(name):
            kept = json.loads((records.DATA / f"{name}.json").read_text(encoding="utf-8"))
            return {**kept, "360": {**kept["360"], "garden_360 1: 2, 3": "gone."}} if name == "places" else kept

        with mock.patch.object(records, "load", load):
            self.assertEqual(write.wrong(), ["data/places.json: garden_360 1: 2, 3 is not among the worst places at 360 lines"])

    def test_a_document_without_its_marks_is_named(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "README.md"
            file.write_text(write.BEGIN)
            with self.assertRaises(SystemExit) as caught:
                write.replaced(file, "text")
            self.assertIn(str(file), str(caught.exception))

    def test_the_command_behind_the_readme_is_named_where_its_figures_are_missing(self):
        run = {"part": "figures"}
        self.assertIs(write.first_run({"360": {"part": "daily"}, "540": run}), run)
        with self.assertRaises(SystemExit) as caught:
            write.first_run({"360": {"part": "daily"}})
        self.assertIn("samples/results/figures.py", str(caught.exception))

    def test_other_arguments_are_refused_with_the_manual(self):
        for arguments in (["page"], ["--check", "folder"], ["corpus", "folder"], ["gpu"]):
            self.assertEqual(ended(*arguments), write.__doc__)


class Index(unittest.TestCase):
    def test_it_names_every_page_and_every_picture_exists(self):
        text = (write.HERE / "README.md").read_text(encoding="utf-8")
        for page in write.HERE.glob("*.md"):
            self.assertTrue(page.name == "README.md" or f"({page.name})" in text, page)
            for picture in re.findall(r"!\[[^]]*\]\(([^)]+)\)", page.read_text(encoding="utf-8")):
                self.assertTrue((write.HERE / picture).exists(), picture)

    def test_it_tells_when_and_at_which_commit_each_page_was_measured(self):
        record = {"date": "2030-01-02", "commit": "abc", "part": "daily", "judged": None, "seed": 3, "variants": ["x=walr,a=1"],
                  "entries": {"e": {"size": [960, 540], "held_back": False, "methods": {"walr": {}, "x": {}}}}}
        other = {"date": "2030-01-03", "commit": "def", "command": "walr measure", "noise": {"s": 0}, "scenes": {"t": {}}, "device": "D",
                 "sequences": {"g": {}, "m": {}}}
        lines = index_page.measured_section([record], other, other, other, other).splitlines()
        self.assertIn("| [errors at 540 lines](CORPUS_540.md) | 1 sequences of `walr render` | 2030-01-02 | abc |", lines)
        self.assertIn("| [times on a GPU](GPU.md) | D | 2030-01-03 | def |", lines)
        self.assertIn("| [errors of reflections](REFLECTIONS.md) | 2 sequences of `walr render` | 2030-01-03 | def |", lines)
        self.assertIn("    samples/corpus/corpus.py run --output DIR --part daily --methods walr --variant x=walr,a=1 --seed 3", lines)


class Text(unittest.TestCase):
    def test_a_verdict_is_told_by_the_interval(self):
        self.assertEqual([verdict(r) for r in ([0.9, 0.8, 0.99], [1.1, 1.01, 1.2], [0.9, 0.8, 1.0], None)],
                         ["better", "worse", "undecided", "undecided"])
        self.assertEqual([mark(r) for r in ([0.9, 0.8, 0.99], [1.1, 1.01, 1.2], None)], ["&lt;", "&gt;", "~"])
        self.assertEqual(verdict([-0.1, -0.2, -0.05], 0), "better")

    def test_numbers_have_no_zero_before_the_point(self):
        self.assertEqual([number(0.01234), number(1.5, 1), number(None), number(-0.5, 1)], [".0123", "1.5", "-", "-0.5"])

    def test_a_long_command_goes_on_in_the_next_line(self):
        text = indented("walr bench --sequences a b " + " ".join(f"--option-{i} {'x' * 30}" for i in range(5)))
        self.assertLess(max(map(len, text.splitlines())), 128)
        self.assertTrue(text.startswith("    walr bench --sequences a b --option-0 "))
        for line in text.splitlines()[:-1]:
            self.assertTrue(line.endswith(" \\"), line)

    def test_files_have_a_line_for_every_member_and_keep_their_values(self):
        kept = {"commit": "abc", "empty": {}, "methods": {"walr": {"a": [1, 2]}, "none": None}, "places": [{"x": 1}, {"x": 2}]}
        text = records.as_text(kept)
        self.assertEqual(json.loads(text), kept)
        self.assertIn('  "walr": {"a":[1,2]},\n', text)
        self.assertIn('  {"x":1},\n', text)

    def test_leads_are_those_beyond_the_least(self):
        text = rates_page.leads_table({"box": {"1": {"walr": 0.100, "flr": 0.099, "plain": 0.09, "none": None}}})
        self.assertIn("| `box` | 1 | plain alternative by 10 % |", text)
        self.assertEqual(rates_page.leads_table({"box": {"1": {"walr": 0.1, "flr": 0.2}}}), "There are none.\n")


class Recording(unittest.TestCase):
    def test_the_last_run_of_the_corpus_keeps_what_its_page_shows(self):
        kept = records.load("corpus_360")
        kept["entries"]["garden_360"]["methods"]["flr"].update(ssim=[0.9, 0.8, 0.95], ratio={"rmse": [1.2, 1.1, 1.3], "ssim": [1.0, 0.9, 1.1]})
        kept["entries"]["garden_360"]["splits"]["age"]["0"]["ratio"]["flr"] = [1.5, 1.2, 1.8]
        kept["places"][0].update(file="a.png", rmse={**kept["places"][0]["rmse"], "none": 0.5})
        slim = records.keep_corpus(kept)
        self.assertEqual(corpus_page.page(slim, "f", "o"), corpus_page.page(kept, "f", "o"))
        self.assertNotIn("ssim", json.dumps(slim["entries"]))
        self.assertNotIn("a.png", json.dumps(slim))

    def test_remarks_on_places_that_are_gone_are_removed_with_the_run(self):
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            kept = records.load("corpus_360")
            gone = kept["places"].pop(0)
            (folder / "results.json").write_text(json.dumps(kept))
            (folder / "places.webp").write_bytes(b"picture")
            (folder / "places.json").write_text(json.dumps(records.load("places")))
            with mock.patch.multiple(records, DATA=folder, IMAGES=folder), mock.patch("builtins.print") as said:
                records.record_corpus("360", folder, corpus_page.shown_places)
                remarks = records.load("places")
                self.assertEqual(records.load("corpus_360"), kept)
            shown = [records.place_name(p) for p in corpus_page.shown_places(kept)]
            self.assertNotIn(records.place_name(gone), remarks["360"])
            self.assertEqual(list(remarks["360"]), shown[:len(remarks["360"])])
            self.assertEqual((folder / "places_360.webp").read_bytes(), b"picture")
            self.assertIn(shown[-1], said.call_args[0][0], "a place that nobody has described")

    def test_times_on_a_gpu_keep_the_passes_of_the_methods_whose_passes_are_shown(self):
        def spread(median):
            return {"median": median, "p5": median / 2, "p95": median * 2}

        def method(name, why_not=None):
            passes = [{"name": n, "milliseconds": spread(ms), "bytes": 2.04e6, "estimate": {"microseconds": 8.26},
                       "attainable_estimate": None} for n, ms in (("a", 0.25), ("b", 0.5))]
            return {"variant": name, "why_not": why_not, "milliseconds": spread(0.75), "estimated_microseconds": 300.126, "passes": passes}

        data = {"device": {"name": "D", "driver": "R"}, "clocks": {"readings": [{"when": "before", "core_mhz": 1, "memory_mhz": 2}]},
                "commit": "0123456789abcdef", "compiler": "c", "build_type": "b", "command": "walr gpu-report", "model": {"gpu": "G"},
                "validation": {"methods": ["walr"], "messages": []}, "bandwidth": {"probes": []},
                "times": [{"width": 1920, "height": 1080, "content": content, "description": content,
                           "methods": [method("walr"), method("svgf"), method("flr", "no memory")]} for content in ("synthetic", "scene")],
                "results": {"agreements": [{"sequence": "scene", "variant": "walr", "rmse": 0.1, "reference_rmse": 0.1,
                                            "rms_difference": 0.01, "suspicious": False}]}}
        methods = gpu_page.keep_gpu(data)["methods"]
        whole = {"ms": [0.75, 0.375, 1.5], "us": 300.13, "mb": 4.0}
        passes = [{"name": n, "ms": ms, "mb": 2.0, "us": [8.3, None]} for n, ms in (("a", 0.25), ("b", 0.5))]
        self.assertEqual(methods["walr"], {"sizes": {"1920 x 1080": {**whole, "passes": passes}},
                                           "agreement": [["scene", 0.1, 0.1, 0.01, False]]})
        self.assertEqual(methods["svgf"]["sizes"], {"1920 x 1080": whole})
        self.assertEqual(methods["flr"]["sizes"], {"1920 x 1080": {"why_not": "no memory"}})


if __name__ == "__main__":
    unittest.main()
