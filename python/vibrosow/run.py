"""One run of a seeder, as `vibrosow run` and `vibrosow export --run` write it."""
import math
import re
from functools import cached_property

import pandas

from .folder import Folder, count_of, read_json, share_of_tray
from .recording import Recording


def seconds(time):
    """Of a text such as "0.1 s" (ms, s, min) or a number of seconds. ValueError for what is no time above 0."""
    found = re.fullmatch(r"\s*(.+?)\s*(ms|s|min)\s*", str(time))
    try:
        value = float(found[1]) * {"ms": 1e-3, "s": 1, "min": 60}[found[2]] if found else float(time)
    except (TypeError, ValueError):
        value = math.nan
    if not 0 < value < math.inf:
        raise ValueError(f'{time!r} is no time above 0, such as "0.1 s" or a number of seconds')
    return value


class Run:
    """The reports of one run. Files are read when they are asked for; their columns and units are in docs/reference/output.md."""

    def __init__(self, folder):
        self._folder = Folder(folder, "run", ("run.json", "outflow.csv", "summary.csv"))
        self.folder = self._folder.path
        self.snapshots = sorted(int(path.stem.split("_")[1]) for path in self.folder.glob("grains_*.csv"))  # their numbers

    info = cached_property(lambda self: read_json(self.folder / "run.json"))  # a dict
    summary = cached_property(lambda self: self._folder.table("summary.csv"))  # by hole and lot, and of all, in the measuring window
    holes = cached_property(lambda self: self.summary[self.summary.hole != "all"])  # of single holes
    total = cached_property(lambda self: self.summary.iloc[-1])  # of all holes and lots
    events = cached_property(lambda self: self._folder.table("outflow.csv"))  # every seed that left, in the whole run
    records = cached_property(lambda self: self._folder.table("records.csv"))  # this and the next two: None without [record]
    profile = cached_property(lambda self: self._folder.table("profile.csv"))
    flow = cached_property(lambda self: self._folder.table("flow.csv"))

    @cached_property
    def recording(self):
        """Its grains frame by frame, a Recording; None where `vibrosow run` was not asked for a page (--html)."""
        page = self.folder / "report.html"
        return Recording(page) if page.exists() else None

    @property
    def doubts(self):
        """What speaks against its figures, a row each; empty where nothing does."""
        return pandas.DataFrame(self.info.get("doubts", []), columns=["kind", "serious", "text", "what_to_do"])

    def __repr__(self):
        return f"<vibrosow run: {self.folder}, {self.info['status']}, {self.total.rate_g_per_s:.3g} g/s, {count_of(self.doubts)}>"

    def snapshot(self, number, what="grains"):
        """Every grain (or what="fields": every cell) of a snapshot, by its number in `snapshots`. KeyError for another number."""
        if number not in self.snapshots:
            raise KeyError(f"{self.folder} has no snapshot {number}; it has {self.snapshots or 'none'}")
        return self._folder.table(f"{what}_{number:03}.csv")

    def outflow(self, bin="0.1 s"):
        """Seeds per time bin (rows: intervals in s from the run's start, the last one cut at its end) and hole (columns; `spilled` where
        seeds went over the rim), of the whole run. ValueError for a bin that is no time or shorter than the run's time step."""
        length, end, step = seconds(bin), self.info["end_time_s"], self.info["dt_s"]
        if length < step:
            raise ValueError(f"a bin of {length:g} s is shorter than the run's time step, {step:g} s")
        count = max(1, math.ceil((end - step) / length))  # the end is within a step of the duration
        edges = [round(k * length, 12) for k in range(count)] + [end]
        bins = pandas.Series(edges[1:-1], dtype=float).searchsorted(self.events.time_s, side="right")
        holes = sorted({*self.summary.hole, *self.events.hole} - {"all"}, key=lambda hole: (not hole.isdigit(), hole.zfill(9)))
        counts = self.events.groupby([bins, "hole"]).size().unstack(fill_value=0)
        counts = counts.reindex(index=range(count), columns=pandas.Index(holes, name="hole"), fill_value=0).astype(int)
        return counts.set_index(pandas.IntervalIndex.from_breaks(edges, closed="left", name="time_s"))

    def plot_outflow(self, ax=None, bin="0.1 s"):
        """Draws seeds per second and hole over time, the measuring window shaded; returns the axes. `bin` as in outflow()."""
        from matplotlib import pyplot

        table, info = self.outflow(bin), self.info
        ax = ax or pyplot.subplots(layout="constrained")[1]
        for hole in table:
            ax.stairs(table[hole] / table.index.length, [*table.index.left, table.index.right[-1]],
                      label=f"hole {hole}" if hole.isdigit() else hole)
        ax.axvspan(*info["outflow"]["window_s"], color="#eee", zorder=0, label="measuring window")
        ax.set(xlabel="time, s", ylabel=f"seeds that leave, 1/s, {share_of_tray([info['outflow']['depth_factor']])}", ylim=(0, None))
        told = [info["status"]] * (info["status"] != "finished") + ["outside the model"] * info["outside_the_model"]
        ax.set_title("\n".join([info["title"], "; ".join(told)]).strip())
        ax.legend(fontsize="small")
        return ax


def open_run(folder):
    """The Run that `vibrosow run` wrote into a folder. NotAReport, Incomplete, MissingFile: where it is none, not whole, lacks a file."""
    return Run(folder)
