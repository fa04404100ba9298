"""A picture of a bed: its grains, the vessels about them, and what falls out of their holes."""
import json
import math
import os
import re
import sys

import matplotlib
import numpy as np

matplotlib.use("Agg")
from matplotlib import pyplot
from matplotlib.cm import ScalarMappable
from matplotlib.collections import EllipseCollection, LineCollection
from matplotlib.colors import LinearSegmentedColormap, Normalize

from . import space
from .tables import command, number, rows

# Seed-coloured even at rest: the palest tenth of the map is left out.
SEEDS = LinearSegmentedColormap.from_list("seeds", matplotlib.colormaps["YlOrBr"](np.linspace(0.1, 1, 256))).with_extremes(bad="lightgrey")
LABELS = {"speed": "speed against the tray, m/s", "shear": "shear strain since the record before"}
WALL = "#37424d"


def stripes(table, height):
    """Every second stripe of starting height 1, the others 0."""
    starts = np.array([float(row["start_y_mm"]) for row in table])
    height = height or np.ptp(starts) / 10 or 1
    return np.floor((starts - starts.min()) / height) % 2


def values_and_colours(table, options):
    """A value per grain, the colour map, and the range of values."""
    if options.by == "start":
        return stripes(table, options.stripe), "cividis", (0, 1.25)
    if options.by == "lot":
        lots = sorted({row["lot"] for row in table})
        return [lots.index(row["lot"]) for row in table], "tab10", (0, 10)
    if options.by == "shear":
        values = np.array([number(row["shear"]) for row in table])
    else:
        parts = [[float(row[name]) for row in table] for name in ("vx_m_per_s", "vy_m_per_s", "vz_m_per_s") if name in table[0]]
        values = np.linalg.norm(parts, axis=0)
    if np.all(np.isnan(values)):
        sys.exit(f"{options.grains}: no grain has a {options.by}; the first record of a run has no shear")
    return values, SEEDS, (0, options.most or np.nanpercentile(values, 95) or 1)


def read_scene(path):
    """The scene of the run that wrote `path`; empty where run.json is not beside it."""
    try:
        with open(os.path.join(os.path.dirname(path), "run.json"), encoding="utf-8") as file:
            return json.load(file)["scene"]
    except FileNotFoundError:
        return {}


def clumps(scene):
    """(diameter, discs or balls) in mm of each lot whose grains are clumps; of each disc x, y, z and radius."""
    def in_mm(disc):
        return [1e3 * disc.get(key, 0) for key in ("x_m", "y_m", "z_m", "radius_m")]

    return {lot["name"]: (1e3 * lot["diameter_m"], [in_mm(disc) for disc in lot["discs"]])
            for lot in scene.get("lots", []) if "discs" in lot}


def discs(row, shapes):
    """(x, y, radius) in mm of each disc of a grain."""
    x, y, radius = (float(row[name]) for name in ("x_mm", "y_mm", "radius_mm"))
    if row["lot"] not in shapes:
        return [(x, y, radius)]
    diameter, parts = shapes[row["lot"]]
    angle = float(row["angle_rad"])
    cosine, sine, size = math.cos(angle), math.sin(angle), 2 * radius / diameter
    return [(x + size * (cosine * a - sine * b), y + size * (sine * a + cosine * b), size * r) for a, b, _, r in parts]


def floor(vessel):
    """Lines of a box: its end walls, and its floor, which slopes towards the holes by the funnel's angle; all in m."""
    length, slope = vessel["length_m"], math.tan(vessel["funnel_rad"])
    lefts, rights = ([hole["centre_m"] + side * hole["width_m"] / 2 for hole in vessel["holes"]] for side in (-1, 1))
    lines = [[(start, 0), ((start + end) / 2, slope * (end - start) / 2), (end, 0)] for start, end in zip(rights, lefts[1:])]
    if lefts:
        lines = [[(0, slope * lefts[0]), (lefts[0], 0)], *lines, [(rights[-1], 0), (length, slope * (length - rights[-1]))]]
    else:
        lines = [[(0, 0), (length, 0)]]
    if vessel["sides"] == "walls":
        lines[0].insert(0, (0, vessel["height_m"]))
        lines[-1].append((length, vessel["height_m"]))
    return lines


