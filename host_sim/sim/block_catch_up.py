"""Connects the tick loop in C with each robot, and brings its client up to date with the ticks of a block."""

import os
import sys
import time
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple, Protocol

from host_sim.client.inbox import is_as_started
from host_sim.client.robot_client import RobotClient
from host_sim.client.robot_reports import FIRST_HALF
from host_sim.protocol.codec import MEMORY_IDS, Frame
from host_sim.sim.in_process_link import InProcessLink, RelayedLink
from host_sim.transport.link import FrameSocket, SocketLink


@dataclass(frozen=True)
class Ticks:
    """Ticks that a robot has answered elsewhere.

    Attributes:
        count: Number of ticks.
        drive: The last DRIVE.
        heard: The check over the senses after each of the last of these ticks, at least one.
    """

    count: int
    drive: Frame
    heard: Sequence[int]


def take_ticks(client: RobotClient, ticks: Ticks) -> None:
    """Takes over ticks, but not the robot's reports in them."""
    drive = client.protocol.decode_drive(ticks.drive)
    assert drive is not None
    client.inbox.catch_up(ticks.count, drive, ticks.drive)
    client.inbox.held_check.go_on(*ticks.heard, drive=ticks.drive)
    client.frames.sent += ticks.count


def take_last_reports(client: RobotClient, reports: Sequence[Frame]) -> None:
    """Takes over the reports of the last of these ticks, in order; earlier reports are not passed on."""
    client.reports.forget()
    if reports:
        client.unsettled = None
    for frame in reports:
        decoded = client.protocol.decode(frame)
        if decoded is not None:
            client.reports.judge(frame, decoded, client.frames.missing)
            client.reports.take(decoded)


def routine_reports(client: RobotClient) -> list[tuple[str, Frame]]:
    """The last report of each kind whose repetition with the next counter needs no further handling."""
    heartbeat = client.reports.heartbeat
    names = {"FAULTS", "HEALTH"}
    if client.reports.memory_is_last:
        names.add("MEMORY")
    is_ours = heartbeat.get("state") and not heartbeat["silent"] and heartbeat["owner"] in (0, client.inbox.owner)
    if is_ours and is_as_started(client.inbox):
        names.add("HEARTBEAT")
    return client.reports.last_of(names)


def take_routine_reports(client: RobotClient, reports: Sequence[tuple[str, Frame]]) -> None:
    """Takes over routine reports that came with the next counters; of several of a kind, the last is enough."""
    for kind, frame in reports:
        client.reports.go_on(kind, frame, client.frames.missing)
        client.inbox.last = frame
        is_last = frame is reports[-1][1]
        if kind == "HEARTBEAT" or (kind == FIRST_HALF and is_last):  # the other half of a memory is still to come
            decoded = client.protocol.decode(frame)
            assert decoded is not None
            client.reports.take(decoded)


WAIT_MS = 5
"""Time for which C code waits for a frame over a link, ms; Python handles longer waits."""

_TIMED_EVERY = 4096
"""One in this many ticks over a link is left to Python, which measures the answer time."""

_BLOCK_S, _FIRST_TICKS = 0.05, 64
"""Longest time of a block over a link, s of wall-clock time, since people can interfere only between blocks; and the
length of the first block, ticks, which is a guess.
"""

_LENGTH = 8
_ID_MAX = 0x7FF
_NO_FRAME = Frame(-1, b"")


class Native(NamedTuple):
    """The C side of a robot.

    Attributes:
        ffi: The declarations.
        library: The functions.
        loop: The `struct loop *`.
        robot: The robot's `struct loop_robot`.
    """

    ffi: Any
    library: Any
    loop: Any
    robot: Any


class LoopRobot(Protocol):
    """One robot of the loop."""

    def prepare(self) -> int:
        """Takes over all changes since the last block. Returns the number of ticks for which the loop may run."""

    def catch_up(self, ticks: int) -> None:
        """Updates the client with a block.

        Args:
            ticks: Number of ticks that the robot has answered, including a tick that was handed over.
        """

    def go_on(self) -> None:
        """Lets the client continue the tick that was handed over: this robot's answer comes next.

        Raises:
            RobotError: The answer can no longer arrive.
        """


class RobotInProcess:
    """A robot in this process."""

    def __init__(self, native: Native, client: RobotClient, link: InProcessLink) -> None:
        """Lets C code call the robot."""
        self._native, self._client, self._link = native, client, link
        self._sent = -1
        self._waiting: Any = None  # referenced by C code, so Python must not free it
        ffi, loop, pointers = native.ffi, native.loop, link.pointers
        native.robot.octet = ffi.cast("struct octet *", pointers.octet)
        loop.exchange = ffi.cast(ffi.typeof(loop.exchange), pointers.exchange)
        loop.answers = ffi.cast(ffi.typeof(loop.answers), pointers.answers)

    def prepare(self) -> int:
        """As in `LoopRobot`. After a command, even an old report may be news."""
        robot = self._native.robot
        self._link.hear_others()
        if self._client.frames.sent != self._sent:
            robot.known_count = 0
        if waiting := self._link.taken():
            self._waiting = robot.waiting = self._native.ffi.new("struct frame[]", [*map(_to_c, waiting)])
            robot.waiting_count = len(waiting)
        return sys.maxsize

    def catch_up(self, ticks: int) -> None:
        """As in `LoopRobot`."""
        robot, client = self._native.robot, self._client
        if not ticks:
            return
        take_ticks(client, Ticks(ticks, _frame(robot.drive), _heard(self._native, ticks)))
        client.frames.received += robot.received
        client.frames.refused += robot.refused
        take_last_reports(client, [_frame(report) for report in robot.reports[0 : robot.report_count]])
        self._sent = client.frames.sent

    def go_on(self) -> None:
        """As in `LoopRobot`: the answer is received again. The robot answers at once or not at all."""
        robot = self._native.robot
        if not robot.answer_count:
            raise self._client.dialogue.no_answer(f"tick {self._native.loop.tick}")
        waiting = [_frame(frame) for frame in robot.waiting[0 : robot.waiting_count]] if robot.waiting_count else []
        robot.waiting_count = 0
        self._link.put_back(waiting, robot.answer_count)


