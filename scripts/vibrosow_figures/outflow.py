"""Rates of a silo through slots of several widths, and slopes of measured and simulated discharge curves."""
import math
import re
import sys

import numpy as np
from scipy.optimize import curve_fit
from scipy.stats import linregress
from scipy.stats import t as student

from .tables import command, mean_and_half_width, rows, runs_within_the_model, write_table

GRAVITY = 9.81  # m/s2


def weights_of(by_slot, slots):
    """Scatter of the logarithms of each run's slot; none, so that all runs count alike, where five runs of a slot do not tell it."""
    if any(len(by_slot[at]) < 5 for at in slots):
        return None
    return np.concatenate([np.full(len(by_slot[at]), np.std(np.log(by_slot[at]), ddof=1)) for at in slots])


def fit(by_slot, slots, unit, exponent=None):
    """(C, k, p) and the half widths of their intervals; rates in `unit` (1/s). An exponent that is given has no interval."""
    widths = np.concatenate([np.full(len(by_slot[at]), at) for at in slots])
    logs = np.concatenate([np.log(np.array(by_slot[at]) / unit) for at in slots])
    free = 2 if exponent else 3
    bounds = ((-np.inf, -3, 0)[:free], (np.inf, slots[0] - 0.05, 5)[:free])
    found, covariance = curve_fit(lambda width, log_c, k, p=exponent: log_c + p * np.log(width - k), widths, logs, p0=(0, 1, 1.5)[:free],
                                  sigma=weights_of(by_slot, slots), bounds=bounds, xtol=1e-12, ftol=1e-12)
    half = student.ppf(0.975, len(logs) - free) * np.sqrt(np.diag(covariance))
    c = math.exp(found[0])
    return (c, found[1], exponent or found[2]), (c * half[0], half[1], 0 if exponent else half[2])


def ranges(values, least):
    """Of neighbouring values, at least so many, the longest first."""
    return [values[k:k + length] for length in range(len(values), least - 1, -1) for k in range(len(values) - length + 1)]


def read_runs(folder, fill, flowing, clogged):
    """Adds rates (1/s) of the runs that flowed to their end, and numbers of the others, by the layout's name. Ends the program
    where neither the study nor `fill` tells how many grains the silo is kept at."""
    layouts = rows(f"{folder}/sweep.csv")
    if fill is None and "tray.fill.count" not in layouts[0]:
        sys.exit(f"{folder}/sweep.csv: no column tray.fill.count; --fill is needed")
    filled = {r["layout"]: int(r.get("tray.fill.count", fill)) for r in layouts}
    for r in runs_within_the_model(folder):
        rates = flowing.setdefault(r["name"], [])
        clogged.setdefault(r["name"], 0)
        if int(r["inside"]) > filled[r["layout"]]:
            rates.append(float(r["seeds_per_s"]))
        else:
            clogged[r["name"]] += 1


def slot_of(name):
    """Width in diameters that a layout's name gives; None: it is not to be fitted."""
    named = re.fullmatch(r"([0-9.]+) d", name)
    return float(named[1]) if named else None


def write_fits(path, flowing, unit, exponent):
    """Fits of each range of slots, and of the widest with the exponent given, if any; returns the rates that the widest range's
    fit has."""
    by_slot = {slot_of(name): rates for name, rates in flowing.items() if slot_of(name) and rates}
    fitted, lines = {}, []
    if len(by_slot) < 3:
        return fitted
    widest = sorted(by_slot)
    for slots, p in [*((slots, None) for slots in ranges(widest, min(4, len(by_slot)))), *([(widest, exponent)] if exponent else [])]:
        values, halves = fit(by_slot, slots, unit, p)
        cells = [f"{number:.4f}" for pair in zip(values, halves) for number in pair]
        lines.append([f"{slots[0]:g}-{slots[-1]:g} d", sum(len(by_slot[at]) for at in slots), *cells])
        c, k, p = values
        fitted = fitted or {at: c * unit * (at - k) ** p for at in slots}
    write_table(path, "slots,runs,C,C_ci95,k,k_ci95,p,p_ci95", lines)
    return fitted


def rate_cells(rates, fitted):
    """Mean, its interval in percent, the fitted rate, and how far the mean is off it in percent; empty where there is none."""
    if not rates:
        return [""] * 4
    mean, half = mean_and_half_width(rates)
    interval = "" if half is None else f"{100 * half / mean:.2f}"
    return [f"{mean:.2f}", interval, *(["", ""] if fitted is None else [f"{fitted:.2f}", f"{100 * (mean / fitted - 1):.2f}"])]


