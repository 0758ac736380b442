"""The tick loop in C (`native/`) for robots in this process: a block of ticks a call, with the same frames."""

from collections.abc import Sequence
from dataclasses import asdict
from functools import cache
from typing import Any, NamedTuple

from host_sim.client.frame_log import FrameLog
from host_sim.client.robot_client import RobotClient
from host_sim.paths import BUILD, ROOT
from host_sim.protocol.codec import Frame
from host_sim.robot_io import Drive, Senses
from host_sim.transport.in_process_link import InProcessLink
from host_sim.world import native_world
from host_sim.world.arena import Arena
from host_sim.world.body_faults import SOUND
from host_sim.world.native_library import load_native
from host_sim.world.native_world import NativeWorld
from host_sim.world.params import SimParams

LIBRARY = BUILD / "host" / "host_sim" / "sim" / "native" / "liboctet_loop.so"
_NATIVE = ROOT / "host_sim" / "sim" / "native"
HEADERS = (ROOT / "hal" / "link" / "link.h", *native_world.HEADERS, _NATIVE / "log_lines.h", _NATIVE / "loop.h")

BLOCK_TICKS = 256
"""Maximum number of ticks in a block."""

_LINES_A_TICK = 3
_LENGTH = 8
_SENSES_END = len(Senses._fields)
_REASON = _SENSES_END + Drive._fields.index("reason")
_DRIVE_END = _SENSES_END + len(Drive._fields)


class RobotBlock(NamedTuple):
    """One robot's part of a block.

    Attributes:
        rows: 16-bit numbers, tick after tick: the fields of `Senses` and `Drive`, the pattern when the current action
            was decided, whether the robot is lifted, and 0.
        poses: Doubles, tick after tick: x and y in mm and heading in rad, after the tick.
        decisions: The ticks, counted from the block's first, in which a remembered turn or a trial began, or an
            action after a trial.
        memory: The robot's eight cells before the block.
    """

    rows: Any
    poses: Any
    decisions: Sequence[int]
    memory: tuple[int, ...]


