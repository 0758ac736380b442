"""The oracles of the behaviours: the class of a profile is its name's."""

from collections.abc import Iterator
from fractions import Fraction

from tests.firmware.oracles.listing import (
    DEG,
    DIST_MM,
    REACH_MM,
    TURN_LEFT,
    TURN_RIGHT,
    Action,
    Listing,
    count_sensors,
    pattern,
)

SENSORS_MM = 60
NOTHING_MM = 255

ON_THE_RIGHT, ON_THE_LEFT = (1, 3), (4, 6)
"""The patterns of a thing on one side."""


# `article`: the listing as it is
class Article(Listing):
    """It learns from trials, and never forgets."""


# `fixed`: the article's "simple coding solution", a programmed turn for every front pattern
class Fixed(Listing):
    """It begins with the programmed turns and learns nothing; what a person writes, it does."""

    @staticmethod
    def begin(cells: bytes) -> bytes:
        """Whatever it was: to the right where the left is blocked and the right is not, else to the left."""
        del cells
        turns = (TURN_RIGHT if pattern in (0b100, 0b110) else TURN_LEFT for pattern in range(1, 8))
        return bytes((0, *turns))

    def learn(self, feel: int, side: int) -> None:
        """Nothing."""


# `five`: a turn for each reading of all five sensors
class Five(Listing):
    """Reading n has two bits, from bit 2n on, the eight bytes taken as one little-endian number.

    The four bits of readings 0 and 1, in which nothing is in the way, are set as soon as something was learned.
    """

    tried_feel = 0
    """The reading of the last remembered turn."""

    def begin_remembered(self, feel: int) -> None:
        """Boredom may be about this."""
        self.tried_feel = feel

    def begin_about_face(self) -> None:
        """Boredom can strike again, and forgets what was in front, whatever was beside it."""
        self.repeat_count = 0
        if not self.frozen:
            for beside in (0, 1, 16, 17):
                self.learn(self.tried_feel & 14 | beside, 0)

    def recall(self, feel: int) -> int:
        """The two bits of a reading."""
        return int.from_bytes(bytes(self.mem), "little") >> 2 * feel & 3

    def learn(self, feel: int, side: int) -> None:
        """Changes the two bits of a reading."""
        number = int.from_bytes(bytes(self.mem), "little") & ~(3 << 2 * feel) | side << 2 * feel | 0b1111
        self.mem[:] = number.to_bytes(8, "little")


# `never`: each blockage is a trial
class Never(Listing):
    """It has a memory and makes no use of it."""

    def recall(self, feel: int) -> int:
        """Nothing."""
        del feel
        return 0

    def try_a_turn(self, senses: int) -> Iterator[Action]:
        """The tenth trial in a row is a turn of 150 degrees."""
        if self.repeat_count + 1 < 10:
            self.repeat_count += 1
            yield from super().try_a_turn(senses)
            return
        self.repeat_count = 0
        yield Action("BOREDOM", -150 if self.robot.random(2) + 1 == TURN_LEFT else 150)

    def learn(self, feel: int, side: int) -> None:
        """Nothing."""


# `rearmed`: boredom can strike again
class Rearmed(Listing):
    """The about-face ends the count."""

    def begin_about_face(self) -> None:
        """RepeatCount = 0."""
        self.repeat_count = 0


# `sided`: no lesson from what has no side
class Sided(Listing):
    """It learns a turn only for an obstacle on its right or on its left."""

    def learn(self, feel: int, side: int) -> None:
        """Front-right or front-left, and not both."""
        if pattern(feel) in (*ON_THE_RIGHT, *ON_THE_LEFT):
            super().learn(feel, side)


# `recheck`: the article's challenge, word for word
class Recheck(Listing):
    """After each remembered turn the cell is erased, unless fewer sensors are triggered than before."""

    def end_remembered(self, feel: int) -> None:
        """Checks what was remembered."""
        if count_sensors(pattern(self.robot.feel())) >= count_sensors(pattern(feel)) and not self.frozen:
            self.mem[pattern(feel)] = 0


# `distance`: the nearer the thing in the way, the bigger the remembered turn
class Distance(Listing):
    """Deg is 10 + 20 x (1 - d/60), to the nearest whole degree; d in whole mm makes no halves."""

    def remembered_deg(self) -> int:
        """By the nearest thing that the three front sensors see."""
        _, *front, _ = self.robot.ranges_mm()
        nearest_mm = min(SENSORS_MM if mm == NOTHING_MM else mm for mm in front)
        return round(DEG + 20 * max(1 - Fraction(nearest_mm, SENSORS_MM), Fraction(0)))


