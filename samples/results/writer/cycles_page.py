"""The page of the two sequences of Cycles, from what `walr bench` measured."""
import costs_text
from markdown_text import indented, listed, number, table
from records import mean

LABELS = {"rmse": "RMSE", "ssim": "SSIM", "flip": "FLIP", "flicker": "flicker"}
DECIMALS = {"rmse": 4, "ssim": 3, "flip": 3, "flicker": 4}
UNFILTERED = ("accumulate", "none")


def times(method):
    """Median, 5 % and 95 % quantile of a method's time ratio to the baseline, mean over the sequences; None without a timer."""
    ratios = [s["time"] for s in method["sequences"].values()]
    return None if None in ratios else [mean(r[i] for r in ratios) for i in range(3)]


def over_sequences(method, figure):
    return mean(s[figure] for s in method["sequences"].values())


def processor_note(kept):
    return f" This is a processor's time, not a GPU's ({kept['device']})." if kept["software"] else ""


def standing(runs, baseline, figures):
    """States in which metrics the baseline is best, and how far it is behind in the others; only methods with a spatial filter count."""
    ahead, others = [], []
    for figure in figures:
        values = {n: run[figure] for n, run in runs.items() if n not in UNFILTERED}
        best = (max if figure == "ssim" else min)(values, key=values.get)
        if best == baseline:
            ahead.append(LABELS[figure])
        else:
            change = 100 * (values[baseline] / values[best] - 1)
            others.append(f"`{best}` has the best {LABELS[figure]}, from which that of `{baseline}` differs by {change:+.1f} %")
    return "; ".join(([f"`{baseline}` has the best {listed(ahead)} of all methods"] if ahead else []) + others)


def methods_table(kept, gpu):
    costs = costs_text.static_costs()
    header = ["method"]
    for sequence in kept["noise"]:
        header += [f"`{sequence}`: RMSE", *list(LABELS.values())[1:]]
    rows = []
    for name, method in kept["methods"].items():
        time = times(method)
        rows.append([f"`{name}`", *(number(s[f], DECIMALS[f]) for s in method["sequences"].values() for f in LABELS),
                     "-" if time is None else f"{time[0]:.2f} ({time[1]:.2f} to {time[2]:.2f})",
                     *costs_text.cells(name, gpu, costs)])
    return table([*header, "relative time", *costs_text.HEADINGS], rows)


def response_section(kept):
    shown = {n: m["response"] for n, m in kept["methods"].items() if "response" in m}
    if not shown:
        return ""

    def frames(count):
        return "not by the end" if count is None else str(count)

    rows = [[f"`{n}`", number(r["first_frame_rmse"], 4), number(r["settled_rmse"], 4), number(r["settled_flicker"], 4),
             frames(r["light_frames"]), f"{r['light_lag']:.1f}", frames(r["recovery_frames"]), f"{r['trail']:.3f}"]
            for n, r in shown.items()]
    return "\n## Response to change\n\nSynthetic scenes of 192 x 108 pixels whose exact light is known.\n\n" + table(
        ["method", "first frame, RMSE", "settled, RMSE", "settled, flicker", "light goes down, frames", "light moves, frames",
         "disocclusion, frames", "trail, share"], rows) + """
* **First frame**: there is no history. **Settled**: the history is as long as it gets.
* **Light goes down**: a light is dimmed to a tenth; frames until at most a tenth of the difference remains.
* **Light moves**: lag of a light that moves over a static wall; the result is nearest to the truth of so many frames ago.
* **Disocclusion**: a slab moves and uncovers a wall; frames until the wall's error there exceeds
  its error elsewhere by at most a quarter.
* **Trail**: share of the slab's light that remains on the wall in the first frame after the disocclusion. Below 0 the wall is too dark
  there. `none` keeps nothing of the slab: its value is noise.
"""


def page(kept, gpu):
    noise = listed(f"{number(v, 4)} on `{s}`" for s, v in kept["noise"].items() if v is not None)
    standings = "".join(f"* On `{s}` " + standing({n: m["sequences"][s] for n, m in kept["methods"].items() if not n.startswith("walr:")}, "walr", list(LABELS)) + ".\n"
                        for s in kept["noise"]) + "  Other presets of `walr` are not counted here.\n"
    return f"""# Methods on frames of Cycles

Written by `samples/results/write.py` from `data/cycles.json`. Two sequences rendered with Blender Cycles, 384 x 216, 1 sample per
pixel, moving camera; references of 1,400 to 2,100 samples per pixel. They are not in this repository: [figures that anyone can
reproduce](METHODS.md). Values are means over the frames after the fourth, over pixels with a diffuse lobe. A method's name means its default preset; `METHOD:PRESET` names another one.

{methods_table(kept, gpu)}
* **RMSE**, **SSIM** (structural similarity, Wang et al. 2004; higher is better) and **FLIP** (Andersson et al. 2020, 67 pixels per
  degree) are taken after the tone map x / (1 + x). **Flicker** is the root mean square change of the error in luminance along
  motion, without disocclusions, over the square root of 2: white noise of standard deviation s has flicker s.
  RMSE and flicker are in units of the tone-mapped value, 0 to 1; SSIM and FLIP have no unit.
* **Relative time**: time of a frame over that of `walr` on the same frame in the same run; median, and in brackets the 5th to the 95th
  percentile; mean over both sequences.{processor_note(kept)}
{costs_text.terms(gpu)}* The references have noise of their own. As an RMSE it is {noise}.
{standings}
![the places of largest error](images/crops.png)

*The two places of each sequence's last frame in which the methods' mean FLIP is largest. Below each: change of the error in luminance
from the frame before, along motion. Red: brighter. Blue: darker. Grey: the surface was not visible in the frame before. Flicker,
trails, and seams that do not stay with their surface show there.*
{response_section(kept)}
## How it was measured

At commit {kept['commit']} ({kept['compiler']}) on {kept['device']}, {kept['driver']}, with

{indented(kept['command'])}
"""
