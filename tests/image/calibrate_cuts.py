"""Cuts an emulated board's power at each write and erase of its flash while it learns and calibrates itself.

    .venv/bin/python -m tests.image.calibrate_cuts
    .venv/bin/python -m tests.image.calibrate_cuts --board nucleo_g431rb --again-every 1

All pages of memory and values are full, so that they are erased on the way. After one of N cuts the robot goes on
and stores all anew, and each write of that is cut, too. Prints how many cuts left what was known before, how many
what was being stored, and how many anything else; the exit code is 1 if any did. A board without a body on pins has
its memory only.
"""

import argparse
import sys
from collections import Counter
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from functools import partial

from host_sim.emulator.board import EmulatedBoard, start_board
from host_sim.emulator.chips import CHIPS
from host_sim.emulator.flash import FlashG4
from host_sim.emulator.pins_board import PinsBoard, start_robot
from host_sim.lab.calibrate.calibration import CALIBRATION_VALUES, STEPS, Places
from host_sim.protocol.generated import Side
from host_sim.protocol.words import BODY_PARAMETERS
from host_sim.sim.access import BOARDS
from tests.image.support import Talk

State = tuple[tuple[int, ...], tuple[int, ...]]
"""The eight cells; the calibration values in their order."""

Step = Callable[[], None]

STORES = {"blue_pill": (0xF800, 0x10000), "feather_stm32f405": (0x4000, 0xC000), "nucleo_g431rb": (0x1F000, 0x20000)}
"""Where the memory is kept: begin and end, bytes from the start of the flash."""

RECORD, WRITE_MAX = 16, 8
"""Bytes of the store's, and of the longest write."""

OF_EACH_RECORD = ("body_track_mm", "body_lag_ms")
"""A value of each record of them."""

_UP_S = {True: 0.15, False: 0.6}  # an erase each of three small pages, or of a large one
_STORED_S, _LONGEST_S = 0.1, 60.0
_MEASURE = BODY_PARAMETERS["body_measure"].number
_REFUSED = BODY_PARAMETERS["body_refused"].number


@dataclass
class Recording:
    """What was done to a board's flash.

    Attributes:
        board: Its name.
        before: The flash's bytes before.
        changes: Of each change the place, the bytes after it, and the bytes if it was cut.
        left: What cuts have left when each begins: pages that are half erased, places that are unreadable.
    """

    board: str
    before: bytes
    changes: list[tuple[int, bytes, bytes]] = field(default_factory=list)
    left: list[tuple[set[int], set[int]]] = field(default_factory=list)

    def cut_at(self, number: int) -> bytes:
        """The flash as it is if the power fails within that change."""
        memory = bytearray(self.before)
        for offset, whole, _ in self.changes[:number]:
            memory[offset : offset + len(whole)] = whole
        offset, _, partial_ = self.changes[number]
        memory[offset : offset + len(partial_)] = partial_
        return bytes(memory)

    def cut(self, board: EmulatedBoard, number: int) -> None:
        """Gives a board the flash as it is if the power fails within that change."""
        flash = board.hardware.flash
        offset, whole, _ = self.changes[number]
        half_erased, unreadable = self.left[number]
        flash.memory[:] = self.cut_at(number)
        flash._half_erased = set(half_erased)
        if isinstance(flash, FlashG4):
            flash.unreadable = set(unreadable)
        flash.changed(offset, len(whole), cut=True)


def recording_of(board: EmulatedBoard, work: Callable[[EmulatedBoard], None]) -> Recording:
    """Has that work done, and notes all changes of the board's flash."""
    flash = board.hardware.flash
    found = Recording(board.hardware.chip.name, bytes(flash.memory))
    change = flash._change

    def recorded(offset: int, whole: bytes, partial_: bytes) -> None:
        found.changes.append((offset, whole, partial_))
        found.left.append((set(flash._half_erased), set(getattr(flash, "unreadable", ()))))
        change(offset, whole, partial_)

    flash._change = recorded  # type: ignore[method-assign]
    work(board)
    return found


@dataclass(frozen=True)
class Life:
    """What was stored, step by step.

    Attributes:
        before: What the robot knew at its begin.
        steps: Number of changes of the flash up to the end of each step, and what it knew then.
        recording: These changes.
    """

    before: State
    steps: list[tuple[int, State]]
    recording: Recording

    def around(self, number: int) -> tuple[State, State]:
        """What it knew before the step that a change is part of, and after it."""
        states = [self.before, *(state for _, state in self.steps)]
        step = next(i for i, (end, _) in enumerate(self.steps) if number < end)
        return states[step], states[step + 1]


