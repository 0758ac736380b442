"""The firmware inside this process, as a link that calls its shared library."""

import os
import time
from collections import deque
from collections.abc import Sequence
from pathlib import Path
from typing import Any, NamedTuple

from host_sim.backends.relay import Relay
from host_sim.base.c_interface import c_interface
from host_sim.base.errors import OctetError
from host_sim.base.paths import BUILD
from host_sim.protocol.codec import Frame

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
