"""Scenes A to D as numbers that every program's deck is fed with. SI throughout."""
import math
from dataclasses import dataclass, field
from typing import NamedTuple

GRAVITY = 9.81
SAME_STEP = ('numerics.steps_per_contact=20',)  # for all programs: the others' contacts err at Vibrosow's own 12


class Window(NamedTuple):
    """Steps before, in and after the timed window, and between two pictures in it (0: none)."""
    lead: int
    steps: int
    rest: int = 0
    sample: int = 0


@dataclass(frozen=True)
class Scene:
    """`lead` and `window` are seconds; `outflow` the time at which grains out are counted (0: nothing leaves); `fallen` that
    at which Vibrosow's grains are taken over by the others, for whom it is time 0. `deck`: what the others' inputs are called.
    `walls` are lines of the plane, in space across the whole `depth` (0: the plane), where front and back are walls too."""
    name: str
    file: str
    deck: str
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
    depth: float = 0
    slot: tuple = ()

    @property
    def is_tray(self):
        return self.deck.startswith('tray')

    def steps(self, dt, checked=False):
        lead, steps = round(self.lead / dt), round(self.window / dt)
        if not checked:
            return Window(lead, steps)
        rest = max(0, round(self.outflow / dt) - lead - steps)
        return Window(lead, steps, rest, max(1, steps // (20 if self.depth else 100)))

    def displacement(self, time):
        return self.amplitude * math.sin(2 * math.pi * self.frequency * time)

    def velocity(self, time):
        return self.amplitude * 2 * math.pi * self.frequency * math.cos(2 * math.pi * self.frequency * time)


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


def tsuji_restitution(restitution):
    """What to ask of LAMMPS' `damping tsuji` to get `restitution` from a force that never pulls. The dashpot is alpha
    sqrt(m* F / d), alpha = sqrt(5) times the damping ratio, and LAMMPS takes alpha from a polynomial in what it is asked for."""
    factors = (4.8218, -18.022, 27.467, -22.348, 11.087, -4.2783, 1.2728)
    wanted = math.sqrt(5) * damping_ratio(restitution)
    low, high = 0.0, 1.0
    for _ in range(60):
        asked, alpha = (low + high) / 2, 0.0
        for factor in factors:
            alpha = alpha * asked + factor
        low, high = (asked, high) if alpha > wanted else (low, asked)
    return low


def shell_law(mass, radius, compression, tangential_ratio=14 / 17):
    """Paper A's shell: m g / 2 eps between grains, m g / eps on walls; restitution 0.5; the tangential spring has
    `tangential_ratio` of the stiffness (as Vibrosow's, where nothing is said), its dashpot half the normal one. gamma = dashpot
    over reduced mass, 1/s, is the same for grains and walls."""
    kn = mass * GRAVITY / (2 * compression * radius)
    gamma = 2 * damping_ratio(0.5) * math.sqrt(kn / (mass / 2))
    return {'kn': kn, 'kt': tangential_ratio * kn, 'gamma_n': gamma, 'gamma_t': gamma / 2, 'friction': 0.3}


def hertz_law(youngs_modulus, poisson_ratio, friction, restitution=0.5):
    """Hertz and Mindlin: 4/3 E* and 8 G* of two surfaces of one material, walls as grains."""
    shear_modulus = youngs_modulus / (2 * (1 + poisson_ratio))
    return {'youngs_modulus': youngs_modulus, 'poisson_ratio': poisson_ratio, 'friction': friction,
            'kn': 4 * shear_modulus / (3 * (1 - poisson_ratio)), 'kt': 4 * shear_modulus / (2 - poisson_ratio),
            'restitution': restitution}


def rolling_spring(scene, of_wall):
    """Stiffness (N/m) and dashpot (kg/s) of LAMMPS' rolling displacement, which are constants, as the rolling spring of model C
    (Ai et al. 2011: 2.25 (F / d) (mu_r R_r)^2 by the angle) has them at a force F of ten weights."""
    law, radius, inertia = scene.law, scene.radius, scene.inertia + scene.mass * scene.radius**2
    arm, inertia = (radius, inertia) if of_wall else (radius / 2, inertia / 2)
    force = 10 * scene.mass * GRAVITY
    secant = (law['kn'] * math.sqrt(arm))**(2 / 3) * force**(1 / 3)
    stiffness = 2.25 * secant * law['rolling']**2
    return stiffness, law['rolling_damping'] * 2 * math.sqrt(inertia * stiffness) / arm


def tray_walls(holes):
    pieces = [(0, 0.113), (0.137, 0.238), (0.262, 0.363), (0.387, 0.5)] if holes else [(0, 0.5)]
    floor = tuple(((a, 0), (b, 0)) for a, b in pieces)
    return floor + (((0, 0), (0, 0.45)), ((0.5, 0), (0.5, 0.45)))


def tray(holes, stiffness):
    """Two strokes are the lead, two are timed."""
    mass, radius = 0.6e-3, 4e-3
    compression, sets = {'stiff': (1e-4, SAME_STEP), 'soft': (0.01, ('numerics.dt=2e-5 s',))}[stiffness]
    opening = 'open' if holes else 'closed'
    return Scene(name=f'tray-{opening}-{stiffness}', file=f'tray-{opening}.toml', deck='tray',
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
    return Scene(name='channel', file='channel.toml', deck='channel', sets=(), lead=0.02, window=0.05, outflow=0, fallen=0.45,
                 radius=radius, mass=mass, inertia=0.4 * mass * radius**2, walls=walls, law=hertz_law(5e10, 0.2, 0.4663),
                 skin={'lammps': 1e-3, 'liggghts': 1e-3, 'yade': 0.1 * radius})


def tray_3d():
    """Two strokes of Vibrosow's, then all take over; one stroke is timed."""
    mass, radius = 0.6e-3, 4e-3
    return Scene(name='tray-in-space', file='tray-in-space.toml', deck='tray-in-space', sets=SAME_STEP, lead=0.01, window=1 / 9, outflow=0,
                 fallen=2 / 9, radius=radius, mass=mass, inertia=0.4 * mass * radius**2, walls=tray_walls(0),
                 law=shell_law(mass, radius, 1e-4), amplitude=0.01, frequency=9, depth=0.165,
                 skin={'lammps': 8e-4, 'liggghts': 8e-4})


def slot_3d(rolling, depth=0.04):
    """The measured slot hopper; Vibrosow's gate opens at 0.1 s; when it has flowed for 0.2 s, all take over."""
    radius, length, height, slot = 3e-3, 0.2, 0.6, (0.08, 0.12)
    mass = 4 / 3 * math.pi * 1592 * radius**3
    walls = (((0, 0), (slot[0], 0)), ((slot[1], 0), (length, 0)), ((0, 0), (0, height)), ((length, 0), (length, height)))
    law = hertz_law(1e7, 0.3, 0.4, restitution=0.85) | {
        'wall_restitution': 0.6, 'tangential_damping': 0.5, 'rolling': rolling, 'rolling_damping': 0.3,
        'rolling_model': 'epsd' if rolling else 'off'}
    sets = (f'tray.depth={depth!r} m', 'tray.holes.open_at=0.1 s', 'run.measure_from=') + SAME_STEP + (() if rolling else ('contact.rolling=none', 'contact.rolling_friction='))
    return Scene(name='slot-in-space-rolling' if rolling else 'slot-in-space', deck='slot-in-space', sets=sets,
                 file='../../seeders/verification/plastic-ball-slot-in-space.toml', lead=0.02, window=0.1, outflow=0, fallen=0.3,
                 radius=radius, mass=mass, inertia=0.4 * mass * radius**2, walls=walls, law=law, depth=depth, slot=slot,
                 skin={'lammps': 8e-4, 'liggghts': 8e-4})


SCENES = [tray(0, 'stiff'), tray(3, 'stiff'), tray(0, 'soft'), tray(3, 'soft'), channel(), tray_3d(), slot_3d(0),
          slot_3d(0.04)]
