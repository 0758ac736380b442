"""What a log's frames say of a robot up to a tick: read without a world, a trajectory or the project's history."""

from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from host_sim.api import resimulate
from host_sim.protocol.codec import Protocol
from host_sim.protocol.generated import PATTERNS, PROFILES, SENTENCES, SIDES, Drive, Opcode, Reason
from host_sim.recording.log_reader import frames_of, read_log
from host_sim.talk.conversation import Conversation, Said, script_named, texts_of
from host_sim.talk.facts import RobotFacts
from host_sim.talk.log_index import index_log


@dataclass
class Tick:
    """The frames of one tick: what was sensed and done, and after it the memory as it was last reported."""

    senses: dict[str, int]
    drive: Drive
    memory: list[int] = field(default_factory=lambda: [0] * 8)


class Frames:
    """A log of one robot, tick by tick; `facts` tells what is known up to one."""

    def __init__(self, log: Path) -> None:
        self.ticks: list[Tick] = []
        self.begun = 0
        self.profile: list[tuple[int, str]] = []
        self.health: list[tuple[int, dict[str, int]]] = []
        self._senses: dict[str, int] = {}
        self._memory = [0] * 8
        protocol = Protocol(1)
        for line in frames_of(read_log(log), 1):
            drive = protocol.decode_drive(line.frame)
            if drive and len(self.ticks) < self.begun:
                self.ticks.append(Tick(self._senses, drive, self._memory))
            elif frame := protocol.decode(line.frame):
                self._take(frame.name, frame.signals)

    def _take(self, name: str, signals: dict[str, int]) -> None:
        if name == "SENSES":
            self._senses, self.begun = signals, len(self.ticks) + 1
        elif name == "MEMORY":
            cells = {int(cell[5:]): value & 3 for cell, value in signals.items() if cell.startswith("cell_")}
            self._memory = [cells.get(cell, side) for cell, side in enumerate(self._memory)]
            if self.ticks and self.begun == len(self.ticks):
                self.ticks[-1].memory = self._memory
        elif name == "HEALTH":
            self.health.append((max(0, self.begun - 1), signals))
        elif name == "COMMAND" and signals["opcode"] == Opcode.START:
            names = {number: profile for profile, number in PROFILES.items()}
            self.profile.append((len(self.ticks), names[signals["profile"]]))

    def starts(self, tick: int) -> Iterator[tuple[int, Tick]]:
        """The ticks up to one in which an action began."""
        for i, it in enumerate(self.ticks[: tick + 1]):
            if i == 0 or it.drive.action != self.ticks[i - 1].drive.action:
                yield i, it

    def answers(self, tick: int, times: list[int]) -> dict[str, str | None]:
        """What must be answered to questions; None where the robot cannot know. Of a meal, the end of the answer."""
        asked: dict[str, str | None] = {
            "What have you learned?": self._cells(tick, "{} blocked, turn {}", "I have learned nothing yet"),
            "How sure are you?": self._cells(
                tick, "{} blocked: turn {}, used {}", "I have learned nothing yet that I could be sure of"
            ),
            "Why did you move?": self._why(tick, lambda it: it.drive.reason != Reason.STOP),
            "Why did you turn?": self._why(tick, lambda it: it.drive.reason in TURNS),
            "Why did you turn left?": self._why(tick, lambda it: it.drive.reason in TURNS and side(it) == 1),
            "Why did you turn right?": self._why(tick, lambda it: it.drive.reason in TURNS and side(it) == 2),
            "Were you bored?": self._bored(tick),
            "When was your last meal?": self._meal(tick),
            "Did you touch anything?": self._touched(tick),
            "How often have you tried?": self._tried(tick),
            "What do you see?": self._sees(tick),
            "Who told you that?": "nobody told me anything",
            "Have you forgotten anything?": self._forgotten(tick),
            "Which behaviour are you?": f"my behaviour is {self.profile[0][1]}",
            "How is the bus?": self._bus(tick),
        }
        asked |= {f"What do you do when {PATTERNS[cell]} is blocked?": self._cell(tick, cell) for cell in range(1, 8)}
        asked |= {f"What did you do at {seconds(at)}?": self._at(at) if at <= tick else None for at in times}
        return asked

    def _changed(self, cell: int, tick: int) -> int:
        """The tick of the last change of a cell; -1 if there was none."""
        memories = [it.memory[cell] for it in self.ticks[: tick + 1]]
        return max((i for i in range(1, len(memories)) if memories[i] != memories[i - 1]), default=-1)

    def _uses(self, cell: int, tick: int) -> str:
        since = self._changed(cell, tick)
        begun = [i for i, it in self.starts(tick) if it.drive.reason == Reason.REMEMBERED and pattern(it) == cell]
        return times_of(sum(i >= since for i in begun))

    def _cells(self, tick: int, text: str, none: str) -> str:
        memory = self.ticks[tick].memory
        said = [text.format(PATTERNS[c], SIDES[memory[c]], self._uses(c, tick)) for c in range(1, 8) if memory[c]]
        return "; ".join(said) or none

    def _cell(self, tick: int, cell: int) -> str:
        turn, since = self.ticks[tick].memory[cell], self._changed(cell, tick)
        if not turn:
            return f"{PATTERNS[cell]} blocked: I do not know yet what helps"
        when = f"learned at {seconds(since)}" if since >= 0 else "known from the start"
        return f"{PATTERNS[cell]} blocked: I turn {SIDES[turn]}, {when}, used {self._uses(cell, tick)} since"

    def _why(self, tick: int, wanted: Any) -> str | None:
        begun = [i for i, it in self.starts(tick) if wanted(it)]
        return self._at(begun[-1]) if begun else None

    def _at(self, tick: int) -> str:
        """Why it did what it did in a tick: by the action that went on then."""
        _, first = [*self.starts(tick)][-1]
        it = self.ticks[tick]
        reason, beacon = Reason(it.drive.reason), it.senses["beacon"]
        name = reason.name.lower()
        if reason == Reason.TOWARD_FOOD and not beacon:
            name = "wander"
        if reason == Reason.AVOID and it.drive.left_mm_s != it.drive.right_mm_s:
            name = "look_aside"
        said = SENTENCES[name].format(
            Pattern=PATTERNS[pattern(first)].capitalize(),
            side=SIDES[side(first if reason == Reason.TRIAL else it)],
            turns=it.drive.repeat_count or "Many",
            beacon=metres(beacon),
        )
        return f"at {seconds(tick)}: {said}"

    def _bored(self, tick: int) -> str:
        begun = [i for i, it in self.starts(tick) if it.drive.reason == Reason.BOREDOM]
        now = f"now my repeat count is {self.ticks[tick].drive.repeat_count} of 10"
        if not begun:
            return f"I have not been bored; {now}"
        return f"I was bored {times_of(len(begun))}, last at {seconds(begun[-1])}; {now}"

    def _meal(self, tick: int) -> str:
        meals = [i for i, it in enumerate(self.ticks[: tick + 1]) if it.drive.eat]
        return f"my last meal was at {seconds(meals[-1])}" if meals else "I have not had a meal yet"

    def _touched(self, tick: int) -> str:
        bumps = [0, *(it.senses["bump"] for it in self.ticks[: tick + 1])]
        begun = [i for i in range(tick + 1) if bumps[i + 1] > bumps[i]]
        if not begun:
            return "I have touched nothing"
        return f"I have touched something {times_of(len(begun))}, last at {seconds(begun[-1])}"

    def _tried(self, tick: int) -> str:
        begun = [*self.starts(tick)]
        tries = [place for place, (_, it) in enumerate(begun) if it.drive.reason == Reason.TRIAL]
        if not tries:
            return "I have not tried anything yet"
        said = ""
        if tries[-1] + 1 < len(begun):
            tried, after = begun[tries[-1]][1], begun[tries[-1] + 1][1]
            helped = pattern(after).bit_count() < pattern(tried).bit_count()
            name = "helped" if helped else "useless"
            said = SENTENCES[name].format(pattern=PATTERNS[pattern(tried)], side=SIDES[side(tried)])
        return f"I have tried {times_of(len(tries))}. {said}"

    def _sees(self, tick: int) -> str:
        senses = self.ticks[tick].senses
        cell, beacon = senses["feel"] >> 1 & 7, senses["beacon"]
        way = f"{PATTERNS[cell]} blocked" if cell else "there is nothing in my way"
        food = f"I see food {metres(beacon)} m ahead" if beacon else "I see no food ahead"
        return f"{way}, and {food}"

    def _forgotten(self, tick: int) -> str:
        memories = [it.memory for it in self.ticks[: tick + 1]]
        lost = [
            (i, cell)
            for i in range(1, len(memories))
            for cell in range(1, 8)
            if memories[i - 1][cell] and not memories[i][cell]
        ]
        if not lost:
            return "I have forgotten nothing"
        said = [f"at {seconds(i)}: {SENTENCES['forgotten'].format(pattern=PATTERNS[cell])}" for i, cell in lost[-3:]]
        return f"I have forgotten something {times_of(len(lost))}: {' '.join(said)}"

    def _bus(self, tick: int) -> str | None:
        reports = [it for it in self.health if it[0] <= tick]
        if not reports:
            return None
        at, it = reports[-1]
        return (
            f"at {seconds(at)}: {it['bus_offs']} times off the bus, {it['dropped']} frames dropped, "
            f"{it['tx_errors']} errors sending and {it['rx_errors']} receiving"
        )


