#!/usr/bin/env python3
"""Applies each fault of faults.toml to a copy of the sources and runs the tests that cover it: README.md."""

import argparse
import json
import os
import re
import subprocess
import sys
import time
import tomllib
from dataclasses import dataclass
from pathlib import Path
from xml.etree import ElementTree

FOLDER = Path(__file__).resolve().parent
PROJECT = FOLDER.parent.parent
QUICK = 2
"""Seconds. CTest starts slow tests first, so the quick ones are a run of their own."""


@dataclass(frozen=True)
class Fault:
    id: str
    file: str
    old: str
    new: str
    why: str
    tests: list[str]  # Names of groups.

    @property
    def area(self):
        return self.file.split("/")[0]


def load(path):
    """The groups of test programs by name, and the faults."""
    with open(path, "rb") as stream:
        given = tomllib.load(stream)
    return given["groups"], [Fault(**fault) for fault in given["fault"]]


def stages_of(groups, fault):
    """Lists of test programs, one for each group, in the order in which they are tried: none of them is tried twice."""
    stages = []
    for group in fault.tests:
        tried = {program for stage in stages for program in stage}
        stages.append([program for program in groups[group] if program not in tried])
    return [stage for stage in stages if stage]


def problems(groups, faults):
    """What is wrong with the list, for the sources beside it."""
    found = []
    scripts = "\n".join(path.read_text() for path in (PROJECT / "tests").rglob("CMakeLists.txt"))
    for program in sorted({program for group in groups.values() for program in group}):
        if not re.search(rf"\b(walr_test|add_executable)\({program}\b", scripts):
            found.append(f"no CMakeLists.txt below tests/ makes the test program {program}")
    used = {group for fault in faults for group in fault.tests}
    found += [f"no fault names the group of tests '{group}'" for group in groups if group not in used]
    ids = [fault.id for fault in faults]
    for fault in faults:
        if ids.count(fault.id) > 1:
            found.append(f"{fault.id}: this id exists {ids.count(fault.id)} times")
        for group in fault.tests:
            if group not in groups:
                found.append(f"{fault.id}: there is no group of tests '{group}'")
        if not fault.tests:
            found.append(f"{fault.id}: names no tests")
        if not fault.why:
            found.append(f"{fault.id}: does not say why a user would notice")
        if "\n" in fault.old + fault.new:
            found.append(f"{fault.id}: its text has more than one line")
        if fault.old == fault.new:
            found.append(f"{fault.id}: the new text is the old one")
        file = PROJECT / fault.file
        if not file.is_file():
            found.append(f"{fault.id}: there is no file {fault.file}")
            continue
        count = file.read_text().count(fault.old) if fault.old else 0
        if count != 1:
            found.append(f"{fault.id}: {fault.file} holds its old text {count} times: {fault.old}")
    return found


def failed_case(test):
    """The first failed case of a suite of GoogleTest in CTest's report, or else the name of the test."""
    found = re.search(r"^\[  FAILED  \] (\S+)", test.findtext("system-out") or "", re.MULTILINE)
    return found[1] if found else test.get("name")


