# Scene A in YADE: balls of a disc's moment of inertia in a tray of facets that oscillates. The viscoelastic law has its own
# dashpots; FrictMat would need local damping, which also damps free fall. Its contact never pulls.
# Verlet distance: 0.3 r.
import math

from common import *

p = read_parameters()
number = len(p['places'])
law = dict(frictionAngle=math.atan(p['friction']), density=p['density'])
# Two materials give one contact by 1/k = 1/k1 + 1/k2; a zero of a wall's leaves the grain's own.
grain = O.materials.append(
    ViscElMat(kn=2 * p['kn'], ks=2 * p['kt'], cn=2 * p['dashpot_n'], cs=2 * p['dashpot_t'], **law))
rigid = O.materials.append(ViscElMat(kn=0, ks=0, cn=0, cs=0, **law))
grains(p, grain)
tray = [i for start, end in p['walls'] for i in wall(start, end, rigid)]


def take_out():
    """Grains well below the counting line."""
    for i in range(number):
        if O.bodies[i] is not None and O.bodies[i].state.pos[1] < p['count_at'] - 0.002:
            O.bodies.erase(i)


O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Facet_Aabb()], verletDist=p['verlet_distance']),
    InteractionLoop([Ig2_Sphere_Sphere_ScGeom(), Ig2_Facet_Sphere_ScGeom()],
                    [Ip2_ViscElMat_ViscElMat_ViscElPhys()], [Law2_ScGeom_ViscElPhys_Basic()]),
    NewtonIntegrator(gravity=(0, -9.81, 0), damping=0),
    HarmonicMotionEngine(A=(p['amplitude'], 0, 0), f=(p['frequency'], 0, 0), fi=(-math.pi / 2, 0, 0), ids=tray),
    PyRunner(command='take_out()', iterPeriod=500)]
O.dt = p['dt']
O.run(p['lead'], True)
result = timed(p['steps'], p['sample'], number)
if p['rest'] > 0:  # 0 would run on for ever
    O.run(p['rest'], True)
report(dict(result, out=number - inside(number, p['count_at']), number=number))