class NativeLoop:
    """The robots of a run, and buffers for a block of their ticks."""

    def __init__(self, clients: Sequence[RobotClient], links: Sequence[InProcessLink], log: FrameLog) -> None:
        """Finds the robots.

        Args:
            clients: The robots' clients.
            links: Their links.
            log: Records every frame.

        Raises:
            NoNativeError: The library cannot be used.
        """
        self._ffi, self._library = _loaded()
        self._clients, self._links, self._log = clients, links, log
        self._faults = [SOUND] * len(clients)
        self._sent, self._memories = [-1] * len(clients), [client.memory for client in clients]
        self._kept: list[Any] = []  # what C code points to, and Python must not free
        self._waiting: dict[int, Any] = {}
        self._text: Any = None
        self._robots: Any = self._ffi.new("struct loop_robot[]", len(clients))
        self._loop: Any = self._ffi.new("struct loop *")
        self._loop.robots, self._loop.robot_count = self._robots, len(clients)
        for robot, client, link in zip(self._robots, clients, links, strict=True):
            self._bind(robot, client, link)
        self._world: NativeWorld

    def enter(self, arena: Arena, params: SimParams, plain: bool = False) -> None:
        """Puts the robots into another arena.

        Args:
            arena: The arena.
            params: The dimensions of the world.
            plain: Whether to use plain geometry, which is faster, rather than pymunk's physics.

        Raises:
            NoNativeError: pymunk's functions cannot be called from C.
        """
        self._world = NativeWorld(self._ffi, self._library, arena, params, plain)
        self._loop.world = self._world.world
        for robot in self._robots:
            robot.begun, robot.food_eaten = [0] * self._library.LOOP_REASONS, 0

    def run(self, tick: int, ticks_max: int) -> int:
        """Runs a block of ticks; it ends after a tick in which food was eaten or a robot reported something new.

        Args:
            tick: Number of the first tick.
            ticks_max: Maximum number of ticks.

        Returns:
            The number of ticks that ran, at least 1.

        Raises:
            RobotError: A robot does not answer.
        """
        self._loop.tick = tick
        for index, client in enumerate(self._clients):
            self._look_up(index, client)
        if self._log.keeps:
            self._make_room(sum(robot.waiting_count for robot in self._robots))
        self._world.borrow()
        try:
            self._library.loop_run(self._loop, min(ticks_max, BLOCK_TICKS))
        finally:
            self._world.give_back()
        if self._log.keeps:
            self._log.add_block(self._ffi.buffer(self._text, self._loop.log.used)[:])
        if self._loop.ticks:
            for index, client in enumerate(self._clients):
                self._catch_up(index, client)
        if self._loop.silent >= 0:
            raise self._clients[self._loop.silent].late(self._loop.tick)
        return int(self._loop.ticks)

    def block(self, index: int) -> RobotBlock:
        """A robot's part of the last block; it is valid until the next block."""
        robot, ticks, ffi = self._robots[index], self._loop.ticks, self._ffi
        return RobotBlock(
            ffi.buffer(robot.rows, ticks * self._library.LOOP_ROW * 2),
            ffi.buffer(robot.poses, ticks * self._library.LOOP_POSE * 8),
            robot.decisions[0 : robot.decision_count],
            self._memories[index],
        )

    def reasons(self, index: int) -> Sequence[int]:
        """A robot's reason in each tick of the last block."""
        row = self._library.LOOP_ROW
        numbers: Sequence[int] = self._ffi.unpack(self._robots[index].rows, self._loop.ticks * row)
        return numbers[_REASON::row]

    def last(self, index: int) -> tuple[Senses, Drive]:
        """A robot's senses and drive in the last tick."""
        first = (self._loop.ticks - 1) * self._library.LOOP_ROW
        numbers = self._ffi.unpack(self._robots[index].rows + first, _DRIVE_END)
        senses = Senses._make(numbers[:_SENSES_END])
        drive = Drive._make(numbers[_SENSES_END:])
        return senses._replace(bump=bool(senses.bump), look=bool(senses.look)), drive

    def begun(self, index: int) -> dict[int, int]:
        """Number of actions that a robot has begun since `enter`, by reason."""
        counts = self._ffi.unpack(self._robots[index].begun, self._library.LOOP_REASONS)
        return {reason: count for reason, count in enumerate(counts) if count}

    def food_eaten(self, index: int) -> int:
        """Number of pieces of food that a robot has eaten since `enter`."""
        return int(self._robots[index].food_eaten)

    def _bind(self, robot: Any, client: RobotClient, link: InProcessLink) -> None:
        """Lets the C code reach a robot, and provides its buffers."""
        ffi, library, pointers = self._ffi, self._library, link.pointers
        robot.octet = ffi.cast("struct octet *", pointers.octet)
        self._loop.exchange = ffi.cast(ffi.typeof(self._loop.exchange), pointers.exchange)
        self._loop.answers = ffi.cast(ffi.typeof(self._loop.answers), pointers.answers)
        robot.senses_id, robot.drive_id, robot.heartbeat_id = map(
            client.protocol.id_of, ("SENSES", "DRIVE", "HEARTBEAT")
        )
        buffers = (
            ffi.new("int16_t[]", BLOCK_TICKS * library.LOOP_ROW),
            ffi.new("double[]", BLOCK_TICKS * library.LOOP_POSE),
            ffi.new("uint32_t[]", BLOCK_TICKS),
        )
        robot.rows, robot.poses, robot.decisions = buffers
        self._kept += buffers

    def _make_room(self, waiting: int) -> None:
        """Makes room for the log of a block in which some ticks have reports, and one has all there can be."""
        library, robots = self._library, len(self._clients)
        lines = waiting + robots * (_LINES_A_TICK * BLOCK_TICKS + 1 + library.LOOP_FRAMES_MAX)
        if self._loop.log_size < lines * library.LOG_LINE_MAX:
            self._text = self._ffi.new("char[]", lines * library.LOG_LINE_MAX)
            self._loop.log.text, self._loop.log_size = self._text, self._ffi.sizeof(self._text)

    def _look_up(self, index: int, client: RobotClient) -> None:
        """Takes over what commands may have changed. After one, even what a robot reported long ago may be news."""
        robot = self._robots[index]
        self._links[index].hear_others()
        if (faults := self._world.arena.bodies[index].faults) is not self._faults[index]:
            self._faults[index], robot.faults = faults, asdict(faults)
        robot.senses_counter, self._memories[index] = client.senses_counter, client.memory
        if client.frames.sent != self._sent[index]:
            robot.known_count = 0
        if waiting := self._links[index].taken():
            frames = [(frame.id, len(frame.data), frame.data.ljust(_LENGTH, b"\0")) for frame in waiting]
            self._waiting[index] = robot.waiting = self._ffi.new("struct frame[]", frames)
            robot.waiting_count = len(waiting)

    def _catch_up(self, index: int, client: RobotClient) -> None:
        robot, ticks = self._robots[index], int(self._loop.ticks)
        client.catch_up(ticks, self.last(index)[1], _frame(robot.drive), robot.received)
        client.frames.refused += robot.refused
        robot.received = robot.refused = 0
        if robot.report_count:
            client.take_reports([_frame(report) for report in robot.reports[0 : robot.report_count]])
        self._sent[index] = client.frames.sent


@cache
def _loaded() -> tuple[Any, Any]:
    return load_native(LIBRARY, "loop_", HEADERS)


def _frame(frame: Any) -> Frame:
    return Frame(frame.id, bytes(frame.data[0 : frame.len]))
