"""Robots inside this process, as links that call a shared library: the firmware, or one with a program as its brain.

docs/article.md describes the language of such programs. A relay passes memories between robots with a line each.
"""

import os
import time
from collections import deque
from collections.abc import Iterable, Sequence
from contextlib import closing
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from host_sim.base.c_interface import c_interface
from host_sim.base.errors import BrainError, OctetError, UsageError
from host_sim.base.files import read_bytes
from host_sim.base.paths import BUILD
from host_sim.protocol.codec import MEMORY_IDS, Frame
from host_sim.protocol.generated import PROGRAM_TEXT_MAX
from host_sim.sim.world_record import Source
from host_sim.transport.link import FrameSocket, Link, SocketLink

if TYPE_CHECKING:
    from host_sim.sim.own_brain import OwnBrain

_PROGRAMMED = BUILD / "host" / "host_sim" / "program" / "native"
PROGRAMMED_LIBRARY, PROGRAMMED_PROCESS = _PROGRAMMED / "liboctet_programmed.so", _PROGRAMMED / "octet-program"
"""Programmable robots, as a library and as an executable."""

_TOLD_MAX = 1024

LIBRARY = BUILD / "host" / "hal" / "library" / "liboctet.so"

_DECLARATIONS = """
struct frame { uint32_t id; uint8_t len; uint8_t data[8]; };
struct octet;
struct octet *octet_open(uint8_t node, const uint8_t memory[8]);
size_t octet_exchange(struct octet *octet, const struct frame *in);
void octet_outage(struct octet *octet);
const struct frame *octet_answers(const struct octet *octet);
size_t octet_size(const struct octet *octet);
void octet_close(struct octet *octet);
struct octet *programmed_open(uint8_t node, const uint8_t memory[8], const char *text, size_t len);
const void *programmed_state(const struct octet *octet);
void programmed_tell(const void *program, char told[1024]);
const char *programmed_printed(const void *program);
const char *own_failure(const void *robot);
"""


def load_library(ffi: Any, path: Path = LIBRARY) -> Any:
    """Loads the firmware as a library.

    Raises:
        OctetError: The library is missing, or cannot be loaded.
    """
    try:
        return ffi.dlopen(os.fspath(path))
    except OSError as error:
        raise OctetError(f"cannot load the firmware: {error}; build it with tools/setup") from error


class RobotPointers(NamedTuple):
    """Addresses by which C code reaches a robot: the robot itself and two functions of `hal/library/exchange.h`."""

    octet: int
    exchange: int
    answers: int


class Relay:
    """Passes memories on. Each robot hears those of the others, in order, before the next frame for itself."""

    def __init__(self, nodes: Iterable[int]) -> None:
        """Starts with nothing to pass on.

        Args:
            nodes: The robots.
        """
        self._waiting: dict[int, list[Frame]] = {node: [] for node in nodes}

    def hear(self, node: int, frame: Frame) -> None:
        """Notes a frame sent by a robot, if it is for the others."""
        if frame.id not in MEMORY_IDS:
            return
        for other, waiting in self._waiting.items():
            if other != node:
                waiting.append(frame)

    def take(self, node: int) -> list[Frame]:
        """Returns, once, the frames that a robot has not received yet."""
        waiting, self._waiting[node] = self._waiting[node], []
        return waiting


@dataclass(frozen=True)
class RelayedLink:
    """A link to a robot that receives memories from others.

    Attributes:
        link: Carries the frames.
        relay: Relays memories between the robots.
        node: The robot.
    """

    link: Link
    relay: Relay
    node: int

    def send(self, frame: Frame) -> None:
        """As in `Link`."""
        self._pass_on()
        self.link.send(frame)

    def receive(self, timeout_s: float) -> Frame | None:
        """As in `Link`."""
        frame = self.link.receive(timeout_s)
        if frame is not None:
            self.relay.hear(self.node, frame)
        return frame

    def frame_socket(self) -> FrameSocket | None:
        """As in `SocketLink`."""
        self._pass_on()
        return self.link.frame_socket() if isinstance(self.link, SocketLink) else None

    def _pass_on(self) -> None:
        for heard in self.relay.take(self.node):
            self.link.send(heard)

    def close(self) -> None:
        """As in `Link`."""
        self.link.close()


