"""Reading Vibrosow's CSV reports, and the mean of several runs with its interval."""
import argparse
import csv
import inspect
import math
import sys

import numpy as np
from scipy.stats import t as student


def rows(path):
    """A dictionary per row; lines that begin with # are skipped. Ends the program where the file cannot be read."""
    try:
        with open(path, newline="", encoding="utf-8") as file:
            return list(csv.DictReader(line for line in file if not line.startswith("#")))
    except OSError as fault:
        sys.exit(f"scripts/figures: {path}: {fault.strerror}")


def runs_within_the_model(folder):
    """The rows of a sweep's runs. Ends the program where one of them left the model: nothing is decided by those."""
    runs = rows(f"{folder}/sweep_runs.csv")
    outside = [run["layout"] for run in runs if run["outside_the_model"] == "yes"]
    if outside:
        sys.exit(f"scripts/figures: {folder}/sweep_runs.csv: layout {outside[0]} has a run outside the model")
    return runs


def write_table(path, header, lines):
    """`header`: the columns' names, with commas between them."""
    with open(path, "w", newline="", encoding="utf-8") as file:
        csv.writer(file, lineterminator="\n").writerows([header.split(","), *lines])


def number(text):
    """An empty cell is not a number."""
    return float(text) if text else math.nan


def mean_and_half_width(values):
    """Mean and half width of its 95 % interval (Student's t); no half width of a single value."""
    mean = np.mean(values)
    if len(values) < 2:
        return mean, None
    return mean, student.ppf(0.975, len(values) - 1) * np.std(values, ddof=1) / math.sqrt(len(values))


def command(commands, name, act):
    """A subcommand that `act` carries out and whose docstring explains; its first paragraph is the summary."""
    text = inspect.cleandoc(act.__doc__)
    summary = " ".join(text.split("\n\n")[0].split()).replace("%", "%%")
    parser = commands.add_parser(name, help=summary, description=text, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.set_defaults(act=act)
    return parser
