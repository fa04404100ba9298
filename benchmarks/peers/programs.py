"""How each program is started on a scene and what its output says. Every program gives a Result."""
import csv
import json
import math
import os
import re
import subprocess
from dataclasses import dataclass
from pathlib import Path

from contacts import mean_contacts, pictures
from scenes import rolling_spring, textbook_restitution, tsuji_restitution

HERE = Path(__file__).resolve().parent
# Damping of LAMMPS' gran/hertz/history, proportional to sqrt(overlap): 9.93e7 1/(m s) gives a pair of these grains the
# restitution 0.5 at 1 m/s (integrated numerically), as paper B's 2.1e4 1/s does.
LAMMPS_HERTZ_DAMPING = 9.93e7


@dataclass
class Result:
    """Of the timed window: processor time of the loop alone, s; grains present summed over steps; touching contacts a step and
    grains out at the scene's `outflow` where they were looked at."""
    cpu: float
    grain_steps: float
    grains: int = 0
    dt: float = 0
    steps: int = 0
    contacts: float = math.nan
    out: int = 0

    @property
    def speed(self):
        """Million grain-steps a second of processor time."""
        return self.grain_steps / self.cpu / 1e6


class Bench:
    """Where and on which core programs run."""

    def __init__(self, vibrosow, core, work, native_lammps=None, box2d=None):
        self.vibrosow, self.box2d, self.core, self.work = Path(vibrosow).resolve(), box2d, core, Path(work)
        self.native_lammps = native_lammps and Path(native_lammps).resolve()
        self.before = {}  # of each scene and its start: what Vibrosow counts up to the timed window
        self.work.mkdir(exist_ok=True)

    def output_of(self, command):
        """Runs on the one core, without threads; returns what it printed, or fails with it."""
        environment = dict(os.environ, OMP_NUM_THREADS='1', PYTHONPATH=str(HERE / 'yade'), PYTHONDONTWRITEBYTECODE='1')
        done = subprocess.run(['taskset', '-c', str(self.core)] + [str(word) for word in command], cwd=self.work,
                              env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace")
        if done.returncode != 0:
            raise RuntimeError(f'{" ".join(str(word) for word in command)}\n{done.stdout[-3000:]}')
        return done.stdout


@dataclass
class Start:
    """The grains of a scene as Vibrosow has laid them with a random seed and let them fall, and its step. Without motions (m/s,
    m/s, rad/s; in space three of each) they start at rest."""
    places: list
    dt: float
    seed: int = 1
    motions: list = ()


def run_vibrosow(bench, scene, duration, *options):
    out = bench.work / 'vibrosow'
    sets = [f'run.duration={duration!r} s', *scene.sets]
    bench.output_of([bench.vibrosow, 'run', HERE / scene.file, '--quiet', '--out', out] +
                    [word for text in sets for word in ('--set', text)] + list(options))
    return json.loads((out / 'run.json').read_text()), json.loads((out / 'timing.json').read_text())


def start_of(bench, scene, seed=1):
    """A picture when they have fallen: x, y, in space z, from the tray's left end; of the channel from the middle of its gate."""
    run, _ = run_vibrosow(bench, scene, scene.fallen + 1e-4, '--random-seed', seed, '--set',
                          f'record.times=["{scene.fallen!r} s"]')
    shift = -run['scene']['tray']['holes'][0]['centre_m'] if scene.deck == 'channel' else 0
    with open(bench.work / 'vibrosow' / 'grains_001.csv') as file:
        rows = list(csv.DictReader(file))
    axes, spins = (('x', 'y', 'z'), ('omega_x', 'omega_y', 'omega')) if scene.depth else (('x', 'y'), ('omega',))
    places = [tuple(float(row[f'{axis}_mm']) / 1e3 + (shift if axis == 'x' else 0) for axis in axes) for row in rows]
    names = [f'v{axis}_m_per_s' for axis in axes] + [f'{spin}_rad_per_s' for spin in spins]
    tray = scene.velocity(scene.fallen)  # a picture's velocities are against the tray
    motions = [(float(row[names[0]]) + tray, *(float(row[name]) for name in names[1:])) for row in rows]
    return Start(places, run['dt_s'], seed, motions if scene.fallen else ())


def vibrosow(bench, scene, start, window, options=()):
    """The window is the measuring window of a run; what was counted in it, the difference from a run that ends there."""
    options = ('--random-seed', start.seed, *options)
    lead = scene.fallen + window.lead * start.dt
    case = (scene.name, lead, options)
    if case not in bench.before:
        bench.before[case], _ = run_vibrosow(bench, scene, lead, *options)
    before = bench.before[case]
    after, timing = run_vibrosow(bench, scene, lead + window.steps * start.dt, *options, '--set', f'run.measure_from={lead!r} s')
    steps = after['steps'] - before['steps']
    result = Result(timing['measured_cpu_s'], after['grain_steps'] - before['grain_steps'],
                    after['balance']['put_in'], after['dt_s'], steps,
                    (after['force_evaluations'] - before['force_evaluations']) / steps)
    if window.rest:
        last, _ = run_vibrosow(bench, scene, scene.outflow, *options)
        result.out = last['balance']['counted'] + last['balance']['spilled']
    return result


def vibrosow_as_published(bench, scene, start, window):
    """Paper B's friction and integrator."""
    published = ('numerics.integrator=gear5', 'contact.friction_model=sliding')
    return vibrosow(bench, scene, start, window, [word for text in published for word in ('--set', text)])


def write_atoms(path, scene, start, density, types=1):
    """A data file of spheres: number, type, diameter, density, x, y, z; number, velocity, spin."""
    places = [(x, y, *z) if z else (x, y, 0) for x, y, *z in start.places]
    low = min(scene.count_at, -2 * scene.radius, *(y for _, y, _ in places)) - 0.002  # what has crossed the line is not taken out at once
    high = max(max(y for _, y, _ in places) + 0.3, max(y for wall in scene.walls for _, y in wall) + 0.01)
    wide = max(max(abs(x) for wall in scene.walls for x, _ in wall), 0) + 0.05
    lines = [scene.name, '', f'{len(places)} atoms', f'{types} atom types', '', f'{-wide} {wide} xlo xhi',
             f'{low} {high} ylo yhi', f'{-2 * scene.radius} {scene.depth + 2 * scene.radius} zlo zhi', '', 'Atoms', '']
    lines += [f'{k} 1 {2 * scene.radius} {density!r} {x!r} {y!r} {z!r}' for k, (x, y, z) in enumerate(places, 1)]
    if start.motions:
        motions = start.motions if scene.depth else [(vx, vy, 0, 0, 0, omega) for vx, vy, omega in start.motions]
        lines += ['', 'Velocities', '']
        lines += [f'{k} {" ".join(map(repr, motion))}' for k, motion in enumerate(motions, 1)]
    path.write_text('\n'.join(lines) + '\n')


def write_mesh(path, scene):
    """The walls as an STL surface, two triangles each, across the whole depth; in space with front and back."""
    near, far = (0, scene.depth) if scene.depth else (-1.9 * scene.radius, 1.9 * scene.radius)
    sheets = [((xa, ya, near), (xb, yb, near), (xb, yb, far), (xa, ya, far)) for (xa, ya), (xb, yb) in scene.walls]
    if scene.depth:
        xs, ys = zip(*(end for wall in scene.walls for end in wall))
        corners = ((min(xs), min(ys)), (max(xs), min(ys)), (max(xs), max(ys)), (min(xs), max(ys)))
        sheets += [tuple((x, y, z) for x, y in corners) for z in (near, far)]
    lines = ['solid walls']
    for a, b, c, d in sheets:
        for triangle in ((a, b, c), (a, c, d)):
            corners = [f'vertex {x!r} {y!r} {z!r}' for x, y, z in triangle]
            lines += ['facet normal 0 0 0', 'outer loop', *corners, 'endloop', 'endfacet']
    path.write_text('\n'.join(lines + ['endsolid walls']) + '\n')


def ball_density(scene):
    return scene.mass / (4 / 3 * math.pi * scene.radius**3)


def window_variables(window, skin):
    never = 10**9
    return {'lead': window.lead, 'steps': window.steps, 'rest': window.rest, 'last': sum(window[:3]),
            'sample': window.sample or never, 'skin': skin, 'pictures': 'pictures', 'thermo': max(1, window.steps // 40)}


def lammps_laws(scene, granular=False):
    """The words that the scene's deck takes its law from."""
    law = scene.law
    if scene.deck == 'slot-in-space':
        return {'pair_coeff': f'* * {granular_hertz(scene, False)}', 'wall': f'granular {granular_hertz(scene, True)}'}
    if granular:
        return {'pair_style': 'granular', 'pair_coeff': f'* * {granular_hooke(law, 1)}',
                'wall': f'granular {granular_hooke(law, 2)}'}
    if scene.deck == 'channel':
        return {'pair_law': f'{law["kn"]} {law["kt"]} {LAMMPS_HERTZ_DAMPING} NULL {law["friction"]}'}
    form = '{0} {1} {gamma_n} {gamma_t} {friction}'
    pair, wall = (form.format(stiffer * law['kn'], stiffer * law['kt'], **law) for stiffer in (1, 2))
    if scene.deck == 'tray-in-space':
        return {'pair_style': f'gran/hooke/history {pair} 1 limit_damping', 'pair_coeff': '* *',
                'wall': f'hooke/history {wall} 1 limit_damping'}
    return {'pair_law': pair, 'wall_law': wall}


def granular_hooke(law, stiffer):
    """`gran/hooke/history` in the words of `granular`."""
    return (f'hooke {stiffer * law["kn"]} {law["gamma_n"]} tangential linear_history {stiffer * law["kt"]} '
            f'{law["gamma_t"] / law["gamma_n"]} {law["friction"]} damping mass_velocity limit_damping')


def granular_hertz(scene, of_wall):
    """Hertz, Mindlin's spring and, where balls resist rolling, a rolling spring. Stiffnesses are given, not a modulus: from
    that, those of walls come out 1.3 and 0.61 times what they should be (at Poisson's ratio 0.3)."""
    law = scene.law
    restitution = tsuji_restitution(law['wall_restitution' if of_wall else 'restitution'])
    rolling = 'rolling sds {} {} {rolling}'.format(*rolling_spring(scene, of_wall), **law) if law['rolling'] else ''
    return (f'hertz {law["kn"]} {restitution} tangential mindlin {law["kt"]} {law["tangential_damping"]} {law["friction"]} '
            f'{rolling} damping tsuji limit_damping')


def lammps_box(scene):
    """Sizes that decks in space read, and the folder of the decks."""
    slot_from, slot_to = scene.slot or (0, 0)
    return {'length': max(x for wall in scene.walls for x, _ in wall), 'depth': scene.depth, 'slot_from': slot_from,
            'slot_to': slot_to, 'decks': HERE / 'lammps'}


def lammps(bench, scene, start, window, skin=None, granular=False, program='lmp'):
    write_atoms(bench.work / 'lammps.data', scene, start, ball_density(scene))
    steep = math.radians(67.5)
    variables = window_variables(window, skin or scene.skin['lammps']) | lammps_laws(scene, granular) | lammps_box(scene) | {
        'data': 'lammps.data', 'dt': start.dt, 'holes': scene.holes, 'amplitude': scene.amplitude,
        'frequency': scene.frequency, 'half_width': 0.05, 'slope_x': math.sin(steep), 'slope_y': math.cos(steep)}
    return molecular(bench, scene, start, window, [program, '-screen', 'none'], HERE / 'lammps' / f'{scene.deck}.in', variables)


def lammps_granular(bench, scene, start, window):
    """The same law by LAMMPS' newer, general style."""
    return lammps(bench, scene, start, window, granular=True)


def native_lammps_granular(bench, scene, start, window):
    """The same source, built for this processor (native-lammps)."""
    return lammps(bench, scene, start, window, granular=True, program=bench.native_lammps)


def liggghts(bench, scene, start, window):
    write_atoms(bench.work / 'liggghts.data', scene, start, ball_density(scene), types=2)
    write_mesh(bench.work / 'walls.stl', scene)
    variables = window_variables(window, scene.skin['liggghts']) | {
        key: textbook_restitution(value) if 'restitution' in key else value for key, value in scene.law.items()} | {
            'data': 'liggghts.data', 'note_cpu': HERE / 'liggghts' / 'note-cpu', 'dt': start.dt, 'amplitude': scene.amplitude, 'tray': 'walls.stl', 'walls': 'walls.stl',
            'wall_kn': 2 * scene.law['kn'], 'wall_kt': 2 * scene.law['kt'], 'depth': scene.depth,
            'period': 1 / scene.frequency if scene.frequency else 0}
    deck = HERE / 'liggghts' / f'{"tray" if scene.is_tray else scene.deck}.in'
    noted = bench.work / 'cpu'
    noted.unlink(missing_ok=True)
    # With -screen none it crashes on reading a mesh.
    result = molecular(bench, scene, start, window, ['liggghts'], deck, variables)
    before, after = map(float, noted.read_text().split())
    result.cpu = after - before
    return result


def molecular(bench, scene, start, window, command, deck, variables):
    """LAMMPS or its child: variables in, log and pictures out."""
    log = bench.work / 'log'
    words = [word for key, value in variables.items() for word in ('-var', key, value)]
    bench.output_of(command + ['-in', deck, '-log', log, *words])
    result = read_log(log.read_text())
    if window.sample:
        result.contacts = mean_contacts(bench.work / 'pictures', scene, start.dt, window.lead)
        *_, (_, last) = pictures(bench.work / ('pictures.end' if window.rest else 'pictures'))
        result.out = result.grains - sum(1 for place in last if place[1] > scene.count_at)
    return result


def read_log(text):
    """The second loop's time, of the processor where the program knows it; its grain-steps by the trapezoidal rule from the table of step, atoms and dt."""
    tables = re.findall(r'^ *Step +Atoms +Dt *\n((?:[ \d.e+-]+\n|WARNING.*\n)*)', text, re.MULTILINE)
    rows = [[[float(word) for word in line.split()] for line in table.splitlines() if line[:1] != 'W'] for table in tables]
    loops = re.findall(r'Loop time of (\S+) on 1 procs for (\d+) steps', text)
    shares = re.findall(r'([\d.]+)% CPU use', text)
    timed = rows[1]
    grain_steps = sum((b[0] - a[0]) * (a[1] + b[1]) / 2 for a, b in zip(timed, timed[1:]))
    share = float(shares[1]) / 100 if shares else 1
    return Result(float(loops[1][0]) * share, grain_steps, int(rows[0][0][1]), timed[0][2], int(loops[1][1]))


def yade(bench, scene, start, window):
    law = dict(scene.law)
    reduced = scene.mass / 2
    if scene.is_tray:
        law |= {'dashpot_n': law['gamma_n'] * reduced, 'dashpot_t': law['gamma_t'] * reduced}
    parameters = law | {
        'textbook_restitution': textbook_restitution(0.5), 'places': start.places, 'motions': start.motions, 'walls': scene.walls, 'radius': scene.radius,
        'density': ball_density(scene), 'inertia': scene.inertia, 'amplitude': scene.amplitude, 'frequency': scene.frequency,
        'count_at': scene.count_at, 'dt': start.dt, 'lead': window.lead, 'steps': window.steps, 'rest': window.rest,
        'sample': window.sample or max(1, window.steps // 40), 'verlet_distance': scene.skin['yade']}
    (bench.work / 'yade.json').write_text(json.dumps(parameters))
    deck = HERE / 'yade' / ('tray.py' if scene.is_tray else 'channel.py')
    found = result_line(bench.output_of(['yade', '-j1', '-n', '-x', deck, bench.work / 'yade.json']))
    return Result(found['cpu_s'], found['grain_steps'], found['number'], found['dt'], window.steps, found['contacts'],
                  found['out'])


def box2d(rate):
    def run(bench, scene, start, window):
        (bench.work / 'start.txt').write_text(''.join(f'{x!r} {y!r}\n' for x, y in start.places))
        rest = window.rest * start.dt
        text = bench.output_of([bench.box2d, 'start.txt', scene.holes, rate, scene.lead, scene.window, rest])
        found = result_line(text)
        return Result(found['cpu_s'], found['grain_steps'], found['number'], 1 / rate, found['steps'], found['contacts'],
                      found['out'])
    return run


def result_line(text):
    return json.loads(re.search(r'^RESULT (.*)$', text, re.MULTILINE)[1])


def version_of(bench, name):
    """As the program itself says it."""
    if name.startswith('vibrosow'):
        return re.search(r'\d+(\.\d+)+', bench.output_of([bench.vibrosow, '--version']))[0]
    if name.startswith('box2d'):
        return bench.output_of([bench.box2d, '--version']).strip()
    question = {'lammps': (['lmp', '-h'], r'- (.*)'), 'native': ([bench.native_lammps, '-h'], r'- (.*)'),
                'liggghts': (['liggghts', '-in', '/dev/null', '-log', 'none'], r'PUBLIC ([\d.]+)'),
                'yade': (['yade', '--version'], r'version: (\S+)')}
    command, pattern = question[name.split()[0]]
    return re.search(pattern, bench.output_of(command))[1].strip()


PROGRAMS = {'vibrosow': vibrosow, 'lammps': lammps, 'lammps granular': lammps_granular,
            'native lammps granular': native_lammps_granular, 'liggghts': liggghts, 'yade': yade,
            'box2d 240 Hz': box2d(240), 'box2d 1 kHz': box2d(1000), 'box2d 4 kHz': box2d(4000),
            'vibrosow as published': vibrosow_as_published}


def can_run(program, scene):
    if scene.depth:  # `lammps` of the slot speaks `granular` already
        return program in ('vibrosow', 'lammps', 'liggghts', 'native lammps granular') or (
            program == 'lammps granular' and scene.deck == 'tray-in-space')
    if program.startswith('box2d'):
        return scene.is_tray
    return 'granular' not in program and (program != 'vibrosow as published' or not scene.is_tray)
