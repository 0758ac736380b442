"""A robot's latest reports: memory, state, identity and faults; their alive counters tell new ones from old ones."""

from collections import defaultdict
from collections.abc import Collection
from enum import Enum, auto

from host_sim.protocol.codec import COUNTERS, DecodedFrame, Frame, MemoryReport, counter_of
from host_sim.protocol.generated import CELL_COUNT
from host_sim.world.memory_kinds import kinds_of

REPORTS = frozenset({"EMERGENCY", "MEMORY", "HEARTBEAT", "BOOT", "FAULTS", "CRASH", "HEALTH"})
"""The messages, other than DRIVE, that a robot sends without a request."""

FIRST_HALF, LAST_HALF = "MEMORY 0", "MEMORY 1"
"""The kinds of reports that carry a memory."""

_WHOLE = frozenset({"HEARTBEAT", "BOOT", "MEMORY", "FAULTS 0", "FAULTS 1", "HEALTH"})
_NOT_FAULTS = ("crc", "counter", "page")
_AHEAD_MAX = COUNTERS // 2
_GAP_MIN = _AHEAD_MAX + 1
"""After this many lost messages, a new one looks like a late one."""


class Arrival(Enum):
    """Classification of a message, compared with the last one of its kind."""

    NEW = auto()
    """The next message, or one of the few after it."""
    AGAIN = auto()
    """The last message again, byte for byte."""
    LATE = auto()
    """An earlier message."""
    OTHER = auto()
    """The last message's counter with other content: from a restarted or another sender."""
    ELSEWHERE = auto()
    """The second of two consecutive messages that do not follow the last one: late, or from another sender."""


class Freshness:
    """Follows the alive counter of one kind of message.

    Attributes:
        last: The last message; None before the first.
    """

    def __init__(self) -> None:
        """Accepts any message as new."""
        self.last: Frame | None = None
        self._late: Frame | None = None
        self._missing = 0

    def judge(self, frame: Frame, missing: int = 0) -> Arrival:
        """Compares a message with those before it.

        Args:
            frame: The message.
            missing: Number of frames so far that are known to be lost. Where they explain a jump of the counter,
                the message is new.
        """
        if frame == self.last:
            return Arrival.AGAIN
        ahead = 1 if self.last is None else _ahead(self.last, frame)
        gap = missing - self._missing >= _GAP_MIN
        arrival = Arrival.NEW if ahead else Arrival.OTHER
        if ahead > _AHEAD_MAX:
            late, self._late = self._late, frame
            if late is None or not 1 <= _ahead(late, frame) <= (_AHEAD_MAX if gap else 1):
                return Arrival.LATE
            arrival = Arrival.ELSEWHERE
        self.go_on(frame, missing)
        return Arrival.NEW if gap else arrival

    def go_on(self, frame: Frame, missing: int) -> None:
        """Accepts a message as the next one."""
        self.last, self._late, self._missing = frame, None, missing


def _ahead(before: Frame, after: Frame) -> int:
    return (counter_of(after) - counter_of(before)) % COUNTERS


