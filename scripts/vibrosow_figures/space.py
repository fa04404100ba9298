"""Balls in space as a camera far away sees them: shaded, with their shadows, between walls of glass."""
import math
from dataclasses import dataclass, field

import numpy as np
from scipy import ndimage

FINE = 3  # picture elements a side that are averaged into one of the picture
LIGHT = np.array([-0.5, 0.8, -0.55]) / np.linalg.norm([-0.5, 0.8, -0.55])  # towards it
METAL, GLASS, EDGE = np.array([0.78, 0.81, 0.84]), np.array([0.62, 0.72, 0.80]), np.array([0.30, 0.36, 0.42])


@dataclass
class Plate:
    """A parallelogram `origin` + s `along` + t `across` with s and t from 0 to 1, in mm, or its half, s + t <= 1; without what
    `left_out` says of the places on it, mm from its origin along its sides."""
    origin: np.ndarray
    along: np.ndarray
    across: np.ndarray
    colour: np.ndarray = field(default_factory=lambda: GLASS)
    opacity: float = 0.12
    half: bool = False
    left_out: object = None


@dataclass
class Shell:
    """What there is of a vessel: plates, and lines of points in mm that are drawn as rods."""
    plates: list
    lines: list

    def moved(self, place):
        """`place` takes points (a row each) to where they are."""
        origin = place(np.zeros((1, 3)))[0]

        def plate(one):
            start, along, across = place(np.array([one.origin, one.along, one.across]))
            return Plate(start, along - origin, across - origin, one.colour, one.opacity, one.half, one.left_out)

        return Shell([plate(one) for one in self.plates], [place(np.asarray(line, float)) for line in self.lines])


def rectangle(origin, along, across, **more):
    """A plate and its outline."""
    origin, along, across = (np.array(v, float) for v in (origin, along, across))
    return Shell([Plate(origin, along, across, **more)], [[origin, origin + along, origin + along + across, origin + across, origin]])


def circle(centre, radius, height, parts=72):
    turn = np.linspace(0, 2 * math.pi, parts + 1)
    return np.stack([centre[0] + radius * np.cos(turn), np.full(parts + 1, height), centre[1] + radius * np.sin(turn)], axis=1)


def between_rings(lower, upper):
    """The surface between two rings of points, as triangles."""
    plates = []
    for a, b, c, d in zip(lower, lower[1:], upper, upper[1:]):
        plates += [Plate(a, b - a, c - a, half=True), Plate(d, c - d, b - d, half=True)]
    return Shell(plates, [lower, upper])


def joined(shells):
    return Shell([plate for shell in shells for plate in shell.plates], [line for shell in shells for line in shell.lines])


def hole_of(hole):
    """(x, z, half length, half depth) in mm, and whether it is round."""
    half = 500 * hole["width_m"]
    round_hole = hole.get("shape") == "round"
    return 1e3 * hole["centre_m"], 1e3 * hole.get("across_m", 0), half, half if round_hole else 500 * hole.get("across_length_m", 0), round_hole


def in_a_hole(holes):
    def left_out(x, z):
        inside = np.zeros(np.broadcast(x, z).shape, bool)
        for at_x, at_z, half_x, half_z, is_round in holes:
            a, b = (x - at_x) / half_x, (z - at_z) / half_z
            inside |= a * a + b * b < 1 if is_round else (abs(a) < 1) & (abs(b) < 1)
        return inside
    return left_out


def rim(hole):
    x, z, half_x, half_z, is_round = hole
    if is_round:
        return circle((x, z), half_x, 0)
    return [(x + a * half_x, 0, z + b * half_z) for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1), (-1, -1))]


def flat_floor(vessel, depth):
    holes = [hole_of(hole) for hole in vessel["holes"]]
    floor = rectangle((0, 0, 0), (1e3 * vessel["length_m"], 0, 0), (0, 0, depth), colour=METAL, opacity=0.93, left_out=in_a_hole(holes))
    return Shell(floor.plates, floor.lines + [rim(hole) for hole in holes])