TURNS = (Reason.REMEMBERED, Reason.TRIAL, Reason.BOREDOM)


def pattern(it: Tick) -> int:
    return it.senses["feel"] >> 1 & 7


def side(it: Tick) -> int:
    return 1 if it.drive.left_mm_s < it.drive.right_mm_s else 2


def seconds(tick: int) -> str:
    return f"{tick // 50}.{tick % 50 * 2:02} s"


def metres(length_mm: int) -> str:
    hundredths = (length_mm + 5) // 10
    return f"{hundredths // 100}.{hundredths % 100:02}"


def times_of(count: int) -> str:
    return "once" if count == 1 else f"{count} times"


def differences(log: Path, ticks: list[int], times: list[int]) -> tuple[int, list[tuple[Any, ...]]]:
    """How many questions were asked at some ticks of a run, and those whose answers are not what the frames say.

    Args:
        log: The log of a run.
        ticks: What is asked about: not later than one of these.
        times: The ticks of which it is asked what the robot did.
    """
    trajectory, index, frames = resimulate(log).trajectory, index_log(log, 1), Frames(log)
    texts, script = texts_of("robot"), script_named("robot")
    count, found = 0, []
    for tick in ticks:
        facts = RobotFacts(trajectory, index, tick, texts).by_name()
        for question, expected in frames.answers(tick, times).items():
            said = Conversation(script, facts, texts).answer(question)
            count += 1
            if not _agrees(said, question, expected):
                found.append((log.name, tick, question, said.text, expected))
    return count, found


def _agrees(said: Said, question: str, expected: str | None) -> bool:
    if expected is None or said.mark != "log":
        return expected is None and said.mark == "words"
    if "meal" in question:
        return said.text.endswith(expected.upper())
    return said.text == expected.upper()
