"""Tables of numbers in the documents, made of the reports' CSV files. A table is a list of lines of cells; the first line is its header."""
import math
import re
import statistics
import sys
import tomllib
from pathlib import Path

from .accuracy import LEVELS, level_rows
from .outflow import slot_of
from .tables import command, rows

ROOT = Path(__file__).resolve().parents[2]
DOCUMENTS = ("reports/FINDINGS.md", "reports/performance.md", "benchmarks/peers/README.md", "docs/explanation/accuracy.md", "docs/explanation/how-calibration-works.md")
MARKED = re.compile(r"^<!-- made: (\S+) -->\n((?:\|.*\n)*)", re.MULTILINE)
HOLES, SPAN, FREQUENCY = "tray.holes.count", "tray.holes.span_mm", "tray.motion.frequency_Hz"


def decimals(value, significant):
    """How many there are where a value is written with so many significant digits."""
    return max(0, significant - 1 - math.floor(math.log10(abs(value)))) if value else 0


def plus_minus(value, half, digits=None, sign=""):
    """A value and the half width of its interval. Where no decimals are given the half width has two significant digits."""
    digits = decimals(half, 2) if digits is None else digits
    return f"{value:{sign}.{digits}f} ± {half:.{digits}f}"


def number(row, key, digits=0, times=1):
    return f"{times * float(row[key]):.{digits}f}"


def interval(row, key, digits=None, half=None, sign=""):
    """Of a column and its half width, `half`, or the column that is called after it."""
    return plus_minus(float(row[key]), float(row[half or f"{key}_ci95"]), digits, sign)


def scientific(value):
    """A power of ten with one digit before it: 3e-4."""
    return f"{value:.0e}".replace("e-0", "e-")


def column(table, key):
    return [float(row[key]) for row in table]


def chosen(table, wanted):
    """The rows with these texts."""
    return [row for row in table if all(row[key] == text for key, text in wanted.items())]


def values(table, key):
    """Each text of a column once, in order."""
    return list(dict.fromkeys(row[key] for row in table))


def wheat_holes(root):
    """One hole is the same at every span, so it is shown at the first alone."""
    header = ["holes", "span, cm", "frequency, Hz", "rate, g/s", "seeds/s", "unevenness (CV), %", "longest pause, ms"]
    table = rows(root / "reports/wheat-holes/sweep.csv")
    lines = []
    for row in table:
        span, unevenness = number(row, SPAN, 0, 0.1), ""
        if row[HOLES] == "1":
            if row[SPAN] != table[0][SPAN]:
                continue
            span = "–"
        else:
            middle, low, high = (number(row, f"unevenness_cv_percent{end}", 1) for end in ("", "_low", "_high"))
            unevenness = f"{middle} ({low} to {high})"
        lines.append([row[HOLES], span, row[FREQUENCY], interval(row, "rate_g_per_s", 2), interval(row, "seeds_per_s", 0), unevenness,
                      number(row, "longest_pause_s", 0, 1000)])
    return [header, *lines]


def wheat_tray_spaces(root):
    header = ["holes", "span, cm", "frequency, Hz", "3D, g/s", "2D slice times depth, g/s", "rank in 3D", "rank in 2D"]
    return [header, *([row[HOLES], number(row, SPAN, 0, 0.1), row[FREQUENCY], number(row, "space_g_per_s", 1),
                       number(row, "plane_g_per_s", 1), row["rank_in_space"], row["rank_in_plane"]]
                      for row in rows(root / "reports/wheat-tray-spaces/spaces.csv"))]


def wheat_tray_grains(root):
    table = rows(root / "reports/wheat-tray-grains/rates.csv")
    lines = [["frequency, Hz", "balls, g/s", "by hole", "clumps, g/s", "by hole", "clumps over balls"]]
    for frequency in values(table, FREQUENCY):
        cells, rates = [frequency], []
        for crop in ("wheat", "wheat-grain"):
            whole, *holes = column(chosen(table, {FREQUENCY: frequency, "seeds.wheat.crop": crop}), "rate_g_per_s")
            cells += [f"{whole:.1f}", ", ".join(f"{rate:.1f}" for rate in holes)]
            rates.append(whole)
        lines.append([*cells, f"{rates[1] / rates[0]:.2f}"])
    return lines