def fit_outflow(options):
    """Fits seeds/s = C sqrt(g / d) (D / d - k)^p to the slots of a silo's study, with C, k and p free.

    This is Beverloo's form; p is 3/2 in a plane where grains fall freely from an arch as wide as the slot.
    REPORTS: a folder made by `vibrosow sweep`, and folders with more runs. Writes rates.csv, every layout's rate, into the first.
    Layouts that are called "5 d", "7 d", .. are fitted, if there are three or more: fit.csv, of each range of four neighbouring
    slots or more (of three, if that is all), the widest first; with --exponent P also all of them with p = P, whose interval is then 0. A run that ends with no more grains than its fill has none
    between floor and counter: it has clogged, is left out and counted. Least squares of the logarithms of all other runs, each
    with the inverse of the variance among its slot's runs as weight, where every slot has five: runs of a narrow slot scatter three
    times as much as those of a wide one. Intervals (95 %) from the fit's covariance and Student's t."""
    folder = options.reports[0]
    unit = math.sqrt(GRAVITY / (options.diameter_mm * 1e-3))
    flowing, clogged = {}, {}
    for more in options.reports:
        read_runs(more, options.fill, flowing, clogged)
    fitted = write_fits(f"{folder}/fit.csv", flowing, unit, options.exponent)
    write_table(f"{folder}/rates.csv", "name,runs,clogged,seeds_per_s,ci95_percent,fitted_seeds_per_s,difference_percent",
                [[name, len(rates), clogged[name], *rate_cells(rates, fitted.get(slot_of(name)))] for name, rates in flowing.items()])


def outflow_slope(options):
    """Slopes of the measured and the simulated curve between two times, from a study's comparison.csv.

    Least squares. Writes slope.csv into REPORTS: in the measured quantity's unit per second, and how far the simulated slope is
    off."""
    chosen = [r for r in rows(f"{options.reports}/comparison.csv") if options.start <= float(r["time_s"]) <= options.end]
    lines = []
    for layout in sorted({r["layout"] for r in chosen}, key=int):
        own = [r for r in chosen if r["layout"] == layout]
        times = [float(r["time_s"]) for r in own]
        measured, simulated = (linregress(times, [float(r[name]) for r in own]).slope for name in ("measured", "simulated"))
        lines.append([layout, f"{options.start:g}", f"{options.end:g}", f"{measured:.2f}", f"{simulated:.2f}",
                      f"{100 * (simulated / measured - 1):.1f}"])
    write_table(f"{options.reports}/slope.csv", "layout,from_s,to_s,measured_per_s,simulated_per_s,difference_percent", lines)


# Of the measured slot hopper, mm: (number, volume in mm3). Sizes and numbers: the demos of projectchrono/DEM-Engine.
BALLS = (14000, math.pi / 6 * 6**3)
CYLINDERS = {"plastic, 4 x 8 mm": (22000, math.pi * 2**2 * 8), "wood, 4 x 8.5 mm": (20000, math.pi * 2**2 * 8.5)}
SLOT_MM, MEASURED_PERCENT_PER_S = 40, 19.1


def cylinders_from_balls(options):
    """What the measured slot hopper would let through of cylinders, if they flowed as its balls do: percent of their mass a second.

    A slot lets through C n (D - k d)^(3/2) of solid volume (Beverloo, Leniger & van de Velde 1961), with d of the ball of a cylinder's volume and
    the balls' own C and packing fraction n, k 1.2 to 1.6. Friction and shape are not in it: more of either flows more slowly."""
    def diameter(volume):
        return (6 * volume / math.pi) ** (1 / 3)

    count, volume = BALLS
    table = []
    for name, (number, own) in CYLINDERS.items():
        rates = [MEASURED_PERCENT_PER_S * count * volume / (number * own)
                 * ((SLOT_MM - k * diameter(own)) / (SLOT_MM - k * diameter(volume))) ** 1.5 for k in (1.2, 1.4, 1.6)]
        table.append([name, f"{diameter(own):.3g}", *(f"{rate:.3g}" for rate in (rates[1], min(rates), max(rates)))])
    write_table(options.table, "cylinders,ball_of_their_volume_mm,percent_per_s,percent_per_s_low,percent_per_s_high", table)


def add_commands(commands):
    parser = command(commands, "cylinders-from-balls", cylinders_from_balls)
    parser.add_argument("table", metavar="CSV")
    parser = command(commands, "fit-outflow", fit_outflow)
    parser.add_argument("--diameter-mm", type=float, required=True, help="d, mean diameter of the grains")
    parser.add_argument("--exponent", type=float, help="also a fit with this p held fast")
    parser.add_argument("--fill", type=int, help="grains that the silo is kept at, where the studies do not vary it")
    parser.add_argument("reports", nargs="+", metavar="REPORTS")
    parser = command(commands, "outflow-slope", outflow_slope)
    parser.add_argument("reports", metavar="REPORTS")
    parser.add_argument("start", type=float, metavar="FROM_S")
    parser.add_argument("end", type=float, metavar="TO_S")
