"""A robot whose front sensor is stuck, and that has found out, does not run into what the sensor should show."""

from host_sim.sim.make import make
from host_sim.sim.run_config import RunConfig

SEEDS, ENVIRONMENTS = 12, 3
CAREFUL = {"filter": 1, "distrust": 32}


def test_a_careful_robot_with_a_stuck_front_sensor_rarely_touches_anything():
    # Given a front sensor that always shows something, and robots that stop believing it
    touched = 0
    for seed in range(1, SEEDS + 1):
        config = RunConfig(seed, ENVIRONMENTS, profile="adaptive", settings=CAREFUL, changes=("stuck-on:front@env1",))
        with make(config) as simulation:
            # When they have been through their environments
            touched += sum(episode.robots[0].collisions > 0 for episode in simulation.run())
    # Then they touched something in less than 5 % of them; without a look aside it was in 18 %
    assert touched < 0.05 * SEEDS * ENVIRONMENTS
