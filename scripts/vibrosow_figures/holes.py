"""The table of one hole: what a round hole of a shaken tray lets through, in units in which the seeds' size falls out."""
import csv
import json
import math
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
from scipy.stats import t as student

from .tables import command, rows

GRAVITY = 9.81  # m/s2
POURED = 0.6  # packing fraction by which the number of seeds is called a depth
STANDS_STILL = 10  # sqrt(d / g); in that time a seed falls 50 diameters
WINDOWS = 10  # equal parts of the measuring window
CONTACT = ("friction", "wall_friction", "rolling_friction", "restitution")

HEADER = ("aspect,width_over_d,peak_speed,depth_over_d,amplitude_over_d,friction,wall_friction,rolling_friction,restitution,runs,seeds,outflow,outflow_ci95,dispersion,longest_pause,"
          "stood_still,watched").split(",")


class Hole:
    """One hole in one run; times in sqrt(d / g)."""

    def __init__(self, times, start, end):
        inside = [time for time in times if start <= time <= end]
        self.seeds, self.watched = len(inside), end - start
        self.longest_pause = float(np.max(np.diff([start, *inside, end])))
        self.counts = np.histogram(inside, bins=WINDOWS, range=(start, end))[0]


def holes_of(run, scene, unit):
    """Of an exported run; a time unit in s."""
    start, end = (time / unit for time in run["outflow"]["window_s"])
    events = rows(Path(run["folder"]) / "outflow.csv")
    times = {str(number + 1): [] for number in range(len(scene["tray"]["holes"]))}
    for event in events:
        if event["hole"] in times:
            times[event["hole"]].append(float(event["time_s"]) / unit)
    return [Hole(ascending, start, end) for ascending in times.values()]


def conditions_of(scene, diameter):
    """(width over d, peak speed over sqrt(g d), depth over d, amplitude over d, and the contact)"""
    tray, contact = scene["tray"], scene["contact"]
    motion, floor = tray["motion"], tray["length_m"] * tray["depth_m"]
    (width,) = {hole["width_m"] for hole in tray["holes"]}
    speed = 2 * math.pi * motion["frequency_hz"] * motion["amplitude_m"]
    depth = tray["fill"]["count"] * math.pi / 6 * diameter**3 / (POURED * floor)
    return tuple(float(f"{value:.3g}") for value in
                 (width / diameter, speed / math.sqrt(GRAVITY * diameter), depth / diameter, motion["amplitude_m"] / diameter,
                  contact["seed"]["friction"], contact["wall"]["friction"], contact["seed"].get("rolling_friction", 0), contact["seed"]["restitution"]))


def exported(program, folder, name, diameter):
    """(conditions, holes) of a kept run."""
    with tempfile.TemporaryDirectory(prefix="one-hole-") as scratch:
        made = subprocess.run([program, "export", folder, "--run", name, "--out", f"{scratch}/run"], capture_output=True, text=True)
        if made.returncode != 0:
            sys.exit(f"scripts/figures: {made.stderr.strip()}")
        run = json.loads(Path(f"{scratch}/run/run.json").read_text(encoding="utf-8"))
        if run["status"] != "finished" or run["outside_the_model"]:
            sys.exit(f"scripts/figures: {folder}: run {name} is {run['status']}, or outside the model: nothing is decided by it")
        run["folder"] = f"{scratch}/run"
        return conditions_of(run["scene"], diameter), holes_of(run, run["scene"], math.sqrt(diameter / GRAVITY))


def runs_of(program, folder, diameter):
    """The runs of a sweep's plan by their conditions: a list of runs, each a list of holes."""
    cases = Path(folder) / "cases"
    plan = json.loads((cases / "plans" / f"{(cases / 'plan').read_text(encoding='utf-8').strip()}.json").read_text(encoding="utf-8"))
    names = [name for group in plan["runs"] for name in group["cases"].split()]
    by_conditions = {}
    with ThreadPoolExecutor() as run_in_parallel:
        for conditions, holes in run_in_parallel.map(lambda name: exported(program, folder, name, diameter), names):
            by_conditions.setdefault(conditions, []).append(holes)
    return dict(sorted(by_conditions.items()))


def relative_half_widths(by_conditions):
    """Of each condition's outflow. Counts of a run scatter by a factor times their mean, the same for all runs of a sweep: of two or
    three runs alone Student's t would make much of little."""
    counts = {conditions: np.array([sum(hole.seeds for hole in run) for run in runs]) for conditions, runs in by_conditions.items()}
    freedom = sum(len(runs) - 1 for runs in counts.values())
    factor = sum(np.sum((runs - np.mean(runs)) ** 2) / np.mean(runs) for runs in counts.values()) / freedom
    return {conditions: student.ppf(0.975, freedom) * math.sqrt(factor / np.sum(runs)) for conditions, runs in counts.items()}


