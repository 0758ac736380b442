"""The shapes of the world in C are those that Python draws."""

from host_sim.world.cones import CONE_BEARINGS_DEG, cone_outline, cone_reach_mm
from host_sim.world.params import SimParams
from host_sim.world.plain_space import cones_in_c
from host_sim.world.world_library import world_library

PARAMS = SimParams()


def test_the_cones_are_those_that_are_drawn():
    cones = cones_in_c(*world_library(), PARAMS)

    for n, (bit, bearing_deg) in enumerate(CONE_BEARINGS_DEG.items()):
        corners = [(corner.x, corner.y) for corner in cones.of[n].corners]
        assert corners == cone_outline(bearing_deg, cone_reach_mm(bit, PARAMS))
