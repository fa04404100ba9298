"""The rates of a sweep's layouts with intervals from the scatter of all of them together."""
import math

from scipy.stats import t as student

from .bench import conditions_of
from .tables import command, number, rows, write_table


def pooled_half_width(of):
    """Of a mean, as a part of it, from rows that have the same number of runs each: their scatter is alike, relative to the rates.
    None of single runs."""
    runs = int(of[0]["replicates"])
    if runs < 2:
        return None
    means = [(float(row["rate_g_per_s"]), float(row["rate_g_per_s_ci95"]) / student.ppf(0.975, runs - 1)) for row in of]
    variance = sum((error / rate) ** 2 for rate, error in means) / len(means)
    return student.ppf(0.975, len(of) * (runs - 1)) * math.sqrt(variance)


def pooled_rates(options):
    """Rates of every layout of a sweep and of its holes, with intervals from the scatter of all layouts' runs.

    Two runs tell little of their own scatter; many layouts of two runs each tell it well, where it is the same part of the rate in all. Writes
    OUT: of each layout its keys, the hole (or all of them), its place, the rate (g/s) and the half width of its 95 % interval, in percent. Ends
    the program where layouts have different numbers of runs, or a hole let nothing through."""
    varied, conditions = conditions_of(rows(f"{options.sweep}/sweep.csv"))
    every = rows(f"{options.sweep}/sweep_holes.csv")
    of_several_lots = {(row["layout"], row["hole"]) for row in every if row["lot"] == "all"}
    of = [row for row in every if row["lot"] == "all" or (row["layout"], row["hole"]) not in of_several_lots]
    if len({row["replicates"] for row in of}) != 1:
        raise SystemExit(f"{options.sweep}/sweep_holes.csv: layouts of different numbers of runs")
    if any(number(row["rate_g_per_s"]) <= 0 for row in of):
        raise SystemExit(f"{options.sweep}/sweep_holes.csv: a hole has no rate, and so no scatter relative to it")
    of_holes, of_all = [row for row in of if row["hole"] != "all"], [row for row in of if row["hole"] == "all"]
    lines = []
    for group in (of_all, of_holes):
        half_width = pooled_half_width(group)
        for row in group:
            lines.append([*conditions[row["layout"]], row["hole"], row["position_mm"], f"{float(row['rate_g_per_s']):.4g}",
                          "" if half_width is None else f"{100 * half_width:.2g}"])
    write_table(options.out, ",".join([*varied, "hole,position_mm,rate_g_per_s,ci95_percent"]), lines)


def add_commands(commands):
    parser = command(commands, "pooled-rates", pooled_rates)
    parser.add_argument("sweep", metavar="SWEEP", help="a folder made by vibrosow sweep")
    parser.add_argument("out", metavar="OUT")
