"""A made-up bench table, to show how a measured one is compared."""
import csv
import sys

from .tables import command, rows


def uniform_numbers(state):
    """Park and Miller 1988, Commun. ACM 31(10): integers alone, so the same table on every machine and Python."""
    while True:
        state = state * 16807 % 2147483647
        yield state / 2147483647


def conditions_of(layouts):
    """The names of the varied keys, which stand in sweep.csv between `reason` and `replicates`, and their values by layout."""
    names = list(layouts[0])
    varied = names[names.index("reason") + 1:names.index("replicates")]
    return varied, {r["layout"]: [r[name] for name in varied] for r in layouts}


def synthetic_bench(options):
    """Makes a SYNTHETIC bench table, not a measurement, from a sweep's reports. It validates nothing.

    Multiplies the rate of every hole by a known factor and adds known noise, evenly spread. Writes CSV to standard output."""
    varied, conditions = conditions_of(rows(f"{options.reports}/sweep.csv"))
    random = uniform_numbers(options.noise_seed)
    # A rate of zero has no relative misfit.
    holes = [r for r in rows(f"{options.reports}/sweep_holes.csv") if r["hole"].isdigit() and float(r["rate_g_per_s"]) != 0]
    if not holes:
        sys.exit(f"{options.reports}/sweep_holes.csv: no hole has a rate")
    print("# SYNTHETIC, not a measurement, never to be quoted as validation. Made by scripts/make-reports wheat-bench-synthetic:")
    print(f"# the simulated rates of {options.study} times {options.factor:g}, each reading off by up to {100 * options.noise:g} % at random.")
    table = csv.writer(sys.stdout, lineterminator="\n")
    table.writerow([*varied, "hole", "repeat", "rate_g_per_s"])
    for r in holes:
        for repeat in range(1, options.repeats + 1):
            rate = float(r["rate_g_per_s"]) * options.factor * (1 + options.noise * (2 * next(random) - 1))
            table.writerow([*conditions[r["layout"]], r["hole"], repeat, f"{rate:.6g}"])


def add_commands(commands):
    parser = command(commands, "synthetic-bench", synthetic_bench)
    parser.add_argument("reports", metavar="REPORTS", help="folder made by `vibrosow sweep`")
    parser.add_argument("--study", required=True, help="what was swept, for the table's head")
    parser.add_argument("--factor", type=float, required=True)
    parser.add_argument("--noise", type=float, required=True, help="largest relative error of a reading")
    parser.add_argument("--repeats", type=int, required=True)
    parser.add_argument("--noise-seed", type=int, required=True)
