"""Proximal policy optimization in numpy: a deep learner as a baseline, small enough to read.

A network of two layers of 64 sees the scaled senses and the last action, and has a head for the actions and one for
the value. Values are discounted by robot time, since a step lasts as long as its action.
"""

from collections.abc import Callable
from typing import Any, NamedTuple

import gymnasium
import numpy as np
from gymnasium import spaces
from numpy.typing import NDArray

import host_sim.lab.gymnasium_envs  # noqa: F401 - names the environments

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


Floats = NDArray[np.float64]

STEPS, ARENAS, SECONDS = 7680, 200, 60.0
_SENSES, _ACTIONS, _HIDDEN = 8, 6, 64
_SHAPES = ((_SENSES + _ACTIONS, _HIDDEN), (_HIDDEN, _HIDDEN), (_HIDDEN, _ACTIONS + 1))
WEIGHTS = sum((rows + 1) * columns for rows, columns in _SHAPES)
_DISCOUNT_A_SECOND, _TRACE = 0.9, 0.95
_ROLLOUT, _EPOCHS, _BATCH = 64, 4, 1600
_CLIP, _ENTROPY, _VALUE, _GRADIENT_MAX = 0.2, 0.01, 0.5, 0.5
_RATE, _DECAYS = 1e-3, (0.9, 0.999)


class Network:
    """The network, and Adam's moments.

    Attributes:
        layers: For each layer its weights, the last row those of a constant 1.
    """

    def __init__(self, draws: np.random.Generator) -> None:
        """Draws the weights; those of the heads are small, so that at first all actions are about as likely."""
        gains = (1.0, 1.0, 0.01)
        self.layers = [
            np.vstack([gain * draws.normal(size=(rows, columns)) / np.sqrt(rows), np.zeros(columns)])
            for (rows, columns), gain in zip(_SHAPES, gains, strict=True)
        ]
        self._moments = [(np.zeros_like(it), np.zeros_like(it)) for it in self.layers]
        self._updates = 0

    def forward(self, seen: Floats) -> tuple[list[Floats], Floats, Floats]:
        """Computes the outputs for observations.

        Args:
            seen: Shape (rows, 14), as `inputs_of` returns it.

        Returns:
            The inputs of each layer, the log-probabilities of the actions, shape (rows, 6), and the values, shape
            (rows,).
        """
        inputs = [_with_one(seen)]
        for layer in self.layers[:-1]:
            inputs.append(_with_one(np.tanh(inputs[-1] @ layer)))
        out = inputs[-1] @ self.layers[-1]
        scores = out[:, :_ACTIONS] - out[:, :_ACTIONS].max(-1, keepdims=True)
        return inputs, scores - np.log(np.exp(scores).sum(-1, keepdims=True)), out[:, _ACTIONS]

    def gradients(self, inputs: list[Floats], of_out: Floats) -> list[Floats]:
        """Backpropagation: the gradient of each layer's weights, given that of the outputs, shape (rows, 7)."""
        found, back = [], of_out
        for layer, its_inputs in zip(reversed(self.layers), reversed(inputs), strict=True):
            found.append(its_inputs.T @ back)
            back = (back @ layer[:-1].T) * (1 - its_inputs[:, :-1] ** 2)  # that of tanh; of no use before the first
        return found[::-1]

    def learn(self, gradients: list[Floats], rate: float) -> None:
        """Takes a step of Adam down a gradient, which is shortened if it is long."""
        norm = np.sqrt(sum(float((it**2).sum()) for it in gradients))
        self._updates += 1
        for i, gradient in enumerate(gradients):
            self.layers[i] -= rate * self._adam(i, gradient * min(1.0, _GRADIENT_MAX / (norm + 1e-9)))

    def _adam(self, i: int, gradient: Floats) -> Floats:
        """Adam's step for a layer, without the rate."""
        first, second = (
            decay * moment + (1 - decay) * of
            for decay, moment, of in zip(_DECAYS, self._moments[i], (gradient, gradient**2), strict=True)
        )
        self._moments[i] = first, second
        mean, square = (it / (1 - decay**self._updates) for it, decay in zip((first, second), _DECAYS, strict=True))
        return mean / (np.sqrt(square) + 1e-8)


class _Rollout(NamedTuple):
    """Steps of all arenas, each array of shape (steps, arenas, ...)."""

    seen: Floats
    actions: NDArray[np.int64]
    log_p: Floats
    values: Floats
    rewards: Floats
    seconds: Floats
    goes_on: NDArray[np.bool_]
    counts: NDArray[np.bool_]