def slot_3d(root):
    table = rows(root / "reports/slot-in-space/slot.csv")
    lines = [["", "percent a second", "of the measured 19.1", "misfit of the curve"]]
    for depth in values(table, "depth_mm"):
        for program, name in (("vibrosow", "Vibrosow"), ("lammps", "LAMMPS")):
            (row,) = chosen(table, {"depth_mm": depth, "program": program})
            off, misfit = float(row["difference_from_measured_percent"]), float(row["misfit_percent"])
            lines.append([f"{name}, {depth} mm{' deep' if len(lines) == 1 else ''}", interval(row, "percent_per_s", 2),
                          f"{off:+.{decimals(off, 2)}f} %", interval(row, "misfit_percent", decimals(misfit, 3)) + " %"])
    return lines


def paper_a_fig3(root):
    """Lost and spilled grains are means of a layout's runs, the overlap is the largest of them."""
    layouts, holes, runs = (rows(root / f"reports/paper-a-fig3/{name}.csv") for name in ("sweep", "sweep_holes", "sweep_runs"))
    lines = [["", "hole 1", "hole 2", "hole 3", "all", "largest relative overlap", "lost through walls, of 2500", "spilled"]]
    for row in layouts:
        own = chosen(runs, {"layout": row["layout"]})
        lost, spilled = (f"{statistics.mean(column(own, key)):.0f}" for key in ("lost", "spilled"))
        lines.append([row["name"], *(interval(hole, "seeds_per_s") for hole in chosen(holes, {"layout": row["layout"]})),
                      f"{max(column(own, 'max_relative_overlap')):.2f}", lost, spilled])
    return lines


READINGS = {"as read: outlet 5 d, walls 22.5 degrees from the vertical": [f"paper-b-channel/seed-{seed}" for seed in (1, 2, 3)],
            "outlet 4 d": ["paper-b-readings/outlet-4-d"],
            "walls 45 degrees from the vertical": ["paper-b-readings/walls-45-degree"],
            "grains that do not turn": ["paper-b-readings/no-rotation"]}
OPENED_AT_S = 0.5  # open_at in seeders/papers/paper-b-channel.toml


def emptied_after(folder):
    """Seconds from when the outlet opens, with the three digits of the run's note."""
    note = rows(folder / "summary.csv")[-1]["note"]
    found = re.search(r"ran dry at ([\d.]+) s", note)
    if not found:
        sys.exit(f"scripts/figures: {folder}/summary.csv: did not run dry: {note}")
    seconds = float(found[1]) - OPENED_AT_S
    return f"{seconds:.{decimals(seconds, 3)}f}"


def pauses_of(folder):
    """Their number, without the wait for the outlet to open, and the longest of those after the first window, in which that wait is."""
    _, *later, whole = rows(folder / "flow.csv")
    count = int(whole["pauses"]) - 1
    return f"{count} ({max(column(later, 'longest_pause_s')):.2f} s)" if count else "none"


def paper_b_readings(root):
    lines = [["reading", "random seeds", "empty after", "pauses (longest)"]]
    for reading, names in READINGS.items():
        folders = [root / "reports" / name for name in names]
        times, pauses = map(emptied_after, folders), dict.fromkeys(map(pauses_of, folders))
        lines.append([reading, str(len(folders)), ", ".join(times) + " s", ", ".join(pauses)])
    return lines


def by_slot(path, corner, unit, cell):
    """A column for each slot or hole that is called after its width: 5 d, 7 d, .."""
    table = sorted((row for row in rows(path) if slot_of(row["name"])), key=lambda row: slot_of(row["name"]))
    return [[corner, *(row["name"] for row in table)], [unit, *map(cell, table)]]


