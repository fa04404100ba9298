"""What accuracy costs, drawn as the field of ODE solvers draws it."""
import matplotlib

matplotlib.use("Agg")
from matplotlib import pyplot

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
        for series in sorted({(softness_of(row), row["slip_speed_mm_per_s"]) for row in own}):
            line = [row for row in own if (softness_of(row), row["slip_speed_mm_per_s"]) == series]
            heights = [max(row["error"], least) for row in line]
            bars = [[height - max(row["error"] - row["band"], least) for row, height in zip(line, heights)],
                    [row["error"] + row["band"] - height for row, height in zip(line, heights)]]
            axes.errorbar([row["cpu_s"] for row in line], heights, yerr=bars, color=colour, marker=marker, markersize=5, linewidth=1,
                          capsize=2, elinewidth=0.8, label=name if series == min((softness_of(r), r["slip_speed_mm_per_s"]) for r in own) else None)
            last = max(line, key=lambda row: row["cpu_s"])
            axes.annotate(f"{float(softness_of(last)):.2g}", (last["cpu_s"], max(last["error"], least)), textcoords="offset points", xytext=(6, 3), fontsize=7,
                          color=colour)
    front = front_of(settings)
    axes.plot([row["cpu_s"] for row in front], [row["error"] + row["band"] for row in front], color="#444", linewidth=1.2, linestyle=":",
              label="front of |error| and band together")
    axes.axhline(chance, color="#888", linewidth=1, linestyle="--", label=f"chance of one run, {chance:.2g} %")
    axes.set(xscale="log", yscale="log", xlabel="CPU time of a run, s", ylabel="error of the rate, %", title=options.title)
    axes.margins(x=0.12)
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_formatter("{x:g}")
    axes.grid(True, which="both", linewidth=0.3)
    axes.legend(fontsize=8)
    figure.savefig(options.out, metadata={"Date": None} if options.out.endswith(".svg") else None, dpi=150)


LEVELS = (("draft", 3e-4, 20), ("design", 3e-5, 20), ("reference", 3e-6, 40))  # as src/scene/accuracy_level.hpp; a test compares


def level_rows(folder):
    """Of a folder of `vibrosow accuracy` that ran velocity Verlet at the levels' softness and steps: level, row, CPU time of a run (s)."""
    table = list(zip(rows(f"{folder}/accuracy.csv"), rows(f"{folder}/accuracy_timing.csv")))
    for level, compression, steps in LEVELS:
        for row, timing in table:
            if float(row["shell_compression"] or 0) == compression and float(row["steps_per_contact"]) == steps and row["fitted_error_percent"]:
                yield level, row, float(timing["cpu_s"])
                break
        else:
            raise SystemExit(f"{folder}/accuracy.csv: no fitted error at {level}: shell compression {compression:g}, {steps} steps a contact")


def accuracy_levels(options):
    """Gathers what the levels cost and err by in several FOLDERs of `vibrosow accuracy`, each of one scene, as levels.csv: the fitted error
    against the limit with its band, and the CPU time of a run, also over that of the reference."""
    lines = []
    for folder in options.folders:
        found = list(level_rows(folder))
        reference = found[-1][2]
        for level, row, seconds in found:
            error, band = float(row["fitted_error_percent"]), float(row["fitted_error_band95"])
            lines.append([folder, level, row["rate_g_per_s"], f"{error:.2f}", f"{band:.2f}", f"{abs(error) + band:.2f}", f"{seconds:.3g}",
                          f"{seconds / reference:.3g}"])
    write_table("levels.csv", "scene,level,rate_g_per_s,error_percent,error_band95,error_bound_percent,cpu_s,cpu_over_reference", lines)


def add_commands(commands):
    draw = command(commands, "work-precision", work_precision)
    draw.add_argument("folder", metavar="FOLDER")
    draw.add_argument("out", metavar="OUT")
    draw.add_argument("--title", default="What accuracy costs in time")
    draw.add_argument("--least", type=float, default=0.01, help="errors below are drawn there, %%; default: %(default)s")

    levels = command(commands, "accuracy-levels", accuracy_levels)
    levels.add_argument("folders", metavar="FOLDER", nargs="+")
