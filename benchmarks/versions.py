"""Programs to set beside one another: of another commit, or of this tree for fewer instruction sets. They are built aside, in build/versions.
What is no program and no commit fails with git's message."""
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
BUILDS = ROOT / 'build/versions'


def call(*words):
    subprocess.run(list(map(str, words)), check=True, cwd=ROOT, stdout=sys.stderr)


def build(tree, folder, sets):
    call('cmake', '--preset', 'release', '-S', tree, '-B', folder, f'-DVIBROSOW_INSTRUCTION_SETS={sets}', '-DVIBROSOW_TESTS=OFF', '-DVIBROSOW_BENCHMARKS=OFF')
    call('cmake', '--build', folder, '--target', 'vibrosow')
    return folder / 'src/vibrosow'


def of(name):
    """The program of that name; or that of a commit, made for this processor."""
    if Path(name).is_file():
        return Path(name).resolve()
    commit = subprocess.run(['git', 'rev-parse', '--verify', f'{name}^{{commit}}'], check=True, cwd=ROOT, stdout=subprocess.PIPE, text=True).stdout.strip()
    folder, tree = BUILDS / commit, BUILDS / f'{commit}-tree'
    if not (folder / 'src/vibrosow').is_file():
        sets = subprocess.run([ROOT / 'scripts/instruction-sets'], check=True, stdout=subprocess.PIPE, text=True).stdout.strip()
        call('git', 'worktree', 'add', '--force', '--detach', tree, commit)
        build(tree, folder, sets)
        call('git', 'worktree', 'remove', '--force', tree)
    return folder / 'src/vibrosow'


def for_instruction_sets(sets):
    """This tree's program for processors with no more than `sets`, "generic;avx2" or "generic"."""
    return build(ROOT, BUILDS / sets.replace(';', '-'), sets)
