"""What a plan says beside runs of the seeder that it writes."""
import csv
import math
import subprocess
import sys
import tempfile
from pathlib import Path

from .tables import command, rows

PACE = ("--row-spacing", "15 cm", "--speed", "8 km/h")
REPLICATES = 2


def run(*words):
    made = subprocess.run(words, capture_output=True, text=True)
    if made.returncode != 0:
        sys.exit(f"scripts/figures: {' '.join(words)}: {made.stderr.strip()}")


def planned_and_run(program, crop, rate):
    """The plan's best layout and what its seeder gives, as a row."""
    with tempfile.TemporaryDirectory(prefix="planned-") as scratch:
        plan, study = f"{scratch}/plan", Path(scratch) / "study.toml"
        run(program, "plan", "--crop", crop, "--rate", rate, *PACE, "--out", plan)
        study.write_text(f'base = "{plan}/seeder.toml"\nreplicates = {REPLICATES}\n', encoding="utf-8")
        run(program, "sweep", str(study), "--quiet", "--jobs", str(REPLICATES), "--out", f"{scratch}/out")
        best, made = rows(f"{plan}/plan.csv")[0], rows(f"{scratch}/out/sweep.csv")[0]
    planned, simulated = float(best["hole_seeds_per_s"]), float(made["seeds_per_s"]) / int(best["holes"])
    chance = float(made["seeds_per_s_ci95"]) / float(made["seeds_per_s"]) * 100
    allowed = math.hypot(float(best["chance_percent"]), float(best["numerics_percent"]), chance)
    return [crop, rate, *(best[name] for name in ("holes", "rows", "width_over_seed", "frequency_Hz", "contact_times")), f"{planned:.4g}",
            f"{simulated:.4g}", f"{chance:.2g}", f"{100 * (planned / simulated - 1):.2g}", f"{allowed:.2g}"]


def planned_runs(options):
    """Plans beside runs: CROP=RATE, each sown every 15 cm at 8 km/h. Prints CSV, a row per crop: its best layout, by how much the table was
    multiplied for its contact, seeds/s of a hole as planned and in two runs of the seeder that the plan wrote, by how much the plan missed
    them, and by how much it may: chance of both and the plan's numerics, 95 %."""
    out = csv.writer(sys.stdout, lineterminator="\n")
    out.writerow("crop,rate,holes,rows,width_over_seed,frequency_Hz,contact_times,planned_seeds_per_s,simulated_seeds_per_s,simulated_ci95_percent,"
                 "missed_percent,allowed_percent".split(","))
    for crop in options.crops:
        out.writerow(planned_and_run(options.program, *crop.split("=", 1)))


def add_commands(commands):
    parser = command(commands, "planned-runs", planned_runs)
    parser.add_argument("program", metavar="VIBROSOW")
    parser.add_argument("crops", nargs="+", metavar="CROP=RATE")