def line_of(aspect, conditions, runs, relative_half_width):
    holes = [hole for run in runs for hole in run]
    seeds, watched = sum(hole.seeds for hole in holes), sum(hole.watched for hole in holes)
    if seeds == 0:
        sys.exit(f"scripts/figures: no seed left the holes of width, speed and depth {conditions[:3]}: there is no outflow to look up")
    outflow = seeds / watched
    means = [np.mean(hole.counts) for hole in holes]
    dispersion = sum(np.var(hole.counts, ddof=1) for hole in holes) / sum(means)
    still = sum(hole.longest_pause > STANDS_STILL for hole in holes) / len(holes)
    numbers = [outflow, relative_half_width * outflow, dispersion, max(hole.longest_pause for hole in holes), still, watched]
    return [f"{aspect:g}", *(f"{value:g}" for value in conditions), len(runs), seeds,
            *(f"{value:.4g}" for value in numbers)]


def hole_table(options):
    """The table of one hole, from sweeps of seeders/one-hole.toml that vary its width, the frequency, the bed's depth and the contact.

    SHAPE=FOLDER: how many times a seed is as long as wide, and a folder of `vibrosow sweep` with every run of its plan. Prints CSV, a
    row per shape, hole width, peak speed, depth of the bed and contact of the seeds; d is the diameter of the ball of a seed's volume, and speeds are in
    sqrt(g d), times in sqrt(d / g): outflow is seeds per hole in such a time, with the half width of its 95 % interval (from the
    scatter between runs, pooled over all runs of a sweep); dispersion is the variance over the mean of a hole's counts in tenths of the
    window (1 for seeds that come at random); longest_pause the longest of any hole; stood_still the share of holes that once let nothing
    through for 10; watched the time of all holes together."""
    out = csv.writer(sys.stdout, lineterminator="\n")
    out.writerow(HEADER)
    for shape in options.shapes:
        aspect, folder = shape.split("=", 1)
        by_conditions = runs_of(options.program, folder, options.diameter_mm * 1e-3)
        halves = relative_half_widths(by_conditions)
        for conditions, runs in by_conditions.items():
            out.writerow(line_of(float(aspect), conditions, runs, halves[conditions]))


def contact_slopes(options):
    """What a contact does to the outflow of one hole, by least squares over the rows of a table with other contacts, as `vibrosow plan` fits them:
    ln(outflow) = what belongs to the setting + slopes. Prints CSV, a row per shape and part of the contact: the slope, its half width (95 %,
    Student's t), and by how many percent the outflow changes from `from` to `to`, the least and the most that were tried."""
    out = csv.writer(sys.stdout, lineterminator="\n")
    out.writerow("aspect,part,slope,slope_ci95,from,to,change_percent,change_ci95_percent".split(","))
    table = rows(options.table)
    for aspect in sorted({row["aspect"] for row in table}, key=float):
        of_shape = [row for row in table if row["aspect"] == aspect]
        settings = sorted({(row["width_over_d"], row["peak_speed"]) for row in of_shape})
        terms = np.array([[(math.log if part == "friction" else float)(float(row[part])) for part in CONTACT]
                          + [(row["width_over_d"], row["peak_speed"]) == setting for setting in settings] for row in of_shape])
        outflows = np.log([float(row["outflow"]) for row in of_shape])
        found = np.linalg.lstsq(terms, outflows, rcond=None)[0]
        freedom = len(of_shape) - terms.shape[1]
        covariance = np.sum((outflows - terms @ found) ** 2) / freedom * np.linalg.inv(terms.T @ terms)
        for k, part in enumerate(CONTACT):
            half, values = student.ppf(0.975, freedom) * math.sqrt(covariance[k, k]), [float(row[part]) for row in of_shape]
            change = np.ptp(terms[:, k])
            out.writerow([aspect, part, f"{found[k]:.3g}", f"{half:.2g}", f"{min(values):g}", f"{max(values):g}",
                          f"{100 * math.expm1(found[k] * change):.2g}", f"{100 * half * change * math.exp(found[k] * change):.2g}"])


def add_commands(commands):
    parser = command(commands, "contact-slopes", contact_slopes)
    parser.add_argument("table", help="models/outflow/one-hole-contacts.csv")
    parser = command(commands, "hole-table", hole_table)
    parser.add_argument("--diameter-mm", type=float, required=True, help="d, of the ball of a seed's volume")
    parser.add_argument("program", metavar="VIBROSOW")
    parser.add_argument("shapes", nargs="+", metavar="SHAPE=FOLDER")
