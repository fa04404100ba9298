"""Whether two sweeps rank the same layouts alike."""
import math
from itertools import combinations

import numpy as np
from scipy.stats import kendalltau, rankdata
from scipy.stats import t as student

from .bench import conditions_of
from .tables import command, rows, runs_within_the_model, write_table


def logs_of_rates(folder):
    """Logarithms of every run's rate of the tray (g/s), a list per layout. Ends the program where a run has none."""
    found = {}
    for run in runs_within_the_model(folder):
        if not run["tray_rate_g_per_s"] or float(run["tray_rate_g_per_s"]) <= 0:
            raise SystemExit(f"{folder}/sweep_runs.csv: layout {run['layout']} has a run without a rate of the tray")
        found.setdefault(run["layout"], []).append(math.log(float(run["tray_rate_g_per_s"])))
    return found


class Sweep:
    """Mean logarithms of the layouts' rates, and the half width of a difference of two of them: from the scatter of all layouts'
    runs together, which is alike for all."""

    def __init__(self, folder):
        logs = logs_of_rates(folder)
        runs = [len(values) for values in logs.values()]
        free = sum(runs) - len(runs)
        self.variance = sum(np.var(values) * len(values) for values in logs.values()) / free
        self.mean = {name: np.mean(values) for name, values in logs.items()}
        self.free = free
        self.quantile = student.ppf(0.975, free)
        self.runs = dict(zip(logs, runs))

    def half_width(self, *layouts):
        return self.quantile * math.sqrt(sum(self.variance / self.runs[name] for name in layouts))

    def order(self, one, other):
        """1 or -1: which is larger, beyond chance; 0: neither."""
        difference = self.mean[one] - self.mean[other]
        return 0 if abs(difference) < self.half_width(one, other) else int(math.copysign(1, difference))


    def surprise(self, one, other):
        """The probability of a difference as large as this or larger between equal layouts."""
        error = math.sqrt(sum(self.variance / self.runs[name] for name in (one, other)))
        return 2 * student.sf(abs(self.mean[one] - self.mean[other]) / error, self.free)

    def sure_of_all(self, pairs):
        """How many pairs differ where all claims together are wrong in 5 % of studies (Holm 1979)."""
        surprises = sorted(self.surprise(*pair) for pair in pairs)
        fails = [k for k, surprise in enumerate(surprises) if surprise > 0.05 / (len(surprises) - k)]
        return fails[0] if fails else len(surprises)


def counted(what, pairs, space, plane):
    """A line of rankings.csv."""
    told = [(space.order(*pair), plane.order(*pair)) for pair in pairs]
    differ = [both for both in told if both[0] != 0]
    return [what, len(pairs), len(differ), sum(a == b for a, b in differ), sum(b == 0 for _, b in differ),
            sum(a == -b for a, b in differ), sum(a == 0 and b != 0 for a, b in told), space.sure_of_all(pairs)]


def compare_rankings(options):
    """Compares how two sweeps of the same layouts, SPACE and PLANE, rank them by the tray's rate.

    Writes into OUT spaces.csv, both rates of every layout (geometric means of the runs), their ratio and ranks, and rankings.csv: of the pairs of layouts, all and those
    that differ in one key alone, how many differ beyond chance (95 %) in space, and in which order the plane has those: the same, none
    beyond chance, the other way round; how many differ in the plane alone; and how many differ in space where all claims of a line
    together are wrong in 5 % of studies. The last column of its first row is Kendall's tau."""
    varied, conditions = conditions_of(rows(f"{options.space}/sweep.csv"))
    if conditions != conditions_of(rows(f"{options.plane}/sweep.csv"))[1]:
        raise SystemExit(f"{options.plane}/sweep.csv: other layouts than in {options.space}/sweep.csv")
    space, plane = Sweep(options.space), Sweep(options.plane)
    names = list(conditions)
    ranks = [rankdata([-sweep.mean[name] for name in names]) for sweep in (space, plane)]
    lines = []
    for name, of_space, of_plane in zip(names, *ranks):
        cells = [f"{math.exp(sweep.mean[name]):.4g}" for sweep in (space, plane)]
        percents = [f"{100 * sweep.half_width(name):.2g}" for sweep in (space, plane)]
        lines.append([*conditions[name], cells[0], percents[0], cells[1], percents[1],
                      f"{math.exp(plane.mean[name] - space.mean[name]):.3f}", f"{of_space:g}", f"{of_plane:g}"])
    write_table(f"{options.out}/spaces.csv",
                ",".join([*varied, "space_g_per_s,space_ci95_percent,plane_g_per_s,plane_ci95_percent,plane_over_space,rank_in_space,rank_in_plane"]),
                lines)
    pairs = list(combinations(names, 2))
    tau = kendalltau(*ranks).statistic
    counts = [[*counted("all", pairs, space, plane), f"{tau:.2f}"]]
    for place, key in enumerate(varied):
        alone = [(a, b) for a, b in pairs if all((x != y) == (at == place) for at, (x, y) in enumerate(zip(conditions[a], conditions[b])))]
        counts.append([*counted(key, alone, space, plane), ""])
    write_table(f"{options.out}/rankings.csv", "pairs_differ_in,pairs,differ_in_space,same_in_plane,alike_in_plane,reversed_in_plane,"
                "differ_in_plane_alone,differ_in_space_all_claims_right,kendall_tau", counts)


def add_commands(commands):
    parser = command(commands, "compare-rankings", compare_rankings)
    parser.add_argument("space", metavar="SPACE", help="a folder made by vibrosow sweep")
    parser.add_argument("plane", metavar="PLANE")
    parser.add_argument("out", metavar="OUT")