def arc(piece):
    angles = np.linspace(piece["from_rad"], piece["to_rad"], 90)
    (x, y), radius = piece["centre_m"], piece["radius_m"]
    return list(zip(x + radius * np.cos(angles), y + radius * np.sin(angles)))


def turned_about(piece):
    """Both sides of a piece that is turned about an axis, upright or along."""
    axis, ends = piece["about_m"][0], (piece["from_m"], piece["to_m"])
    if piece.get("axis") == "along":
        return [[(x, axis + side * radius) for radius, x in ends] for side in (-1, 1)]
    return [[(axis + side * radius, y) for radius, y in ends] for side in (-1, 1)]


def outline(vessel, box):
    """Lines of a vessel's walls in its own frame, in mm, with those of its box or without."""
    lines = floor(vessel) if box else []
    for piece in vessel["pieces"]:
        lines += turned_about(piece) if "about_m" in piece else [arc(piece) if "radius_m" in piece else [piece["from_m"], piece["to_m"]]]
    return [1e3 * np.array(line) for line in lines]


def turned(line, angle):
    cosine, sine = math.cos(angle), math.sin(angle)
    return line @ np.array([[cosine, sine], [-sine, cosine]])


def displacement(vessel, time):
    """Of a vessel from where it stands at rest, (x, y, z) in mm: of a harmonic motion between its ramps. Zero of all others."""
    motion = vessel["motion"]
    if not motion or motion["kind"] != "harmonic":
        return np.zeros(3)
    stop = motion["stop_s"]
    if time < motion["ramp_s"] or (stop is not None and time > stop):
        return np.zeros(3)
    along = 1e3 * motion["amplitude_m"] * math.sin(2 * math.pi * motion["frequency_hz"] * time + motion["phase_rad"])
    direction, across = motion["direction_rad"], motion.get("across_rad", 0)
    return along * np.array([math.cos(across) * math.cos(direction), math.cos(across) * math.sin(direction), math.sin(across)])


def place_of_hopper(scene, time):
    """(x, y, z) in mm in the lab's directions, from the tray's zero."""
    tray, hopper = scene["tray"], scene["hopper"]
    at_rest = 1e3 * np.array([hopper["left_m"], hopper["above_m"], hopper.get("front_m", 0) - tray.get("front_m", 0)])
    return at_rest + displacement(hopper, time) - displacement(tray, time)


def in_side_view(vessel, cut_at):
    """The vessel with one hole, as a plane one has it, wherever its floor in space is open: anywhere across, or `cut_at` mm from its
    front."""
    spans = []
    for x, z, half_x, half_z, is_round in map(space.hole_of, vessel["holes"]):
        off = 0 if cut_at is None else abs(cut_at - z)
        if off > half_z:
            continue
        half = math.sqrt(half_x**2 - off**2) if is_round else half_x
        spans.append([x - half, x + half])
    merged = []
    for low, high in sorted(spans):
        if merged and low <= merged[-1][1]:
            merged[-1][1] = max(high, merged[-1][1])
        else:
            merged.append([low, high])
    return vessel | {"holes": [{"centre_m": (low + high) / 2000, "width_m": (high - low) / 1000} for low, high in merged]}


def walls(scene, time, view="plane"):
    """Lines of the tray and of the hopper, in the tray's frame, in mm."""
    if not scene:
        return []
    tray, hopper = scene["tray"], scene.get("hopper")
    middle = 500 * tray["depth_m"] if view == "cut" else None
    lines = outline(tray if view == "plane" else in_side_view(tray, middle), tray["box"])
    if hopper:
        place = place_of_hopper(scene, time)
        if view != "plane":
            hopper = in_side_view(hopper, None if middle is None else middle - place[2])
        lines += [turned(turned(line, hopper["tilt_rad"]) + place[:2], -tray["tilt_rad"]) for line in outline(hopper, hopper["box"])]
    return lines


def shell(scene, time):
    """The tray and the hopper in space, in the tray's frame."""
    if not scene:
        return space.Shell([], [])
    tray, hopper = scene["tray"], scene.get("hopper")
    parts = [space.shell_of(tray, outline)]
    if hopper:
        place = place_of_hopper(scene, time)

        def in_tray_frame(points):
            in_lab = np.column_stack([turned(points[:, :2], hopper["tilt_rad"]), points[:, 2]]) + place
            return np.column_stack([turned(in_lab[:, :2], -tray["tilt_rad"]), in_lab[:, 2]])

        parts.append(space.shell_of(hopper, outline).moved(in_tray_frame))
    return space.joined(parts)


