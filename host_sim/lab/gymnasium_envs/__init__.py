"""The robot and its world as environments of Gymnasium and PettingZoo, for learning algorithms.

Importing this module registers the environments with Gymnasium; docs/python.md shows how.

>>> import gymnasium
>>> import host_sim.lab.gymnasium_envs
>>> env = gymnasium.make("octet/Arena-v0", limit_s=60)
"""

import gymnasium

gymnasium.register(
    id="octet/Arena-v0",
    entry_point=f"{__name__}.arena_env:ArenaEnv",
    vector_entry_point=f"{__name__}.arena_vector_env:ArenaVectorEnv",
)
