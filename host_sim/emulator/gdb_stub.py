"""A debugger's way into an emulated core: gdb's remote serial protocol, for one client on a socket of this machine.

Board time stands still while the core is halted. What a client sends is checked: a wrong request is answered with an
error, and a client that does not speak the protocol is dropped.
"""

import re
import select
import socket
from collections.abc import Callable
from pathlib import Path

from host_sim.base.errors import RobotError
from host_sim.emulator.core import REGISTERS, Core

_PACKET_MAX, _BREAKPOINTS_MAX = 4096, 64
_LOOK_S = 0.1
_OK, _ERROR, _UNKNOWN = "OK", "E01", ""
_TRAPPED, _INTERRUPTED = "S05", "S02"
_WORD = re.compile(r"[0-9a-fA-F]{1,8}")
_PACKET = re.compile(rb"\$([^$#]*)#([0-9a-fA-F]{2})")
_BETWEEN_PACKETS = b"+-\x03"
_LEFT = "the debugger was left before the run had ended"
_TARGET = (
    '<?xml version="1.0"?><!DOCTYPE target SYSTEM "gdb-target.dtd"><target version="1.0">'
    '<architecture>arm</architecture><feature name="org.gnu.gdb.arm.m-profile">'
    + "".join(map('<reg name="{}" bitsize="32"/>'.format, REGISTERS))
    + "</feature></target>"
)


class GdbStub:
    """Lets gdb halt a core, look at it and change it. The core halts before its next instruction, for a client.

    Attributes:
        check_client: Called while no client has come; raises RobotError if none will.
    """

    def __init__(self, core: Core, path: Path) -> None:
        """Listens.

        Args:
            core: The core.
            path: The Unix socket to make, in a folder that only this user can enter.
        """
        self.check_client: Callable[[], object] = lambda: None
        self._core = core
        self._socket = socket.socket(socket.AF_UNIX)
        self._socket.bind(str(path))
        self._socket.listen(1)
        self._has_client = self._has_gone_on = False
        self._received, self._why = b"", _TRAPPED
        self._commands: dict[str, Callable[[str], str]] = {
            "?": lambda _: self._why,
            "H": lambda _: _OK,
            "q": self._query,
            "g": self._read_registers,
            "P": self._write_register,
            "m": self._read_memory,
            "M": self._write_memory,
            "Z": self._add_breakpoint,
            "z": self._drop_breakpoint,
        }
        core.on_halt, core.is_halt_asked = self._serve, self._is_halt_asked
        core.halts = True

    def close(self) -> None:
        """Closes the socket; the core goes on."""
        self._core.on_halt, self._core.is_halt_asked = lambda: False, lambda: False
        self._core.clear_breakpoints()
        self._socket.close()

    def _serve(self) -> bool:
        """Answers the client until it lets the core go on; returns whether for one instruction only.

        Raises:
            RobotError: The client has left, or is none.
        """
        self._await_client()
        if self._has_gone_on:
            self._send(self._why)
        while True:
            packet = self._receive()
            kind, rest = packet[:1], packet[1:]
            if kind in ("c", "s", "C", "S") and len(packet) <= len("C05"):
                self._has_gone_on, self._why = True, _TRAPPED
                return kind in "sS"
            if kind == "D":
                self._send(_OK)
                self.close()
                return False
            if kind == "k":
                raise self._left()
            self._send(self._answer(kind, rest))

    def _answer(self, kind: str, rest: str) -> str:
        command = self._commands.get(kind)
        try:
            return command(rest) if command else _UNKNOWN
        except ValueError:
            return _ERROR

    def _await_client(self) -> None:
        """Takes the first client, and no other."""
        while not self._has_client:
            if select.select([self._socket], [], [], _LOOK_S)[0]:
                listener, self._has_client = self._socket, True
                self._socket, _ = listener.accept()
                listener.close()
            else:
                self.check_client()

    def _is_halt_asked(self) -> bool:
        """Whether the client has sent something while the core runs: it asks for a halt."""
        if self._has_client and select.select([self._socket], [], [], 0)[0]:
            self._why = _INTERRUPTED
        return self._why == _INTERRUPTED

    def _left(self, why: str = _LEFT) -> RobotError:
        self.close()
        return RobotError(why)

    def _read(self) -> None:
        try:
            received = self._socket.recv(_PACKET_MAX)
        except OSError:
            received = b""
        if not received:
            raise self._left()
        self._received += received

    def _receive(self) -> str:
        """The next packet that is whole; one with another checksum is asked for again."""
        while True:
            self._received = self._received.lstrip(_BETWEEN_PACKETS)
            packet = _PACKET.match(self._received)
            if packet:
                self._received = self._received[packet.end() :]
                is_whole = sum(packet[1]) % 256 == int(packet[2], 16)
                self._socket.sendall(b"+" if is_whole else b"-")
                if is_whole:
                    return packet[1].decode("latin-1")
            elif len(self._received) > _PACKET_MAX or self._received[:1] not in (b"", b"$"):
                raise self._left("the debugger sent what is not of gdb's remote protocol")
            else:
                self._read()

    def _send(self, answer: str) -> None:
        try:
            self._socket.sendall(f"${answer}#{sum(answer.encode()) % 256:02x}".encode())
        except OSError:
            raise self._left() from None

    def _query(self, words: str) -> str:
        if words.startswith("Supported"):
            return f"PacketSize={_PACKET_MAX:x};qXfer:features:read+"
        if words.startswith("Xfer:features:read:target.xml:"):
            begin, size = _numbers(words.rpartition(":")[2])
            more = "m" if begin + size < len(_TARGET) else "l"
            return more + _TARGET[begin : begin + size]
        return "0" if words == "Attached" else _UNKNOWN

    def _read_registers(self, _: str) -> str:
        return b"".join(self._core.register(it).to_bytes(4, "little") for it in range(len(REGISTERS))).hex()

    def _write_register(self, words: str) -> str:
        number, _, digits = words.partition("=")
        value = bytes.fromhex(digits)
        if len(value) != 4:  # noqa: PLR2004 - bytes in a register
            raise ValueError
        self._core.set_register(_number(number), int.from_bytes(value, "little"))
        return _OK

    def _read_memory(self, words: str) -> str:
        address, size = _numbers(words)
        return self._core.read(address, min(size, _PACKET_MAX // 2)).hex()

    def _write_memory(self, words: str) -> str:
        place, _, digits = words.partition(":")
        address, size = _numbers(place)
        data = bytes.fromhex(digits)
        if len(data) != size:
            raise ValueError
        self._core.write_ram(address, data)
        return _OK

    def _add_breakpoint(self, words: str) -> str:
        if words[:2] not in ("0,", "1,"):
            return _UNKNOWN  # gdb steps for a watchpoint
        if len(self._core.breakpoints) >= _BREAKPOINTS_MAX:
            raise ValueError
        self._core.add_breakpoint(_numbers(words[2:])[0])
        return _OK

    def _drop_breakpoint(self, words: str) -> str:
        self._core.drop_breakpoint(_numbers(words[2:])[0])
        return _OK


def _number(text: str) -> int:
    if not _WORD.fullmatch(text):
        raise ValueError
    return int(text, 16)


def _numbers(text: str) -> tuple[int, int]:
    first, _, second = text.partition(",")
    return _number(first), _number(second)
