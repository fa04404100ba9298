"""Published relations, each as a number with its interval beside what is published of it."""
import math
import re
from dataclasses import dataclass
from pathlib import Path
from typing import Callable

import numpy as np
from scipy.optimize import brentq, minimize_scalar
from scipy.stats import beta, chi2
from scipy.stats import t as student

from .tables import command, rows, runs_within_the_model, write_table

REPORTS = Path(__file__).resolve().parents[2] / "reports"
DURATION, PAUSE = 4.0, 0.25  # s, of a run of silo-clogging, and run.end_after_pause
ENOUGH = 200  # seeds; To's hopper held 700, for which our runs are too short


@dataclass
class Estimate:
    """A number, its 95 % interval, and how many runs it is of."""
    value: float
    low: float
    high: float
    runs: int


@dataclass
class Published:
    """What is published of a number: the range in which it lies; both ends the same where it is a number itself."""
    low: float
    high: float

    def text(self):
        if self.low == self.high:
            return f"{self.low:g}"
        if self.high == math.inf:
            return f"above {self.low:g}"
        return f"below {self.high:g}" if self.low == 0 else f"{self.low:g} to {self.high:g}"

    def verdict(self, found):
        """Of a number: whether the interval has it, if it is no wider than a quarter of it to each side. Of a range: whether the whole
        interval, or none of it, lies in the range."""
        if self.low == self.high:
            if not found.low <= self.low <= found.high:
                return "does not hold"
            return "holds" if found.high - found.low <= 0.5 * self.low else "not resolved"
        if self.low <= found.low and found.high <= self.high:
            return "holds"
        return "does not hold" if found.high < self.low or found.low > self.high else "not resolved"


ABOVE_ONE, BELOW_ONE = Published(1, math.inf), Published(0, 1)
ALIKE, TENTH = Published(0.95, 1.05), Published(0.9, 1.1)  # "independent", "hardly changes" and "nearly" are in words alone


@dataclass
class Quantity:
    """`find` works it out from a folder of reports: of a study of this report, or of another report of the repository."""
    what: str
    published: Published
    study: str
    find: Callable
    of_another_report: bool = False

    def folder(self, reports):
        return REPORTS / self.study if self.of_another_report else f"{reports}/{self.study}"

    def command(self):
        if self.of_another_report:
            return f"scripts/make-reports {self.study}"
        return f"vibrosow sweep seeders/verification/studies/{self.study}.toml"


@dataclass
class Relation:
    statement: str
    source: str
    quantities: list


def layouts_of(folder, *keys):
    """The runs of each layout, by the values of these columns of sweep.csv."""
    runs = {}
    for run in runs_within_the_model(folder):
        runs.setdefault(run["layout"], []).append(run)
    return {tuple(row[key] for key in keys): runs[row["layout"]] for row in rows(f"{folder}/sweep.csv")}


def rates(runs):
    """Seeds a second."""
    return np.array([float(run["seeds_per_s"]) for run in runs])


def clogged(run):
    return "no grain left for" in run["note"]


def ratio(above, below):
    """Of two geometric means, of runs of unequal scatter (Welch 1947, Biometrika 34:28)."""
    a, b = np.log(above), np.log(below)
    var_a, var_b = (logs.var(ddof=1) / len(logs) for logs in (a, b))
    free = (var_a + var_b) ** 2 / (var_a ** 2 / (len(a) - 1) + var_b ** 2 / (len(b) - 1))
    half = student.ppf(0.975, free) * math.sqrt(var_a + var_b)
    middle = a.mean() - b.mean()
    return Estimate(*(math.exp(middle + add) for add in (0, -half, half)), len(a) + len(b))


def share(count, of):
    """Clopper and Pearson 1934, Biometrika 26:404."""
    low = beta.ppf(0.025, count, of - count + 1) if count else 0.0
    high = beta.ppf(0.975, count + 1, of - count) if count < of else 1.0
    return Estimate(count / of, low, high, of)


def exponent(folder):
    """p of the widest range that scripts/figures fit-outflow fitted."""
    row = rows(f"{folder}/fit.csv")[0]
    p, half = float(row["p"]), float(row["p_ci95"])
    return Estimate(p, p - half, p + half, int(row["runs"]))


def of_two_layouts(above, below):
    def find(folder):
        layouts = layouts_of(folder, "name")
        return ratio(rates(layouts[above,]), rates(layouts[below,]))
    return find


