"""The dialogue with a robot: commands, answers, and requested reports."""

from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass, field

from host_sim.base.errors import RefusedError, RivalError, RobotError
from host_sim.client.connection import Connection, Waiting
from host_sim.client.inbox import Inbox
from host_sim.protocol.codec import COUNTERS, DecodedFrame, Frame
from host_sim.protocol.generated import MESSAGES, Opcode, Result

_REPORT_S, _DRIVE_S, _NOISY_REPORT_S = 1.0, 0.1, 0.03
_REPORT_DEMANDS, _PROOFS = 50, 3
_JUMP = 7


@dataclass
class Dialogue:
    """Sends commands to a robot until they are answered, and waits for its reports.

    Attributes:
        connection: Carries the frames.
        inbox: Processes incoming frames.
        waiting: Waits for incoming frames.
        commands: The commands sent, each with the number of ticks before it.
    """

    connection: Connection
    inbox: Inbox
    waiting: Waiting
    commands: list[tuple[int, Frame]] = field(default_factory=list)
    _counter: int = 0

    def command(self, opcode: str, **signals: int) -> DecodedFrame:
        """Sends a command until it is answered.

        Args:
            opcode: Name of the command.
            **signals: The command's signals, by name.

        Returns:
            The answer.

        Raises:
            RefusedError: The robot refuses the command.
            RobotError: The robot does not answer.
        """
        answer = self.ask(opcode, signals, self.connection.deadline_s)
        if answer is None:
            raise self.no_answer(opcode)
        return answer

    def ask(self, opcode: str, signals: Mapping[str, int], timeout_s: float) -> DecodedFrame | None:
        """As `command`, but None if there is no answer in time.

        If the robot refuses the counter, the command is sent with another one: the robot may have counted other
        commands in an earlier, interrupted session.
        """
        answer = None
        for jump in (1, _JUMP, _JUMP):
            answer = self._ask_once(self._next(opcode, signals, jump), timeout_s)
            if answer is None or answer.signals["result"] != Result.OUT_OF_SEQUENCE:
                break
        if answer is None or answer.signals["result"] == Result.DONE:
            return answer
        if answer.signals["result"] == Result.OWNED:
            node, tick = self.inbox.protocol.node, self.inbox.tick
            raise RivalError(f"node {node} obeys another simulator (tick {tick}): end one of the two")
        assert self.inbox.last is not None
        raise RefusedError(f"the robot refused a command: {self.inbox.protocol.describe(self.inbox.last)}")

    def demand_reports(self, opcode: str) -> None:
        """Asks with `report` or `stop` until every report has come, and after a stop until the wheels rest.

        Raises:
            RobotError: The robot does not answer.
        """
        self.expect_reports(opcode)
        for attempt in range(_REPORT_DEMANDS):
            self.command(self._once_more(opcode, attempt) if attempt else opcode)
            if self.await_reports(_DRIVE_S if attempt else _REPORT_S):
                return
        missing = ", ".join(self.inbox.reports.missing) or "a DRIVE at rest"
        raise RobotError(f"after {opcode}, the robot did not send {missing}; {self.account()}")

    def _once_more(self, opcode: str, attempt: int) -> str:
        """The next request: a second stop only for a missing DRIVE at rest, since it sets the robot's check to 0."""
        told, reports = self.inbox.held_check, self.inbox.reports
        if opcode != "stop" or not told.commands:
            return opcode
        told.settle(reports.held, reports.memory)
        return opcode if reports.complete and (told.settled or attempt >= _PROOFS) else "report"

    def expect_reports(self, opcode: str) -> None:
        """Prepares for the reports that `report` or `stop` asks for."""
        self.inbox.reports.await_all()
        self.inbox.reporting, self.inbox.rested = True, opcode != "stop"

    def await_reports(self, rest_s: float = _REPORT_S) -> bool:
        """Waits for every report that was asked for. Returns False as soon as one is known to be missing.

        A whole report ends after the answer: frames before it may be the end of an older report.

        Args:
            rest_s: Time after the reports within which a stopped robot sends a DRIVE at rest, s.
        """
        reports, now = self.inbox.reports, self.connection.now
        give_up = now() + self.connection.deadline_s
        reports.await_end()
        self.inbox.silent = False
        while not (self._has_reported and reports.ended):
            usual_s = rest_s if reports.ended else _REPORT_S
            heard = self.waiting.receive(self._take_any, _NOISY_REPORT_S if self.connection.line.noisy else usual_s)
            if heard is None or self.inbox.silent or now() > give_up:
                break
            if reports.ended and not reports.complete:
                break
        self.inbox.reporting = not self._has_reported
        return self._has_reported

    @property
    def _has_reported(self) -> bool:
        return self.inbox.reports.complete and self.inbox.rested

    def await_memory(self) -> None:
        """Waits for the memory that the robot reports after a change, and requests it if it was lost.

        Raises:
            RobotError: The robot does not report it.
        """
        if self.waiting.receive(self.inbox.take_memory, _REPORT_S) is None:
            self.demand_reports("report")

    def stop_at_once(self) -> None:
        """Stops the wheels, without waiting for an answer."""
        self.inbox.session = None
        with suppress(RobotError):
            self.connection.link.send(self._next("stop", {}))

    def no_answer(self, to: str) -> RobotError:
        """The error for a request that the robot did not answer by the deadline."""
        return RobotError(f"the robot did not answer {to} within {self.connection.deadline_s:g} s; {self.account()}")

    def account(self) -> str:
        """The last frame from the robot and the state of its process, for error messages."""
        last = self.inbox.last
        said = "none" if last is None else self.inbox.protocol.describe(last)
        line = self.connection.line.account()
        return f"last frame from it: {said}{self._damaged()}; it {self.connection.status()}{line}"

    def _damaged(self) -> str:
        """The robot's last damaged frame in this tick, as the continuation of a sentence; empty if there is none."""
        protocol, frame = self.inbox.protocol, self.inbox.refused
        names = [name for name in MESSAGES if protocol.id_of(name) == frame.id]
        if self.inbox.refused_at != self.inbox.ticks or not names or protocol.decode(frame) is not None:
            return ""
        return f"; its {names[0]} came with a wrong CRC or length: {frame.id:03X}#{frame.data.hex().upper()}"

    def _next(self, opcode: str, signals: Mapping[str, int], jump: int = 1) -> Frame:
        """A command with the next counter, or with one some steps ahead."""
        self._counter = (self._counter + jump) % COUNTERS
        fixed = {"counter": self._counter, "opcode": Opcode[opcode.upper()], "owner": self.inbox.owner}
        return self.inbox.protocol.encode("COMMAND", {**fixed, **signals})

    def _ask_once(self, command: Frame, timeout_s: float) -> DecodedFrame | None:
        waiting, counts = self.waiting, self.inbox.counts
        self.inbox.asked.add(command)
        self.inbox.record(command)
        self.commands.append((self.inbox.ticks, command))
        counts.sent += 1
        began, repeated = self.connection.now(), counts.repeated
        self.connection.link.send(command)
        answer = waiting.receive_or_repeat(lambda: waiting.repeat(command), self.inbox.take_answer, timeout_s)
        if answer is not None and counts.repeated == repeated:
            waiting.round_trip.sample(self.connection.now() - began)
        return answer

    def _take_any(self, frame: Frame) -> bool:
        self.inbox.take(frame)
        return True
