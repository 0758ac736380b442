"""The frames that one robot received in a log, as the input file of `octet-debug`."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

from host_sim.base.errors import UsageError
from host_sim.protocol.codec import MEMORY_IDS, Frame, Protocol, node_of
from host_sim.recording.log_reader import LogReader, Recorded, check_protocol, first_memory
from host_sim.recording.replay import Comparison

if TYPE_CHECKING:
    from host_sim.sim.own_brain import OwnBrain

_SLACK_US = 1
_OUTAGE = "0 - -"


@dataclass
class Heard:
    """A frame that the robot received.

    Attributes:
        tick: Number of the tick that it belongs to, or of the next one, as on the page.
        time_us: Its time in the log, us.
        frame: The frame; None is an outage.
        drive: For SENSES: the DRIVE with which the robot answered, if any.
    """

    tick: int
    time_us: int
    frame: Frame | None
    drive: Frame | None = None

    def __str__(self) -> str:
        """A line for `octet-debug`."""
        if self.frame is None:
            return f"{self.tick} {self.time_us // 1000} {_OUTAGE}"
        drive = self.drive.data.hex() if self.drive else "-"
        return f"{self.tick} {self.time_us // 1000} {self.frame.id:x} {self.frame.data.hex()} {drive}"


class Feed:
    """The frames that one robot heard, in order.

    The log of a run in real time does not say which senses the robot received; as in `replay`, those are taken that
    explain its drives.

    Attributes:
        heard: The frames.
        senses: The SENSES among them.
    """

    def __init__(self, log: LogReader, protocol: Protocol, own: "OwnBrain | None" = None) -> None:
        """Reads the log of a robot, which may have had a behaviour of its user.

        Raises:
            UsageError: The log is of another protocol, or has no tick of this node.
        """
        check_protocol(log, protocol)
        self._log, self._protocol, self._own = log, protocol, own
        self._senses_id, self._drive_id = protocol.id_of("SENSES"), protocol.id_of("DRIVE")
        self.heard = self._read()
        self.senses = [it for it in self.heard if it.frame is not None and it.frame.id == self._senses_id]
        if not self.senses:
            raise UsageError(f"{log.path} has no tick of node {protocol.node}")

    def text(self) -> str:
        """The file for `octet-debug`."""
        first = f"{self._protocol.node} {first_memory(self._log, self._protocol).hex()}"
        return "\n".join([first, *map(str, self.heard)]) + "\n"

    def tick_at(self, time_s: float) -> int:
        """The last tick that has begun at this time of the log."""
        return max((it.tick for it in self.senses if it.time_us <= time_s * 1e6 + _SLACK_US), default=0)

    def tick_of_decision(self, number: int) -> int:
        """The tick in which the robot begins its n-th action, counted from 1.

        Raises:
            UsageError: It begins fewer.
        """
        count, last = 0, 0
        for it in self.senses:
            drive = self._protocol.decode_drive(it.drive) if it.drive else None
            if drive and drive.action != last:
                count, last = count + 1, drive.action
            if count == number:
                return it.tick
        raise UsageError(f"{self._log.path} has {count} decisions of node {self._protocol.node}, not {number}")

    def _read(self) -> list[Heard]:
        node = self._protocol.node
        lines = [it for it in self._log if (node_of(it.frame.id) == node) != (it.frame.id in MEMORY_IDS)]
        if any(self._is_real_time(line.frame) for line in lines):
            return self._read_real_time(lines)
        return list(self._ticks(lines))

    def _is_real_time(self, frame: Frame) -> bool:
        command = self._protocol.decode(frame) if frame.id == self._protocol.id_of("COMMAND") else None
        return command is not None and command.signals.get("lockstep") == 0

    def _ticks(self, lines: Iterable[Recorded]) -> Iterator[Heard]:
        """Numbers the ticks. DRIVE and SENSES of a tick have the same number there."""
        tick, last = 0, Heard(0, 0, None)
        asked: dict[int, Heard] = {}
        for time_us, frame in lines:
            if frame.id == self._drive_id:
                answered = asked.get(self._number(frame), last)
                answered.drive = answered.drive or frame
            elif frame.id in MEMORY_IDS or frame.id in self._protocol.ids_from("SIM"):
                again = frame == last.frame
                entry = Heard(last.tick if again else tick, time_us, frame)
                if frame.id == self._senses_id and not again:
                    last = asked[self._number(frame)] = entry
                    tick += 1
                yield entry

    def _number(self, frame: Frame) -> int:
        """The number of the tick in a SENSES or DRIVE frame; -1 if it is damaged."""
        decoded = self._protocol.decode(frame)
        return decoded.signals["tick"] if decoded else -1

    def _read_real_time(self, lines: list[Recorded]) -> list[Heard]:
        numbered = {id(it.frame): it for it in self._ticks(lines)}
        hearing, heard = _Hearing(self._log, self._protocol, self._own), [Heard(0, 0, None)]
        for frame in hearing.follow(lines):
            last = heard[-1]
            heard.append(Heard(last.tick, last.time_us, None) if frame is None else numbered[id(frame)])
        return heard[1:]


class _Hearing(Comparison):
    """Records the frames that the firmware receives."""

    def follow(self, lines: Iterable[Recorded]) -> list[Frame | None]:
        """The frames that the robot heard, up to the first difference, and all that were sent to it after that."""
        self._received: list[Frame | None] = []
        for time_us, frame in lines:
            if frame.id in MEMORY_IDS:
                self.feed(frame)
            else:
                self.accept(Recorded(time_us, frame))
        return self._received + self.heard()

    def feed(self, frame: Frame) -> None:
        """As in `Comparison`."""
        if self._lockstep:
            self._received += [*self.heard(), frame]
        super().feed(frame)
