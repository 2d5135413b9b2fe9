"""The first page of figures and the table of README.md, from scenes of this repository (samples/results/figures.py)."""
import costs_text
from corpus_page import METRIC_NAMES, lines_of
from gpu_page import gpu_term, gpu_time, milliseconds
from markdown_text import filled, listed, mark, number, ratio_text, table, with_interval

DECIMALS = {"ssim": 3, "flip": 3, "flicker": 4}
SHOWN = {"ssim": "SSIM", "flip": "FLIP", "flicker": "flicker"}
UNFILTERED = ("accumulate", "none")
COMMAND = "samples/results/figures.py"


def methods_of(kept):
    return list(next(iter(kept["entries"].values()))["methods"])


def headline(kept):
    """The methods of README.md, each with its default preset."""
    return [m for m in methods_of(kept) if ":" not in m and m != "accumulate"]


def over_baseline(kept, method):
    """The RMSE of a method over that of the baseline, geometric mean of all scenes, with its interval."""
    return [1.0, 1.0, 1.0] if method == kept["baseline"] else kept["summary"][method]["rmse"]


def frames_text(kept):
    """What was rendered, for a sentence."""
    first = next(iter(kept["entries"].values()))
    width, height = first["size"]
    judged = first["judged"][1] - first["judged"][0] + 1
    names = listed(f"`{name}`" for name in kept["entries"])
    return (f"Diffuse indirect light of {len(kept['entries'])} scenes of this repository ({names}), {width} x {height}, "
            f"moving camera, jitter, {first['samples']} sample per pixel (references: {first['reference_samples']}), errors of {judged} frames each after "
            "8 frames of history")


def pareto_points(kept, gpu):
    """Time of a frame and error by method, where both are known."""
    points = {m: (milliseconds(gpu, m), over_baseline(kept, m)) for m in headline(kept) if m not in UNFILTERED}
    return {m: (time, ratio[0]) for m, (time, ratio) in points.items() if time and ratio}


def error(kept, entry, method):
    value = kept["entries"][entry]["methods"][method]["rmse"]
    return number(value and value[0])


def readme_part(kept, gpu):
    """A small table, its terms, and one plot."""
    costs = costs_text.static_costs()
    rows = [[f"`{m}`", number(over_baseline(kept, m)[0], 2), number(kept["means"][m]["flip"], 3),
             number(kept["means"][m]["flicker"], 4), gpu_time(gpu, m), f"{costs[m]['bytes']:.0f}"] for m in headline(kept)]
    intro = filled(f"{frames_text(kept)}. Measured on {kept['date']} at commit {kept['commit']} by `{COMMAND}`, which renders, denoises and "
                   "scores in less than an hour on two cores, and writes this part.")
    return f"""{intro}
{table(["method", f"RMSE over that of `{kept['baseline']}`", "FLIP", "flicker", "GPU time, ms", "bytes per pixel"], rows)}
* **Method**: each with its default settings, on the same frames. `none` is the noisy input.
* **RMSE**: root mean square error of the light without albedo, after the tone map x / (1 + x), without the noise of the references;
  lower is better. Geometric mean of the ratios of all scenes.
* **FLIP**: difference that a person would see (Andersson et al. 2020), 0 to 1; lower is better. Mean over the scenes.
* **Flicker**: how much the error changes from one frame to the next on the same surface point, in the units of RMSE; lower is
  better. Mean over the scenes.
{gpu_term(gpu)} Spread, larger
  sizes, passes and bandwidth: [GPU.md](samples/results/GPU.md).
* **Bytes per pixel**: what the passes of one frame read and write at 1920 x 1080, counted from the compiled graph. It holds on any
  device. A texel counts once a pass, so the wide window of `joint_bilateral` looks cheap here.

![RMSE against GPU time](samples/results/images/pareto.png)

*Lower left is better. Grey line: Pareto front.*

With scenes, intervals and presets: [the first page of figures](samples/results/METHODS.md).
[Two sequences of Blender Cycles](samples/results/CYCLES.md) are not in this repository. Other sizes, scenes and numbers of rays:
[all results](samples/results/README.md). To measure other frames: [`walr bench`](samples/docs/bench.md).
"""


def errors_table(kept):
    rows = []
    for method in methods_of(kept):
        row = [f"`{method}`", "1" if method == kept["baseline"] else ratio_text(over_baseline(kept, method))]
        for name, entry in kept["entries"].items():
            figures = entry["methods"][method]
            row.append(with_interval(figures["rmse"]) if method == kept["baseline"] else
                       f"{error(kept, name, method)} {mark(figures['ratio']['rmse'])}")
        rows.append(row + [number(kept["means"][method][m], DECIMALS[m]) for m in SHOWN])
    return table(["method", f"RMSE over that of `{kept['baseline']}`", *(f"`{n}`" for n in kept["entries"]), *SHOWN.values()], rows)


def page(kept, gpu):
    found = costs_text.static_costs()
    costs = table(["method", *costs_text.HEADINGS], [[f"`{m}`", *costs_text.cells(m, gpu, found)] for m in methods_of(kept)])
    lines = lines_of(kept)
    return f"""# Speed against error

{filled(f"Written by `samples/results/write.py` from `data/corpus_{lines}.json`. {frames_text(kept)}. Measured on {kept['date']} at commit "
        f"{kept['commit']} with")}
    {COMMAND}

{filled("It renders, denoises and scores on any machine with Vulkan, and writes this page, the table of the README and the plot: "
        "less than an hour on two cores. It goes on where it was interrupted. A method's name means its default preset; `METHOD:PRESET` "
        "names another one. Sequences that are not in this repository have [a page of their own](CYCLES.md), with all presets.")}
## Errors

{errors_table(kept)}
* **RMSE** is taken after the tone map x / (1 + x), 0 to 1, and is free of the references' noise. First column: geometric mean of the
  ratios of all scenes, with its interval of 95 %; **bold**: 1 is outside. Scenes: &lt;: better than `{kept['baseline']}` beyond the
  interval of the difference; &gt;: worse; ~: undecided. -: not above the noise of the reference.
* **SSIM** (structural similarity, Wang et al. 2004; higher is better) and **FLIP** (Andersson et al. 2020, 67 pixels per degree; lower
  is better) contain the noise of the references, alike for all methods. **Flicker** is free of it: the root mean square change of
  the error in luminance along motion, over the square root of 2. All three are means over the scenes.
* Places, splits by edges, noise and age, and intervals of {listed(METRIC_NAMES.values())}: [errors at {lines} lines](CORPUS_{lines}.md).

![RMSE against GPU time](images/pareto.png)

## Costs

{costs}
{costs_text.terms(gpu)}"""
