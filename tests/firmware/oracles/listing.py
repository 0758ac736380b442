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


class Robot(Protocol):
    """What the listing asks of the simulated robot and of BASIC."""

    def feel(self) -> int: ...
    def look(self) -> bool: ...
    def beacon_mm(self) -> int: ...
    def random(self, n: int) -> int: ...


def count_sensors(senses: int) -> int:
    """The listing's CountSensors."""
    return bin(senses).count("1")


class Listing:
    """The listing's variables and its Search routine.

    Attributes:
        mem: The learned memory, Mem[].
        repeat_count: RepeatCount; it has no upper limit here.
    """

    def __init__(self, robot: Robot, mem: MutableMapping[int, int] | bytearray, repeat_count: int = 0) -> None:
        self.robot, self.mem, self.repeat_count = robot, mem, repeat_count

    @staticmethod
    def begin(cells: bytes) -> bytes:
        """The memory with which a run begins, from what it was before."""
        return cells

    def recall(self, pattern: int) -> int:
        """What is known for a pattern."""
        return self.mem[pattern]

    def learn(self, pattern: int, side: int) -> None:
        """Takes a lesson."""
        self.mem[pattern] = side

    def search(self) -> Iterator[Action]:  # noqa: C901, PLR0912  # as long as the listing
        """Search, for ever: the food never runs out."""
        robot, mem = self.robot, self.recall
        while True:  # while FoodCnt
            senses = (robot.feel() >> 1) & 7  # Senses = (rFeel()>>1)&7
            if senses == 0:  # if Senses=0
                self.repeat_count = 0  # RepeatCount = 0
                yield Action("TOWARD_FOOD" if robot.look() else "WANDER", forward_mm=DIST_MM)  # rForward Dist
                if robot.look():  # if rLook(0)=Green
                    if robot.beacon_mm() < REACH_MM:  # if rBeacon(Green)<30
                        yield Action("EAT")  # x = rGPSx() ... FoodCnt--
                elif robot.random(2):  # else: if random(2)
                    yield Action("LOOK_AROUND", 2 + robot.random(10))  # rTurn 2 +random(10)
                else:  # else
                    yield Action("LOOK_AROUND", -(2 + robot.random(10)))  # rTurn -(2+random(10))
            elif mem(senses):  # else: if Mem[Senses]
                if mem(senses) == TURN_LEFT:  # if Mem[Senses] = TurnLeft
                    yield Action("REMEMBERED", -DEG)  # then rTurn -Deg
                elif mem(senses) == TURN_RIGHT:  # if Mem[Senses] = TurnRight
                    yield Action("REMEMBERED", DEG)  # then rTurn Deg
                self.repeat_count += 1  # RepeatCount++
                if self.repeat_count == 10:  # if RepeatCount=10
                    yield Action("BOREDOM", 150 + robot.random(60))  # then rturn (150+random(60))
            else:  # else
                cnt = count_sensors(senses)  # call CountSensors(Senses,Cnt)
                old_senses = senses  # OldSenses = Senses
                r = robot.random(2) + 1  # r=random(2)+1
                if r == TURN_LEFT:  # if r=TurnLeft
                    yield Action("TRIAL", -45)  # then rTurn -45
                if r == TURN_RIGHT:  # if r=TurnRight
                    yield Action("TRIAL", 45)  # then rTurn 45
                senses = (robot.feel() >> 1) & 7  # Senses = (rFeel()>>1)&7
                new_cnt = count_sensors(senses)  # call CountSensors(Senses,NewCnt)
                if new_cnt < cnt:  # if NewCnt<Cnt
                    self.learn(old_senses, r)  # then Mem[OldSenses]=r