class Copy:
    """A clone of the project's last commit with a build folder of its own, in which faults are applied."""

    def __init__(self, folder, jobs, timeout):
        self.source = folder / "source"
        self.build_folder = self.source / "build"
        self.logs = folder / "logs"
        self.jobs = jobs
        self.timeout = timeout

    def prepare(self, commit):
        self.logs.mkdir(parents=True, exist_ok=True)
        if not self.source.exists():
            subprocess.run(["git", "clone", "--quiet", "--no-checkout", PROJECT, self.source], check=True)
        self.git("fetch", "--quiet", PROJECT, "HEAD")
        self.git("checkout", "--quiet", "--force", "--detach", commit)
        # A fault that leaves a variable unused must still build.
        command = ["cmake", "--preset", "ci", "-DWALR_WARNINGS_AS_ERRORS=OFF"]
        if not (self.build_folder / "build.ninja").exists() and not self.logged("configure", command):
            sys.exit(f"the copy cannot be configured: {self.logs}/configure.txt")

    def git(self, *arguments):
        subprocess.run(["git", "-C", self.source, *arguments], check=True)

    def logged(self, name, command):
        with open(self.logs / f"{name}.txt", "w") as log:
            return subprocess.run(command, cwd=self.source, stdout=log, stderr=log).returncode == 0

    def apply(self, fault):
        file = self.source / fault.file
        file.write_text(file.read_text().replace(fault.old, fault.new, 1))

    def revert(self):
        self.git("checkout", "--quiet", "--", ".")

    def build(self, name, programs):
        targets = ["--target", *programs] if programs else []
        return self.logged(f"{name}.build", ["cmake", "--build", "build", "-j", str(self.jobs), *targets])

    def seconds(self):
        """How long each test took in earlier runs, by name, as CTest keeps it."""
        costs = self.build_folder / "Testing" / "Temporary" / "CTestCostData.txt"
        # Name, number of runs, mean seconds; a name may have spaces.
        rows = [line.rsplit(" ", 2) for line in costs.read_text().split("---")[0].splitlines()] if costs.exists() else []
        return {name: float(mean) for name, _, mean in rows}

    def numbers(self, programs):
        """CTest's numbers of the quick tests and of the slow ones that run one of the programs; of all tests if none is named."""
        listing = subprocess.run(["ctest", "--test-dir", "build", "--show-only=json-v1"], cwd=self.source, check=True,
                                 capture_output=True).stdout
        wanted = set(programs)
        seconds = self.seconds()
        quick, slow = [], []
        for number, test in enumerate(json.loads(listing)["tests"], 1):
            if not wanted or wanted & {os.path.basename(word) for word in test.get("command", [])}:
                (quick if seconds.get(test["name"], 0) < QUICK else slow).append(number)
        return quick, slow

    def test(self, name, programs, stop):
        """Runs tests. Returns the failed ones with what happened, and how many ran. Those that tell a fault soon come first."""
        quick, slow = self.numbers(programs)
        failed, count = self.run_tests(f"{name}.quick", quick, stop)
        if slow and not (failed and stop):
            more, ran = self.run_tests(f"{name}.slow", slow, stop)
            failed, count = failed + more, count + ran
        return failed, count

    def run_tests(self, name, numbers, stop):
        report = self.logs / f"{name}.xml"
        report.unlink(missing_ok=True)
        numbers = ",".join(map(str, numbers))
        if not numbers:
            return [], 0
        # 0,0,0 is an empty range.
        self.logged(f"{name}.test", ["env", f"GTEST_FAIL_FAST={int(stop)}", "ctest", "--test-dir", "build",
                                     "-I", f"0,0,0,{numbers}", "-j", str(self.jobs), "--timeout", str(self.timeout),
                                     "--output-on-failure", "--output-junit", report,
                                     *(["--stop-on-failure"] if stop else [])])
        if not report.exists():
            sys.exit(f"ctest wrote no report: {self.logs}/{name}.test.txt")
        cases = ElementTree.parse(report).getroot().findall("testcase")
        failed = [(failed_case(case), case.find("failure").get("message") or "Failed")
                  for case in cases if case.get("status") == "fail"]
        return failed, sum(case.get("status") in ("run", "fail") for case in cases)


def try_fault(copy, fault, stages):
    """Builds and runs one stage after the other until a test fails. A stage without programs is the whole suite."""
    result = {"status": "no test ran", "by": "", "how": "", "tests": 0, "build_seconds": 0.0, "test_seconds": 0.0}
    copy.apply(fault)
    try:
        for number, programs in enumerate(stages, 1):
            name = f"{fault.id}.{number}"
            started = time.monotonic()
            built = copy.build(name, programs)
            result["build_seconds"] += round(time.monotonic() - started, 1)
            if not built:
                return {**result, "status": "does not build"}
            started = time.monotonic()
            failed, count = copy.test(name, programs, stop=True)
            result["test_seconds"] += round(time.monotonic() - started, 1)
            result["tests"] += count
            if failed:
                return {**result, "status": "caught", "by": failed[0][0], "how": failed[0][1]}
            if result["tests"]:
                result["status"] = "not caught"
    finally:
        copy.revert()
    return result


def require_clean(copy, results, programs, save):
    """Refuses programs whose tests fail without a fault."""
    untested = sorted(set(programs) - set(results["passes_without_fault"]))
    if not untested:
        return
    print(f"without a fault: building and running {' '.join(untested)}", flush=True)
    if not copy.build("no-fault", [] if "all" in untested else untested):
        sys.exit(f"the sources do not build without a fault: {copy.logs}/no-fault.build.txt")
    failed, count = copy.test("no-fault", [] if "all" in untested else untested, stop=False)
    if failed or not count:
        sys.exit(f"{count} tests ran without a fault, and these fail, so that they tell nothing: {failed}; "
                 f"see {copy.logs}")
    print(f"without a fault: all {count} tests pass", flush=True)
    results["passes_without_fault"] = sorted([*results["passes_without_fault"], *untested])
    save()