def round_vessel(vessel):
    radius, height = 500 * vessel["length_m"], 1e3 * vessel["height_m"]
    centre, outlet = (radius, radius), 500 * vessel["holes"][0]["width_m"] if vessel["holes"] else 0
    if vessel["funnel_rad"] > 0:
        top = math.tan(vessel["funnel_rad"]) * (radius - outlet)
        bottom = between_rings(circle(centre, outlet, 0), circle(centre, radius, top))
    else:
        top, bottom = 0, flat_floor(vessel, 2 * radius)
        in_holes = bottom.plates[0].left_out
        bottom.plates[0].left_out = lambda x, z: in_holes(x, z) | ((x - radius)**2 + (z - radius)**2 > radius * radius)
        bottom.lines = bottom.lines[1:]
    return joined([bottom, between_rings(circle(centre, radius, top), circle(centre, radius, height))])


def shell_of(vessel, lines_of):
    """Of a vessel in its own frame. `lines_of` gives the lines of its side view: with True of all its walls, else of its pieces."""
    depth, length, height = (1e3 * vessel[key] for key in ("depth_m", "length_m", "height_m"))
    sloped, is_round = vessel["funnel_rad"] > 0, vessel.get("plan") == "round"
    straight = vessel | {"pieces": [piece for piece in vessel["pieces"] if "about_m" not in piece]}
    parts = [turned_about(piece) for piece in vessel["pieces"] if "about_m" in piece]
    parts += [drawn_out(line, depth) for line in lines_of(straight, vessel["box"] and sloped and not is_round)]
    if vessel["box"] and is_round:
        return joined([round_vessel(vessel), *parts])
    if vessel["box"] and not sloped:
        parts.append(flat_floor(vessel, depth))
        if vessel["sides"] == "walls":
            parts += [rectangle((x, 0, 0), (0, height, 0), (0, 0, depth)) for x in (0, length)]
    if vessel["box"] and vessel.get("front_and_back", "walls") == "walls":
        parts += [rectangle((0, 0, z), (length, 0, 0), (0, height, 0), opacity=0.05 if z == 0 else 0.12) for z in (0, depth)]
    return joined(parts)


def drawn_out(line, depth):
    """From front to back."""
    front, across = np.column_stack([line, np.zeros(len(line))]), np.array([0, 0, depth])
    ends = [] if np.allclose(front[0], front[-1]) else [[front[k], front[k] + across] for k in (0, -1)]
    return Shell([Plate(a, b - a, across) for a, b in zip(front, front[1:])], [front, front + across, *ends])


def turned_about(piece):
    """A line turned about an axis, upright or along."""
    (aside, z), ends = piece["about_m"], [1e3 * np.array(piece[key]) for key in ("from_m", "to_m")]
    rings = [circle((1e3 * aside, 1e3 * z), radius, place) for radius, place in ends]
    return between_rings(*(ring[:, [1, 0, 2]] if piece.get("axis") == "along" else ring for ring in rings))


def rotation(quaternion):
    """The matrix of a unit quaternion w, x, y, z."""
    w, x, y, z = quaternion
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                     [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                     [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])


class Camera:
    """Seen from the front, turned by so much to the right and raised by so much, in degrees. Views are in picture elements:
    to the right, up, and towards the camera."""

    def __init__(self, turn, raised):
        t, e = math.radians(turn), math.radians(raised)
        self.axes = np.array([[math.cos(t), 0, math.sin(t)],
                              [-math.sin(t) * math.sin(e), math.cos(e), math.cos(t) * math.sin(e)],
                              [math.sin(t) * math.cos(e), math.sin(e), -math.cos(t) * math.cos(e)]])

    def look_at(self, points, width, room):
        """Scales so that `points` are `width` picture elements wide, with room about them (in parts of the width)."""
        seen = points @ self.axes.T
        low, high = seen.min(axis=0)[:2], seen.max(axis=0)[:2]
        self.scale = width / ((high[0] - low[0]) * (1 + 2 * room))
        self.corner = low - room * (high[0] - low[0])
        self.shape = math.ceil(self.scale * (high[1] - low[1] + 2 * room * (high[0] - low[0]))), width

    def see(self, points):
        seen = np.asarray(points, float) @ self.axes.T
        seen[:, :2] -= self.corner
        return self.scale * seen

    def direction(self, vector):
        return self.axes @ vector


