"""The article's Figure 4 in Python, each line beside the listing's own: the oracles of the behaviours start from it.

Where the listing moves the robot, `Listing.search` yields the action and goes on when it has ended. Where the listing
asks the robot, it asks a `Robot`. The listing's lengths are pixels of its screen; a pixel is 5 mm here.
"""

from collections.abc import Iterator, MutableMapping
from typing import NamedTuple, Protocol

TURN_LEFT, TURN_RIGHT = 1, 2
DEG = 10
DIST_MM = 12
REACH_MM = 150


class Action(NamedTuple):
    """One movement. `why` is the part of REASON_ in the C names; turns are in degrees, right positive."""

    why: str
    turn_deg: int = 0
    forward_mm: int = 0
    until_food: bool = False


class Robot(Protocol):
    """What the listing asks of the simulated robot and of BASIC."""

    def feel(self) -> int: ...
    def look(self) -> bool: ...
    def beacon_mm(self) -> int: ...
    def ranges_mm(self) -> tuple[int, ...]: ...
    def random(self, n: int) -> int: ...


def pattern(feel: int) -> int:
    """The listing's Senses: the three front sensors."""
    return (feel >> 1) & 7


def count_sensors(senses: int) -> int:
    """The listing's CountSensors."""
    return bin(senses).count("1")


class Listing:
    """The listing's variables and its Search routine, with places where a behaviour may do more.

    Attributes:
        mem: The learned memory, Mem[].
        repeat_count: RepeatCount; it has no upper limit here.
        frozen: Whether nothing is learned.
    """

    STATE: tuple[str, ...] = ()
    """Names of further attributes, which are fields of the brain as well, beside those that each behaviour has."""

    def __init__(
        self, robot: Robot, mem: MutableMapping[int, int] | bytearray, repeat_count: int = 0, frozen: bool = False
    ) -> None:
        self.robot, self.mem, self.repeat_count, self.frozen = robot, mem, repeat_count, frozen

    @staticmethod
    def begin(cells: bytes) -> bytes:
        """The memory with which a run begins, from what it was before."""
        return cells

    def recall(self, feel: int) -> int:
        """What is known for a reading of the five sensors."""
        return self.mem[pattern(feel)]

    def learn(self, feel: int, side: int) -> None:
        """Takes a lesson."""
        self.mem[pattern(feel)] = side

    def remembered_deg(self) -> int:
        """The size of a remembered turn."""
        return DEG

    def find_way_clear(self) -> None:
        """The way is clear at the top of the loop."""

    def begin_remembered(self, feel: int) -> None:
        """A remembered turn is about to begin."""

    def end_remembered(self, feel: int) -> None:
        """A remembered turn, begun at a reading, has ended."""

    def begin_about_face(self) -> None:
        """Bored, it is about to turn about."""

    def search(self) -> Iterator[Action]:
        """Search, for ever: the food never runs out."""
        while True:  # while FoodCnt
            senses = self.robot.feel()  # Senses = (rFeel()>>1)&7
            if pattern(senses) == 0:  # if Senses=0
                self.find_way_clear()
                self.repeat_count = 0  # RepeatCount = 0
                yield from self.go_forward()
            elif self.recall(senses):  # else: if Mem[Senses]
                yield from self.turn_as_remembered(senses)
            else:  # else
                yield from self.try_a_turn(senses)

    def go_forward(self) -> Iterator[Action]:
        """The way is clear."""
        robot = self.robot
        yield Action("TOWARD_FOOD" if robot.look() else "WANDER", forward_mm=DIST_MM)  # rForward Dist
        if robot.look():  # if rLook(0)=Green
            if robot.beacon_mm() < REACH_MM:  # if rBeacon(Green)<30
                yield Action("EAT")  # x = rGPSx() ... FoodCnt--
        elif robot.random(2):  # else: if random(2)
            yield Action("LOOK_AROUND", 2 + robot.random(10))  # rTurn 2 +random(10)
        else:  # else
            yield Action("LOOK_AROUND", -(2 + robot.random(10)))  # rTurn -(2+random(10))

    def turn_as_remembered(self, senses: int) -> Iterator[Action]:
        """Blocked, and the memory knows a turn."""
        self.begin_remembered(senses)
        if self.recall(senses) == TURN_LEFT:  # if Mem[Senses] = TurnLeft
            yield Action("REMEMBERED", -self.remembered_deg())  # then rTurn -Deg
        elif self.recall(senses) == TURN_RIGHT:  # if Mem[Senses] = TurnRight
            yield Action("REMEMBERED", self.remembered_deg())  # then rTurn Deg
        self.end_remembered(senses)
        self.repeat_count += 1  # RepeatCount++
        if self.repeat_count == 10:  # if RepeatCount=10
            self.begin_about_face()
            yield Action("BOREDOM", 150 + self.robot.random(60))  # then rturn (150+random(60))

    def try_a_turn(self, senses: int) -> Iterator[Action]:
        """Blocked, and the memory knows nothing."""
        cnt = count_sensors(pattern(senses))  # call CountSensors(Senses,Cnt)
        old_senses = senses  # OldSenses = Senses
        r = self.robot.random(2) + 1  # r=random(2)+1
        if r == TURN_LEFT:  # if r=TurnLeft
            yield Action("TRIAL", -45)  # then rTurn -45
        if r == TURN_RIGHT:  # if r=TurnRight
            yield Action("TRIAL", 45)  # then rTurn 45
        senses = self.robot.feel()  # Senses = (rFeel()>>1)&7
        new_cnt = count_sensors(pattern(senses))  # call CountSensors(Senses,NewCnt)
        if new_cnt < cnt and not self.frozen:  # if NewCnt<Cnt
            self.learn(old_senses, r)  # then Mem[OldSenses]=r
