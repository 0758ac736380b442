"""The tick loop in C (`native/`): runs a block of ticks per call, with the same frames."""

from collections.abc import Sequence
from functools import cache
from typing import Any, NamedTuple

from host_sim.base.paths import BUILD, PACKAGE, ROOT
from host_sim.client.frame_log import FrameLog
from host_sim.client.pacing import BegunTick
from host_sim.client.robot_client import RobotClient
from host_sim.protocol.generated import ROW, Drive, Senses
from host_sim.sim.block_catch_up import LoopRobot, Native, RobotBehindLink, RobotInProcess
from host_sim.sim.in_process_link import InProcessLink
from host_sim.transport.link import SocketLink
from host_sim.world.arena import Arena
from host_sim.world.world_library import WORLD_HEADERS, load_native

LIBRARY = BUILD / "host" / "host_sim" / "sim" / "native" / "liboctet_loop.so"
_NATIVE = PACKAGE / "sim" / "native"
HEADERS = (ROOT / "hal" / "link" / "link.h", *WORLD_HEADERS, _NATIVE / "log_lines.h", _NATIVE / "loop.h")

BLOCK_TICKS = 1024
"""Maximum number of ticks in a block."""

_LINES_A_TICK = 3
_SENSES_END = len(Senses._fields)
_REASON = ROW.index("reason")
_DRIVE_END = _SENSES_END + len(Drive._fields)


class RobotBlock(NamedTuple):
    """One robot's part of a block.

    Attributes:
        rows: 16-bit fields of `ROW`, tick after tick; `pattern` and `frozen` are not filled in yet.
        poses: Doubles, tick after tick: x and y in mm and heading in rad, after the tick.
        memory: The robot's eight cells before the block.
    """

    rows: Any
    poses: Any
    memory: tuple[int, ...]


def suits(clients: Sequence[RobotClient]) -> bool:
    """Whether a loop can run these robots: all in this process, or all behind links that may have sockets."""
    return any(
        all(isinstance(client.connection.link, kind) for client in clients) for kind in (InProcessLink, SocketLink)
    )