# `forgetful`: bored, it forgets what it has used since the way was last clear
class Forgetful(Listing):
    """As the listing, but boredom can strike again, and what led to it is forgotten."""

    STATE = ("used", "unlearned")

    used = 0
    """Bit p for cell p."""

    unlearned = 0
    """The same for those that boredom has emptied."""

    def learn(self, feel: int, side: int) -> None:
        """A lesson counts as used."""
        super().learn(feel, side)
        self.used |= 1 << pattern(feel)

    def find_way_clear(self) -> None:
        """It led to something."""
        self.used = 0

    def begin_remembered(self, feel: int) -> None:
        """The cell is used."""
        self.used |= 1 << pattern(feel)

    def begin_about_face(self) -> None:
        """It led to nothing."""
        self.repeat_count = 0
        for cell in range(1, 8):
            if self.used >> cell & 1 and not self.frozen:
                self.unlearned |= (self.mem[cell] != 0) << cell
                self.mem[cell] = 0
        self.used = 0


# `adaptive`: as `forgetful`, with confidence
class Adaptive(Forgetful):
    """A cell is its side and four times its confidence, which is 1 to 3; or 0."""

    def recall(self, feel: int) -> int:
        """The side alone."""
        return self.mem[pattern(feel)] % 4

    def learn(self, feel: int, side: int) -> None:
        """A lesson has confidence 1."""
        super().learn(feel, side + 4)

    def find_way_clear(self) -> None:
        """Praise."""
        self.judge(1)

    def begin_about_face(self) -> None:
        """Blame."""
        self.repeat_count = 0
        self.judge(-2)

    def judge(self, change: int) -> None:
        """Changes the confidence of each used cell that has a side."""
        for cell in range(1, 8):
            if self.used >> cell & 1 and not self.frozen and self.mem[cell]:
                confidence, side = divmod(self.mem[cell], 4)
                confidence = min(3, confidence + change)
                self.mem[cell] = side + 4 * confidence if confidence > 0 else 0
                self.unlearned |= (confidence <= 0) << cell
        self.used = 0


# `searcher`: as `adaptive`, with another way of looking for food
class Searcher(Adaptive):
    """It drives straight on, looks around after a metre without looking, and goes straight to what it sees.

    A lesson of what is on one side is one of what is on the other, too.
    """

    STATE = ("used", "unlearned", "since_mm", "lost", "chasing", "ate", "tried_side")

    since_mm = 1000
    tried_side = 0
    chasing = ate = lost = False

    def learn(self, feel: int, side: int) -> None:
        """All patterns of one side get the turn that agrees with it."""
        super().learn(feel, side)
        learned = pattern(feel)
        for same, others in ((ON_THE_RIGHT, ON_THE_LEFT), (ON_THE_LEFT, ON_THE_RIGHT)):
            if learned in same:
                turns = dict.fromkeys(same, side) | dict.fromkeys(others, TURN_LEFT + TURN_RIGHT - side)
                for cell, turn in turns.items():
                    self.mem[cell] = turn + 4

    def search(self) -> Iterator[Action]:
        """It keeps in mind to which side it turns away from things."""
        for action in super().search():
            if action.why in ("TRIAL", "REMEMBERED"):
                self.tried_side = TURN_LEFT if action.turn_deg < 0 else TURN_RIGHT
            yield action

    def go_forward(self) -> Iterator[Action]:
        """The way is clear."""
        robot = self.robot
        if self.ate:
            self.ate = self.chasing = self.lost = False
            self.since_mm = 1000
        if robot.look():
            self.since_mm = 0
            self.chasing = True
        elif self.chasing:
            self.chasing = False
            self.since_mm = 600 if self.lost else 800
            self.lost = True
        if not robot.look() and self.since_mm >= 1000:
            more = robot.random(60)
            self.since_mm = 8 * more
            to_the_left = self.lost and self.tried_side == TURN_RIGHT
            yield Action("LOOK_AROUND", -360 - more if to_the_left else 360 + more, until_food=True)
            return
        yield Action("TOWARD_FOOD" if robot.look() else "WANDER", forward_mm=DIST_MM)
        self.since_mm += DIST_MM
        if robot.look():
            self.since_mm = 0
            if robot.beacon_mm() < REACH_MM:
                self.ate = True
                yield Action("EAT")
