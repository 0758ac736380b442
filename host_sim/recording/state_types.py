"""The visible state of a run as plain JSON types: the one form that every view draws, live or recorded.

Ticks are counted from the start of the run and do not wrap. Lengths are in mm, x to the right and y down; headings in
mrad, 0 along +x, positive to the right. Sides: 0 nothing, 1 left, 2 right. Reasons: as in octet.dbc. tools/generate
makes the types of the pages from these.
"""

from typing import TypedDict


class Trial(TypedDict):
    """A random turn, tried because the pattern's cell was empty.

    Attributes:
        tick: Tick in which it began.
        cell: The pattern, 1..7.
        side: Direction of the turn: 1 left, 2 right.
        helped: 1 if fewer front sensors were triggered afterwards, 0 if not; None during the turn.
        frozen: 1 if learning was frozen when it ended, else 0.
    """

    tick: int
    cell: int
    side: int
    helped: int | None
    frozen: int


class Lesson(TypedDict):
    """A change of a cell.

    Attributes:
        node: Node number of the robot.
        tick: Tick of the change.
        cell: The cell, 1..7.
        side: Its new content: 0 nothing, 1 left, 2 right.
        by_hand: 1 if a person wrote or erased it, 0 if the robot learned or forgot it.
    """

    node: int
    tick: int
    cell: int
    side: int
    by_hand: int


class Learned(TypedDict):
    """What a robot knows at a tick; see `State`."""

    memory: list[int]
    uses: list[int]
    learned: list[int]
    by_hand: list[int]
    frozen: int
    trial: Trial | None


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
