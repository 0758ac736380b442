"""Updates one robot, as docs/update.md has it: whatever is lost on the way is said again, or gone on from."""

import struct
import time
import zlib
from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import dataclass
from functools import partial
from typing import Any, TypeVar

from udsoncan import MemoryLocation
from udsoncan.client import Client
from udsoncan.exceptions import (
    InvalidResponseException,
    NegativeResponseException,
    TimeoutException,
    UnexpectedResponseException,
)

from host_sim.base.errors import OctetError, RobotError
from host_sim.transport.link import Link
from host_sim.update.image import LAYOUTS, SlotImage
from host_sim.update.isotp_connection import IsoTpConnection
from host_sim.update.keys import Ed25519PrivateKey

_T = TypeVar("_T")
_STATUS = struct.Struct(">BBBBIIIBIB4s")
_BOARD, _STATUS_ID, _WRITTEN, _VERSION, _RUNNING, _NODE, _BITRATE = (
    0xF191,
    0xFD00,
    0xFD01,
    0xFD02,
    0xFD03,
    0xFD04,
    0xFD05,
)
_ERASE, _CHECK, _FLOOR = 0xFF00, 0xFF01, 0xF000
_PURPOSE = b"octet challenge\0"
_PROGRAMMING, _CRC_FROM = 2, 16
_BLOCKS = (1024, 128, 32)
"""Bytes of a block: shorter ones where frames are lost."""

_TRIES, _FEW, _ROUNDS = 40, 3, 8
_WAIT_S, _LONG_S, _START_S = 0.3, 5.0, 20.0
_REASONS = {
    1: "it is no image of ours",
    2: "it is for another chip",
    3: "it is for another board",
    4: "it is for another layout of the flash",
    5: "it is for the other slot",
    6: "it is too long for its slot",
    7: "it is older than the board takes; --allow-older lowers that",
    8: "it is not the image that was announced",
    9: "it arrived damaged",
    10: "it is not signed by the key of this board",
    11: "the board could not write its flash",
}
_NOT_NOW, _LOCKED, _WRONG_KEY, _TOO_MANY, _DELAYED = 0x22, 0x33, 0x35, 0x36, 0x37


class UpdateError(RobotError):
    """The board did not take the update, and runs what it ran before; says why."""

    exit_code = 2


@dataclass(frozen=True)
class Status:
    """What a boot loader says of its board.

    Attributes:
        installed: Bit s is set if slot s has a signed image.
        slot: The one that starts.
        trial: 0 if its image is confirmed, else 1 more than its starts so far.
        free: The slot that an update goes to.
        floor: Lowest version that is taken.
        versions: Of what is in the slots; 0 for none.
        reason: Why the last image was refused.
        signer: The begin of the public key.
    """

    installed: int
    slot: int
    trial: int
    free: int
    floor: int
    versions: tuple[int, int]
    reason: int
    signer: bytes