class Robot:
    """A board and what one does with it."""

    def __init__(self, name: str) -> None:
        self.board: EmulatedBoard = start_robot(name) if CHIPS[name].converter else start_board(name)
        self.talk = Talk(self.board)

    def power_up(self) -> None:
        self.board.cut_power()
        self.talk.wait(_UP_S[isinstance(self.board, PinsBoard)])

    def learn(self, side: int) -> None:
        self.talk.order("write", mask=0b1111, half=0, byte_0=0, byte_1=side, byte_2=0, byte_3=0)
        self.talk.wait(_STORED_S)

    def get(self, number: int) -> int:
        self.talk.order("get", wanted=number)
        self.talk.wait(0.01)
        return self.talk.last("ANSWER")["value"]

    def set(self, name: str, value: int) -> None:
        self.talk.order("set", parameter=BODY_PARAMETERS[name].number, value=value)
        self.talk.wait(_STORED_S)

    def knows(self) -> State:
        self.talk.heard.clear()
        self.talk.ask()
        rows = CALIBRATION_VALUES.values() if isinstance(self.board, PinsBoard) else ()
        return self.talk.memory, tuple(self.get(row.number) for row in rows)

    def measure(self, places: Places, step: str) -> None:
        places.put(step)
        self.talk.order("set", parameter=_MEASURE, value=1 + STEPS.index(step))
        end = self.board.now() + _LONGEST_S
        while self.get(_MEASURE) and self.board.now() < end:
            places.wait(_STORED_S)
        places.wait(_STORED_S)
        assert (self.get(_MEASURE), self.get(_REFUSED)) == (0, 0)

    def storing(self, side: int) -> list[Step]:
        """Something new for each of its stores."""
        steps: list[Step] = [partial(self.learn, side)]
        if isinstance(self.board, PinsBoard):
            steps += [partial(self.set, name, CALIBRATION_VALUES[name].minimum + side) for name in OF_EACH_RECORD]
        return steps

    def fill(self, store: int, page: int) -> None:
        """As after long use: what is newest in a page stands in all places but the last. After it, power up."""
        memory, (begin, end) = self.board.hardware.flash.memory, STORES[self.board.hardware.chip.name]
        size = (end - begin) // 2
        begin += (page - 2 * store) * size
        used = begin + -(-len(memory[begin : begin + size].rstrip(b"\xff")) // RECORD) * RECORD
        room = begin + size - RECORD - used
        memory[used : used + room] = memory[used - RECORD : used] * (room // RECORD)

    def live(self, before: State, steps: Iterable[Step]) -> Life:
        """Has all of that done."""
        flash = self.board.hardware.flash
        first, known = flash.operations, list[tuple[int, State]]()

        def work(_board: EmulatedBoard) -> None:
            for step in steps:
                step()
                known.append((flash.operations - first, self.knows()))

        return Life(before, known, recording_of(self.board, work))


def full_robot(name: str) -> Robot:
    """One whose next stores need an erase each: of memory, of light and track, of motors."""
    robot = Robot(name)
    for page in range(2):
        for store, step in enumerate(robot.storing(Side.LEFT)):
            step()
            robot.fill(store, page)
        robot.power_up()
        for step in robot.storing(Side.RIGHT):
            step()
    return robot


def a_calibration(name: str) -> Life:
    """The robot learns, calibrates all there is, and learns once more."""
    robot = full_robot(name)
    steps: list[Step] = [partial(robot.learn, Side.LEFT)]
    if isinstance(robot.board, PinsBoard):
        places = Places(robot.board, "kit", seed=3)
        steps += [partial(robot.measure, places, step) for step in STEPS]
    return robot.live(robot.knows(), [*steps, partial(robot.learn, Side.RIGHT)])


def known_after(life: Life, cuts: Iterable[int]) -> list[State]:
    """What the robot knows after a power cut at each of these changes."""
    robot, found = Robot(life.recording.board), []
    for cut in cuts:
        life.recording.cut(robot.board, cut)
        robot.power_up()
        found.append(robot.knows())
    return found


def outcomes(life: Life, cuts: Sequence[int]) -> Counter[str]:
    """How many of these cuts left what was known before, how many what came then, how many neither."""
    found = Counter({"old": 0, "new": 0, "neither": 0})
    for cut, state in zip(cuts, known_after(life, cuts), strict=True):
        old, new = life.around(cut)
        found["old" if state == old else "new" if state == new else "neither"] += 1
    return found


def going_on(life: Life, cut: int) -> Life:
    """A life after that cut: everything is stored anew."""
    robot = Robot(life.recording.board)
    (before,) = known_after(life, [cut])
    life.recording.cut(robot.board, cut)
    return robot.live(before, [robot.power_up, *robot.storing(Side.LEFT + Side.RIGHT - before[0][1])])


def cut_again(life: Life, cuts: Iterable[int]) -> Counter[str]:
    """The same of all changes that come after these cuts."""
    lives = (going_on(life, cut) for cut in cuts)
    return sum((outcomes(again, range(len(again.recording.changes))) for again in lives), Counter())


def main() -> int:
    """Cuts them all."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--board", choices=BOARDS, default=BOARDS[0], help="which board (default: %(default)s)")
    parser.add_argument(
        "--again-every", type=int, default=10, metavar="N", help="cut again after 1 of N (default: 10)"
    )
    arguments = parser.parse_args()
    life = a_calibration(arguments.board)
    cuts = range(len(life.recording.changes))
    once, twice = outcomes(life, cuts), cut_again(life, cuts[:: arguments.again_every])
    for what, found in (("once", once), ("twice", twice)):
        counts = ", ".join(f"{found[outcome]:,} {outcome}" for outcome in ("old", "new", "neither"))
        sys.stdout.write(f"{arguments.board}, cut {what}: {found.total():,} cuts, {counts}\n")
    return 1 if once["neither"] + twice["neither"] else 0


if __name__ == "__main__":
    sys.exit(main())