class Training:
    """A network in training; equal seeds give equal networks on the same machine.

    Attributes:
        network: The network.
        samples: Number of actions so far.
    """

    def __init__(self, seed: int, arenas: int = ARENAS) -> None:
        """Creates the network and the arenas, and resets these."""
        self._draws = np.random.default_rng(seed)
        self._env: Any = gymnasium.make_vec("octet/Arena-v0", num_envs=arenas, limit_s=SECONDS)
        self.network, self.samples = Network(self._draws), 0
        self._last = np.zeros(arenas, np.int64)
        self._over = np.zeros(arenas, bool)
        self._senses, info = self._env.reset(seed=seed)
        self._now_s = info["robot_s"]

    def run(self, steps: int = STEPS) -> "Training":
        """Learns for a number of steps in each arena."""
        for rollout in range(rollouts := steps // _ROLLOUT):
            self._improve(self._collect(), _RATE * (1 - rollout / rollouts))
        return self

    def _collect(self) -> _Rollout:
        rows = [self._act() for _ in range(_ROLLOUT)]
        return _Rollout(*map(np.array, zip(*rows, strict=True)))

    def _act(self) -> tuple[Any, ...]:
        """A step of each arena; one after an end only begins the next episode, and does not count."""
        seen, counts = inputs_of(self._senses, self._last), ~self._over
        _, log_p, values = self.network.forward(seen)
        actions = drawn(log_p, self._draws)
        self._senses, rewards, ended, truncated, info = self._env.step(actions)
        seconds, self._now_s = info["robot_s"] - self._now_s, info["robot_s"]
        self._over, self._last = ended | truncated, np.where(counts, actions, 0)
        self.samples += int(counts.sum())
        return seen, actions, log_p[np.arange(len(actions)), actions], values, rewards, seconds, ~self._over, counts

    def _improve(self, it: _Rollout, rate: float) -> None:
        advantages = self._advantages(it)
        wanted = (advantages + it.values)[it.counts]
        seen, log_p, gains = (part[it.counts] for part in (it.seen, it.log_p, advantages))
        actions = it.actions[it.counts]
        gains = (gains - gains.mean()) / (gains.std() + 1e-8)
        for _ in range(_EPOCHS):
            order = self._draws.permutation(len(gains))
            for some in (order[at : at + _BATCH] for at in range(0, len(order), _BATCH)):
                inputs, log_now, values = self.network.forward(seen[some])
                of_out = _gradient(log_now, actions[some], log_p[some], gains[some])
                of_value = _VALUE * (values - wanted[some])[:, np.newaxis]
                gradients = self.network.gradients(inputs, np.hstack([of_out, of_value]) / len(some))
                self.network.learn(gradients, rate)

    def _advantages(self, it: _Rollout) -> Floats:
        """Generalized advantage estimates, with a discount by robot time."""
        _, _, after = self.network.forward(inputs_of(self._senses, self._last))
        found, advantage = np.zeros_like(it.values), np.zeros(len(after))
        for step in reversed(range(_ROLLOUT)):
            discount = _DISCOUNT_A_SECOND ** it.seconds[step] * it.goes_on[step]
            td_error = it.rewards[step] + discount * after - it.values[step]
            advantage = np.where(it.counts[step], td_error + discount * _TRACE * advantage, 0.0)
            found[step], after = advantage, it.values[step]
        return found


def inputs_of(senses: NDArray[np.int32], last: NDArray[np.int64]) -> Floats:
    """The network's inputs, shape (rows, 14): the scaled senses, and the last action one-hot."""
    return np.hstack([scaled(senses).astype(np.float64), np.eye(_ACTIONS)[last]])


def drawn(log_p: Floats, draws: np.random.Generator) -> NDArray[np.int64]:
    """Draws an action for each row of log-probabilities, shape (rows, 6). Returns shape (rows,)."""
    return np.asarray((log_p + draws.gumbel(size=log_p.shape)).argmax(-1))


def policy(network: Network, seed: int, arenas: int) -> Callable[[NDArray[np.int32]], NDArray[np.int64]]:
    """The policy of a trained network for a number of arenas; actions are drawn as in training."""
    draws, last = np.random.default_rng(seed), np.zeros(arenas, np.int64)

    def act(senses: NDArray[np.int32]) -> NDArray[np.int64]:
        nonlocal last
        last = drawn(network.forward(inputs_of(senses, last))[1], draws)
        return last

    return act


def _gradient(log_now: Floats, actions: NDArray[np.int64], log_p: Floats, gains: Floats) -> Floats:
    """The gradient of the loss by the actions' scores: the clipped ratio, and the entropy."""
    probability, one = np.exp(log_now), np.eye(_ACTIONS)[actions]
    ratio = np.exp(log_now[np.arange(len(actions)), actions] - log_p)
    is_clipped = ((gains > 0) & (ratio > 1 + _CLIP)) | ((gains < 0) & (ratio < 1 - _CLIP))
    of_policy = -(np.where(is_clipped, 0.0, ratio * gains))[:, np.newaxis] * (one - probability)
    entropy = -(probability * log_now).sum(-1, keepdims=True)
    gradient: Floats = of_policy + _ENTROPY * probability * (log_now + entropy)
    return gradient


def _with_one(values: Floats) -> Floats:
    stacked: Floats = np.hstack([values, np.ones((len(values), 1))])
    return stacked