def nearest(balls, shape):
    """Of each picture element how near the nearest ball is there, and which; -inf and -1 without one. A row a ball: x, y, nearness,
    radius."""
    near, which = np.full(shape, -np.inf, np.float32), np.full(shape, -1, np.int32)
    for k, (x, y, z, r) in enumerate(balls):
        left, right = max(0, math.ceil(x - r)), min(shape[1] - 1, math.floor(x + r))
        low, high = max(0, math.ceil(y - r)), min(shape[0] - 1, math.floor(y + r))
        if left > right or low > high:
            continue
        dx, dy = np.arange(left, right + 1) - x, np.arange(low, high + 1) - y
        rise = r * r - dy[:, None]**2 - dx**2
        here = z + np.sqrt(np.maximum(rise, 0))
        window, ids = near[low:high + 1, left:right + 1], which[low:high + 1, left:right + 1]
        nearer = (rise > 0) & (here > window)
        window[nearer], ids[nearer] = here[nearer], k
    return near, which


class Shadows:
    """How much of the light reaches a place; the balls alone throw shadows."""

    def __init__(self, balls, light, grain):
        side = np.cross(light, [0.0, 0.0, 1.0])
        side /= np.linalg.norm(side)
        self.axes = np.array([side, np.cross(light, side), light])
        self.coarse = max(1.0, grain / 12)
        seen = balls[:, :3] @ self.axes.T / self.coarse
        radii = balls[:, 3] / self.coarse
        self.corner = (seen[:, :2] - radii[:, None]).min(axis=0) - 4
        seen[:, :2] -= self.corner
        high = (seen[:, :2] + radii[:, None]).max(axis=0) + 4
        self.near, _ = nearest(np.column_stack([seen, radii]), (math.ceil(high[1]), math.ceil(high[0])))
        self.slack = 0.25 * grain / self.coarse

    def light_at(self, points):
        seen = points @ self.axes.T / self.coarse
        column, row = (np.rint(seen[:, k] - self.corner[k]).astype(int) for k in (0, 1))
        lit = np.zeros(len(points))
        for up in (-2, 0, 2):
            for aside in (-2, 0, 2):
                r, c = row + up, column + aside
                known = (r >= 0) & (c >= 0) & (r < self.near.shape[0]) & (c < self.near.shape[1])
                blocked = self.near[np.where(known, r, 0), np.where(known, c, 0)] > seen[:, 2] + self.slack
                lit += ~(known & blocked) / 9
        return lit


def hollows(near, grain):
    """How deep each picture element lies under what is about it, from 0 to 1."""
    filled = np.where(np.isfinite(near), near, near[np.isfinite(near)].min())
    deep = [np.clip((ndimage.gaussian_filter(filled, size * grain) - filled) / (1.5 * size * grain), 0, 1) for size in (0.5, 1.6)]
    return np.clip(0.7 * deep[0] + 0.5 * deep[1], 0, 1)


def rods(lines, camera, radius):
    """Balls along lines, so near each other that they look like rods."""
    balls = []
    for line in lines:
        seen = camera.see(line)
        for a, b in zip(seen, seen[1:]):
            steps = max(2, math.ceil(np.linalg.norm(b - a) / (0.2 * radius)))
            balls.append(a + np.linspace(0, 1, steps)[:, None] * (b - a))
    places = np.concatenate(balls)
    return np.column_stack([places, np.full(len(places), radius)])


