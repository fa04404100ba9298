"""Runs of the program whose processor time counts."""
import os
import subprocess
import sys


def start(program, command, file, keys, out, *options):
    """A run that goes on beside this program: `command` of the seeder or study `file`, with keys set and options."""
    words = [word for key, value in keys.items() for word in ('--set', f'{key}={value}')]
    return subprocess.Popen([str(word) for word in (program, command, file, *words, *options, '--out', out, '--quiet')],
                            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


def processor_time(process):
    """Waits for its end: user's and system's time, s. A run that fails ends this program."""
    _, status, used = os.wait4(process.pid, 0)
    if status != 0:
        sys.exit(f'{os.path.basename(sys.argv[0])}: {" ".join(process.args)} failed')
    return used.ru_utime + used.ru_stime