def time_of(path):
    """When the record was taken, s; records.csv beside it tells. Zero without."""
    number_of = re.search(r"grains_(\d+)\.csv$", path)
    records = os.path.join(os.path.dirname(path), "records.csv")
    if not number_of or not os.path.exists(records):
        return 0.0
    return next((float(r["time_s"]) for r in rows(records) if int(r["record"]) == int(number_of[1])), 0.0)


def bounds_of(parts, lines):
    """Corners of the smallest box around all discs and walls, with a little room."""
    places, radii = parts[:, :2], parts[:, 2:3]
    points = np.concatenate([places - radii, places + radii, *lines])
    room = 0.02 * np.ptp(points, axis=0).max()
    return points.min(axis=0) - room, points.max(axis=0) + room


def add_discs(axes, parts, colours, limits):
    x, y, radius, values = parts.T
    grains = EllipseCollection(2 * radius, 2 * radius, np.zeros(len(x)), units="x", offsets=parts[:, :2], transOffset=axes.transData,
                               cmap=colours, edgecolor="#4a2c12", linewidth=0.35, zorder=2)
    grains.set_array(values)
    grains.set_clim(*limits)
    return axes.add_collection(grains)


def add_scale(axes, low, high):
    """A bar instead of axes: the longest of 1, 2, 5, 10, .. mm below a tenth of the width."""
    tenth = (high[0] - low[0]) / 10
    length = max(n * 10**k for n in (1, 2, 5) for k in range(-2, 6) if n * 10**k <= tenth)
    right, up = high[0] - 0.02 * (high[0] - low[0]), low[1] + 0.04 * (high[1] - low[1])
    axes.plot([right - length, right], [up, up], color=WALL, linewidth=2, solid_capstyle="butt")
    axes.annotate(f"{length:g} mm", (right - length / 2, up), xytext=(0, 4), textcoords="offset points", ha="center", color=WALL)


def balls(table, scene):
    """(x, y, z, radius) in mm, a row a ball, and of each ball the number of its grain."""
    shapes, rows_of_balls, grain = clumps(scene), [], []
    for number_of, row in enumerate(table):
        x, y, z, radius = (float(row[name]) for name in ("x_mm", "y_mm", "z_mm", "radius_mm"))
        parts = [(x, y, z, radius)]
        if row["lot"] in shapes:
            diameter, shape = shapes[row["lot"]]
            shape = np.array(shape) * (2 * radius / diameter)
            arms = shape[:, :3] @ space.rotation([float(row[name]) for name in ("q_w", "q_x", "q_y", "q_z")]).T
            parts = np.column_stack([arms + (x, y, z), shape[:, 3]])
        rows_of_balls += [tuple(part) for part in parts]
        grain += [number_of] * len(parts)
    return np.array(rows_of_balls), np.array(grain)


def parts_to_draw(table, values, scene, options):
    """(x, y, radius, value) of each disc, what is drawn later above what is drawn before."""
    if "z_mm" not in table[0]:
        shapes = clumps(scene)
        return np.array([(*disc, value) for row, value in zip(table, values) for disc in discs(row, shapes)])
    seeds, grain = balls(table, scene)
    x, y, z, radius = seeds.T
    values = np.asarray(values)[grain]
    if options.view == "side":
        far_first = np.argsort(-z, kind="stable")
        return np.column_stack([x, y, radius, values])[far_first]
    from_cut = z - middle(scene, z)
    cut = abs(from_cut) < radius
    return np.column_stack([x, y, np.sqrt(np.maximum(radius**2 - from_cut**2, 0)), values])[cut]


def middle(scene, z):
    """Of the depth, mm."""
    return 500 * scene["tray"]["depth_m"] if scene else (z.min() + z.max()) / 2


def draw_3d(table, options):
    """Seen from above and aside."""
    scene = read_scene(options.grains)
    values, colours, limits = values_and_colours(table, options)
    of_value = ScalarMappable(Normalize(*limits), colours)
    seeds, grain = balls(table, scene)
    of_ball, camera = of_value.to_rgba(values)[grain, :3], space.Camera(options.turn, options.raised)
    if options.open:
        left = (seeds[:, 2] >= middle(scene, seeds[:, 2])) | (seeds[:, 1] < 0)
        seeds, of_ball = seeds[left], of_ball[left]
    picture = space.render(seeds, of_ball, shell(scene, time_of(options.grains)), camera, options.width)
    save_picture(picture, camera.scale / space.FINE, of_value if options.by in LABELS else None, options)


