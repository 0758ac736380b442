"""The visible state of a run as plain JSON types: the one form that every view draws, live or recorded.

Ticks are counted from the start of the run and do not wrap. Lengths are in mm, x to the right and y down; headings in
mrad, 0 along +x, positive to the right. Sides: 0 nothing, 1 left, 2 right. Reasons: as in octet.dbc.
"""

from collections.abc import Sequence
from typing import TypedDict, cast

from host_sim.protocol.generated import COLUMNS
from host_sim.sim.simulation import Simulation
from host_sim.sim.world_record import Begun
from host_sim.view.history import Learned, LearningHistory, Lesson, Trial
from host_sim.world.arena import Arena
from host_sim.world.geometry import Pose
from host_sim.world.params import SimParams

__all__ = ["EnvironmentScene", "Lesson", "Measures", "State", "Trial", "environment_scene", "measures", "state"]


class Measures(TypedDict):
    """The dimensions that a drawing needs, in mm unless stated otherwise.

    Attributes:
        width: Inside width of the arena.
        height: Inside height of the arena.
        body: Radius of the robot.
        track: Distance between its wheels.
        reach: How far the sensor cones reach beyond the body.
        beam: Width of the corridor in which food is seen.
        eat: Food nearer than this to the robot's centre can be eaten.
        bar: Thickness of an obstacle.
        tick_ms: Length of a tick, ms of robot time.
        boredom: Number of remembered turns in a row at which the robot is bored.
    """

    width: float
    height: float
    body: float
    track: float
    reach: float
    beam: float
    eat: float
    bar: float
    tick_ms: float
    boredom: int


class _SceneWithoutPlants(TypedDict):
    number: int
    of: int
    seed: int
    first_tick: int
    start_tick: int
    bars: list[list[float]]
    food: list[list[float]]


class EnvironmentScene(_SceneWithoutPlants, total=False):
    """One environment's arena. A new scene begins with each environment and each change of its obstacles or food.

    Attributes:
        number: Number of the environment, from 1.
        of: Number of environments in the run.
        seed: Seed that it was drawn from.
        first_tick: Its first tick.
        start_tick: First tick since the run was last started over: clocks count from here.
        bars: For each obstacle its id and both ends of its centre line: [id, ax, ay, bx, by].
        food: For each piece of food, eaten or not: [x, y].
        plants: For each plant its id, its centre and its radius: [id, x, y, radius]; left out where there are none.
    """

    plants: list[list[float]]


class State(TypedDict):
    """One robot's state: what it sensed at a tick, what it did, and where it was afterwards.

    Attributes:
        node: The robot's node number on the bus.
        tick: Number of the tick.
        x: Centre of the robot after the tick, to 0.1 mm.
        y: Likewise.
        heading: Heading after the tick, -3142..3142 mrad.
        lifted: 1 while a person holds the robot in the air, else 0.
        feel: Proximity, one bit each: right 1, front-right 2, front 4, front-left 8, left 16.
        bump: 1 if the body touched something, else 0.
        beacon: Distance to the food seen straight ahead; 0 if none is seen.
        left: Speed of the left wheel, mm/s, forward positive.
        right: Speed of the right wheel, likewise.
        reason: Reason of the action.
        repeat_count: Number of remembered turns since the way was last clear, 0..255.
        action: Number of the current action, 0..127, wraps.
        pattern: The three front sensors when that action was decided: bit 0 front-right, 1 front, 2 front-left.
        eaten: For each piece of food, 1 if it was eaten, else 0.
        memory: The eight cells, each a side.
        uses: For each cell, the number of remembered turns that used its present content.
        learned: For each cell, the tick of its last change; -1 if there was none since the run was started over.
        by_hand: For each cell, 1 if its last change came from outside, from a person or from another robot; else 0.
        frozen: 1 if learning is frozen, else 0.
        trial: The last trial of the run, or None.
    """

    node: int
    tick: int
    x: float
    y: float
    heading: int
    lifted: int
    feel: int
    bump: int
    beacon: int
    left: int
    right: int
    reason: int
    repeat_count: int
    action: int
    pattern: int
    eaten: list[int]
    memory: list[int]
    uses: list[int]
    learned: list[int]
    by_hand: list[int]
    frozen: int
    trial: Trial | None


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
        known: What the robot knows.
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
