"""A robot whose front sensor is stuck, and has found out, does not run into what it should show; or all are stuck."""

import pytest

from host_sim.protocol.generated import FEEL
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


@pytest.mark.parametrize(("how", "left_out", "said"), [("on", 0, True), ("off", 0, True), ("on", 1, False)])
def test_that_every_sensor_is_stuck_is_said(run, how, left_out, said):
    sensors = [name.lower().replace("_", "-") for name in FEEL][left_out:]
    words = [word for sensor in sensors for word in ("--change", f"stuck-{how}:{sensor}@1s")]

    done = run("--environments", "1", "--limit-s", "2", "--bus", "none", *words)

    assert (", every sensor stuck" in done.output) == said
    assert done.summary["environments"][0]["robots"][0]["stuck_sensors"] == len(sensors)
