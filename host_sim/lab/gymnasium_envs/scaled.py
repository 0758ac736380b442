"""A robot's senses scaled to numbers from 0 to 1, for function approximation."""

from typing import Any

import gymnasium
import numpy as np
from gymnasium import spaces
from numpy.typing import NDArray

_CONES, _FAR_MM = 5, 5000.0  # the diagonal of the arena


class ScaledSenses(gymnasium.ObservationWrapper[Any, Any, Any], gymnasium.utils.RecordConstructorArgs):
    """Makes the observation a `Box` of eight float32 from 0 to 1, without clock and odometers, which wrap.

    | index | meaning                                                                            |
    | ----- | ---------------------------------------------------------------------------------- |
    | 0..4  | proximity: right, front-right, front, front-left, left                             |
    | 5     | the body touches something                                                         |
    | 6     | food is seen straight ahead                                                        |
    | 7     | how near that food is: 1 at the body's centre, 0 from five metres on, or if none is |

    >>> import gymnasium
    >>> env = ScaledSenses(gymnasium.make("octet_robot:octet/Arena-v0"))
    >>> senses, info = env.reset(seed=1)
    >>> senses in env.observation_space, senses.shape
    (True, (8,))
    """

    def __init__(self, env: gymnasium.Env[Any, Any]) -> None:
        """Wraps an `ArenaEnv`."""
        gymnasium.utils.RecordConstructorArgs.__init__(self)
        gymnasium.ObservationWrapper.__init__(self, env)
        self.observation_space = spaces.Box(0.0, 1.0, (_CONES + 3,), np.float32)

    def observation(self, observation: NDArray[np.int32]) -> NDArray[np.float32]:
        """Returns `scaled(observation)`."""
        return scaled(observation)


def scaled(senses: NDArray[np.int32]) -> NDArray[np.float32]:
    """Scales observations of any shape (..., 7), such as those of a vector environment."""
    cones = senses[..., 1:2] >> np.arange(_CONES) & 1
    seen = senses[..., 3:4]
    near = seen * np.clip(1 - senses[..., 4:5] / _FAR_MM, 0, 1)
    parts: NDArray[np.float64] = np.concatenate([cones, senses[..., 2:3], seen, near], -1)
    return parts.astype(np.float32)