class RobotReports:
    """The last reports of one robot.

    Attributes:
        memory: The eight cells.
        faults: The robot's fault counters, by name; each stays at 255.
        faults_before: Previously reported value of each counter.
        heartbeat: The signals of its HEARTBEAT; empty before the first.
        boot: The signals of its BOOT, which names the firmware; empty before the first.
        held: HEALTH's checksum of the commands that the robot has carried out, and of the senses that it has obeyed.
        memories: Number of whole memories so far.
        ended: Whether the last frame of a whole report has arrived since `await_end`.
        gap: Number of memories that were lost on the way before the first one since this was last set to None.
    """

    def __init__(self) -> None:
        """Starts without any report."""
        self.memory: tuple[int, ...] = (0,) * CELL_COUNT
        self.faults: dict[str, int] = {}
        self.faults_before: dict[str, int] = {}
        self.heartbeat: dict[str, int] = {}
        self.boot: dict[str, int] = {}
        self.held = 0
        self.memories = 0
        self.gap: int | None = None
        self.forget()

    def forget(self) -> None:
        """Restarts the alive counters; the reports are kept."""
        self._fresh: defaultdict[str, Freshness] = defaultdict(Freshness)
        self._joined = MemoryReport()
        self._memory_counter: int | None = None
        self.await_all()

    def await_all(self) -> None:
        """From now on, `complete` waits for each report."""
        self._heard: set[str] = set()
        self.await_end()

    def await_end(self) -> None:
        """From now on, `ended` waits for the last report."""
        self.ended = False

    @property
    def missing(self) -> list[str]:
        """Kinds of reports that have not arrived since `await_all`."""
        return sorted(_WHOLE - self._heard)

    @property
    def complete(self) -> bool:
        """Whether every report has arrived since `await_all`."""
        return not self.missing

    def is_awaited(self, decoded: DecodedFrame) -> bool:
        """Whether this is a report that has not arrived since `await_all`."""
        return _kind(decoded) in _WHOLE - self._heard

    def judge(self, frame: Frame, decoded: DecodedFrame, missing: int) -> Arrival:
        """Compares a report with those of its kind before it.

        Args:
            frame: The report.
            decoded: The decoded report.
            missing: As in `Freshness.judge`.
        """
        return self._fresh[_kind(decoded)].judge(frame, missing)

    def last_of(self, names: Collection[str]) -> list[tuple[str, Frame]]:
        """Each received kind of report with one of these names, and the last report of that kind."""
        kinds = self._fresh.items()
        return [(kind, fresh.last) for kind, fresh in kinds if kind.split()[0] in names and fresh.last is not None]

    @property
    def memory_is_last(self) -> bool:
        """Whether the last two halves of a memory form a valid memory."""
        halves = self.last_of({"MEMORY"})
        return bool(halves) and all(counter_of(half) == self._memory_counter for _, half in halves)

    def go_on(self, kind: str, frame: Frame, missing: int) -> None:
        """Notes a report with the same content as the last one of its kind; none were lost between them.

        Args:
            kind: The kind, as in `last_of`.
            frame: The report.
            missing: As in `Freshness.judge`.
        """
        self._fresh[kind].go_on(frame, missing)
        if kind == LAST_HALF:
            self.gap = self.gap or 0
            self._memory_counter = counter_of(frame)

    def take(self, decoded: DecodedFrame) -> bool:
        """Stores a report.

        Returns:
            False if it is the second half of an invalid memory, which is not stored.
        """
        if decoded.name == "MEMORY":
            return self._take_memory(decoded)
        if decoded.name == "FAULTS":
            counts = {name: count for name, count in decoded.signals.items() if name not in _NOT_FAULTS}
            self.faults_before |= {name: self.faults.get(name, 0) for name in counts}
            self.faults |= counts
        elif decoded.name == "HEARTBEAT":
            self.heartbeat = decoded.signals
        elif decoded.name == "BOOT":
            self.boot = decoded.signals
        elif decoded.name == "HEALTH":
            self.held = decoded.signals["held"]
        self._heard.add(_kind(decoded))
        self.ended = self.ended or decoded.name == "HEALTH"
        return True

    def _take_memory(self, decoded: DecodedFrame) -> bool:
        memory, counter = self._joined.join(decoded), decoded.signals["counter"]
        if memory is None:
            return True
        if not kinds_of(memory):
            return False
        if self.gap is None:
            self.gap = 0 if self._memory_counter is None else (counter - self._memory_counter - 1) % COUNTERS
        self.memory, self._memory_counter = memory, counter
        self.memories += 1
        self._heard.add("MEMORY")
        return True


def _kind(decoded: DecodedFrame) -> str:
    """The message's name, with the part number if it has several parts."""
    part = decoded.signals.get("half", decoded.signals.get("page"))
    return decoded.name if part is None else f"{decoded.name} {part}"