def describe(result):
    how = "" if result["how"] in ("", "Failed") else f" ({result['how']})"
    return (f"{result['status']:14} build {result['build_seconds']:6.1f} s, {result['tests']:4} tests "
            f"{result['test_seconds']:6.1f} s  {result['by']}{how}")


def campaign(options, groups, faults):
    commit = subprocess.run(["git", "-C", PROJECT, "rev-parse", "HEAD"], check=True, capture_output=True,
                            text=True).stdout.strip()
    folder = options.work.resolve()
    if folder.is_relative_to(PROJECT):
        sys.exit("--work must be a folder outside the sources")
    file = options.results or folder / "results.json"
    results = json.loads(file.read_text()) if file.exists() else {"commit": commit, "passes_without_fault": [],
                                                                   "faults": {}}
    if results["commit"] != commit:
        sys.exit(f"{file} holds results of commit {results['commit']}, and this is {commit}: give another --results")

    def save():
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(json.dumps(results, indent=2) + "\n")

    todo = [fault for fault in faults if options.again or fault.id not in results["faults"]]
    print(f"{len(faults) - len(todo)} of {len(faults)} faults have been tried already", flush=True)
    if todo:
        copy = Copy(folder, options.jobs, options.timeout)
        copy.prepare(commit)
        stages = {fault.id: [[]] if options.all_tests else stages_of(groups, fault) for fault in todo}
        needed = {program for each in stages.values() for stage in each for program in stage}
        require_clean(copy, results, ["all"] if options.all_tests else needed, save)
        for number, fault in enumerate(todo, 1):
            result = try_fault(copy, fault, stages[fault.id])
            results["faults"][fault.id] = {"file": fault.file, **result}
            save()
            print(f"{number}/{len(todo)} {fault.id}: {describe(result)}", flush=True)

    tried = [(fault, results["faults"][fault.id]) for fault in faults]
    print()
    for fault, result in tried:
        print(f"{fault.id:34} {describe(result)}")
    missed = [fault.id for fault, result in tried if result["status"] != "caught"]
    minutes = sum(result["build_seconds"] + result["test_seconds"] for _, result in tried) / 60
    print(f"\n{len(tried) - len(missed)} of {len(tried)} faults are caught, in {minutes:.1f} minutes"
          + (f"; not caught: {' '.join(missed)}" if missed else ""))
    return 1 if missed else 0


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--work", type=Path, metavar="DIR", help="folder outside the sources for the copy and its build")
    parser.add_argument("--only", nargs="+", metavar="ID", help="these faults alone")
    parser.add_argument("--area", help="faults below this folder alone, as in --area shaders")
    parser.add_argument("--all-tests", action="store_true", help="run the whole suite, not the part that covers a fault")
    parser.add_argument("--again", action="store_true", help="try faults again that the results hold already")
    parser.add_argument("--results", type=Path, metavar="FILE", help="default: results.json in --work")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="default: one for each processor")
    parser.add_argument("--timeout", type=int, default=600, help="seconds for a test; running longer counts as failing")
    parser.add_argument("--dry-run", action="store_true", help="list what would be done")
    parser.add_argument("--check", action="store_true", help="only check that the list fits the sources")
    parser.add_argument("--faults", type=Path, default=FOLDER / "faults.toml", metavar="FILE", help="the list")
    options = parser.parse_args()

    groups, faults = load(options.faults)
    found = problems(groups, faults)
    if found:
        sys.exit("\n".join(found))
    if options.check:
        print(f"{len(faults)} faults, each of which fits the sources")
        return 0
    unknown = sorted(set(options.only or []) - {fault.id for fault in faults})
    if unknown:
        sys.exit(f"there is no fault {' '.join(unknown)}")
    chosen = [fault for fault in faults
              if (not options.only or fault.id in options.only) and options.area in (None, fault.area)]
    if not chosen:
        sys.exit("no fault is chosen")
    if options.dry_run:
        for fault in chosen:
            line = (PROJECT / fault.file).read_text().split(fault.old)[0].count("\n") + 1
            stages = "all tests" if options.all_tests else ", then ".join(map(" ".join, stages_of(groups, fault)))
            print(f"{fault.id}: {fault.file}:{line}, by {stages}")
        return 0
    if not options.work:
        sys.exit("--work DIR is missing")
    return campaign(options, groups, chosen)


if __name__ == "__main__":
    sys.exit(main())
