"""Time to answer: the longest step at which a program still gives a scene's outflow, and its cost."""
import statistics
from dataclasses import dataclass, replace

from programs import lammps, run_vibrosow, start_of
from scenes import Window, slot_3d, tray

WITHIN = 3  # percent of the mean at the smallest step
COLUMNS = ['scene', 'program', 'dt_s', 'seeds', 'out', 'out_min', 'out_max', 'difference_percent', 'within_3_percent',
           'cpu_s_per_simulated_s', 'cpu_min', 'cpu_max', 'answers']


@dataclass(frozen=True)
class Question:
    """How many grains leave a scene within `duration`, s, from when all take over. `steps`: s, the smallest first; or, where the law
    has a time of contact, parts of it, of the scene's own 20."""
    scene: object
    duration: float
    programs: dict
    steps: tuple = ()
    steps_per_contact: tuple = ()

    def steps_from(self, start):
        return self.steps or tuple(20 * start.dt / each for each in self.steps_per_contact)


def by_lammps(bench, question, start, dt):
    scene, steps = question.scene, round(question.duration / dt)
    skin = scene.skin['lammps'] if scene.depth or dt <= 1e-4 else 5e-3  # a long step moves grains far: fewer rebuilds
    result = lammps(bench, scene, replace(start, dt=dt), Window(0, steps, 0, steps), skin)
    return result.out, result.cpu / question.duration


def by_vibrosow(integrator):
    def run(bench, question, start, dt):
        scene = question.scene
        kept = tuple(text for text in scene.sets if not text.startswith('numerics.'))
        scene = replace(scene, sets=(*kept, f'run.measure_from={scene.fallen!r} s', f'numerics.dt={dt!r} s', 'numerics.allow_long_step=true',
                                     f'numerics.integrator={integrator}', 'guard.energy_tolerance=1e9'))
        found, timing = run_vibrosow(bench, scene, scene.fallen + question.duration, '--random-seed', start.seed)
        if found['status'] != 'finished':
            raise RuntimeError(found['stop_reason'])
        since, until = found['outflow']['window_s']
        out = found['balance']['spilled'] + round(found['outflow']['seeds_per_s'] * (until - since))
        return out, timing['measured_cpu_s'] / question.duration
    return run


BOTH = {'lammps': by_lammps, 'vibrosow velocity-verlet': by_vibrosow('velocity-verlet')}
QUESTIONS = (
    Question(tray(3, 'soft'), 2.0, BOTH | {'vibrosow rk2-midpoint': by_vibrosow('rk2-midpoint')}, steps=(2e-5, 5e-5, 1e-4, 2e-4, 5e-4, 1e-3)),
    Question(slot_3d(0), 0.5, BOTH, steps_per_contact=(20, 12, 8, 6, 5)))


def measure(bench, question, seeds, say):
    """{program: [(dt, [(grains out, processor time per simulated second) of each seed])]}; a run that fails is None."""
    found = {}
    for seed in range(1, seeds + 1):
        start = start_of(bench, question.scene, seed)
        for k, dt in enumerate(question.steps_from(start)):
            for name, program in question.programs.items():
                try:
                    one = program(bench, question, start, dt)
                except RuntimeError:
                    one = None
                steps = found.setdefault(name, [])
                if k == len(steps):
                    steps.append((dt, []))
                steps[k][1].append(one)
                say(f'{question.scene.name} seed {seed} dt {dt:g} s {name:26} ' + (f'{one[0]:5} out {one[1]:8.3f} s/s' if one else 'failed'))
    return found


def rows_of(scene, program, steps):
    """The step that answers: the longest one up to which every shorter one is right too."""
    reference = statistics.mean(out for out, _ in steps[0][1])
    rows, right, longest = [], True, 0
    for dt, runs in steps:
        about = [scene, program, f'{dt:.4g}', len(runs)]
        if None in runs:
            rows.append([*about, '', '', '', '', 'failed', '', '', ''])
            right = False
            continue
        outs, times = zip(*runs)
        difference = 100 * (statistics.mean(outs) / reference - 1)
        right = right and abs(difference) <= WITHIN
        rows.append([*about, f'{statistics.mean(outs):.1f}', min(outs), max(outs), f'{difference:.2f}',
                     'yes' if abs(difference) <= WITHIN else 'no', f'{statistics.median(times):.4g}', f'{min(times):.4g}',
                     f'{max(times):.4g}'])
        longest = len(rows) - 1 if right else longest
    return [row + ['yes' if k == longest else ''] for k, row in enumerate(rows)]


def time_to_answer(bench, seeds, say):
    found = {question.scene.name: measure(bench, question, seeds, say) for question in QUESTIONS}
    return COLUMNS, [row for scene, programs in found.items() for program, steps in programs.items() for row in rows_of(scene, program, steps)]
