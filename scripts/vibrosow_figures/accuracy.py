"""What accuracy costs, drawn as the field of ODE solvers draws it."""
import json
import math
from pathlib import Path

import matplotlib
import numpy as np

matplotlib.use("Agg")
from matplotlib import pyplot
from matplotlib.ticker import LogLocator, NullFormatter

from .tables import command, rows, write_table

SCHEMES = {"velocity-verlet": ("#1b6ca8", "o", "velocity Verlet"), "rk2-midpoint": ("#c8553d", "s", "midpoint Runge-Kutta"),
           "gear5": ("#3a7d44", "^", "Gear, fifth order")}


def settings_of(folder):
    """Rows of accuracy.csv that have an error, with the CPU time of a run, by time. The error is the fitted one, against the limit."""
    times = rows(f"{folder}/accuracy_timing.csv")
    found = []
    for row, timing in zip(rows(f"{folder}/accuracy.csv"), times):
        if row["fitted_error_percent"] and timing["cpu_s"]:
            error, band = float(row["fitted_error_percent"]), float(row["fitted_error_band95"])
            found.append({**row, "cpu_s": float(timing["cpu_s"]), "error": abs(error), "band": band})
    if not found:
        raise SystemExit(f"{folder}/accuracy.csv: no setting has a fitted error")
    return sorted(found, key=lambda row: row["cpu_s"])


def chance_of_a_run(folder):
    return next(float(row["rate_change_percent"]) for row in rows(f"{folder}/accuracy_errors.csv") if row["source"].startswith("chance"))


def front_of(settings):
    """From the cheapest on, each whose error and band together are smaller than all cheaper ones'."""
    front, least = [], float("inf")
    for row in settings:
        if row["error"] + row["band"] < least:
            least = row["error"] + row["band"]
            front.append(row)
    return front


def softness_of(row):
    return row["shell_compression"] or row["youngs_modulus_MPa"]


def work_precision(options):
    """Draws a folder of `vibrosow accuracy` as OUT (SVG or PNG): the error of every setting against the limit of step 0 and rigid grains,
    with its 95 % band, over the CPU time of a run, both logarithmic. Lines join the steps of one scheme at one softness; the front is
    what bounds its error most tightly for its time; the dashed line is the chance of one run. Beside a line: its softness."""
    matplotlib.rcParams["svg.hashsalt"] = "vibrosow"  # the same names in every SVG
    settings, chance = settings_of(options.folder), chance_of_a_run(options.folder)
    least = options.least
    figure, axes = pyplot.subplots(figsize=(7.2, 5), layout="constrained")
    for scheme, (colour, marker, name) in SCHEMES.items():
        own = [row for row in settings if row["integrator"] == scheme]
        labelled = set()  # lines of one softness and several slip speeds lie on each other
        for series in sorted({(softness_of(row), row["slip_speed_mm_per_s"]) for row in own}):
            line = [row for row in own if (softness_of(row), row["slip_speed_mm_per_s"]) == series]
            heights = [max(row["error"], least) for row in line]
            bars = [[height - max(row["error"] - row["band"], least) for row, height in zip(line, heights)],
                    [row["error"] + row["band"] - height for row, height in zip(line, heights)]]
            axes.errorbar([row["cpu_s"] for row in line], heights, yerr=bars, color=colour, marker=marker, markersize=5, linewidth=1,
                          capsize=2, elinewidth=0.8, label=name if series == min((softness_of(r), r["slip_speed_mm_per_s"]) for r in own) else None)
            last = max(line, key=lambda row: row["cpu_s"])
            if softness_of(last) in labelled:
                continue
            labelled.add(softness_of(last))
            axes.annotate(f"{float(softness_of(last)):.2g}", (last["cpu_s"], max(last["error"], least)), textcoords="offset points", xytext=(6, 3), fontsize=7,
                          color=colour)
    front = front_of(settings)
    axes.plot([row["cpu_s"] for row in front], [row["error"] + row["band"] for row in front], color="#444", linewidth=1.2, linestyle=":",
              label="front of |error| and band together")
    axes.axhline(chance, color="#888", linewidth=1, linestyle="--", label=f"chance of one run, {chance:.2g} %")
    axes.set(xscale="log", yscale="log", xlabel="CPU time of a run, s", ylabel="error of the rate, %", title=options.title)
    axes.margins(x=0.12)
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_locator(LogLocator(subs=(1, 2, 5)))
        axis.set_major_formatter("{x:g}")
        axis.set_minor_formatter(NullFormatter())
    axes.grid(True, which="both", linewidth=0.3)
    axes.legend(fontsize=8)
    figure.savefig(options.out, metadata={"Date": None} if options.out.endswith(".svg") else None, dpi=150)


