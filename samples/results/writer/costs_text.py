"""What pages say of the costs of methods: times on a GPU, estimates, bytes and memory."""
import json

from gpu_page import gpu_term, gpu_time
from markdown_text import number
from records import RESULTS

FIGURES_FILE, MACHINES_FILE = (RESULTS.parent / "estimate" / f"{name}.json" for name in ("shader_figures", "machines"))
HEADINGS = ("GPU time, ms", "estimated GPU time, us", "bytes per pixel", "memory, MB")


def static_costs():
    """By method: estimated GPU time in us, bytes a pixel, and memory in MB, of the compiled graphs and shaders of this commit."""
    static = json.loads(FIGURES_FILE.read_text())
    pixels = static["width"] * static["height"]
    return {e["variant"]: {"microseconds": e["microseconds"], "bytes": 1e6 * e["megabytes"] / pixels, "memory": e["memory_megabytes"]}
            for e in static["estimates"]}


def cells(name, gpu, costs):
    """Cells below HEADINGS."""
    cost = costs[name]
    return [gpu_time(gpu, name), number(cost["microseconds"], 0), f"{cost['bytes']:.0f}", f"{cost['memory']:.0f}"]


def terms(gpu):
    static, machines = json.loads(FIGURES_FILE.read_text()), json.loads(MACHINES_FILE.read_text())["machines"]
    machine = next(m["gpu"] for m in machines if m["name"] == static["machine"])
    return f"""{gpu_term(gpu)} More of it: [GPU.md](GPU.md).
* **Estimated GPU time**: microseconds of a frame of {static['width']} x {static['height']} on one GPU, {machine}.
  It is an estimate by a static model, and no measurement: for each pass the largest of what the plan's bytes, the instructions and
  the fetches of the compiled shader, and its waits take at the GPU's peak rates (see `tests/costs/README.md`).
* **Bytes** and **memory** are those of the compiled graph at 1920 x 1080 and hold on any device. Like the estimate, they are those
  of this commit, also where the other columns were measured at an earlier one. Bytes: every texel that a pass
  reads or writes, once. Memory: histories and transient textures, which alias each other, without the textures of the host.
"""
