"""Runs the images for a Raspberry Pi Pico in rp2040js, a third-party emulator on Node."""

import os
import shutil
import subprocess
from contextlib import suppress
from pathlib import Path

from host_sim.base.errors import RobotError, UsageError
from host_sim.base.paths import BUILD, PACKAGE
from host_sim.sim.qemu import SerialEmulator
from host_sim.transport.link import Frame
from host_sim.transport.slcan_link import decode, encode

_NODE = "node"
_LIBRARY = Path("rp2040js", "node_modules", "rp2040js", "dist", "esm", "index.js")


def command_line(image: Path, *options: str) -> list[str]:
    """The command that runs an image.

    Args:
        image: The `.bin` file.
        options: Options of pico.mjs, which explains them.

    Raises:
        UsageError: Node or rp2040js is not installed.
        OctetError: The image is not built.
    """
    library = BUILD / _LIBRARY
    if shutil.which(_NODE) is None:
        raise UsageError("an emulated pico runs in Node, which is not installed: run tools/setup pico")
    if not library.exists():
        raise UsageError("an emulated pico runs in rp2040js, which is not installed: run tools/setup pico")
    return [_NODE, *map(os.fspath, (PACKAGE / "emulator" / "pico.mjs", library, image)), *options]


class Pico(SerialEmulator):
    """A running rp2040js."""

    def __init__(self, image: Path) -> None:
        """Starts it; image and errors are those of `command_line`, and errors of `SerialEmulator`."""
        super().__init__("rp2040js", command_line(image))


class SteppedPico:
    """A running rp2040js whose time passes only on orders, which pico.mjs explains.

    Attributes:
        said: The frames that it sent on its serial line.
        text: The other lines.
    """

    def __init__(self, image: Path, *options: str) -> None:
        """Starts it with an image; raises as `command_line` does."""
        self._process = subprocess.Popen(
            command_line(image, "stepped", *options),
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            bufsize=0,
        )
        self._rest = self._begun = b""
        self.said: list[Frame] = []
        self.text: list[bytes] = []

    def order(self, *orders: str) -> list[str]:
        """Gives orders; returns the answers.

        Raises:
            RobotError: It has ended; the message has what it printed.
        """
        self.write("".join(f"!{order}\r" for order in orders).encode())
        return [self._answer() for _ in orders]

    def send(self, frame: Frame) -> None:
        """Puts a frame on its serial line; raises as `order` does."""
        self.write(encode(frame))

    def close(self) -> None:
        """Ends it."""
        self._process.kill()
        self._process.wait()
        for stream in (self._process.stdin, self._process.stdout, self._process.stderr):
            assert stream is not None
            with suppress(BrokenPipeError):
                stream.close()

    def write(self, text: bytes) -> None:
        """Puts any text on its serial line."""
        assert self._process.stdin is not None
        with suppress(BrokenPipeError):  # no answer comes then, and that error says more
            self._process.stdin.write(text)

    def _answer(self) -> str:
        while True:
            begun, mark, answer = self._line().partition(b"!")
            self._begun += begun
            if mark:
                return answer.decode()
            line, self._begun = self._begun, b""
            frame = decode(line)
            if frame is None:
                self.text.append(line)
            else:
                self.said.append(frame)

    def _line(self) -> bytes:
        assert self._process.stdout is not None
        while b"\r" not in self._rest:
            more = self._process.stdout.read(65536)
            if not more:
                assert self._process.stderr is not None
                printed = self._process.stderr.read().decode(errors="replace").strip().replace("\n", " / ")
                raise RobotError(f"rp2040js ended and printed: {printed or 'nothing'}")
            self._rest += more
        line, _, self._rest = self._rest.partition(b"\r")
        return line
