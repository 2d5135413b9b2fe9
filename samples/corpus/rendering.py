"""Renders the sequences of the corpus into a cache, and resumes where it was interrupted."""
import functools
import hashlib
import os
import pathlib
import re
import subprocess
import time

from entries import key, renderer_version

DONE = re.compile(r"^(noisy|ref)_\d+\.exr: (already exists)?")


class Remaining:
    """Tells the time that is left, from the share of the work that is done. Work is in any unit, such as paths."""

    def __init__(self, total, clock=time.monotonic):
        self.left, self.done, self.clock, self.start = total, 0.0, clock, clock()

    def worked(self, amount):
        self.left -= amount
        self.done += amount

    def skipped(self, amount):
        """Work that was found done. It says nothing of the speed."""
        self.left -= amount

    def text(self):
        if not self.done:
            return "unknown"
        minutes = round((self.clock() - self.start) * self.left / self.done / 60)
        return f"{minutes // 60}:{minutes % 60:02d} h"


class Cache:
    """The folder with everything that has been rendered. The names of its folders tell the entry and the key of its settings.

    References of the same light are rendered once: sequences that differ in seed or samples per pixel link to the same files."""

    def __init__(self, folder, walr):
        self.folder, self.walr, self.versions = pathlib.Path(folder), walr, {}

    @functools.cached_property
    def program(self):
        """A hash of the program, which tells its results from those of another one."""
        return hashlib.sha256(pathlib.Path(self.walr).read_bytes()).hexdigest()

    def version(self, entry):
        view = entry.scene, entry.camera, *entry.light_options()
        if view not in self.versions:
            self.versions[view] = renderer_version(self.walr, *view)
        return self.versions[view]

    def sequence(self, entry):
        return self.folder / "sequences" / f"{entry.name}-{key(entry.settings(), self.version(entry))}"

    def references(self, entry):
        return self.folder / "references" / key(entry.reference_settings(), self.version(entry))

    def files(self, entry):
        """The names of the files that `walr render` writes for an entry."""
        first, last = entry.frames
        noisy = [f"noisy_{i:04d}.exr" for i in range(first, last + 1)]
        references = range(entry.judged[0], entry.judged[1] + 1) if entry.reference_samples else ()
        return noisy + [f"ref_{i:04d}.exr" for i in references]

    def complete(self, entry):
        """Whether everything of an entry has been rendered."""
        return entry.scene.exists() and all((self.sequence(entry) / file).exists() for file in self.files(entry))

    def work(self, entry, file):
        """Paths of one file of an entry."""
        paths = entry.reference_paths() if file.startswith("ref") else entry.noisy_paths()
        first, last = entry.judged if file.startswith("ref") else entry.frames
        return paths / (last - first + 1)

    def share_references(self, source, target):
        """Links the references of one folder into another one that lacks them."""
        target.mkdir(parents=True, exist_ok=True)
        for file in source.glob("ref_*.exr"):
            if not (target / file.name).exists():
                os.link(file, target / file.name)

    def render(self, entry, remaining, log):
        """Renders what is missing of one entry. `walr render` keeps complete files and replaces damaged ones."""
        sequence, references = self.sequence(entry), self.references(entry)
        self.share_references(references, sequence)
        command = [str(self.walr), "render", str(entry.scene), "--output", str(sequence), *entry.render_options()]
        with subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True) as process:
            tail = []
            for line in process.stderr:
                tail = tail[-5:] + [line]
                if found := DONE.match(line):
                    work = self.work(entry, line)
                    (remaining.skipped if found.group(2) else remaining.worked)(work)
                    if not found.group(2):
                        log(f"{entry.name}: {line.strip()}; all rendering: {remaining.text()} left")
        if process.returncode:
            raise RuntimeError(f"walr render of {entry.name} failed:\n" + "".join(tail))
        self.share_references(sequence, references)


def render_all(entries, cache, log):
    """Renders all entries. Counts the work of references that several entries share once per entry, and then skips it."""
    remaining = Remaining(sum(cache.work(entry, file) for entry in entries for file in cache.files(entry)))
    for entry in entries:
        cache.render(entry, remaining, log)
