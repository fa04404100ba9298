"""Time to answer: the longest step at which a program still gives the soft, open tray's outflow, and its cost."""
import statistics
from dataclasses import replace

from programs import Start, lammps, run_vibrosow, start_of
from scenes import Window, tray

STEPS = [2e-5, 5e-5, 1e-4, 2e-4, 5e-4, 1e-3]
WITHIN = 3  # percent of the mean at the smallest step
COLUMNS = ['program', 'dt_s', 'seeds', 'out', 'out_min', 'out_max', 'difference_percent', 'within_3_percent',
           'cpu_s_per_simulated_s', 'cpu_min', 'cpu_max', 'answers']


def by_lammps(bench, scene, places, dt, seed):
    steps = round(scene.outflow / dt)
    skin = 3e-3 if dt <= 1e-4 else 5e-3  # a long step moves grains far: fewer rebuilds
    result = lammps(bench, scene, Start(places, dt), Window(0, steps, 0, steps), skin)
    return result.out, result.cpu / scene.outflow


def by_vibrosow(integrator):
    def run(bench, scene, places, dt, seed):
        scene = replace(scene, sets=(scene.sets[0], f'numerics.dt={dt!r} s', 'numerics.allow_long_step=true',
                                     f'numerics.integrator={integrator}', 'guard.energy_tolerance=1e9'))
        found, timing = run_vibrosow(bench, scene, scene.outflow, '--random-seed', seed)
        return found['balance']['counted'] + found['balance']['spilled'], timing['measured_cpu_s'] / scene.outflow
    return run


PROGRAMS = {'lammps': by_lammps, 'vibrosow velocity-verlet': by_vibrosow('velocity-verlet'),
            'vibrosow rk2-midpoint': by_vibrosow('rk2-midpoint')}


def measure(bench, seeds, say):
    """{(program, dt): [(grains out, processor time per simulated second) of each seed]}; a run that fails is None."""
    scene = tray(3, 'soft')
    found = {(program, dt): [] for program in PROGRAMS for dt in STEPS}
    for seed in range(1, seeds + 1):
        places = start_of(bench, scene, seed).places
        for dt in STEPS:
            for name, program in PROGRAMS.items():
                try:
                    one = program(bench, scene, places, dt, seed)
                except RuntimeError:
                    one = None
                found[name, dt].append(one)
                say(f'seed {seed} dt {dt:g} s {name:26} ' + (f'{one[0]:5} out {one[1]:8.3f} s/s' if one else 'failed'))
    return found


def rows_of(program, found):
    """The step that answers: the longest one up to which every shorter one is right too."""
    reference = statistics.mean(out for out, _ in found[program, STEPS[0]])
    rows, right = [], True
    for dt in STEPS:
        runs = found[program, dt]
        if None in runs:
            rows.append([program, dt, len(runs), '', '', '', '', 'failed', '', '', ''])
            right = False
            continue
        outs, times = zip(*runs)
        difference = 100 * (statistics.mean(outs) / reference - 1)
        right = right and abs(difference) <= WITHIN
        rows.append([program, dt, len(runs), f'{statistics.mean(outs):.1f}', min(outs), max(outs), f'{difference:.2f}',
                     'yes' if abs(difference) <= WITHIN else 'no', f'{statistics.median(times):.4g}', f'{min(times):.4g}',
                     f'{max(times):.4g}'])
        longest = len(rows) - 1 if right else longest
    return [row + ['yes' if k == longest else ''] for k, row in enumerate(rows)]


def time_to_answer(bench, seeds, say):
    found = measure(bench, seeds, say)
    return COLUMNS, [row for program in PROGRAMS for row in rows_of(program, found)]
