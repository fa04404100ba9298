"""Reads pictures (LAMMPS' text dumps of id, x, y) and counts what touches in them."""
import math
from collections import defaultdict


def pictures(path):
    """Yields (step, [(x, y), ...]) of each picture."""
    with open(path) as file:
        for line in file:
            if line.startswith('ITEM: TIMESTEP'):
                step = int(next(file))
            elif line.startswith('ITEM: NUMBER'):
                number = int(next(file))
            elif line.startswith('ITEM: ATOMS'):
                rows = (next(file).split() for _ in range(number))
                yield step, [(float(row[1]), float(row[2])) for row in rows]


def pair_contacts(places, diameter):
    cells = defaultdict(list)
    for x, y in places:
        cells[math.floor(x / diameter), math.floor(y / diameter)].append((x, y))
    count = 0
    for (column, row), own in cells.items():
        near = [p for c, r in ((1, -1), (1, 0), (1, 1), (0, 1)) for p in cells.get((column + c, row + r), ())]
        for k, (x, y) in enumerate(own):
            count += sum(1 for a, b in near + own[k + 1:] if (a - x)**2 + (b - y)**2 < diameter**2)
    return count


def distance2_to_wall(x, y, wall):
    (ax, ay), (bx, by) = wall
    ex, ey = bx - ax, by - ay
    along = min(1, max(0, ((x - ax) * ex + (y - ay) * ey) / (ex * ex + ey * ey)))
    return (x - ax - along * ex)**2 + (y - ay - along * ey)**2


def wall_contacts(places, walls, shift, radius):
    return sum(1 for x, y in places for wall in walls if distance2_to_wall(x - shift, y, wall) < radius**2)


def mean_contacts(path, scene, dt, after):
    """Mean number of touching contacts, walls included, over the pictures after step `after`."""
    counts = [pair_contacts(places, 2 * scene.radius) +
              wall_contacts(places, scene.walls, scene.displacement(step * dt), scene.radius)
              for step, places in pictures(path) if step > after]
    return sum(counts) / len(counts)