class RobotBehindLink:
    """A robot whose frames C code sends and receives itself, over the socket of a link."""

    def __init__(self, native: Native, client: RobotClient, link: SocketLink) -> None:
        """Takes a link whose socket may still close and reopen."""
        self._native, self._client, self._link = native, client, link
        self._socket: FrameSocket | None = None
        self._opened: Any = None  # referenced by C code, so Python must not free it
        self._kinds: list[str] = []  # kinds of the reports known to C code
        self._counts: tuple[int, ...] = ()
        self._began_s, self._ticks_max = 0.0, _FIRST_TICKS
        native.loop.take_turns = native.library.turns_over_links
        native.loop.wait_ms = WAIT_MS

    def prepare(self) -> int:
        """As in `LoopRobot`. Returns 0 ticks if the robot or its line needs special handling."""
        client, socket = self._client, self._link.frame_socket()
        session = client.inbox.session
        if socket is None or session is None or not client.round_trip.is_sure:
            return 0
        if socket is not self._socket and not self._open(socket):
            return 0
        if self._count() != self._counts:
            self._know_reports()
        self._began_s = time.perf_counter()
        return min(self._ticks_max, -(client.inbox.ticks + 1) % _TIMED_EVERY)

    def catch_up(self, ticks: int) -> None:
        """As in `LoopRobot`."""
        robot, client = self._native.robot, self._client
        if ticks:
            self._ticks_max = max(1, int(_BLOCK_S * ticks / (time.perf_counter() - self._began_s)))
        told = self._native.ffi.unpack(robot.told, len(self._kinds)) if self._kinds else []
        in_order = sorted((when, i) for i, when in enumerate(told) if when)
        take_routine_reports(client, [(self._kinds[i], _frame(robot.known[i])) for _, i in in_order])
        client.frames.received += robot.received
        if ticks:
            take_ticks(client, Ticks(ticks, _frame(robot.drive), _heard(self._native, ticks)))
        self._counts = self._count()

    def go_on(self) -> None:
        """As in `LoopRobot`: the frame in hand is received again."""
        loop, library, socket = self._native.loop, self._native.library, self._socket
        assert socket is not None
        if loop.received == 1:
            frame = loop.in_hand
            socket.put_back(_frame(frame) if frame.id <= _ID_MAX else _NO_FRAME)
        socket.garbled += loop.received == library.LINK_E_GARBLED
        loop.received = 0  # it was this robot's

    def _open(self, socket: FrameSocket) -> bool:
        """Lets C code use another socket, if a file descriptor is free for it."""
        ffi, library = self._native.ffi, self._native.library
        try:
            number = os.dup(socket.fileno())
        except OSError:
            return False
        link = ffi.new("struct link **")
        if library.link_open(link, b"fd:%d" % number, ffi.NULL, 0) != 0:
            os.close(number)
            return False
        self._opened = self._native.robot.link = ffi.gc(link[0], library.link_close)
        self._socket, socket.closing = socket, self._close
        return True

    def _close(self) -> None:
        """Ends the use of the socket, and closes its file descriptor."""
        assert self._socket is not None
        self._socket.closing = lambda: None
        self._native.ffi.release(self._opened)
        self._socket = None

    def _know_reports(self) -> None:
        """Tells the loop the known reports, except those that other robots must hear, which Python relays."""
        robot, reports = self._native.robot, routine_reports(self._client)
        if isinstance(self._link, RelayedLink):
            reports = [(kind, frame) for kind, frame in reports if frame.id not in MEMORY_IDS]
        self._kinds = [kind for kind, _ in reports]
        robot.known_count = len(reports)
        for i, (_, frame) in enumerate(reports):
            robot.known[i] = _to_c(frame)

    def _count(self) -> tuple[int, ...]:
        """Counters that change with each frame that the client processes."""
        frames = self._client.frames
        return frames.sent, frames.received, frames.refused


def _heard(native: Native, ticks: int) -> list[int]:
    """The checks over the senses after the last of these ticks."""
    robot, kept = native.robot, native.library.LOOP_HEARD
    last = range(robot.heard_count - min(ticks, kept), robot.heard_count)
    return [robot.heard[i % kept] for i in last]


def _to_c(frame: Frame) -> tuple[int, int, bytes]:
    return frame.id, len(frame.data), frame.data.ljust(_LENGTH, b"\0")


def _frame(frame: Any) -> Frame:
    return Frame(frame.id, bytes(frame.data[0 : frame.len]))
