"""Reads pictures (LAMMPS' text dumps of id, x, y, in space z) and counts what touches in them."""
import itertools
import math
from collections import defaultdict


def pictures(path):
    """Yields (step, [(x, y), ...]) of each picture, or (x, y, z)."""
    with open(path) as file:
        for line in file:
            if line.startswith('ITEM: TIMESTEP'):
                step = int(next(file))
            elif line.startswith('ITEM: NUMBER'):
                number = int(next(file))
            elif line.startswith('ITEM: ATOMS'):
                rows = (next(file).split() for _ in range(number))
                yield step, [tuple(map(float, row[1:])) for row in rows]


def pair_contacts(places, diameter):
    cells = defaultdict(list)
    for place in places:
        cells[tuple(math.floor(x / diameter) for x in place)].append(place)
    dimensions = len(places[0])
    ahead = [offset for offset in itertools.product((-1, 0, 1), repeat=dimensions) if offset > (0,) * dimensions]
    count = 0
    for cell, own in cells.items():
        near = [p for offset in ahead for p in cells.get(tuple(map(sum, zip(cell, offset))), ())]
        for k, place in enumerate(own):
            count += sum(1 for other in near + own[k + 1:] if math.dist(place, other) < diameter)
    return count


def distance2_to_wall(x, y, wall):
    (ax, ay), (bx, by) = wall
    ex, ey = bx - ax, by - ay
    along = min(1, max(0, ((x - ax) * ex + (y - ay) * ey) / (ex * ex + ey * ey)))
    return (x - ax - along * ex)**2 + (y - ay - along * ey)**2


def wall_contacts(places, scene, shift):
    radius = scene.radius
    count = sum(1 for x, y, *_ in places for wall in scene.walls if distance2_to_wall(x - shift, y, wall) < radius**2)
    if scene.depth:
        count += sum((z < radius) + (scene.depth - z < radius) for _, _, z in places)
    return count


def mean_contacts(path, scene, dt, after):
    """Mean number of touching contacts, walls included, over the pictures after step `after`."""
    counts = [pair_contacts(places, 2 * scene.radius) + wall_contacts(places, scene, scene.displacement(step * dt))
              for step, places in pictures(path) if step > after]
    return sum(counts) / len(counts)
