"""Rates that others measured beside rates that are predicted without fitting: what a prediction errs by for a new material."""
import math
import tomllib
from pathlib import Path

from scipy import stats

from .outflow import CYLINDERS, GRAVITY, MEASURED_PERCENT_PER_S
from .tables import command, rows, write_table

ROOT = Path(__file__).resolve().parents[2]
# Constants as they are commonly quoted, with their spread: C and k of Beverloo, Leniger & van de Velde 1961 for plant seeds; Fowler & Glastonbury 1959.
BEVERLOO_C, BEVERLOO_K = (0.58, 0.55, 0.65), (1.4, 1.7, 1.2)  # middle, slowest, fastest
FOWLER, FOWLER_POWER, FOWLER_SPREAD = 0.236, 0.185, 0.15
MEASURED_WOOD_PERCENT_PER_S = 15.8


def value(text, unit):
    number, own = text.split()
    assert own == unit, text
    return float(number)


def crop_named(name):
    """Bulk density (kg/m3) and diameter (m) of the ball of a seed's volume, as the crop's file has them."""
    with open(ROOT / f"models/crops/{name}.toml", "rb") as file:
        crop = tomllib.load(file)
    mass = value(crop["thousand_grain_weight"], "g") * 1e-6
    density = value(crop["reference"]["true_density"], "kg/m3")
    return value(crop["bulk_density"], "kg/m3"), (6 / math.pi * mass / density) ** (1 / 3)


def beverloo(bulk, width, diameter, c, k):
    return c * bulk * math.sqrt(GRAVITY) * (width - k * diameter) ** 2.5


def fowler(bulk, width, diameter):
    return FOWLER * bulk * math.pi / 4 * width**2 * math.sqrt(2 * GRAVITY * width) * (width / diameter) ** FOWLER_POWER


def orifices(options):
    """Still flow of crops through round holes beside two published formulas, from a study on seeders/verification/orifice.toml.

    A formula's bulk density and seed diameter (of the ball of a seed's volume) are those of the crop's file. Writes orifices.csv into REPORTS."""
    lines = []
    for row in rows(f"{options.reports}/sweep.csv"):
        crop, width = row["seeds.seed.crop"], float(row["tray.holes.width_mm"]) / 1e3
        bulk, diameter = crop_named(crop)
        rate = float(row["tray_rate_g_per_s"])
        by_beverloo = [1e3 * beverloo(bulk, width, diameter, c, k) for c, k in zip(BEVERLOO_C, BEVERLOO_K)]
        by_fowler = 1e3 * fowler(bulk, width, diameter)
        lines.append([crop, f"{width / diameter:.3g}", row["replicates"], f"{rate:.4g}", *(f"{one:.4g}" for one in by_beverloo), f"{by_fowler:.4g}",
                      f"{100 * (rate / by_beverloo[0] - 1):.1f}", f"{100 * (rate / by_fowler - 1):.1f}"])
    write_table(f"{options.reports}/orifices.csv", "crop,width_over_seed,runs,rate_g_per_s,beverloo_g_per_s,beverloo_slowest_g_per_s,"
                "beverloo_fastest_g_per_s,fowler_g_per_s,over_beverloo_percent,over_fowler_percent", lines)


def held_out(options):
    """All rates that others measured beside predicted ones, unfitted, from committed reports: the program's models/held-out.csv."""
    reports = ROOT / "reports"
    lines = []
    slot = next(row for row in rows(reports / "slot-in-space/slot.csv") if row["program"] == "vibrosow" and row["depth_mm"] == "40")
    lines.append(["plastic balls", "still slot of 40 mm", "%/s", f"{MEASURED_PERCENT_PER_S:g}", slot["percent_per_s"], "reports/slot-in-space"])
    cylinders = rows(reports / "cylinder-slot-in-space/sweep.csv")
    wood = next(row for row in cylinders if row["name"] == "wood, with its source's friction")
    number = CYLINDERS["wood, 4 x 8.5 mm"][0]
    lines.append(["wooden cylinders", "still slot of 40 mm", "%/s", f"{MEASURED_WOOD_PERCENT_PER_S:g}",
                  f"{100 * float(wood['seeds_per_s']) / number:.4g}", "reports/cylinder-slot-in-space"])
    for row in rows(reports / "orifices/orifices.csv"):
        lines.append([row["crop"], f"still round hole of {row['width_over_seed']} seeds, by Beverloo et al. 1961", "g/s", row["beverloo_g_per_s"],
                      row["rate_g_per_s"], "reports/orifices"])
    write_table(options.table, "material,condition,unit,measured,predicted,report", lines)


def logarithms_by_material(table):
    """ln(measured / predicted) of each material, mean over its conditions, by name: as the program takes them."""
    ratios = {}
    for row in rows(table):
        ratios.setdefault(row["material"], []).append(math.log(float(row["measured"]) / float(row["predicted"])))
    return {material: sum(ratios[material]) / len(ratios[material]) for material in sorted(ratios)}


def left_out(options):
    """Each material predicted with the error that the others tell: Student's t about zero, as `vibrosow plan` has it of a new one.

    `held`: whether the range of 95 % holds what was measured. The last row is of all: how many it held, and Clopper and Pearson's 95 % of that."""
    logarithms = logarithms_by_material(options.held_out)
    lines, held = [], 0
    for material, own in logarithms.items():
        others = [one for name, one in logarithms.items() if name != material]
        scale = math.sqrt(sum(one * one for one in others) / len(others))
        half = stats.t.ppf(0.975, len(others)) * scale
        held += abs(own) <= half
        lines.append([material, len(others), f"{math.exp(own):.4f}", f"{math.exp(-half):.4f}", f"{math.exp(half):.4f}", "yes" if abs(own) <= half else "no"])
    count = len(lines)
    low = stats.beta.ppf(0.025, held, count - held + 1) if held else 0
    high = stats.beta.ppf(0.975, held + 1, count - held) if held < count else 1
    lines.append(["all", count, f"{held / count:.4f}", f"{low:.4f}", f"{high:.4f}", f"{held} of {count}"])
    write_table(options.table, "material,others,measured_over_predicted,low,high,held", lines)


def add_commands(commands):
    parser = command(commands, "orifices", orifices)
    parser.add_argument("reports", metavar="REPORTS")
    parser = command(commands, "held-out", held_out)
    parser.add_argument("table", metavar="CSV")
    parser = command(commands, "left-out", left_out)
    parser.add_argument("held_out", metavar="HELD-OUT.csv")
    parser.add_argument("table", metavar="CSV")