class Flows:
    """For how long (s) runs through one slot that flowed at a time after the slot opened flowed on, and whether a clog ended them."""

    def __init__(self, runs, after):
        ended = [re.search(r"ended at ([\d.]+) s", run["note"]) for run in runs]
        times = np.array([(float(found[1]) - PAUSE if found else DURATION) - after for found in ended])
        flowed = times > 0
        self.times, self.clogs = times[flowed], np.array([clogged(run) for run in runs])[flowed]

    def log_likelihood(self, shape):
        """Of Weibull's distribution with the scale that suits it best; a run that did not clog says that its flow lasts longer."""
        count = self.clogs.sum()
        scale = math.log(np.sum(self.times ** shape) / count)
        return count * (math.log(shape) - scale - 1) + (shape - 1) * np.sum(np.log(self.times[self.clogs]))


def survival_shape(after):
    """Weibull's shape of how long runs that flow at a time (s) flow on, the same for all slots: 1 where survival is exponential. Ends of the
    interval from the profile of the likelihood (Wilks 1938, Ann. Math. Stat. 9:60)."""
    def find(folder):
        slots = [Flows(runs, after) for runs in layouts_of(folder, "name").values()]

        def log_likelihood(shape):
            return sum(slot.log_likelihood(shape) for slot in slots)

        best = minimize_scalar(lambda shape: -log_likelihood(shape), bounds=(0.1, 10), method="bounded", options={"xatol": 1e-8}).x
        least = log_likelihood(best) - chi2.ppf(0.95, 1) / 2
        ends = [brentq(lambda shape: log_likelihood(shape) - least, *sorted((best, end))) for end in (0.1, 10)]
        return Estimate(best, *ends, sum(len(slot.times) for slot in slots))
    return find


def jammed(runs):
    """Of the runs, those that clogged before `ENOUGH` seeds had left."""
    return sum(clogged(run) and int(run["counted"]) < ENOUGH for run in runs)


def less_jamming(wide, narrow):
    """How much likelier the narrower slot jams: the difference of two shares (Newcombe 1998, Stat. Med. 17:873, his method 10, of
    Wilson's intervals)."""
    def find(folder):
        layouts = layouts_of(folder, "name")
        ends = []
        for name in (narrow, wide):
            runs = layouts[name,]
            n, p, z2 = len(runs), jammed(runs) / len(runs), 1.959964 ** 2
            middle, half = p + z2 / (2 * n), math.sqrt(z2) * math.sqrt(p * (1 - p) / n + z2 / (4 * n * n))
            ends.append((p, (middle - half) / (1 + z2 / n), (middle + half) / (1 + z2 / n), n))
        (p, p_low, p_high, n), (q, q_low, q_high, m) = ends
        return Estimate(p - q, p - q - math.hypot(p - p_low, q_high - q), p - q + math.hypot(p_high - p, q - q_low), n + m)
    return find


def by_speed(folder, direction=None):
    """Rates by peak speed (m/s), and there by frequency (Hz), of layouts that are called "0.2 m/s, 25 Hz"; of a study that varies the
    direction, of one of them."""
    speeds = {}
    for (name, *directions), runs in layouts_of(folder, "name", *(["tray.motion.direction_degree"] if direction else [])).items():
        if "," in name and directions in ([], [direction]):
            speed, frequency = (float(part.split()[0]) for part in name.split(","))
            speeds.setdefault(speed, {})[frequency] = rates(runs)
    return speeds


def at_speeds(above, below, direction=None):
    """Ratio of the rates at two peak speeds, over all frequencies."""
    def find(folder):
        speeds = by_speed(folder, direction)
        return ratio(*(np.concatenate(list(speeds[speed].values())) for speed in (above, below)))
    return find


def at_frequencies(above, below, chosen, direction=None):
    """Ratio of the rates at two frequencies, each over the mean of both at its peak speed, over the chosen speeds."""
    def find(folder):
        speeds, parts = by_speed(folder, direction), ([], [])
        for speed in chosen:
            both = [speeds[speed][frequency] for frequency in (above, below)]
            middle = np.mean([np.log(values).mean() for values in both])
            for part, values in zip(parts, both):
                part.append(values / math.exp(middle))
        return ratio(*(np.concatenate(part) for part in parts))
    return find


def flowing(name, width_mm):
    """Share of the runs that no clog ended."""
    def find(folder):
        runs = layouts_of(folder, "name", "tray.holes.width_mm")[name, width_mm]
        return share(sum(not clogged(run) for run in runs), len(runs))
    return find


def shaken_over_still(name, width_mm):
    def find(folder):
        layouts = layouts_of(folder, "name", "tray.holes.width_mm")
        return ratio(rates(layouts[name, width_mm]), rates(layouts["still", width_mm]))
    return find


def least_over_still(folder):
    least = min((np.concatenate(list(at.values())) for at in by_speed(folder).values()), key=lambda values: np.log(values).mean())
    return ratio(least, rates(layouts_of(folder, "name")["still",]))


