"""Q-learning with 16 numbers: how many turns to either side each pattern of the front sensors takes."""

import gymnasium
import numpy as np

EPISODES, RIGHT = 12, {0b001: 0, 0b011: 0, 0b100: 1, 0b110: 1}


def learn(seed):
    env = gymnasium.make("octet_robot:octet/Arena-v0", limit_s=60)
    draws = np.random.default_rng(seed)
    turns_needed, tries = np.zeros((8, 2)), np.zeros((8, 2))
    wrong_until = 0, 0
    for episode in range(EPISODES):
        senses, _ = env.reset(seed=seed if episode == 0 else None)
        ended = truncated = False
        while not (ended or truncated):
            pattern, side = senses[1] >> 1 & 7, draws.integers(2)
            turns = pattern > 0 or draws.random() < 0.2
            senses, _, ended, truncated, _ = env.step(1 + side if turns else 0)
            after = senses[1] >> 1 & 7
            if pattern:
                tries[pattern, side] += 1
                target = 1 + (turns_needed[after].min() if after else 0)
                rate = 1 / min(tries[pattern, side], 100)
                turns_needed[pattern, side] += rate * (target - turns_needed[pattern, side])
            if any(turns_needed[front].argmin() != best for front, best in RIGHT.items()):
                wrong_until = episode + 1, int(tries.sum())
    return wrong_until


for seed in (1, 2, 3):
    episodes, turns = learn(seed)
    print(f"seed {seed}: right after {episodes} episodes and {turns} turns")
