"""Runs and logs for programs of your own, as `host_sim.api` has them. docs/python.md shows how.

>>> import octet_robot
>>> done = octet_robot.run(octet_robot.RunConfig(environments=1, limit_s=20))
>>> [episode.robot_s for episode in done.episodes]
[20.0]
"""

from importlib import import_module
from importlib.util import find_spec

from host_sim.api import *  # noqa: F403 - its names are this package's
from host_sim.api import __all__ as __all__

if find_spec("gymnasium"):  # so that gymnasium.make("octet_robot:octet/Arena-v0") finds it
    import_module("host_sim.lab.gymnasium_envs")