def silo(root):
    return by_slot(root / "reports/silo/rates.csv", "slot D", "grains/s",
                   lambda row: plus_minus(float(row["seeds_per_s"]), float(row["seeds_per_s"]) * float(row["ci95_percent"]) / 100))


def round_holes(root):
    return by_slot(root / "reports/round-holes/rates.csv", "hole D", "balls/s", lambda row: number(row, "seeds_per_s"))


def relations(root):
    """A relation is named at the first of its numbers."""
    lines = [["relation", "number", "published", "comes out", "verdict", "runs"]]
    named = set()
    for row in rows(root / "reports/relations/relations.csv"):
        relation = f"{row['relation']}. {row['statement']} ({row['source']})"
        lines.append(["" if relation in named else relation, row["number"], row["published"],
                      f"{row['value']} ({row['ci95_low']} to {row['ci95_high']})", row["verdict"], row["runs"]])
        named.add(relation)
    return lines


SCHEMES = {"velocity-verlet": "Verlet", "rk2-midpoint": "midpoint", "gear5": "Gear"}
SOURCES = {"step, velocity-verlet": "step, velocity Verlet", "step, rk2-midpoint": "step, midpoint rule", "step, gear5": "step, Gear"}


def setting(text):
    """The end of a comparison, without its unit."""
    text = text.removeprefix("eps/r ").removesuffix(" a contact")
    return SCHEMES.get(text) or (scientific(float(text)) if float(text) < 1 else text)


def accuracy_tray(root):
    """Softness and the first of the steps say what their numbers are."""
    lines = [["source", "from, to", "rate changes by, %"]]
    for row in rows(root / "reports/accuracy-tray/accuracy_errors.csv"):
        source = row["source"]
        if source.startswith("chance"):
            lines.append([source, "", f"{number(row, 'rate_change_percent', 1)} (standard deviation)"])
            continue
        before = "eps/r " if source == "softness" else ""
        after = " steps a contact" if source == "step, velocity-verlet" else ""
        lines.append([SOURCES.get(source, source.replace("scheme, ", "scheme, at ")),
                      f"{before}{setting(row['from'])}, {setting(row['to'])}{after}",
                      interval(row, "rate_change_percent", 1, "rate_change_ci95", "+")])
    return lines


def levels(root):
    """What the worst of the seeders in 2D and in 3D is known to stay within at each level, rounded up."""
    table = rows(root / "reports/accuracy-levels/levels.csv")
    lines = [["level", "shell compression", "steps a contact", "errs by at most, %: in 2D", "in 3D"]]
    for level, compression, steps in LEVELS:
        bounds = {"2D": [], "3D": []}
        for row in chosen(table, {"level": level}):
            bounds[space_of(root, row["scene"])].append(float(row["error_bound_percent"]))
        worst = (f"{math.ceil(round(10 * max(of_space), 6)) / 10:.1f}" for of_space in bounds.values())
        lines.append([f"`{level}`", scientific(compression), str(steps), *worst])
    return lines


def space_of(root, scene):
    seeder = tomllib.loads((root / f"seeders/{scene}.toml").read_text(encoding="utf-8"))
    return "3D" if seeder.get("space") == "3d" else "2D"


def level_errors(root):
    """By seeder: errors, and times over that of the reference, whose own is in seconds. From its own report: levels.csv is rounded."""
    folder = root / "reports/accuracy-levels"
    lines = [["seeder", "draft: error, %; time", "design", "reference; s of a run"]]
    for scene in values(rows(folder / "levels.csv"), "scene"):
        errors, seconds = [], []
        for _, row, cpu_s in level_rows(folder / scene):
            errors.append(interval(row, "fitted_error_percent", 1, "fitted_error_band95", "+"))
            seconds.append(cpu_s)
        times = [*(f"{time / seconds[-1]:.2f}" for time in seconds[:-1]), f"{seconds[-1]:.0f}"]
        lines.append([f"{scene}, {space_of(root, scene)}", *(f"{error}; {time}" for error, time in zip(errors, times))])
    return lines