LEVELS = (("draft", 3e-4, 12), ("design", 3e-5, 12), ("reference", 3e-6, 24))  # as src/scene/accuracy_level.hpp; a test compares


def level_rows(folder):
    """Of a folder of `vibrosow accuracy` that ran velocity Verlet at the levels' softness and steps: level, row, CPU time of a run (s). Where
    so few steps are not safe, as of grains, a level takes more, and so does its row."""
    table = list(zip(rows(f"{folder}/accuracy.csv"), rows(f"{folder}/accuracy_timing.csv")))
    for level, compression, steps in LEVELS:
        found = [(float(row["steps_per_contact"]), row, float(timing["cpu_s"])) for row, timing in table
                 if float(row["shell_compression"] or 0) == compression and float(row["steps_per_contact"]) >= steps and timing["cpu_s"]]
        if not found:
            raise SystemExit(f"{folder}/accuracy.csv: no fitted error at {level}: shell compression {compression:g}, {steps} steps a contact")
        yield level, *min(found, key=lambda one: one[0])[1:]


def accuracy_levels(options):
    """Gathers what the levels cost and err by in several FOLDERs of `vibrosow accuracy`, each of one scene, as levels.csv: the fitted error
    against the limit with its band, and the CPU time of a run, also over that of the reference."""
    lines = []
    for folder in options.folders:
        found = list(level_rows(folder))
        reference = found[-1][2]
        for level, row, seconds in found:
            error, band = float(row["fitted_error_percent"]), float(row["fitted_error_band95"])
            lines.append([folder, level, f"{float(row['steps_per_contact']):g}", row["rate_g_per_s"], f"{error:.2f}", f"{band:.2f}", f"{abs(error) + band:.2f}", f"{seconds:.3g}",
                          f"{seconds / reference:.3g}"])
    write_table("levels.csv", "scene,level,steps_per_contact,rate_g_per_s,error_percent,error_band95,error_bound_percent,cpu_s,cpu_over_reference", lines)


def softest(limit, terms, within):
    """The least shell compression at which the error of a rate limit + terms[0] sqrt(c) + terms[1] c passes so many percent; infinite: none."""
    compressions = np.geomspace(1e-7, 1e-1, 1201)
    errors = 100 * np.abs(terms[0] * np.sqrt(compressions) + terms[1] * compressions) / limit
    return compressions[np.argmax(errors > within)] if (errors > within).any() else math.inf


def softening(options):
    """How far the seeds of one scene can be softened: from all velocity Verlet runs of several FOLDERs of `vibrosow accuracy`.

    Writes softening.csv: the shell compression at which the rate is off by --within percent, with its 95 % interval, and how much less time a run
    takes there than at --own. Least squares of rate = limit + a sqrt(compression) + b compression + c / steps per contact, each run weighted by the
    length of its window; the interval is that of 10 000 draws of the coefficients."""
    runs = [row for folder in options.folders for row in rows(f"{folder}/accuracy_runs.csv")
            if row["integrator"] == "velocity-verlet" and row["rate_g_per_s"] and not row["reason"]]
    compression, steps, window, rate = (np.array([float(row[key]) for row in runs])
                                        for key in ("shell_compression", "steps_per_contact", "window", "rate_g_per_s"))
    columns = np.column_stack([np.ones(len(runs)), np.sqrt(compression), compression, 1 / steps])
    inverse = np.linalg.inv(columns.T @ (window[:, None] * columns))
    fit = inverse @ columns.T @ (window * rate)
    variance = np.sum(window * (rate - columns @ fit) ** 2) / (len(runs) - len(fit))
    draws = np.random.default_rng(1).multivariate_normal(fit, variance * inverse, 10000)
    found = softest(fit[0], fit[1:3], options.within)
    low, high = np.quantile([softest(draw[0], draw[1:3], options.within) for draw in draws], [0.025, 0.975], method="nearest")
    write_table("softening.csv", "within_percent,shell_compression,low95,high95,runs,times_as_fast_as_own,times_as_fast_low95",
                [[f"{options.within:g}", f"{found:.2g}", f"{low:.2g}", f"{high:.2g}", len(runs), f"{math.sqrt(found / options.own):.2g}",
                  f"{math.sqrt(low / options.own):.2g}"]])


