"""Pictures for those who have not run anything yet: how far hard cases stay from their bounds, what each effect costs, and a screen."""
import matplotlib

matplotlib.use("Agg")
from matplotlib import pyplot

from .tables import command, rows

BLUE, GREY = "#1b6ca8", "#888888"


def saved(figure, out):
    matplotlib.rcParams["svg.hashsalt"] = "vibrosow"  # the same names in every SVG
    figure.savefig(out, metadata={"Date": None} if out.endswith(".svg") else None, dpi=150)


def margins(options):
    """Draws stability.csv (TABLE) as OUT: of each hard case the part of its bound that is left in the worst of its runs, over all laws,
    schemes and spaces; 0 is the bound. What is to be just so, such as a count, has no margin and is left out."""
    least, runs = {}, {}
    for row in rows(options.table):
        if not row["margin"] or row["is_to_be"] == "just":
            continue
        case = row["case"]
        least[case] = min(least.get(case, 1), float(row["margin"]))
        runs.setdefault(case, set()).add((row["space"], row["law"], row["scheme"], row["friction"]))
    cases = sorted(least, key=least.get)
    figure, axes = pyplot.subplots(figsize=(7.2, 0.2 * len(cases) + 1), layout="constrained")
    places = range(len(cases))
    axes.barh(places, [100 * least[case] for case in cases], color=BLUE, height=0.6)
    axes.set_yticks(places, [f"{case} ({len(runs[case])})" for case in cases], fontsize=7)
    axes.axvline(0, color=GREY, linewidth=1)
    axes.set(xlabel="left of its bound in the worst run, %; in brackets: runs", ylim=(-0.6, len(cases) - 0.4))
    axes.xaxis.label.set_size(8)
    axes.grid(True, axis="x", linewidth=0.3)
    saved(figure, options.out)


def effect_prices(options):
    """Draws effects.csv (TABLE) as OUT: the time of a grain-step with all effects, and what it is without each."""
    found = rows(options.table)
    shown = [row for row in found if row["case"] == "all effects" or row["case"].startswith("without ")]
    shown += [row for row in found if row["case"] == "normal contact alone, its own kernel"]
    figure, axes = pyplot.subplots(figsize=(7.2, 0.3 * len(shown) + 1), layout="constrained")
    places = range(len(shown))
    times = [float(row["ns_per_grain_step"]) for row in shown]
    axes.barh(places, times, color=[GREY if row["case"] == "all effects" else BLUE for row in shown], height=0.6)
    axes.set_yticks(places, [row["case"].removesuffix(", its own kernel") for row in shown], fontsize=8)
    axes.invert_yaxis()
    axes.set(xlabel="ns of CPU time per grain-step")
    axes.grid(True, axis="x", linewidth=0.3)
    saved(figure, options.out)


def screen(options):
    """Draws the text that a command printed (TABLE) as OUT, as a terminal shows it."""
    with open(options.table, encoding="utf-8") as file:
        lines = file.read().splitlines()
    size = 8  # points
    figure = pyplot.figure(figsize=(max(map(len, lines)) * 0.602 * size / 72 + 0.3, len(lines) * 1.09 * size / 72 + 0.3), facecolor="#1e1e1e")
    figure.text(0.15 / figure.get_figwidth(), 1 - 0.15 / figure.get_figheight(), "\n".join(lines), family="DejaVu Sans Mono", size=size,
                color="#e6e6e6", va="top", linespacing=1.25, parse_math=False)
    saved(figure, options.out)


def add_commands(commands):
    for name, act in (("margins", margins), ("effect-prices", effect_prices), ("screen", screen)):
        drawn = command(commands, name, act)
        drawn.add_argument("table")
        drawn.add_argument("out")
