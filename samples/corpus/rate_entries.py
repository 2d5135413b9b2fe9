"""The sequences of rates.py: the same frames with ever more rays per pixel."""
import dataclasses
import fractions

import entries

SIZE = (384, 216)
JUDGED = (14, 16)
SCENES = {"sponza": entries.shared, "living_room": entries.shared, "cornell_fence": entries.shared, "box": entries.built_in}
SPARSE = ("1/9", "1/4", "1/2")
"""Rates of `walr render --light-rate`."""
TAKE_SPARSE = ("walr", "flr", "bmfr", "accumulate")
"""Methods that take sparse light."""
SAMPLES = (1, 2, 4, 16, 64)
"""Whole numbers of rays per pixel."""
RESAMPLED_FRAMES = 20
"""Frames that the resampled input takes paths from: what engines take."""
PLAIN = {"1/4": 2, "1/9": 3}
"""The plain alternative: rate, and the factor by which its frames are smaller on each side."""
FINE = {"1, 4 hits": {"light_rate": "1/4"}, "4, 4 hits": {"samples": 1}, "16, 4 hits": {"samples": 4}, "64, 4 hits": {"samples": 16}}
"""Frames of twice the size on each side, so that a pixel of the picture has four primary hits: rate, and what makes it."""
FINE_METHODS = ("walr", "flr", "bmfr", "svgf", "accumulate", "none")
"""Methods that are run on them, all but the slowest."""


def rays(rate):
    """Rays per pixel of the picture, from the name of a rate."""
    return float(fractions.Fraction(rate.split(",")[0]))


@dataclasses.dataclass(frozen=True)
class RateEntry(entries.Entry):
    """A sequence of the corpus with other light than a whole number of plain paths per pixel."""

    light_rate: str = "1"  # Of `walr render`; 1/2, 1/4 or 1/9: sparse light.
    resampled_frames: int = 0
    warm_up: int = entries.WARM_UP

    @property
    def frames(self):
        return self.judged[0] - self.warm_up, self.judged[1]

    def settings(self):
        return {**super().settings(), "light_rate": self.light_rate, "resampled_frames": self.resampled_frames}

    def noisy_paths(self):
        traced = self.samples * rays(self.light_rate)
        return (self.frames[1] - self.frames[0] + 1) * self.pixels * (traced + 1)

    def render_options(self):
        return super().render_options() + ["--light-rate", self.light_rate, "--resampled-frames", str(self.resampled_frames)]


def of_scene(scene):
    """The entries of a scene by the name of their rate, those of the plain alternative, and those of twice the size."""

    def entry(kind, name, **settings):
        made = SCENES[scene](name, scene, SIZE, JUDGED, 2, reference_samples=128)
        fields = {field.name: getattr(made, field.name) for field in dataclasses.fields(made)}
        return kind(**{**fields, **settings})

    found = {rate: entry(RateEntry, f"{scene}_rate_{rate.replace('/', '_')}", light_rate=rate) for rate in SPARSE}
    for samples in SAMPLES:
        found[str(samples)] = entry(RateEntry, f"{scene}_rate_{samples}", samples=samples)
    found["1, resampled"] = entry(RateEntry, f"{scene}_resampled", resampled_frames=RESAMPLED_FRAMES,
                                 warm_up=JUDGED[0])
    plain = {rate: entry(RateEntry, f"{scene}_plain_{rate.replace('/', '_')}", size=(SIZE[0] // side, SIZE[1] // side),
                         reference_samples=0) for rate, side in PLAIN.items()}
    fine = {rate: entry(RateEntry, f"{scene}_fine_{rate.split(',')[0]}", size=(SIZE[0] * 2, SIZE[1] * 2), reference_samples=0, **settings)
            for rate, settings in FINE.items()}
    return found, plain, fine
