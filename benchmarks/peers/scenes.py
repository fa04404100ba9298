"""Scenes A and B as numbers that every program's deck is fed with. SI throughout."""
import math
from dataclasses import dataclass, field
from typing import NamedTuple

GRAVITY = 9.81


class Window(NamedTuple):
    """Steps before, in and after the timed window, and between two pictures in it (0: none)."""
    lead: int
    steps: int
    rest: int = 0
    sample: int = 0


@dataclass(frozen=True)
class Scene:
    """`lead` and `window` are seconds; `outflow` the time at which grains out are counted (0: nothing leaves); `fallen` that
    at which Vibrosow's grains are taken over by the others, for whom it is time 0."""
    name: str
    file: str
    sets: tuple
    lead: float
    window: float
    outflow: float
    radius: float
    mass: float
    inertia: float
    walls: tuple
    law: dict
    holes: int = 0
    amplitude: float = 0
    frequency: float = 0
    skin: dict = field(default_factory=dict)
    count_at: float = -0.02
    fallen: float = 0

    @property
    def is_tray(self):
        return self.file.startswith('tray')

    def steps(self, dt, checked=False):
        lead, steps = round(self.lead / dt), round(self.window / dt)
        if not checked:
            return Window(lead, steps)
        rest = max(0, round(self.outflow / dt) - lead - steps)
        return Window(lead, steps, rest, max(1, steps // 100))

    def displacement(self, time):
        return self.amplitude * math.sin(2 * math.pi * self.frequency * time)


def damping_ratio(restitution):
    """Of a spring and dashpot whose force never pulls: e = exp(-z (pi - 2 asin z) / sqrt(1 - z^2))."""
    low, high = 0.0, 0.999
    for _ in range(60):
        z = (low + high) / 2
        e = math.exp(-z * (math.pi - 2 * math.asin(z)) / math.sqrt(1 - z * z))
        low, high = (z, high) if e > restitution else (low, z)
    return low


def textbook_restitution(restitution):
    """What to ask of a program that takes e = exp(-pi z / sqrt(1 - z^2)), to get `restitution` from a force that never pulls."""
    z = damping_ratio(restitution)
    return math.exp(-math.pi * z / math.sqrt(1 - z * z))


def shell_law(mass, radius, compression, tangential_ratio=14 / 17):
    """Paper A's shell: m g / 2 eps between grains, m g / eps on walls; restitution 0.5; the tangential spring has
    `tangential_ratio` of the stiffness (as Vibrosow's, where nothing is said), its dashpot half the normal one. gamma = dashpot over reduced mass, 1/s, is the same for grains and walls."""
    kn = mass * GRAVITY / (2 * compression * radius)
    gamma = 2 * damping_ratio(0.5) * math.sqrt(kn / (mass / 2))
    return {'kn': kn, 'kt': tangential_ratio * kn, 'gamma_n': gamma, 'gamma_t': gamma / 2, 'friction': 0.3}


def hertz_law(youngs_modulus, poisson_ratio, friction):
    """Hertz and Mindlin: 4/3 E* and 8 G* of two surfaces of one material."""
    shear_modulus = youngs_modulus / (2 * (1 + poisson_ratio))
    return {'youngs_modulus': youngs_modulus, 'poisson_ratio': poisson_ratio, 'friction': friction,
            'kn': 4 * shear_modulus / (3 * (1 - poisson_ratio)), 'kt': 4 * shear_modulus / (2 - poisson_ratio),
            'restitution': 0.5}


def tray_walls(holes):
    pieces = [(0, 0.113), (0.137, 0.238), (0.262, 0.363), (0.387, 0.5)] if holes else [(0, 0.5)]
    floor = tuple(((a, 0), (b, 0)) for a, b in pieces)
    return floor + (((0, 0), (0, 0.45)), ((0.5, 0), (0.5, 0.45)))


def tray(holes, stiffness):
    """Two strokes are the lead, two are timed."""
    mass, radius = 0.6e-3, 4e-3
    compression, sets = {'stiff': (1e-4, ()), 'soft': (0.01, ('numerics.dt=2e-5 s',))}[stiffness]
    opening = 'open' if holes else 'closed'
    return Scene(name=f'tray-{opening}-{stiffness}', file=f'tray-{opening}.toml',
                 sets=(f'contact.shell_compression={compression}',) + sets,
                 lead=2 / 9, window=2 / 9, outflow=2.0 if holes else 0, radius=radius, mass=mass,
                 inertia=mass * radius**2 / 2, walls=tray_walls(holes), law=shell_law(mass, radius, compression),
                 holes=holes, amplitude=0.01, frequency=9,
                 skin={'lammps': 3e-3, 'liggghts': 3e-3, 'yade': 0.3 * radius})


def channel():
    """Origin in the middle of the gate; slopes 22.5 degrees from the vertical."""
    radius, half, top = 0.01, 0.05, 1.25
    mass = 4 / 3 * math.pi * 2500 * radius**3
    wide = half + top * math.tan(math.radians(22.5))
    walls = (((-half, 0), (half, 0)), ((-half, 0), (-wide, top)), ((half, 0), (wide, top)))
    return Scene(name='channel', file='channel.toml', sets=(), lead=0.02, window=0.05, outflow=0, fallen=0.45, radius=radius, mass=mass,
                 inertia=0.4 * mass * radius**2, walls=walls, law=hertz_law(5e10, 0.2, 0.4663),
                 skin={'lammps': 1e-3, 'liggghts': 1e-3, 'yade': 0.1 * radius})


SCENES = [tray(0, 'stiff'), tray(3, 'stiff'), tray(0, 'soft'), tray(3, 'soft'), channel()]