def shaded(near, which, balls, colours, light, shadows, grain):
    """The picture of the balls on white."""
    picture = np.ones((*near.shape, 3), np.float32)
    row, column = np.nonzero(which >= 0)
    k = which[row, column]
    places = np.column_stack([column, row, near[row, column]]).astype(float)
    normals = (places - balls[k, :3]) / balls[k, 3:]
    facing = normals @ light
    lit = np.clip(facing, 0, 1) * shadows.light_at(places + 0.1 * grain * normals)
    half_way = light + [0, 0, 1]
    gloss = np.clip(normals @ (half_way / np.linalg.norm(half_way)), 0, 1)**40 * (lit > 0)
    sky = 0.5 + 0.16 * normals[:, 1] + 0.10 * normals[:, 2]
    brightness = sky * (1 - 0.75 * hollows(near, grain)[row, column]) + 0.62 * lit
    picture[row, column] = np.clip(colours[k] * brightness[:, None] + 0.22 * gloss[:, None], 0, 1)
    return picture


def lay_on(picture, near, plate, camera, light, shadows):
    """Lays a plate over what lies behind it."""
    origin, far, aside = camera.see([plate.origin, plate.origin + plate.along, plate.origin + plate.across])
    along, across = far - origin, aside - origin
    sides = np.array([along[:2], across[:2]]).T
    if abs(np.linalg.det(sides)) < 1:
        return  # seen edge on
    corners = np.array([origin, far, aside, origin if plate.half else far + across])
    low = np.maximum(np.floor(corners[:, :2].min(axis=0)).astype(int), 0)
    high = np.minimum(np.ceil(corners[:, :2].max(axis=0)).astype(int) + 1, near.shape[::-1])
    if np.any(low >= high):
        return
    column, row = np.meshgrid(np.arange(low[0], high[0]), np.arange(low[1], high[1]))
    inverse = np.linalg.inv(sides)
    s = inverse[0, 0] * (column - origin[0]) + inverse[0, 1] * (row - origin[1])
    t = inverse[1, 0] * (column - origin[0]) + inverse[1, 1] * (row - origin[1])
    here = origin[2] + s * along[2] + t * across[2]
    seen = (s >= 0) & (t >= 0) & ((s + t <= 1) if plate.half else (s <= 1) & (t <= 1)) & (here > near[row, column])
    if plate.left_out is not None:
        seen &= ~plate.left_out(s * np.linalg.norm(plate.along), t * np.linalg.norm(plate.across))
    row, column, here = row[seen], column[seen], here[seen]
    colour = plate.colour
    if plate.opacity > 0.5:
        normal = np.cross(along, across)
        normal *= np.sign(normal[2]) / np.linalg.norm(normal)
        lit = shadows.light_at(np.column_stack([column, row, here])) * max(0.0, normal @ light)
        colour = np.clip(plate.colour * (0.62 + 0.45 * lit)[:, None], 0, 1)
    picture[row, column] += plate.opacity * (colour - picture[row, column])


def render(balls, colours, shell, camera, width):
    """A picture, rows from above, of balls (x, y, z, radius in mm, a row each) and a shell; `width` picture elements wide."""
    corners = np.concatenate([balls[:, :3] - balls[:, 3:], balls[:, :3] + balls[:, 3:], *shell.lines])
    camera.look_at(corners, FINE * width, 0.02)
    seen = np.column_stack([camera.see(balls[:, :3]), camera.scale * balls[:, 3]])
    light, grain = camera.direction(LIGHT), float(np.median(seen[:, 3]))
    edges = rods(shell.lines, camera, 0.8 * FINE)
    shadows = Shadows(seen, light, grain)
    everything = np.concatenate([seen, edges])
    near, which = nearest(everything, camera.shape)
    picture = shaded(near, np.where(which < len(seen), which, -1), seen, colours, light, shadows, grain)
    picture[which >= len(seen)] = EDGE
    for plate in sorted(shell.plates, key=lambda one: float((camera.see([one.origin]) + camera.see([one.origin + one.along + one.across]))[0, 2])):
        lay_on(picture, near, plate, camera, light, shadows)
    rows, columns = (size // FINE * FINE for size in camera.shape)
    fine = picture[:rows, :columns].reshape(rows // FINE, FINE, columns // FINE, FINE, 3)
    return fine.mean(axis=(1, 3))[::-1]