def carried(direction):
    """Speed along the tray over the vendor's 3.81 N S: the seeds that the longer tray holds more are its rate times their time on the way
    that it is longer."""
    further_m, vendor_m_per_s = 0.3, 3.81 * 10 * 0.010  # 10 Hz, 10 mm

    def find(folder):
        layouts = layouts_of(folder, "name", "tray.motion.direction_degree")
        short, long = layouts["short", direction], layouts["long", direction]
        held = [np.array([float(run["inside"]) for run in runs]) for runs in (short, long)]
        rate = np.concatenate([rates(short), rates(long)]).mean()
        half = student.ppf(0.975, len(short) + len(long) - 2) * math.sqrt(sum(values.var(ddof=1) / len(values) for values in held))
        more = held[1].mean() - held[0].mean()
        return Estimate(*(further_m * rate / seeds / vendor_m_per_s for seeds in (more, more + half, more - half)), len(short) + len(long))
    return find


RELATIONS = [
    Relation("Above 1.2 widths of depth, and at least as wide as its outlet and 30 grains, a silo's rate depends on neither",
             "Mankoc et al. 2007, doi:10.1007/s10035-007-0062-2", [
                 Quantity("rate from 2.4 over that from 1.2 widths of depth, slot of 8 d in 20 d, discs that roll freely", ALIKE, "silo-size",
                          of_two_layouts("rolls freely, 2.4 widths deep", "rolls freely, 1.2 widths deep")),
                 Quantity("rate from 2.4 over that from 1.2 widths of depth, slot of 8 d in 20 d, rolling friction of 0.1", ALIKE, "silo-size",
                          of_two_layouts("rolling friction, 2.4 widths deep", "rolling friction, 1.2 widths deep")),
                 Quantity("rate of a silo 50 d wide over that of one of 38 d, slot of 8 d, rolling friction of 0.1", ALIKE, "silo-size",
                          of_two_layouts("rolling friction, 50 d wide", "rolling friction, 38 d wide")),
             ]),
    Relation("The rate goes as (D - k d)^p, p = 3/2 for a slot in the plane, 5/2 for a hole in space",
             "Beverloo et al. 1961, doi:10.1016/0009-2509(61)85030-6; arXiv:0707.4550", [
                 Quantity("p of slots of 5 to 20 d", Published(1.5, 1.5), "silo", exponent, True),
                 Quantity("p of round holes of 5 to 16 d", Published(2.5, 2.5), "round-holes", exponent, True),
             ]),
    Relation("A flow that may clog survives for a time t with probability exp(-t / tau)",
             "Tang, Sagdiphour, Behringer 2009, AIP (abstract)", [
                 Quantity("Weibull's shape of how long a flow lasts from 0.1 s on, slots of 3 to 4 d (1: exponential)", Published(1, 1),
                          "silo-clogging", survival_shape(0.1)),
                 Quantity("Weibull's shape of how long a flow lasts from 0.2 s on, slots of 3 to 4 d (1: exponential)", Published(1, 1),
                          "silo-clogging", survival_shape(0.2)),
             ]),
    Relation("A hopper jams less often the wider its slot", "To 2002, Chin. J. Phys. 40:379 (abstract)", [
        Quantity(f"share of runs that jam before {ENOUGH} seeds have left, at 3 d less at 3.5 d", Published(0, math.inf), "silo-clogging",
                 less_jamming("3.5 d", "3 d")),
        Quantity(f"share of runs that jam before {ENOUGH} seeds have left, at 3.5 d less at 4 d", Published(0, math.inf), "silo-clogging",
                 less_jamming("4 d", "3.5 d")),
    ]),
    Relation("What passes a hole of a shaken tray is set by the peak speed, whatever the frequency; it falls with it, then hardly changes",
             "'Flux through a hole from a shaken granular medium' (abstract)", [
                 Quantity("upright, 0.1 to 0.4 m/s: rate at 40 over that at 15 Hz", TENTH, "shaken-slot", at_frequencies(40, 15, (0.1, 0.2, 0.4), "90")),
                 Quantity("upright, 0.8 m/s: rate at 40 over that at 15 Hz", TENTH, "shaken-slot", at_frequencies(40, 15, (0.8,), "90")),
                 Quantity("upright: rate at 0.4 over that at 0.1 m/s", BELOW_ONE, "shaken-slot", at_speeds(0.4, 0.1, "90")),
                 Quantity("upright: rate at 0.8 over that at 0.4 m/s", TENTH, "shaken-slot", at_speeds(0.8, 0.4, "90")),
                 Quantity("along the floor, 0.1 to 0.8 m/s: rate at 40 over that at 15 Hz", TENTH, "shaken-slot",
                          at_frequencies(40, 15, (0.1, 0.2, 0.4, 0.8), "0")),
                 Quantity("along the floor: rate at 0.8 over that at 0.1 m/s", BELOW_ONE, "shaken-slot", at_speeds(0.8, 0.1, "0")),
             ]),
    Relation("Shaken, a hopper flows through openings that clog it, down to one grain; where it flows its rate is hardly another",
             "Janda et al. 2009, doi:10.1209/0295-5075/87/24002 (abstract)", [
                 Quantity("share of runs without a pause of 0.4 s in 2 s, slot of 3 d, still", Published(0, 0.5), "shaken-silo", flowing("still", "12")),
                 Quantity("share of runs without a pause of 0.4 s in 2 s, slot of 3 d, shaken with g", Published(0.5, 1), "shaken-silo", flowing("g", "12")),
                 Quantity("share of runs without a pause of 0.4 s in 2 s, slot of 3 d, shaken with 4 g", Published(0.5, 1), "shaken-silo", flowing("4 g", "12")),
                 Quantity("share of runs without a pause of 0.4 s in 2 s, slot of 2 d, shaken with 4 g", Published(0.5, 1), "shaken-silo", flowing("4 g", "8")),
                 Quantity("share of runs without a pause of 0.4 s in 2 s, slot of 1.5 d, shaken with 4 g", Published(0.5, 1), "shaken-silo", flowing("4 g", "6")),
                 Quantity("rate through a slot of 6 d, shaken with 4 g over still", TENTH, "shaken-silo", shaken_over_still("4 g", "24")),
             ]),
    Relation("Shaken ever harder, a silo's flow first falls, then rises", "Pascot et al. 2020, doi:10.1016/j.ces.2020.115749 (abstract)", [
        Quantity("upright, slot of 6 d: smallest rate at 0.1 to 1.2 m/s over that of the still silo", BELOW_ONE, "shaken-silo-strength",
                 least_over_still),
        Quantity("upright, slot of 6 d: rate at 1.2 over that at 0.6 m/s", ABOVE_ONE, "shaken-silo-strength", at_speeds(1.2, 0.6)),
    ]),
    Relation("Dry rapeseed flows faster than wet", "'Discharge of rapeseeds from a model silo: physical testing and DEM' (abstract)", [
        Quantity("rate with dry seed's friction over that with wet seed's, aperture of 6.7 d in space", ABOVE_ONE, "rapeseed-bin",
                 of_two_layouts("dry, square", "wet, square")),
    ]),
    Relation("Of apertures of one area the round one passes more than the square", "Kalantari & Tolouti 2013, IJAPP 4(8):1997 (abstract)", [
        Quantity("rate of the round over that of the square aperture, 6.7 d in space", ABOVE_ONE, "rapeseed-bin",
                 of_two_layouts("dry, round", "dry, square")),
    ]),
    Relation("A vibrating conveyor carries at 70 to 80 % of 3.81 N S", "Daesung Machinery, www.dsv.co.kr (vendor's page)", [
        Quantity("speed over 3.81 N S, 10 Hz and 10 mm at 20 degrees", Published(0.7, 0.8), "conveyor", carried("20")),
        Quantity("speed over 3.81 N S, 10 Hz and 10 mm at 30 degrees", Published(0.7, 0.8), "conveyor", carried("30")),
    ]),
]


def published_relations(options):
    """Compares ten published relations with what comes out of the studies made for them.

    REPORTS: a folder with the reports of these studies. Writes relations.csv into it: a row per number, with what is published of it, its
    95 % interval and a verdict. Of a published range: it holds where the whole interval lies in it, it does not where none of it does,
    else it is not resolved. Of a published number: it holds where the interval has it and is no wider than a quarter of it to each side; it
    does not where the interval has it not. Ratios are of geometric means of the runs (Welch)."""
    lines = []
    for number, relation in enumerate(RELATIONS, 1):
        for quantity in relation.quantities:
            found = quantity.find(quantity.folder(options.reports))
            lines.append([number, relation.statement, relation.source, quantity.what, quantity.published.text(), f"{found.value:.3g}",
                          f"{found.low:.3g}", f"{found.high:.3g}", quantity.published.verdict(found), found.runs, quantity.command()])
    write_table(f"{options.reports}/relations.csv", "relation,statement,source,number,published,value,ci95_low,ci95_high,verdict,runs,command", lines)


def add_commands(commands):
    parser = command(commands, "published-relations", published_relations)
    parser.add_argument("reports", metavar="REPORTS")
