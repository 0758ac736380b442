"""The state of a run, as `state_types` has it, from a simulation or from what was recorded of one."""

from collections.abc import Sequence
from typing import cast

from host_sim.protocol.generated import COLUMNS
from host_sim.recording.history import LearningHistory
from host_sim.recording.state_types import EnvironmentScene, Learned, Measures, State
from host_sim.sim.simulation import Simulation
from host_sim.sim.world_record import Begun
from host_sim.world.arena import Arena
from host_sim.world.geometry import Pose, SimParams


def measures(params: SimParams, boredom_limit: int) -> Measures:
    """The dimensions of a world, and the robot's parameter `boredom_limit`."""
    return Measures(
        width=params.width_mm,
        height=params.height_mm,
        body=params.body_radius_mm,
        track=params.wheel_track_mm,
        reach=params.sensor_reach_mm,
        beam=params.beam_width_mm,
        eat=params.eat_reach_mm,
        bar=params.bar_thickness_mm,
        tick_ms=params.tick_s * 1000,
        boredom=boredom_limit,
    )


def environment_scene(begun: Sequence[Begun], of: int, arena: Arena) -> EnvironmentScene:
    """The scene of an arena as it is now.

    Args:
        begun: The environments of the run so far.
        of: Number of environments in the run.
        arena: The arena of the last one.
    """
    last = begun[-1]
    scene = EnvironmentScene(
        number=last.number,
        of=of,
        seed=last.seed,
        first_tick=last.first_tick,
        start_tick=next((it.first_tick for it in reversed(begun) if it.number == 1), last.first_tick),
        bars=[[bar_id, *(round(c, 1) for c in (*bar.a, *bar.b))] for bar_id, bar in arena.obstacles.bars.items()],
        food=[[round(x, 1), round(y, 1)] for x, y in arena.food.at],
    )
    if plants := arena.obstacles.plants:
        scene["plants"] = [[plant_id, *at, radius_mm] for plant_id, (at, radius_mm) in plants.items()]
    return scene


def state(  # noqa: PLR0913, PLR0917 - everything that a display shows
    node: int, tick: int, pose: Pose, row: Sequence[int], known: Learned, eaten: Sequence[int]
) -> State:
    """A robot's state after a tick.

    Args:
        node: The robot's node number on the bus.
        tick: Number of the tick.
        pose: Its position and heading, after its move.
        row: The numbers of `ROW`.
        known: The robot's knowledge.
        eaten: For each piece of food, 1 if it was eaten, else 0.
    """
    x, y, heading = pose
    place = {"node": node, "tick": tick, "x": round(x, 1), "y": round(y, 1), "heading": round(heading * 1000)}
    shown = {name: row[number] for name, number in COLUMNS.items()}
    return cast("State", {**place, **shown, "eaten": list(eaten), **known})


def states(simulation: Simulation, histories: Sequence[LearningHistory]) -> list[State]:
    """The state of each robot after the last tick of a simulation, which `histories` must include."""
    tick, eaten = max(0, simulation.tick - 1), [int(is_eaten) for is_eaten in simulation.arena.food.eaten]
    robots = zip(simulation.arena.bodies, simulation.senses, simulation.drives, histories, strict=True)
    found = []
    for body, senses, drive, history in robots:
        row = [*map(int, (*senses, *drive, history.pattern, body.lifted, history.frozen))]
        found.append(state(history.node, tick, body.pose, row, history.known(), eaten))
    return found
