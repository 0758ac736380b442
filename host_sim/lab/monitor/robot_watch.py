"""The state of one robot from its frames on a bus: messages, rates, losses, and problems."""

from collections import deque
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field

from host_sim.protocol.codec import COUNTERS
from host_sim.protocol.generated import MESSAGES, SAME_LAYOUT, Opcode

WINDOW_S = 2.0
"""Window over which rates are measured, s."""

_HEARTBEATS_MISSED_S = 3.0
_ANSWER_S = 0.5
# An ANSWER repeats its command's counter, and a command may come from any sender.
_NOT_COUNTED = ("ANSWER", "COMMAND")
_OF_TICKS = ("SENSES", "RANGES", "DRIVE")


@dataclass
class MessageWatch:
    """The received frames of one message.

    Attributes:
        frames: Number of whole frames.
        damaged: Number of frames with a wrong CRC or length.
        lost: Number of frames that are missing, by the alive counter.
        repeated: Number of repeated frames.
        signals: Signals of the last frame.
        last_s: Time of the last frame, s.
    """

    frames: int = 0
    damaged: int = 0
    lost: int = 0
    repeated: int = 0
    signals: dict[str, int] = field(default_factory=dict)
    last_s: float = 0.0
    _recent: deque[float] = field(default_factory=deque)
    _follows: bool = False

    def rate(self, now_s: float) -> float:
        """Recent rate, frames per second."""
        while self._recent and self._recent[0] <= now_s - WINDOW_S:
            self._recent.popleft()
        return len(self._recent) / WINDOW_S

    def add(self, name: str, signals: dict[str, int], now_s: float) -> None:
        """Counts a whole frame."""
        if self._follows and name not in _NOT_COUNTED:
            self._follow_counter(signals)
        self.frames += 1
        self._follows = True
        self.signals, self.last_s = signals, now_s
        self._recent.append(now_s)
        self.rate(now_s)

    def begin_anew(self) -> None:
        """Accepts any counter in the next frame."""
        self._follows = False

    def _follow_counter(self, signals: dict[str, int]) -> None:
        ahead = (signals["counter"] - self.signals["counter"]) % COUNTERS
        self.lost += max(0, ahead - 1)
        self.repeated += signals == self.signals


class RobotWatch:
    """Follows the frames from and to one robot.

    Attributes:
        node: The robot's node number.
        messages: Received frames by message.
    """

    def __init__(self, node: int, now_s: float) -> None:
        self.node = node
        self.messages = {name: MessageWatch() for name in MESSAGES}
        self._first_s = now_s
        self._faults: dict[str, int] = {}
        self._cells: dict[str, int] = {}
        self._boots = 0

    def accept(self, name: str, signals: dict[str, int] | None, now_s: float) -> None:
        """Processes a frame by the name of its message; its signals are None if it is damaged."""
        message = self.messages[name]
        if signals is None:
            message.damaged += 1
            return
        self._notice_start(name, signals, now_s)
        message.add(name, signals, now_s)
        if name == "FAULTS":
            self._faults |= {key: n for key, n in signals.items() if key not in ("crc", "counter", "page")}
        if name == "MEMORY":
            self._cells |= {key: n for key, n in signals.items() if key.startswith("cell_")}

    def _notice_start(self, name: str, signals: dict[str, int], now_s: float) -> None:
        """Accepts restarted counters: after a start in SENSES, RANGES and DRIVE, after a boot in all messages."""
        if name == "COMMAND" and signals["opcode"] == Opcode.START:
            self._begin_anew(_OF_TICKS)
        if name == "BOOT" and not self._reports(now_s):
            self._boots += 1
            self._begin_anew(self.messages)

    def _reports(self, now_s: float) -> bool:
        """Whether it is answering a command, which may request all reports."""
        answer = self.messages["ANSWER"]
        return answer.frames > 0 and now_s - answer.last_s < _ANSWER_S

    def _begin_anew(self, names: Iterable[str]) -> None:
        for name in names:
            self.messages[name].begin_anew()

    @property
    def memory(self) -> list[int]:
        """The cells of its memory received so far."""
        return [number for _, number in sorted(self._cells.items())]

    def said(self, name: str, signal: str) -> int | None:
        """The last received value of a signal; None if it was never received."""
        return self.messages[name].signals.get(signal)

    def total(self, count: str) -> int:
        """The sum of a count (`frames`, `damaged`, `lost`, `repeated`) over all messages."""
        return sum(getattr(message, count) for message in self.messages.values())

    def wrong(self, now_s: float) -> list[str]:
        """The current problems, each in a few words that stay the same while it lasts."""
        return [*self._wrong_on_the_bus(now_s), *self._wrong_in_the_robot()]

    def _wrong_on_the_bus(self, now_s: float) -> Iterator[str]:
        heartbeat, senses, drive = (self.messages[name] for name in ("HEARTBEAT", "SENSES", "DRIVE"))
        since_s = now_s - (heartbeat.last_s if heartbeat.frames else self._first_s)
        if since_s > _HEARTBEATS_MISSED_S:
            yield "no heartbeat"
        if senses.last_s > drive.last_s and now_s - max(drive.last_s, self._first_s) > _ANSWER_S:
            yield "does not answer its SENSES"
        if heartbeat.frames and self.said("HEARTBEAT", "layout") not in SAME_LAYOUT:
            yield f"another octet.dbc (layout {self.said('HEARTBEAT', 'layout'):04X})"
        owner, sender = self.said("HEARTBEAT", "owner"), self.said("COMMAND", "owner")
        if owner and sender and owner != sender:
            yield f"commands of {sender}, but its owner is {owner}"
        for name, message in self.messages.items():
            if message.damaged:
                yield f"damaged {name} frames"
            if message.lost:
                yield f"lost {name} frames"

    def _wrong_in_the_robot(self) -> Iterator[str]:
        running = self.said("HEARTBEAT", "state")
        if running and self.said("HEARTBEAT", "silent"):
            yield "runs, and hears no senses"
        if self._boots:
            yield f"restarted {self._boots} times" if self._boots > 1 else "restarted"
        choices = {signal.name: signal.choices for signal in MESSAGES["HEALTH"].signals}
        if state := self.said("HEALTH", "bus_state"):
            yield f"its CAN controller is {choices['bus_state'].get(state, state)}"
        if self.said("HEALTH", "clock") == 0:
            yield "its clock is inexact"
        if self.messages["CRASH"].frames:
            yield "has crashed since power-up"
        for name, number in self._faults.items():
            if number:
                yield f"counts faults: {name}"