PROMISES = ("scene,within_percent,random_seed,integrator,steps_per_contact,shell_compression,youngs_modulus_MPa,pilots,replicates,rate_g_per_s,"
            "promised_within_percent,error_percent,truth_half_width_percent,kept,cpu_s,refused")


def truth_of(folder):
    """Mean rate and half width of its 95 % interval, %, of a sweep of one layout; None where there is none."""
    if not folder.is_dir():
        return None, None
    (row,) = rows(f"{folder}/sweep.csv")
    return float(row["rate_g_per_s"]), 100 * float(row["rate_g_per_s_ci95"]) / float(row["rate_g_per_s"])


def promise_row(folder, truth, half_width):
    """A row of promises.csv, but for the scene: what the promise in `folder` says, and what it errs by against `truth`."""
    made = json.loads((folder / "promise.json").read_text(encoding="utf-8"))
    timing = json.loads((folder / "timing.json").read_text(encoding="utf-8"))
    seed = rows(folder / "accuracy_runs.csv")[0]["random_seed"]
    chosen = [made[key] for key in ("integrator", "steps_per_contact", "shell_compression", "youngs_modulus_MPa", "pilots", "replicates")]
    row = [f"{made['goal']['within_percent']:g}", seed, *chosen]
    known = "" if truth is None else f"{half_width:.2f}"
    if made["refused"] or made["rate_g_per_s"] is None:
        return [*row, "", "", "", known, "", f"{timing['run_cpu_s']:.3g}", made["refused"]]
    error = 100 * (made["rate_g_per_s"] / truth - 1)
    kept = "yes" if abs(error) <= made["goal"]["within_percent"] else "no"
    return [*row, f"{made['rate_g_per_s']:.6g}", f"{made['error_bound_percent']:.2f}", f"{error:.2f}", known, kept, f"{timing['run_cpu_s']:.3g}", ""]


def promises(options):
    """Holds promises of `vibrosow accuracy --within` against the truth. Each FOLDER is of one scene: `truth` in it is a sweep of its finest
    setting, without which it may hold promises that were refused alone, every other folder a promise.

    Writes promises.csv: what was chosen, its error against the truth, whose own half width is beside it, and whether it is within the error
    that was asked for."""
    lines = []
    for scene in map(Path, options.folders):
        truth, half_width = truth_of(scene / "truth")
        folders = sorted(path for path in scene.iterdir() if path.is_dir() and path.name != "truth")
        lines += [[scene.name, *promise_row(folder, truth, half_width)] for folder in folders]
    write_table("promises.csv", PROMISES, lines)


def add_commands(commands):
    draw = command(commands, "work-precision", work_precision)
    draw.add_argument("folder", metavar="FOLDER")
    draw.add_argument("out", metavar="OUT")
    draw.add_argument("--title", default="What accuracy costs in time")
    draw.add_argument("--least", type=float, default=0.01, help="errors below are drawn there, %%; default: %(default)s")

    levels = command(commands, "accuracy-levels", accuracy_levels)
    levels.add_argument("folders", metavar="FOLDER", nargs="+")

    kept = command(commands, "promises", promises)
    kept.add_argument("folders", metavar="FOLDER", nargs="+")

    soft = command(commands, "softening", softening)
    soft.add_argument("folders", metavar="FOLDER", nargs="+")
    soft.add_argument("--within", type=float, default=3, help="%%; default: %(default)s")
    soft.add_argument("--own", type=float, required=True, metavar="EPS/R", help="shell compression to compare times with")
