"""What a decision cost beside a sweep and a full grid, and what became of its finalists in the whole tray."""
import json
import sys
from pathlib import Path

from .tables import command, rows, runs_within_the_model, write_table

COSTS = "way,runs,grain_steps,core_hours,decisions_per_hour_of_two_cores,layout,name,goal,confidence_percent"
OF_SECTION = ["standing", "runs", "goal", "goal_ci95", "rate", "rate_ci95"]
OF_WHOLE = ["replicates", "tray_rate_g_per_s", "tray_rate_g_per_s_ci95", "raw_cv_percent", "chance_cv_percent", "unevenness_cv_percent",
            "unevenness_cv_percent_low", "unevenness_cv_percent_high", "spilled_percent"]


def json_of(path):
    try:
        return json.loads(Path(path).read_text(encoding="utf-8"))
    except (OSError, ValueError) as fault:
        sys.exit(f"scripts/figures: {path}: {fault}")


class Decision:
    """What `vibrosow decide` wrote into a folder."""

    def __init__(self, folder):
        self.answer = json_of(f"{folder}/decision.json")
        self.layouts = {row["layout"]: row for row in rows(f"{folder}/decision.csv")}
        self.best = self.layouts.get(str(self.answer["best"]))

    def chosen(self):
        """(number, name, goal) of the best, and the confidence with which it is."""
        if self.best is None:
            return ["", "", "", ""]
        sure = f"{self.answer['confidence_percent']:g}" if self.answer["sure"] else "not sure"
        return [self.best["layout"], self.best["name"], self.best["goal"], sure]


def least_of_sweep(folder, answer):
    """The row of the layout that the sweep's means call best: the least goal among those whose mean rate lies in the band."""
    goal, rate = answer["goal.figure"], answer["rate.figure"]
    fit = [row for row in rows(f"{folder}/sweep.csv") if row[goal] and row[rate] and
           (answer["rate.low"] is None or answer["rate.low"] <= float(row[rate]) <= answer["rate.high"])]
    return min(fit, key=lambda row: float(row[goal]), default=None)


def flat(keys, before=""):
    """{"cost": {"runs": 1}} to {"cost.runs": 1}."""
    found = {}
    for key, value in keys.items():
        found.update(flat(value, f"{before}{key}.") if isinstance(value, dict) else {before + key: value})
    return found


def decision_costs(options):
    """What decisions cost: DECISION folders of `vibrosow decide` over one study, a SWEEP of the same study, and what a full grid would cost.

    Writes costs.csv: a row per way with its runs, grain-steps, hours of a core at the speed of TIMING (timing.json of a run of
    the study's seeder), decisions per hour of two cores, and the layout that it calls best, with its mean goal. Two full grids are
    not run: the smallest of GRID (what benchmarks/decision_grid prints) that names the last decision's layout as surely as it is, and
    what Rinott's procedure takes for that confidence whatever the means, by the variances of the decision's first runs."""
    speed = json_of(options.timing)["grain_steps_per_s"]

    def line(way, runs, grain_steps, chosen):
        hours = grain_steps / speed / 3600
        return [way, f"{runs:.0f}", f"{grain_steps:.3g}", f"{hours:.3g}", f"{2 / hours:.2g}", *chosen]

    lines, last = [], None
    for folder in options.decisions:
        last = Decision(folder)
        last.answer = flat(last.answer)
        lines.append(line(f"decide, {last.answer['procedure']}", last.answer["cost.runs"], last.answer["cost.grain_steps"], last.chosen()))
    each = last.answer["cost.grain_steps"] / last.answer["cost.runs"]
    runs = len(runs_within_the_model(options.sweep))
    best = least_of_sweep(options.sweep, last.answer)
    chosen = [best["layout"], best["name"], best[last.answer["goal.figure"]], ""] if best else [""] * 4
    lines.append(line("sweep", runs, runs * each, chosen))
    grid = rows(options.grid)[-1]
    if float(grid["right_percent"]) >= float(grid["confidence_percent"]):
        lines.append(line(f"full grid of {grid['replicates']} replicates, drawn from runs kept", float(grid["runs"]), float(grid["grain_steps"]),
                          [*last.chosen()[:2], "", grid["right_percent"]]))
    if last.answer["equal_grid.runs"] is not None:
        confidence = f"{last.answer['confidence_percent']:g}"
        lines.append(line("full grid by Rinott, reckoned", last.answer["equal_grid.runs"], last.answer["equal_grid.grain_steps"], ["", "", "", confidence]))
    write_table("costs.csv", COSTS, lines)


def decision_finalists(options):
    """The finalists of a DECISION in the WHOLE tray, a sweep whose [[layout]] are called "layout 17: ..." by the decision's numbers.

    Writes finalists.csv: goal and rate of single runs in the section, then the whole tray's rate and unevenness, all its
    replicates together, in the order of their raw CV."""
    decision = Decision(options.decision)
    lines = []
    for row in rows(f"{options.whole}/sweep.csv"):
        number, colon, _ = row["name"].partition(":")
        of = decision.layouts.get(number.removeprefix("layout "))
        if of is None or not colon:
            sys.exit(f"scripts/figures: {options.whole}/sweep.csv: {row['name']} names no layout of {options.decision}")
        lines.append([row["name"], *(of[key] for key in OF_SECTION), *(row[key] for key in OF_WHOLE)])
    raw = len(OF_SECTION) + 1 + OF_WHOLE.index("raw_cv_percent")
    write_table("finalists.csv", ",".join(["name", *(f"section_{key}" for key in OF_SECTION), *OF_WHOLE]),
                sorted(lines, key=lambda line: float(line[raw])))


def add_commands(commands):
    parser = command(commands, "decision-costs", decision_costs)
    parser.add_argument("timing", metavar="TIMING")
    parser.add_argument("grid", metavar="GRID")
    parser.add_argument("sweep", metavar="SWEEP")
    parser.add_argument("decisions", nargs="+", metavar="DECISION")
    parser = command(commands, "decision-finalists", decision_finalists)
    parser.add_argument("decision", metavar="DECISION")
    parser.add_argument("whole", metavar="WHOLE")
