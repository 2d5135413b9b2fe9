"""Figures of a run from its sums over blocks: what results.json holds."""
import math

import intervals
import numpy as np
from judging import CLASSES, FIGURES

UNFILTERED = ("accumulate", "none")
METRICS = {"rmse": ("square", "pixels", 0.5), "ssim": ("dissimilarity", "windows", 1.0), "flip": ("flip", "pixels", 1.0),
           "flicker": ("flicker", "pairs", 0.5)}
"""For every metric the sum that it is made of, the number that divides it, and the power to which their ratio is raised."""


def figure(values, name):
    """Sums per block of one figure of FIGURES, of one class."""
    return values[FIGURES.index(name)]


def rounded(value, digits=4):
    return None if value is None or not math.isfinite(value) else float(f"{value:.{digits}g}")


def level(values, metric):
    """A metric with its interval from the sums of one class; None if it has no value."""
    total, number, power = METRICS[metric]
    found = intervals.log_ratio_interval([(figure(values, total), figure(values, number))])
    return found and [rounded(math.exp(power * v)) for v in found]


def difference(values, others, metric):
    """Ratio of a metric of one method to that of another one, with its interval. `values` and `others`: sums of one class for
    every sequence; ratios of several sequences are averaged geometrically. For SSIM the ratio is that of 1 - SSIM."""
    total, _, power = METRICS[metric]
    pairs = [(figure(a, total), figure(b, total)) for a, b in zip(values, others)]
    found = intervals.log_ratio_interval(pairs)
    return found and [rounded(math.exp(power * v)) for v in found]


def entry_results(sums, methods, baseline):
    """All figures of one sequence. sums: by method and split an array of figures x classes x blocks."""
    whole = {m: sums[m, "all"][:, 0] for m in methods}
    result = {"blocks": int((figure(whole[baseline], "pixels") > 0).sum()), "methods": {}, "splits": {}}
    for method in methods:
        figures = {metric: level(whole[method], metric) for metric in METRICS}
        if figures["ssim"]:
            figures["ssim"] = [rounded(1 - v) for v in (figures["ssim"][0], figures["ssim"][2], figures["ssim"][1])]
        if method != baseline:
            figures["ratio"] = {metric: difference([whole[method]], [whole[baseline]], metric) for metric in METRICS}
        result["methods"][method] = figures
    pixels = figure(whole[baseline], "pixels").sum()
    for split, names in CLASSES.items():
        if split == "all":
            continue
        for index, name in enumerate(names):
            one = {m: sums[m, split][:, index] for m in methods}
            result["splits"].setdefault(split, {})[name] = {
                "share": rounded(figure(one[baseline], "pixels").sum() / pixels, 3),
                "rmse": {m: (level(one[m], "rmse") or [None])[0] for m in methods},
                "ratio": {m: difference([one[m]], [one[baseline]], "rmse") for m in methods if m != baseline}}
    return result


def summary(all_sums, methods, baseline):
    """Every method against the baseline over several sequences: mean ratios with intervals."""
    wholes = {m: [sums[m, "all"][:, 0] for sums in all_sums] for m in methods}
    return {m: {metric: difference(wholes[m], wholes[baseline], metric) for metric in METRICS} for m in methods if m != baseline}


def save_sums(path, sums):
    np.savez_compressed(path, **{f"{method}|{split}": values for (method, split), values in sums.items()})


def load_sums(path):
    with np.load(path) as file:
        return {tuple(name.split("|")): file[name] for name in file.files}


def ranking(results):
    """The filtering methods from the best to the worst mean ratio of RMSE; the baseline's own ratio is 1."""
    ratios = {m: r["rmse"] for m, r in results["summary"].items() if m.split(":")[0] not in UNFILTERED}
    ratios[results["baseline"]] = [1.0, 1.0, 1.0]
    return sorted((m for m in ratios if ratios[m]), key=lambda m: ratios[m][0]), ratios


def disagreements(first, second):
    """Pairs of methods that two runs rank in opposite order although each run's intervals of the two do not overlap."""
    one, two = ranking(first)[1], ranking(second)[1]
    found = []
    for a in one:
        for b in one:
            if all(m in two and two[m] for m in (a, b)) and one[a] and one[b] and one[a][2] < one[b][1] and two[b][2] < two[a][1]:
                found.append((a, b))
    return found