def calibration_coverage(root):
    """How often a calibration's intervals held the truth."""
    lines = [["key", "held", "of 400, 95 %", "uncertainty reduced by, mean"]]
    for row in rows(root / "reports/calibration/coverage.csv"):
        low, high = (number(row, f"{end}_percent", 1) for end in ("low", "high"))
        lines.append([f"`{row['key']}`", f"{number(row, 'covered_percent', 1)} %", f"{low} to {high}", f"{number(row, 'mean_contraction_percent')} %"])
    return lines


def bench_sheets(root):
    """What sheets of made-up benches promised, and what calibrations found with their readings."""
    lines = [["key", "uncertainty reduced by, promised", "found", "held", "of 40, 95 %"]]
    for row in rows(root / "reports/bench-sheets/summary.csv"):
        low, high = (number(row, f"held_{end}_percent", 0) for end in ("low", "high"))
        lines.append([f"`{row['key']}`", f"{number(row, 'promised_percent', 0)} %",
                      f"{number(row, 'narrowed_percent', 0)} ± {number(row, 'narrowed_half_width_95', 0)} %", f"{number(row, 'held_percent', 0)} %",
                      f"{low} to {high}"])
    return lines


# What changed, the table that benchmarks/paired wrote of it, and the commits before and after that it was given.
GAINS = (("all 3D kernels in vector instructions", "kernels-in-space", "6cf2536", "909c446"),
         ("what a pair needs of a ball side by side, transposed four pairs at once", "rows-in-space", "43a6bc4", "30158b5"),
         ("contacts eight at a time, no longer filled up to sixteen", "whole-vectors", "a043a7f", "ba36282"),
         ("records of contacts side by side in their block", "dense-records", "b854941", "7b97115"),
         ("columns of a block a cache line longer; blocks of 1024", "block-columns", "2121648", "22fca1a"),
         ("eight clumps turned at once, their balls written straight into the rows", "clumps", "3065349", "9b07292"),
         ("places and velocities written into the rows in one pass instead of seven", "predicted-rows", "873d8a9", "64b0d6c"),
         ("memory in large pages", "large-pages", "64b0d6c", "739d357"),
         ("a contact keeps 3 numbers, not 9; with rolling 7, not 17", "lean-contacts", "681eff9", "5a3ac46"))
NEW_PROGRAM_FIRST = ("lean-contacts",)
GAINED_IN = {"balls, slot hopper with rolling": "3D slot with rolling", "balls, shaken tray of 20 000": "3D shaken tray",
             "balls, sliding friction, closed tray": "3D sliding friction", "clumps of five balls, section of a tray": "clumps",
             "shells, closed tray": "2D tray"}


def spread(row, keys):
    return f"{float(row[keys[0]]):.2f} ({float(row[keys[1]]):.2f} to {float(row[keys[2]]):.2f})"


def layout_gains(root):
    """How often the program was as fast after each change of how data lie."""
    lines = [["change", *GAINED_IN.values(), "table", "`benchmarks/paired`"]]
    for change, name, *commits in GAINS:
        table, cells = rows(root / f"reports/performance/{name}.csv"), []
        for scene in GAINED_IN:
            found = chosen(table, {"scene": scene})
            keys = ("other_over_first", "least", "most")
            if found and name in NEW_PROGRAM_FIRST:
                found, keys = [{key: 1 / float(found[0][key]) for key in keys}], (keys[0], keys[2], keys[1])
            cells.append(spread(found[0], keys) if found else "")
        lines.append([change, *cells, f"[{name}](performance/{name}.csv)", f"`{' '.join(commits)}`"])
    return lines


