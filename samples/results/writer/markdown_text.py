"""What all pages of results share: tables, numbers and verdicts as text. Needs nothing but Python."""
import itertools
import textwrap


def table(header, rows):
    lines = [header, ["---"] * len(header), *rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines) + "\n"


def listed(words):
    words = list(words)
    return words[0] if len(words) == 1 else ", ".join(words[:-1]) + " and " + words[-1]


def filled(text):
    """A paragraph in lines of the width that documents have."""
    return textwrap.fill(text, 128, break_long_words=False, break_on_hyphens=False) + "\n"


def number(value, decimals=4):
    """Without a zero before the point; "-" if there is no value."""
    return "-" if value is None else f"{value:.{decimals}f}".removeprefix("0")


def over(numerator, denominator, decimals=2):
    return f"{numerator / denominator:.{decimals}f}" if numerator and denominator else "-"


def verdict(interval, equal=1.0):
    """"better", "worse" or "undecided": where an interval (estimate, lower, upper) lies beside the value of two equal methods."""
    if interval is None or interval[1] <= equal <= interval[2]:
        return "undecided"
    return "better" if interval[2] < equal else "worse"


def mark(ratio):
    return {"better": "&lt;", "worse": "&gt;", "undecided": "~"}[verdict(ratio)]


def ratio_text(ratio):
    """A ratio with its interval; bold if 1 is outside."""
    if ratio is None:
        return "-"
    text = f"{ratio[0]:.3f} ({ratio[1]:.3f} to {ratio[2]:.3f})"
    return text if verdict(ratio) == "undecided" else f"**{text}**"


def with_interval(value):
    return "-" if value is None else f"{number(value[0])} ({number(value[1])} to {number(value[2])})"


def indented(command):
    """A command over several lines that a shell takes as it stands; options begin a line where one is full."""
    lines = []
    for option in (" ".join(words) for words in option_groups(command.split())):
        if lines and len(lines[-1]) + len(option) < 120:
            lines[-1] += " " + option
        else:
            lines.append(option)
    return "    " + " \\\n        ".join(lines)


def option_groups(words):
    """Words of a command, each option with the words that follow it."""
    groups = itertools.accumulate(word.startswith("--") for word in words)
    return [[word for _, word in group] for _, group in itertools.groupby(zip(groups, words), lambda pair: pair[0])]
