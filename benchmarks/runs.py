"""Runs of the program whose processor time counts."""
import os
import subprocess
import sys


# Keys that write wheat and its contact out, since versions know them by different names: as balls and as grains of five balls.
_CONTACT = {'seeds.wheat.crop': '', 'contact.model': '', 'contact.law': 'elastic-shell', 'contact.shell_compression': 3e-5, 'contact.friction': 0.45,
            'contact.restitution': 0.5, 'contact.friction_model': 'spring', 'contact.wall.friction': 0.36, 'contact.wall.restitution': 0.5,
            'seeds.wheat.thousand_grain_weight': '29.6 g'}
BALLS = _CONTACT | {'seeds.wheat.shape': 'ball', 'seeds.wheat.diameter': '3.57 mm'}
GRAINS = _CONTACT | {'seeds.wheat.shape': 'elongated', 'seeds.wheat.length': '6.32 mm', 'seeds.wheat.width': '2.92 mm', 'seeds.wheat.thickness': '2.66 mm'}


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
