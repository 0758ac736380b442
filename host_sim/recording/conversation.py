"""Checks a log against the protocol alone, for any firmware: each request must have its answer."""

from dataclasses import dataclass, field

from host_sim.client.session import HeldCheck
from host_sim.protocol.codec import DecodedFrame, Frame, Protocol, counter_of, node_of
from host_sim.protocol.generated import Reason, Result
from host_sim.recording.log_reader import LogReader, check_protocol


@dataclass
class Conversation:
    """One robot's exchange in a log.

    Attributes:
        commands: Number of commands that were answered.
        drives: Number of senses that were answered.
        problems: Violations of the protocol, each with its time, as sentences without a full stop.
    """

    commands: int = 0
    drives: int = 0
    problems: list[str] = field(default_factory=list)


def check_conversation(log: LogReader, protocol: Protocol) -> Conversation:
    """Checks one robot's part of a log.

    Raises:
        UsageError: The log has no heartbeat of this node, or was recorded with another layout of the messages.
    """
    check_protocol(log, protocol)
    check = _Check(protocol)
    for line in log:
        if node_of(line.frame.id) == protocol.node:
            check.time_s = line.time_us / 1e6
            check.hear(line.frame)
    return check.found


class _Check:
    def __init__(self, protocol: Protocol) -> None:
        self.time_s, self.found = 0.0, Conversation()
        self._protocol, self._held_check = protocol, HeldCheck()
        self._command: Frame | None = None
        self._senses: Frame | None = None
        self._lockstep = False

    def hear(self, frame: Frame) -> None:
        decoded = self._protocol.decode(frame)
        if decoded is None:
            self._complain(f"a frame is damaged or of a wrong length: {self._protocol.describe(frame)}")
        elif decoded.name == "COMMAND":
            self._ask(frame, decoded)
        elif decoded.name == "SENSES":
            self._sense(frame)
        elif decoded.name == "ANSWER":
            self._answer(frame, decoded)
        elif decoded.name == "DRIVE":
            self._drive(frame, decoded)
        elif decoded.name == "HEALTH" and not self._is_held(decoded.signals["held"]):
            self._complain("HEALTH holds something else than the commands and senses that were answered")

    def _is_held(self, held: int) -> bool:
        """Whether the robot holds the commands sent; true if unknown: without an owner, or during a command."""
        if not self._held_check.owned or self._command is not None:
            return True
        if self._held_check.heard and held == self._held_check.commands & 0xFFFF:
            self._held_check.takes_senses = False  # a robot that senses for itself
        return self._held_check.agrees(held, ())

    def _ask(self, frame: Frame, decoded: DecodedFrame) -> None:
        if self._command not in (None, frame):
            self._complain("a command was not answered")
        self._command = frame
        self._lockstep = bool(decoded.signals.get("lockstep", self._lockstep))

    def _answer(self, frame: Frame, decoded: DecodedFrame) -> None:
        asked = self._command
        if asked is None:
            return  # a repetition
        if asked.data[1] != frame.data[1] and decoded.signals["result"] == Result.DONE:
            self._complain("an answer has another counter or opcode than its command")
        if decoded.signals["result"] == Result.DONE:
            self._held_check.carry_out(asked, decoded)
        self._command, self.found.commands = None, self.found.commands + 1

    def _sense(self, frame: Frame) -> None:
        if self._lockstep and self._senses not in (None, frame):
            self._complain("senses were not answered in lockstep")
        self._senses = frame
        self._held_check.ask(frame if self._lockstep else None)

    def _drive(self, frame: Frame, decoded: DecodedFrame) -> None:
        if self._senses is None or decoded.signals["reason"] in (Reason.STOP, Reason.SILENCE):
            return
        senses = self._protocol.decode(self._senses)
        assert senses is not None
        is_same_tick = decoded.signals["tick"] == senses.signals["tick"]
        is_answer = is_same_tick and counter_of(frame) == counter_of(self._senses)
        if self._lockstep and not is_answer:
            self._complain("a drive has another tick or counter than its senses")
        if is_answer:
            self._held_check.take_drive(frame)
        if is_answer or self._lockstep:
            self._senses, self.found.drives = None, self.found.drives + is_answer

    def _complain(self, what: str) -> None:
        self.found.problems.append(f"at {self.time_s:.2f} s {what}")
