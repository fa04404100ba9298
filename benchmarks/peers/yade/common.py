# What both scenes in YADE share. Run with this directory in PYTHONPATH as:
#   yade -j1 -n -x SCENE.py PARAMETERS.json
import json
import math
import sys
import time

from yade import *
from yade.utils import *


def read_parameters():
    """The scene's numbers, SI, as `run` wrote them."""
    with open(sys.argv[1]) as file:
        return json.load(file)


def wall(start, end, material):
    """A wall from start to end in the plane, as two facets 40 mm deep; returns their ids."""
    (xa, ya), (xb, yb) = start, end
    a, b, c, d = (xa, ya, -.02), (xb, yb, -.02), (xb, yb, .02), (xa, ya, .02)
    return O.bodies.append([facet([a, b, c], material=material), facet([a, c, d], material=material)])


def grains(parameters, material):
    """Balls that stay in the plane z = 0 and turn about z only."""
    motions = parameters['motions'] or [(0, 0, 0)] * len(parameters['places'])
    for (x, y), (vx, vy, omega) in zip(parameters['places'], motions):
        ball = sphere((x, y, 0), parameters['radius'], material=material)
        ball.state.blockedDOFs = 'zXY'
        ball.state.inertia = (parameters['inertia'],) * 3
        ball.state.vel, ball.state.angVel = (vx, vy, 0), (0, 0, omega)
        O.bodies.append(ball)


def inside(number, floor):
    """Of the first `number` bodies those that are still there and above `floor`."""
    return sum(1 for i in range(number) if O.bodies[i] is not None and O.bodies[i].state.pos[1] > floor)


def timed(steps, sample, number):
    """Runs and returns the processor time of the loop alone, the grain-steps and the mean number of contacts."""
    cpu_time = grain_steps = contacts = done = 0
    while done < steps:
        part = min(sample, steps - done)
        begin = time.process_time()
        O.run(part, True)
        cpu_time += time.process_time() - begin
        done += part
        contacts += part * O.interactions.countReal()
        grain_steps += part * sum(1 for i in range(number) if O.bodies[i] is not None)
    return {'cpu_s': cpu_time, 'grain_steps': grain_steps, 'contacts': contacts / steps, 'dt': O.dt}


def report(result):
    print('RESULT ' + json.dumps(result), flush=True)