class Updater:
    """Talks to one node."""

    def __init__(self, link: Link, node: int, key: Ed25519PrivateKey) -> None:
        """Says nothing yet.

        Args:
            link: Carries frames to the node and back; the caller closes it.
            node: Its number.
            key: The one whose public half the board has.
        """
        self.node = node
        self._key = key
        config: Any = {  # udsoncan fills in the rest
            "security_algo": lambda level, seed: key.sign(_PURPOSE + seed),  # noqa: ARG005 - udsoncan's names
            "request_timeout": _LONG_S,
            "p2_timeout": _WAIT_S,
            "p2_star_timeout": _LONG_S,
            "use_server_timing": False,
            "data_identifiers": {},
            "standard_version": 2020,
        }
        self._client = Client(IsoTpConnection(link, node), config=config)
        self._client.logger.setLevel("CRITICAL")

    def enter(self) -> None:
        """Has the boot loader run, in a programming session.

        Raises:
            UpdateError: The node does not answer, has no boot loader, or the robot is being driven.
        """
        try:
            self._persist(lambda: self._client.change_session(_PROGRAMMING))
        except TimeoutException:
            raise UpdateError(f"node {self.node} does not answer: it is not there, or has no boot loader") from None
        except NegativeResponseException as error:
            if error.response.code == _NOT_NOW:
                raise UpdateError(f"node {self.node} is being driven: end its run first") from None
            raise

    def unlock(self) -> None:
        """Proves the key.

        Raises:
            UpdateError: It is not the board's.
        """
        try:
            self._persist(lambda: self._client.unlock_security_access(1))
        except NegativeResponseException as error:
            if error.response.code in (_WRONG_KEY, _TOO_MANY):
                raise UpdateError(f"node {self.node} has another key: nothing was changed") from None
            if error.response.code == _DELAYED:
                raise UpdateError(f"node {self.node} was given too many wrong keys: wait for 10 s") from None
            raise

    def board(self) -> str:
        """The name of the board."""
        return self._read(_BOARD).decode("ascii", "replace")

    def status(self) -> Status:
        """What the boot loader says."""
        installed, slot, trial, free, floor, a, b, _, _, reason, signer = _STATUS.unpack(self._read(_STATUS_ID))
        return Status(installed, slot, trial, free, floor, (a, b), reason, signer)

    def lower_floor(self, version: int) -> None:
        """Lets the board take versions from that one on. It must be unlocked."""
        self._persist(lambda: self._client.start_routine(_FLOOR, struct.pack(">I", version)))

    def set_node(self, node: int) -> None:
        """Gives the board another number from its next start on; 0 is that of its build. It must be unlocked."""
        self._write(_NODE, bytes([node]))

    def set_bitrate(self, bitrate: int) -> None:
        """Has the board use another bit rate from its next start on; 0 is that of its build. It must be unlocked."""
        self._write(_BITRATE, struct.pack(">I", bitrate))

    def install(self, image: SlotImage, progress: Callable[[int], None]) -> None:
        """Writes an image to the free slot, and has it chosen. The session must be entered.

        Args:
            image: For that slot.
            progress: Told how many bytes are there.

        Raises:
            UpdateError: The board refuses it.
            TimeoutException: The bus loses too much.
        """
        for number in range(_ROUNDS):
            try:
                return self._install(image, progress, _BLOCKS[min(number, len(_BLOCKS) - 1)])
            except TimeoutException:  # noqa: PERF203 - a round takes seconds
                if number == _ROUNDS - 1:
                    raise
                self.enter()
                self.unlock()
            except NegativeResponseException as error:
                self._explain(error)
        return None

    def restart(self) -> None:
        """Leaves the boot loader."""
        with suppress(TimeoutException):  # it leaves by itself after 5 s, if it did not hear that
            self._client.ecu_reset(1)

    def running(self) -> tuple[int, bool]:
        """Version of the image that runs, and whether it is on trial; waits until one does.

        Raises:
            UpdateError: None does.
        """
        deadline = time.monotonic() + _START_S
        while time.monotonic() < deadline:
            with suppress(TimeoutException):
                version = int.from_bytes(self._read(_VERSION, tries=1), "big")
                return version, bool(self._read(_RUNNING, tries=1)[1])
        raise UpdateError(f"node {self.node}: no image answers after the restart")

    def confirmed(self, version: int) -> int:
        """The version that runs once its trial is over.

        Raises:
            UpdateError: It is not that one, or still on trial.
        """
        runs, trial = self.running()
        deadline = time.monotonic() + _START_S
        while runs == version and trial and time.monotonic() < deadline:
            time.sleep(_WAIT_S)
            runs, trial = self.running()
        if runs != version:
            raise UpdateError(f"node {self.node} went back: version {runs} runs, and not {version}")
        if trial:
            raise UpdateError(f"node {self.node}: version {version} runs, but was not confirmed yet")
        return runs

    def _install(self, image: SlotImage, progress: Callable[[int], None], block: int) -> None:
        client = self._client
        begin = self._written(image)
        self._persist(lambda: client.start_routine(_ERASE, struct.pack(">I", begin) + image.header))
        location = MemoryLocation(begin, len(image.data) - begin, address_format=32, memorysize_format=32)
        self._persist(lambda: client.request_download(location))
        for number, at in enumerate(range(begin, len(image.data), block), 1):
            piece = image.data[at : at + block]
            self._persist(
                partial(client.transfer_data, number & 0xFF, piece), _FEW if block > min(_BLOCKS) else _TRIES
            )
            progress(at + len(piece))
        self._persist(client.request_transfer_exit)
        self._check(image)

    def _check(self, image: SlotImage) -> None:
        """What was said last may have been done, although its answer was lost."""
        try:
            self._persist(lambda: self._client.start_routine(_CHECK), tries=1)
        except (TimeoutException, NegativeResponseException):
            status = self.status()
            done = status.slot == image.slot and status.versions[image.slot] == image.version
            if not (done and status.installed >> image.slot & 1):
                raise

    def _written(self, image: SlotImage) -> int:
        """From where on an interrupted update goes on."""
        count, crc = struct.unpack(">II", self._read(_WRITTEN))
        page = LAYOUTS[image.board].page
        count = min(count, image.size // page * page)
        return count if count and zlib.crc32(image.data[_CRC_FROM:count]) == crc else 0

    def _explain(self, error: NegativeResponseException) -> None:
        reason = _REASONS.get(self.status().reason)
        said = reason or f"its answer is {error.response.code_name}"
        raise UpdateError(f"node {self.node} refuses the image: {said}") from None

    def _read(self, identifier: int, tries: int = _TRIES) -> bytes:
        return self._ask(0x22, identifier, b"", tries)

    def _write(self, identifier: int, value: bytes) -> None:
        self._ask(0x2E, identifier, value, _TRIES)

    def _ask(self, service: int, identifier: int, value: bytes, tries: int) -> bytes:
        request = struct.pack(">BH", service, identifier)

        def ask() -> bytes:
            self._client.conn.empty_rxqueue()
            self._client.conn.send(request + value)
            answer = self._client.conn.wait_frame(timeout=_WAIT_S, exception=True) or b""
            if answer[:3] != bytes([service | 0x40]) + request[1:]:
                raise TimeoutException("an answer to something else")  # type: ignore[no-untyped-call]
            return bytes(answer[3:])

        return self._persist(ask, tries)

    @staticmethod
    def _persist(ask: Callable[[], _T], tries: int = _TRIES) -> _T:
        """Asks again where no answer comes."""
        for _ in range(tries - 1):
            with suppress(TimeoutException, InvalidResponseException, UnexpectedResponseException):
                return ask()
        return ask()


def check_images(images: Mapping[int, SlotImage], board: str) -> None:
    """Refuses an update for another board, before anything is asked of it.

    Raises:
        OctetError: It is for another board.
    """
    wanted = {image.board for image in images.values()}
    if wanted != {board}:
        raise OctetError(f"the image is for {', '.join(sorted(wanted))}, not for {board}: nothing was changed")