class InProcessLink:
    """A robot that answers within `send`. Its only time is that of the ticks, and it is never late."""

    def __init__(
        self, node: int = 1, memory: Sequence[int] = (0,) * 8, library: Path = LIBRARY, relay: Relay | None = None
    ) -> None:
        """Starts a robot.

        Args:
            node: 1..31.
            memory: Its initial eight cells.
            library: The firmware.
            relay: Relays memories from other robots; None if it is alone.

        Raises:
            OctetError: The library cannot be loaded.
        """
        self._ffi = c_interface(_DECLARATIONS)
        self._library = loaded = load_library(self._ffi, library)
        opened = self._open(node, bytes(memory))
        # This function keeps the library loaded until the robot is closed.
        self._octet = self._ffi.gc(opened, lambda octet: loaded.octet_close(octet))  # noqa: PLW0108 - see above
        self._state: Any = self._ffi.buffer(self._octet, loaded.octet_size(opened))
        self._in: Any = self._ffi.new("struct frame *")
        self._out: Any = self._library.octet_answers(self._octet)
        self._answers: deque[Frame] = deque()
        self._node, self._relay = node, relay

    def _open(self, node: int, memory: bytes) -> Any:
        return self._library.octet_open(node, memory)

    @property
    def pointers(self) -> RobotPointers:
        """Addresses of the robot, valid for as long as this link exists."""
        library = self._library
        things = (self._octet, library.octet_exchange, library.octet_answers)
        return RobotPointers(*(int(self._ffi.cast("uintptr_t", thing)) for thing in things))

    def send(self, frame: Frame) -> None:
        """As in `Link`."""
        if self._relay is not None:
            self.hear_others()
        data = frame.data
        self._in.id, self._in.len = frame.id, len(data)
        self._ffi.memmove(self._in.data, data, len(data))
        count = self._library.octet_exchange(self._octet, self._in)
        for i in range(count):
            out = self._out[i]
            answer = Frame(out.id, self._ffi.buffer(out.data, out.len)[:])
            self._answers.append(answer)
            if self._relay is not None:
                self._relay.hear(self._node, answer)

    def lose_touch(self) -> None:
        """Tells the robot that senses did not arrive in time: it accepts the next ones as fresh."""
        self._library.octet_outage(self._octet)

    @property
    def state(self) -> bytes:
        """The robot's complete state, for `go_back_to`."""
        return bytes(self._state)

    def go_back_to(self, state: bytes) -> None:
        """Restores an earlier state of the robot."""
        self._state[:] = state

    def status(self) -> str:
        """As in `Connection`."""
        return "runs in this process"

    def printed(self) -> str:
        """As in `Connection`."""
        return ""

    def hear_others(self) -> None:
        """Passes on memories from others that the robot has not received yet."""
        if self._relay is not None:
            for frame in self._relay.take(self._node):
                self.send(frame)

    def receive(self, timeout_s: float) -> Frame | None:
        """As in `Link`. Waiting only passes the time: a frame that is not there yet will not come."""
        if self._answers:
            return self._answers.popleft()
        time.sleep(timeout_s)
        return None

    def taken(self) -> list[Frame]:
        """Returns all waiting frames at once."""
        answers = list(self._answers)
        self._answers.clear()
        return answers

    def put_back(self, waiting: Sequence[Frame], count: int) -> None:
        """Makes frames that were taken available again, and a number of answers to a frame that C code has sent."""
        answers = [Frame(out.id, self._ffi.buffer(out.data, out.len)[:]) for out in self._out[0:count]]
        self._answers += [*waiting, *answers]

    def close(self) -> None:
        """As in `Link`."""
        self._answers.clear()


class OwnLink(InProcessLink):
    """A robot with a behaviour of its user, in this process."""

    def __init__(
        self, own: "OwnBrain", node: int = 1, memory: Sequence[int] = (0,) * 8, relay: Relay | None = None
    ) -> None:
        """As in `InProcessLink`, with the behaviour."""
        super().__init__(node, memory, own.library, relay)
        self._own = own

    def send(self, frame: Frame) -> None:
        """As in `Link`; raises BrainError if the behaviour has made a mistake."""
        super().send(frame)
        self.status()

    def status(self) -> str:
        """As in `Connection`."""
        failure: Any = self._ffi.string(self._library.own_failure(self._octet))
        if failure:
            raise BrainError.from_failure(self._own.named(failure.decode(errors="replace")), self._node)
        return super().status()


class ProgrammedLink(InProcessLink):
    """A robot with a program, in this process."""

    def __init__(
        self, program: "Program", node: int = 1, memory: Sequence[int] = (0,) * 8, relay: Relay | None = None
    ) -> None:
        """As in `InProcessLink`; raises UsageError if the program has an error, with its line."""
        self._text = program.text
        super().__init__(node, memory, PROGRAMMED_LIBRARY, relay)
        if told := self.program_state():
            raise UsageError(f"{program.name}, {told}")

    def _open(self, node: int, memory: bytes) -> Any:
        return self._library.programmed_open(node, memory, self._text, len(self._text))

    def program_state(self) -> str:
        """The state of the program for people: its error, its end, or its output; empty if there is none."""
        told = self._ffi.new("char[]", _TOLD_MAX)
        self._library.programmed_tell(self._library.programmed_state(self._octet), told)
        text: Any = self._ffi.string(told)
        return str(text.decode(errors="replace"))

    def printed(self) -> str:
        """As in `Connection`."""
        text: Any = self._ffi.string(self._library.programmed_printed(self._library.programmed_state(self._octet)))
        return str(text.decode(errors="replace").rpartition("\n")[0])

    def status(self) -> str:
        """As in `Connection`."""
        return f"runs in this process, the program: {self.program_state() or 'runs'}"


@dataclass(frozen=True)
class Program:
    """A program in a file, as a robot's brain.

    Attributes:
        name: The name of its file, for people.
        text: Its text.
    """

    name: str
    text: bytes

    @property
    def source(self) -> Source:
        """Its source, as recorded in the world file."""
        return Source(Path(self.name).name, self.text)

    @property
    def command(self) -> list[Path | str]:
        """The robot as a process, as `robot_process.PROGRAM`."""
        return [PROGRAMMED_PROCESS, self.name]

    def robot(self, node: int = 1, memory: Sequence[int] = (0,) * 8, relay: Relay | None = None) -> ProgrammedLink:
        """The robot in this process; raises as `ProgrammedLink`."""
        return ProgrammedLink(self, node, memory, relay)


def read_program(path: Path) -> Program:
    """Reads a program; raises UsageError as `read_source`, or if it has an error."""
    program = Program(os.fspath(path), read_source(path, PROGRAM_TEXT_MAX - 1))
    with closing(program.robot()):
        return program


def read_source(path: Path, size_max: int) -> bytes:
    """The text of a behaviour in a file.

    Raises:
        UsageError: The file cannot be read, is too large, or is not text.
    """
    try:
        text = read_bytes(path, size_max)
    except OSError as error:
        raise UsageError(f"cannot read {path}: {error.strerror}") from None
    if b"\0" in text:
        raise UsageError(f"{path} is no behaviour: it is not text")
    return text