def size(root):
    """Of one run each."""
    lines = [["grains", *(f"{space}: {of}" for space in ("2D", "3D") for of in ("ns a grain-step, one thread", "two", "bytes a grain"))]]
    tables = [rows(root / f"reports/performance/{name}.csv") for name in ("growth", "growth-in-space")]
    for grains in ("2400", "10000", "100000", "1000000"):
        cells = []
        for table in tables:
            one, two = chosen(table, {"grains": grains})
            cells += [number(one, "ns_per_grain_step", 1), number(two, "ns_per_grain_step", 1), one["bytes_per_grain"]]
        lines.append([grains, *cells])
    return lines


PEERS = {"lammps": "LAMMPS", "lammps granular": "LAMMPS, `pair granular`", "liggghts": "LIGGGHTS", "yade": "YADE"}


def peers(root):
    """Speed of Vibrosow, and how often it is as fast as each program."""
    tables = [rows(root / f"reports/performance/{name}.csv") for name in ("peers", "peers-yade", "peers-in-space")]
    lines = [["scene", "Vibrosow, million grain-steps/s", *(f"times as fast as {name}" for name in PEERS.values())]]
    for scene in dict.fromkeys(row["scene"] for table in tables for row in table):
        of_scene = [row for table in tables for row in chosen(table, {"scene": scene})]
        granular = scene.startswith("slot")  # there "lammps" is pair granular, which alone has what the scene needs
        cells = []
        for program in PEERS:
            wanted = {"lammps": "", "lammps granular": "lammps"}.get(program, program) if granular else program
            found = chosen(of_scene, {"program": wanted})
            cells.append(spread(found[0], ("vibrosow_over_program", "ratio_min", "ratio_max")) if found else "")
        lines.append([scene, number(chosen(of_scene, {"program": "vibrosow"})[0], "mgs_per_s", 1), *cells])
    return lines


TABLES = {"wheat-holes": wheat_holes, "wheat-tray-spaces": wheat_tray_spaces, "wheat-tray-grains": wheat_tray_grains,
          "slot-in-space": slot_3d, "paper-a-fig3": paper_a_fig3,
          "paper-b-readings": paper_b_readings, "silo": silo, "round-holes": round_holes, "relations": relations,
          "accuracy-tray": accuracy_tray, "levels": levels, "level-errors": level_errors, "calibration-coverage": calibration_coverage,
          "bench-sheets": bench_sheets, "layout-gains": layout_gains, "size": size, "peers": peers}


def markdown(lines):
    header, *others = ("| " + " | ".join(cells) + " |\n" for cells in lines)
    return "".join([header, "|" + "---|" * len(lines[0]) + "\n", *others])


def made(name, root):
    if name not in TABLES:
        sys.exit(f"scripts/figures: documents: no table is called {name}")
    return markdown(TABLES[name](root))


def documents(options):
    """Makes the tables of numbers in the documents from the reports' CSV files.

    A table is made where a line <!-- made: NAME --> stands above it; all else of a document stays as it is."""
    differences, shown = [], set()
    for document in DOCUMENTS:
        path = options.root / document
        text = path.read_text(encoding="utf-8")
        tables = {name: made(name, options.root) for name, _ in MARKED.findall(text)}
        differences += [f"{document}: {name} is not what scripts/figures documents writes"
                        for name, old in MARKED.findall(text) if old != tables[name]]
        shown |= tables.keys()
        remade = MARKED.sub(lambda found: f"<!-- made: {found[1]} -->\n{tables[found[1]]}", text)
        if remade != text and not options.check:
            path.write_text(remade, encoding="utf-8")
    differences += [f"{name}: no document has this table" for name in TABLES if name not in shown]
    if options.check and differences:
        sys.exit("\n".join(differences))


def add_commands(commands):
    parser = command(commands, "documents", documents)
    parser.add_argument("--check", action="store_true", help="changes nothing; fails and names the tables that would change")
    parser.add_argument("--root", type=Path, default=ROOT, metavar="FOLDER", help="the repository; default: this one")
