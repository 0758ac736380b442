"""Robots whose brain is a program in the language of the article's listing: docs/language.md."""

from collections.abc import Sequence
from contextlib import closing
from pathlib import Path
from typing import Any

from host_sim.backends.in_process_link import InProcessLink
from host_sim.backends.relay import Relay
from host_sim.base.errors import UsageError
from host_sim.base.paths import BUILD
from host_sim.base.regular_file import read_bytes
from host_sim.protocol.generated import PROGRAM_TEXT_MAX

_FOLDER = BUILD / "host" / "host_sim" / "program" / "native"
LIBRARY, PROCESS = _FOLDER / "liboctet_programmed.so", _FOLDER / "octet-program"
"""Programmable robots, as a library and as an executable."""

_TOLD_MAX = 1024


class ProgrammedLink(InProcessLink):
    """A robot with a program, in this process."""

    def __init__(
        self, program: Path | bytes, node: int = 1, relay: Relay | None = None, memory: Sequence[int] = (0,) * 8
    ) -> None:
        """Starts a robot.

        Args:
            program: The file with its program, or its text.
            node: 1..31.
            relay: Relays memories from other robots; None if it is alone.
            memory: Its initial eight cells.

        Raises:
            UsageError: The file cannot be read, or the program has an error; the message names it and its line.
            OctetError: The library cannot be loaded.
        """
        self._text = program if isinstance(program, bytes) else read_program(program)
        super().__init__(node, memory, library=LIBRARY, relay=relay)
        if told := self.told():
            raise UsageError(f"{'the program of the run' if isinstance(program, bytes) else program}, {told}")

    def _open(self, node: int, memory: bytes) -> Any:
        return self._library.programmed_open(node, memory, self._text, len(self._text))

    def told(self) -> str:
        """The state of the program for people: its error, its end, or its output; empty if there is none."""
        told = self._ffi.new("char[]", _TOLD_MAX)
        self._library.programmed_tell(self._library.programmed_state(self._octet), told)
        text: Any = self._ffi.string(told)
        return str(text.decode(errors="replace"))

    def status(self) -> str:
        """As in `Connection`."""
        return f"runs in this process, the program: {self.told() or 'runs'}"


def read_program(path: Path) -> bytes:
    """The text of a program.

    Raises:
        UsageError: The file cannot be read, or is not text.
    """
    try:
        text = read_bytes(path, PROGRAM_TEXT_MAX - 1)
    except OSError as error:
        raise UsageError(f"cannot read {path}: {error.strerror}") from None
    if b"\0" in text:
        raise UsageError(f"{path} is not a program: it is not text")
    return text


def check_program(program: str) -> None:
    """Refuses a program with an error.

    Args:
        program: The file with it; empty for none.

    Raises:
        UsageError: As `ProgrammedLink`.
    """
    if program:
        with closing(ProgrammedLink(Path(program))):
            pass
