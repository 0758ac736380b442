"""A robot's starts and health reports in a log, and the line of the log for each tick."""

from array import array
from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path

from host_sim.protocol.codec import Frame, Protocol
from host_sim.protocol.generated import PROFILES

_PROFILES = {number: name for name, number in PROFILES.items()}


@dataclass
class LogIndex:
    """An index of one robot's frames.

    Attributes:
        lines: For each tick, the line (or frame number) of its SENSES, from 1.
        starts: For each start of the robot, the tick that follows it, and the behaviour.
        health: For each HEALTH frame, its tick and its signals.
    """

    lines: "array[int]" = field(default_factory=lambda: array("L"))
    starts: list[tuple[int, str]] = field(default_factory=list)
    health: list[tuple[int, dict[str, int]]] = field(default_factory=list)

    def lines_of(self, ticks: Iterable[int]) -> list[int]:
        """The log lines of ticks; ticks that are not in the log are left out."""
        return [self.lines[tick] for tick in ticks if tick < len(self.lines)]


def index_log(path: Path, node: int) -> LogIndex:
    """Indexes a log. A repeated SENSES belongs to the same tick.

    Raises:
        UsageError: The log cannot be read, or is damaged.
    """
    from host_sim.recording.log_files import frames_in  # noqa: PLC0415 - pages are written without reading a log
    from host_sim.recording.log_text import Recorded  # noqa: PLC0415

    protocol, index = Protocol(node), LogIndex()
    wanted = {protocol.id_of(name): name for name in ("SENSES", "COMMAND", "HEALTH")}
    senses: Frame | None = None
    for line, (_, it) in enumerate(frames_in(path), 1):
        if not isinstance(it, Recorded) or it.frame.id not in wanted:
            continue
        if wanted[it.frame.id] == "SENSES":
            if it.frame != senses:
                senses = it.frame
                index.lines.append(line)
        elif (message := protocol.decode(it.frame)) and message.name == "HEALTH":
            index.health.append((max(0, len(index.lines) - 1), message.signals))
        elif message and message.signals.get("profile") in _PROFILES:
            index.starts.append((len(index.lines), _PROFILES[message.signals["profile"]]))
    return index
