"""A study's layouts, as `vibrosow sweep` and `vibrosow export` write them."""
import os
import shutil
import subprocess
import tempfile
import tomllib
import weakref
from contextlib import ExitStack
from functools import cached_property

import pandas

from .folder import Folder, ProgramError, VibrosowError, count_of, read_json, share_of_tray
from .run import Run

FIGURES = {  # columns of sweep.csv that have an interval
    "rate_g_per_s": "mass flow through all holes, g/s, {of}",
    "seeds_per_s": "seeds through all holes, 1/s, {of}",
    "tray_rate_g_per_s": "mass flow of the whole tray, g/s",
    "tray_rate_g_per_min": "mass flow of the whole tray, g/min",
    "tray_seeds_per_s": "seeds of the whole tray, 1/s",
    "run_cv_percent": "variation between the holes in a single run (CV), %",
    "unevenness_cv_percent": "unevenness between the holes (CV) without chance, %",
    "instability_cv_percent": "variation of the outflow over about ten parts of the window, %",
    "longest_pause_s": "longest time without a seed from any hole, s",
    "spilled_percent": "seeds over the rim, % of all that left",
    "misfit_percent": "misfit to the measured outflow, %",
}


class Study:
    """The reports of one sweep. Files are read when they are asked for; their columns and units are in docs/reference/output.md."""

    def __init__(self, folder):
        self._folder = Folder(folder, "sweep", ("sweep.csv", "sweep_holes.csv", "sweep_runs.csv"))
        self.folder = self._folder.path

    layouts = cached_property(lambda self: self._folder.table("sweep.csv"))
    _holes = cached_property(lambda self: self._folder.table("sweep_holes.csv"))
    holes = cached_property(lambda self: self._holes[self._holes.hole != "all"])  # a row for each layout, hole and lot
    totals = cached_property(lambda self: self._holes[self._holes.hole == "all"])  # of all holes together
    records = cached_property(lambda self: self._folder.table("sweep_records.csv"))  # None without [record]
    comparison = cached_property(lambda self: self._folder.table("comparison.csv"))  # None without a measurement

    @cached_property
    def doubts(self):
        """What speaks against the runs of the layouts, a row each; empty where nothing does, None in a folder that does not tell."""
        return self._folder.doubts("layouts")

    @cached_property
    def plan(self):
        """The current plan as a dict; None for a folder without kept runs, as committed reports are."""
        current = self.folder / "cases" / "plan"
        return read_json(current.parent / "plans" / f"{current.read_text().strip()}.json") if current.is_file() else None

    @cached_property
    def title(self):
        """Of the study's file, which the plan holds; None without a plan."""
        return tomllib.loads(self.plan["files"][self.plan["study"]]).get("title", "") if self.plan else None

    @cached_property
    def runs(self):
        """sweep_runs.csv; with a plan also `case`, the name of each run in it, empty where it has none."""
        runs = self._folder.table("sweep_runs.csv")
        if self.plan is None:
            return runs
        cases = {(group["layout"], group["random_seed"] + k): case
                 for group in self.plan["runs"] for k, case in enumerate(group["cases"].split())}
        alike = runs.note.str.extract(r"same run as of layout (\d+)$")[0].astype(float)  # the plan has the first of these
        return runs.assign(case=[cases.get(run, "") for run in zip(alike.fillna(runs.layout), runs.random_seed)])

    def case(self, layout, random_seed, program=None):
        """The Run of a layout (its number) and a random seed, which `vibrosow export --run` makes of the kept run. The program: `program`,
        else the environment's VIBROSOW, else on the PATH; ProgramError where it is not there or refuses. KeyError for a run that the
        study does not have, VibrosowError for one that its plan does not have or has otherwise."""
        found = self.runs.query("layout == @layout and random_seed == @random_seed")
        if found.empty:
            raise KeyError(f"{self.folder} has no run of layout {layout} with random seed {random_seed}")
        name = found.case.iloc[0] if self.plan else ""
        if not name:
            raise VibrosowError(f"{self.folder} keeps no run of layout {layout} with random seed {random_seed}: "
                                f"{'its plan names none' if self.plan else 'it has no cases/plan'}")
        wanted = str(program or os.environ.get("VIBROSOW") or "vibrosow")
        if not shutil.which(wanted):
            raise ProgramError(f"there is no program {wanted}: give program=..., set VIBROSOW, or put vibrosow on the PATH")
        with ExitStack() as stack:
            folder = f"{stack.enter_context(tempfile.TemporaryDirectory(prefix='vibrosow-'))}/run"
            command = [shutil.which(wanted), "export", str(self.folder), "--run", name, "--out", folder]
            done = subprocess.run(command, capture_output=True, text=True)
            if done.returncode != 0:
                raise ProgramError(f"{' '.join(command)}: {done.stderr.strip() or f'exit code {done.returncode}'}")
            run = Run(folder)
            if run.info["grain_steps"] != found.grain_steps.iloc[0]:
                raise VibrosowError(f"{self.folder}: its plan is not the one that its reports are of; `vibrosow export` makes them again")
            weakref.finalize(run, stack.pop_all().close)
        return run

    def __repr__(self):
        return f"<vibrosow sweep: {self.folder}, {len(self.layouts)} layouts, {(self.layouts.status != 'ok').sum()} of them not ok, {count_of(self.doubts)}>"

    def intervals(self, figure="rate_g_per_s"):
        """`value`, `low` and `high` of a figure by layout, in its column's unit: the mean over the replicates and its 95 % interval, NaN
        with one replicate. Holes that are not told from equal ones have no unevenness, only low and high. ValueError for another column."""
        if figure not in FIGURES:
            raise ValueError(f"{figure!r} has no interval; those that have: {', '.join(FIGURES)}")
        table = self.layouts.set_index("layout")
        value, half = table[figure], table.get(f"{figure}_ci95")
        low, high = (table[f"{figure}_low"], table[f"{figure}_high"]) if half is None else (value - half, value + half)
        return pandas.DataFrame({"value": value, "low": low, "high": high})

    @property
    def compared(self):
        """Whether each row of `layouts` has figures of all its runs: it is ok, or doubtful, which its `reason` says."""
        return self.layouts.status.isin(["ok", "doubtful"]).values

    def best(self, figure="rate_g_per_s", least=False):
        """Rows of `layouts` that chance alone may hold apart from the one with the largest figure (least: the smallest), the best first.
        Each is compared with that one, at 95 %, by their two intervals (Zou and Donner 2008, doi 10.1002/sim.3095): of many equal layouts
        some are left out by chance. Only layouts that are ok or doubtful are compared; one without an interval cannot be told apart. VibrosowError
        where none has the figure."""
        table = self.intervals(figure)[self.compared]
        table["value"] = table.value.fillna(table.low)
        table = table.dropna(subset="value").sort_values("value", ascending=least, kind="stable")
        if table.empty:
            raise VibrosowError(f"{self.folder}: no layout that can be compared has {figure}")
        first, (far, near) = table.iloc[0], ("low", "high") if least else ("high", "low")
        reach = ((table[far] - table.value) ** 2 + (first[near] - first.value) ** 2) ** 0.5
        alike = table.index[~((table.value - first.value).abs() > reach)]
        return self.layouts.set_index("layout").loc[alike].reset_index()

    def labels(self):
        """A short text for each row of `layouts`: its number, and its name or, where names do not tell layouts apart, what is varied."""
        names = list(self.layouts)
        varied = [] if self.layouts["name"].is_unique else names[names.index("reason") + 1:names.index("replicates")]
        told = [[f"{key.split('.')[-1]} {row[key]}" for key in varied if pandas.notna(row[key])] for row in self.layouts.to_dict("records")]
        heads = [f"{number} {name}".strip() for number, name in zip(self.layouts.layout, self.layouts["name"])]
        return [", ".join([head, *values])[:60] for head, values in zip(heads, told)]

    def plot_rates(self, ax=None, figure="rate_g_per_s"):
        """Draws a figure of every layout with its 95 % interval, the first layout on top; returns the axes. Layouts that cannot be compared are
        hollow, those without the figure empty. ValueError for a figure without intervals, VibrosowError where no layout has it."""
        from matplotlib import pyplot

        table, sound = self.intervals(figure), self.compared
        if table.isna().all(axis=None):
            raise VibrosowError(f"{self.folder}: no layout has {figure}")
        ax, places = ax or pyplot.subplots(figsize=(7, 2 + 0.25 * len(table)), layout="constrained")[1], pandas.RangeIndex(len(table))
        known = table.high.notna().values
        ax.hlines(places[known], table.low[known], table.high[known], color="#1b6ca8")
        ax.plot(table.value[sound], places[sound], "o", color="#1b6ca8")
        hollow = ~sound & table.value.notna().values
        if hollow.any():
            label = f"{' or '.join(self.layouts.status[hollow].unique())}: decides nothing"
            ax.plot(table.value[hollow], places[hollow], "o", color="#1b6ca8", mfc="white", label=label)
            ax.legend(fontsize="small")
        of = share_of_tray(self.layouts.depth_factor[self.layouts.replicates > 0])
        runs = f"over {' or '.join(map(str, sorted({*self.layouts.replicates} - {0})))} random seeds"
        ax.set(xlabel=f"{FIGURES[figure].format(of=of)}\n{f'95 % intervals {runs}' if known.any() else 'one random seed, so no intervals'}",
               title=self.title or self.folder.resolve().name, ylim=(len(table) - 0.5, -0.5))
        ax.set_yticks(places, self.labels(), fontsize="small")
        return ax


def open_study(folder):
    """The Study that `vibrosow sweep` wrote into a folder. NotAReport, Incomplete, MissingFile: it is none, not whole, lacks a file."""
    return Study(folder)