def save_picture(picture, scale, of_value, options):
    """`scale`: picture elements a mm; the value's bar stands below the picture."""
    tall, wide = picture.shape[:2]
    band = max(70, 0.07 * wide) if of_value else 0
    figure = pyplot.figure(figsize=(wide / 100, (tall + band) / 100), dpi=100)
    axes = figure.add_axes((0, band / (tall + band), 1, tall / (tall + band)))
    axes.imshow(picture, interpolation="none", extent=(0, wide / scale, 0, tall / scale), aspect="auto")
    axes.set(xlim=(0, wide / scale), ylim=(0, tall / scale))
    axes.set_axis_off()
    add_scale(axes, (0, 0), (wide / scale, tall / scale))
    if of_value:
        bar = figure.add_axes((0.32, 0.7 * band / (tall + band), 0.36, 0.12 * band / (tall + band)))
        figure.colorbar(of_value, cax=bar, label=LABELS[options.by], orientation="horizontal")
    small = {"pil_kwargs": {"quality": 90}} if options.picture.endswith(".jpg") else {}
    figure.savefig(options.picture, dpi=100, facecolor="white", **small)


def draw(table, options):
    if "z_mm" in table[0] and options.view == "space":
        return draw_3d(table, options)
    scene = read_scene(options.grains)
    values, colours, limits = values_and_colours(table, options)
    parts = parts_to_draw(table, values, scene, options)
    lines = walls(scene, time_of(options.grains), options.view if "z_mm" in table[0] else "plane")
    low, high = bounds_of(parts, lines)
    wide, tall = high - low

    figure, axes = pyplot.subplots(figsize=(12, min(16, max(2, 12 * tall / wide))))
    axes.add_collection(LineCollection(lines, colors=WALL, linewidths=5, capstyle="round", joinstyle="round", zorder=1))
    grains = add_discs(axes, parts, colours, limits)
    axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), aspect="equal")
    axes.set_axis_off()
    add_scale(axes, low, high)
    if options.by in LABELS:
        figure.colorbar(grains, ax=axes, label=LABELS[options.by], orientation="horizontal", shrink=0.4, aspect=40, pad=0.02)
    figure.savefig(options.picture, dpi=130, bbox_inches="tight", facecolor="white")


def draw_bed(options):
    """Draws a grains_NNN.csv of `vibrosow run` as a picture: grains, tray and hopper.

    Each grain is coloured by the stripe of height where it started, by its shear strain since the record before, by its speed
    against the tray, or by lot; clumps as their discs. Walls and clumps' shapes are told by run.json, the moment by records.csv
    beside the file. All is in the tray's frame; a hopper is put where it stood when the tray's motion is harmonic, and else
    where it stands while the tray is at rest.

    Balls in space are shown as a camera in front of the tray sees them, turned to its right and raised; from the side, the
    nearest in front; or cut through the middle of the depth."""
    table = rows(options.grains)
    if not table:
        sys.exit(f"{options.grains}: no grains")
    draw(table, options)


def add_commands(commands):
    parser = command(commands, "draw", draw_bed)
    parser.add_argument("grains", metavar="GRAINS_CSV")
    parser.add_argument("picture", metavar="PICTURE", help="file to write: .png, .jpg, .svg or .pdf")
    parser.add_argument("--by", choices=["start", "shear", "speed", "lot"], default="start")
    parser.add_argument("--stripe", type=float, metavar="MM", help="height of a stripe of starts; default: a tenth")
    parser.add_argument("--most", type=float, help="value of the darkest colour of shear or speed; default: 95 %% lie below")
    parser.add_argument("--view", choices=["space", "side", "cut"], default="space", help="of balls in space; default: space")
    parser.add_argument("--open", action="store_true", help="leave out the seeds over the floor in the front half of the depth")
    parser.add_argument("--turn", type=float, default=25, metavar="DEGREES", help="of the camera; default: %(default)s")
    parser.add_argument("--raised", type=float, default=20, metavar="DEGREES", help="of the camera; default: %(default)s")
    parser.add_argument("--width", type=int, default=1400, metavar="PIXELS", help="of a picture in space; default: %(default)s")
