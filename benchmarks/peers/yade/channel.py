# Scene B in YADE: balls in a closed converging channel of facets, Hertz-Mindlin with damping by a restitution.
# Verlet distance: 0.1 r.
import math

from common import *

p = read_parameters()
number = len(p['places'])
rock = O.materials.append(FrictMat(young=p['youngs_modulus'], poisson=p['poisson_ratio'],
                                   frictionAngle=math.atan(p['friction']), density=p['density']))
grains(p, rock)
for start, end in p['walls']:
    wall(start, end, rock)
restitution = p['textbook_restitution']
O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Facet_Aabb()], verletDist=p['verlet_distance']),
    InteractionLoop([Ig2_Sphere_Sphere_ScGeom(), Ig2_Facet_Sphere_ScGeom()],
                    [Ip2_FrictMat_FrictMat_MindlinPhys(en=restitution, es=restitution)],
                    [Law2_ScGeom_MindlinPhys_Mindlin()]),
    NewtonIntegrator(gravity=(0, -9.81, 0), damping=0)]
O.dt = p['dt']
O.run(p['lead'], True)
report(dict(timed(p['steps'], p['sample'], number), out=0, number=number))