class NativeLoop:
    """The robots of a run, and buffers for a block of their ticks.

    Attributes:
        handed_over: Whether Python must do the tick after the last `run`: `take_over`, then `record`.
    """

    def __init__(self, clients: Sequence[RobotClient], log: FrameLog) -> None:
        """Connects the loop to the robots.

        Args:
            clients: The robots' clients, for which `suits` is true.
            log: Records every frame.

        Raises:
            NoNativeError: The library cannot be used.
        """
        self._ffi, self._library = loaded()
        self.handed_over = False
        self._clients, self._log = clients, log
        self._memories = [client.memory for client in clients]
        self._kept: list[Any] = []  # referenced by C code, so Python must not free it
        self._text: Any = None
        self._robots: Any = self._ffi.new("struct loop_robot[]", len(clients))
        self._loop: Any = self._ffi.new("struct loop *")
        self._loop.robots, self._loop.robot_count = self._robots, len(clients)
        self._wires = [self._bind(robot, client) for robot, client in zip(self._robots, clients, strict=True)]
        self._arena: Arena

    def enter(self, arena: Arena) -> None:
        """Puts the robots into another arena."""
        self._arena = arena
        self._loop.world = self._ffi.cast("struct world *", arena.inside.address)
        for robot in self._robots:
            robot.begun, robot.food_eaten = [0] * self._library.LOOP_REASONS, 0

    def run(self, tick: int, ticks_max: int) -> int:
        """Runs a block of ticks; it ends after a tick in which food was eaten or a robot reported something new.

        Args:
            tick: Number of the first tick.
            ticks_max: Maximum number of ticks.

        Returns:
            The number of ticks that ran, at least 1 unless a tick is handed over.
        """
        self._loop.tick = tick
        for index, client in enumerate(self._clients):
            self._look_up(index, client)
        halted = any(client.inbox.session is not None and client.inbox.session.halted for client in self._clients)
        ticks = 0 if halted else min(ticks_max, BLOCK_TICKS, *(wire.prepare() for wire in self._wires))
        if self._log.keeps:
            self._make_room(sum(robot.waiting_count for robot in self._robots))
        self._library.loop_run(self._loop, ticks)
        self._arena.inside.check()
        if self._log.keeps:
            self._log.add_block(self._ffi.buffer(self._text, self._loop.log.used)[:])
        for index, wire in enumerate(self._wires):
            wire.catch_up(self._loop.ticks + (self._loop.handed_over and index < self._loop.answered))
        self.handed_over = self._loop.handed_over or not ticks
        return int(self._loop.ticks)

    def take_over(self) -> BegunTick:
        """The part already done of the tick that is handed over.

        Raises:
            RobotError: A robot can no longer answer.
        """
        loop = self._loop
        if not loop.handed_over:
            return BegunTick(0, ())
        if loop.sent == len(self._wires):
            for wire in self._wires[loop.answered :]:
                wire.go_on()
        return BegunTick(loop.sent, [client.inbox.drive for client in self._clients[: loop.answered]])

    def record(self, senses: Sequence[Senses], drives: Sequence[Drive], food_eaten: Sequence[int]) -> None:
        """Adds the tick that was handed over to the block, now that it has been done.

        Args:
            senses: Each robot's senses.
            drives: Each robot's drive.
            food_eaten: For each robot, the number of pieces of food that it has eaten since `enter`.
        """
        first = self._loop.ticks * len(ROW)
        for robot, sensed, drive, eaten in zip(self._robots, senses, drives, food_eaten, strict=True):
            robot.rows[first : first + _DRIVE_END] = [*sensed, *drive]
            robot.food_eaten = eaten
        self._library.loop_record(self._loop)

    def block(self, index: int) -> RobotBlock:
        """A robot's part of the last block; it is valid until the next block."""
        robot, ticks, ffi = self._robots[index], self._loop.ticks, self._ffi
        return RobotBlock(
            ffi.buffer(robot.rows, ticks * len(ROW) * 2),
            ffi.buffer(robot.poses, ticks * self._library.LOOP_POSE * 8),
            self._memories[index],
        )

    @property
    def ticks(self) -> int:
        """Number of ticks in the last block."""
        return int(self._loop.ticks)

    def reasons(self, index: int) -> Sequence[int]:
        """A robot's reason in each tick of the last block."""
        row = len(ROW)
        numbers: Sequence[int] = self._ffi.unpack(self._robots[index].rows, self._loop.ticks * row)
        return numbers[_REASON::row]

    def last(self, index: int) -> tuple[Senses, Drive]:
        """A robot's senses and drive in the last tick."""
        first = (self._loop.ticks - 1) * len(ROW)
        numbers = self._ffi.unpack(self._robots[index].rows + first, _DRIVE_END)
        tick, feel, bump, look, *rest = numbers[:_SENSES_END]
        return Senses(tick, feel, bump != 0, look != 0, *rest), Drive(*numbers[_SENSES_END:])

    def begun(self, index: int) -> dict[int, int]:
        """Number of actions that a robot has begun since `enter`, by reason."""
        counts = self._ffi.unpack(self._robots[index].begun, self._library.LOOP_REASONS)
        return {reason: count for reason, count in enumerate(counts) if count}

    def food_eaten(self, index: int) -> int:
        """Number of pieces of food that a robot has eaten since `enter`."""
        return int(self._robots[index].food_eaten)

    def _bind(self, robot: Any, client: RobotClient) -> LoopRobot:
        """Lets the C code reach a robot, and provides its buffers."""
        ffi, library, link = self._ffi, self._library, client.connection.link
        robot.senses_id, robot.drive_id, robot.heartbeat_id, robot.health_id = map(
            client.protocol.id_of, ("SENSES", "DRIVE", "HEARTBEAT", "HEALTH")
        )
        buffers = (
            ffi.new("int16_t[]", BLOCK_TICKS * len(ROW)),
            ffi.new("double[]", BLOCK_TICKS * library.LOOP_POSE),
        )
        robot.rows, robot.poses = buffers
        self._kept += buffers
        native = Native(ffi, library, self._loop, robot)
        if isinstance(link, InProcessLink):
            return RobotInProcess(native, client, link)
        assert isinstance(link, SocketLink)
        return RobotBehindLink(native, client, link)

    def _make_room(self, waiting: int) -> None:
        """Allocates the log of a block in which some ticks have reports, and one has the maximum."""
        library, robots = self._library, len(self._clients)
        lines = waiting + robots * (_LINES_A_TICK * BLOCK_TICKS + 1 + library.LOOP_FRAMES_MAX)
        if self._loop.log_size < lines * library.LOG_LINE_MAX:
            self._text = self._ffi.new("char[]", lines * library.LOG_LINE_MAX)
            self._loop.log.text, self._loop.log_size = self._text, self._ffi.sizeof(self._text)

    def _look_up(self, index: int, client: RobotClient) -> None:
        """Takes over changes made by commands and people."""
        robot = self._robots[index]
        robot.senses_counter, self._memories[index] = client.inbox.sent_counter, client.memory
        told = client.inbox.held_check
        robot.commands, robot.heard[0], robot.heard_count, robot.driven = told.commands, told.heard, 1, told.drive


@cache
def loaded() -> tuple[Any, Any]:
    """The interface to the library, and the library; raises NoNativeError if it cannot be used."""
    return load_native(LIBRARY, "loop_", HEADERS)
