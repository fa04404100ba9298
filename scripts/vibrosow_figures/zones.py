"""Maps of the packing fraction by zones of a bed."""
import csv
import sys

import numpy as np

from .tables import command, mean_and_half_width, rows

ZONES = ("over the holes", "inside", "near the end walls", "surface")


def zone(x, y, holes, length):
    """The name of the zone a cell lies in; all in mm."""
    if y > 120:
        return "surface"
    if x < 40 or x > length - 40:
        return "near the end walls"
    return "over the holes" if y < 40 and any(abs(x - hole) < 20 for hole in holes) else "inside"


def means(path, holes, length):
    """{zone: (mean packing fraction, mean change)} of one map."""
    cells = {}
    for row in rows(path):
        if row["packing_change"] == "":
            sys.exit(f"{path}: the first record has no change")
        x, y = float(row["x_mm"]), float(row["y_mm"])
        if 0 < x < length and y > 0:
            values = float(row["packing_fraction"]), float(row["packing_change"])
            cells.setdefault(zone(x, y, holes, length), []).append(values)
    return {name: np.mean(values, axis=0) for name, values in cells.items()}


def cells(values):
    mean, half = mean_and_half_width(values)
    return [f"{mean:.4f}", "" if half is None else f"{half:.4f}"]


def map_zones(options):
    """Where a bed with holes has loosened and compacted since the record before, by zones.

    Reads one fields_NNN.csv per random seed, writes CSV to standard output: by zone the mean over its cells, with the 95 %
    interval over the seeds (Student's t). Zones, in mm: over a hole (less than 20 off its centre and 40 up), near an end wall
    (40), all else below 120, and, higher, the surface, which also sinks as grains leave."""
    holes = [float(hole) for hole in options.holes.split(",")]
    maps = [means(path, holes, options.length) for path in options.fields]
    table = csv.writer(sys.stdout, lineterminator="\n")
    table.writerow("zone,seeds,packing_fraction,packing_fraction_ci95,packing_change,packing_change_ci95".split(","))
    for name in ZONES:
        of_zone = [one[name] for one in maps if name in one]
        if of_zone:
            packing, change = zip(*of_zone)
            table.writerow([name, len(of_zone), *cells(packing), *cells(change)])


def add_commands(commands):
    parser = command(commands, "map-zones", map_zones)
    parser.add_argument("--length", type=float, required=True, metavar="MM", help="of the tray")
    parser.add_argument("--holes", required=True, metavar="MM,MM", help="their centres")
    parser.add_argument("fields", nargs="+", help="fields_NNN.csv, one per random seed")
