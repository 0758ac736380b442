"""Updates one robot, as in docs/update.md: repeats what is lost, and resumes where it stopped."""

import struct
import time
import zlib
from collections.abc import Callable, Mapping
from contextlib import suppress
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

from host_sim.base.errors import OctetError
from host_sim.transport.link import Link
from host_sim.update.image import LAYOUTS, SlotImage
from host_sim.update.isotp_connection import IsoTpConnection
from host_sim.update.keys import Ed25519PrivateKey
from host_sim.update.status import REASONS, Status, UpdateError

_T = TypeVar("_T")
_BOARD = 0xF191
_STATUS_ID, _WRITTEN, _VERSION, _RUNNING, _NODE, _BITRATE = range(0xFD00, 0xFD06)
_ERASE, _CHECK, _FLOOR = 0xFF00, 0xFF01, 0xF000
_PURPOSE = b"octet challenge\0"
_PROGRAMMING, _CRC_FROM = 2, 16
_BLOCKS = (1024, 128, 32)
"""Block sizes, bytes: shorter blocks if frames are lost."""

_TRIES, _FEW, _ROUNDS = 40, 3, 8
_QUICK_S, _WAIT_S, _WAIT_S_MAX, _LONG_S, _START_S = 0.1, 0.3, 1.0, 5.0, 20.0
_UNUSED = (0xBA, 0xBB, 0xBC, 0xBD, 0xBE, 0xBA, 0xBB, 0xBC, 0xBD, 0xBE)
"""Services that no board supports: the number of refusals is the number of boards."""

_NOT_NOW, _OUT_OF_RANGE, _LOCKED, _WRONG_KEY = 0x22, 0x31, 0x33, 0x35
_TOO_MANY, _DELAYED, _NO_SESSION = 0x36, 0x37, 0x7F


class Updater:
    """Talks to one node."""

    def __init__(self, link: Link, node: int, key: Ed25519PrivateKey) -> None:
        """Creates an updater; nothing is sent yet.

        Args:
            link: Carries frames to the node and back; the caller closes it.
            node: Number of the node.
            key: The key whose public half the board has.
        """
        self.node = node
        config: Any = {  # udsoncan fills in the rest
            "security_algo": lambda level, seed: key.sign(_PURPOSE + seed),  # noqa: ARG005 - udsoncan's names
            "request_timeout": _LONG_S,
            "p2_timeout": _WAIT_S,
            "p2_star_timeout": _LONG_S,
            "use_server_timing": False,
            "data_identifiers": {},
            "standard_version": 2020,
        }
        self._connection = IsoTpConnection(link, node)
        self._client = Client(self._connection, config=config)
        self._client.logger.setLevel("CRITICAL")

    def enter(self) -> None:
        """Starts the boot loader in a programming session.

        Raises:
            UpdateError: No board answers, or two do, or the robot is being driven.
        """
        self._find()
        try:
            self._persist(lambda: self._client.change_session(_PROGRAMMING))
        except NegativeResponseException as error:
            if error.response.code == _NOT_NOW:
                raise UpdateError(f"node {self.node} is being driven: end its run first") from None
            raise

    def _find(self) -> None:
        for service in _UNUSED:
            count = self._connection.answers(service, _WAIT_S)
            if count > 1:
                raise UpdateError(f"{count} boards answer as node {self.node}: leave one of them on the bus")
            if count == 1:
                return
        raise UpdateError(f"node {self.node} does not answer: it is off the bus, or has no boot loader")

    def unlock(self, again: int = _ROUNDS) -> None:
        """Authenticates with the key.

        Raises:
            UpdateError: It is not the board's key.
        """
        try:
            self._persist(lambda: self._client.unlock_security_access(1))
        except NegativeResponseException as error:
            if error.response.code in (_WRONG_KEY, _TOO_MANY):
                raise UpdateError(f"node {self.node} has another key: nothing was changed") from None
            if error.response.code == _NO_SESSION and again:
                self.enter()  # it ended meanwhile
                self.unlock(again - 1)
                return
            if error.response.code == _DELAYED:
                raise UpdateError(f"node {self.node} was given too many wrong keys: wait for 10 s") from None
            raise

    def board(self) -> str:
        """The name of the board."""
        return self._read(_BOARD).decode("ascii", "replace")

    def status(self) -> Status:
        """Requests the boot loader's status."""
        return Status.unpack(self._read(_STATUS_ID))

    def lower_floor(self, version: int) -> None:
        """Lets the board accept versions from that one on. It must be unlocked."""
        self._persist(lambda: self._client.start_routine(_FLOOR, struct.pack(">I", version)))

    def set_node(self, node: int) -> None:
        """Gives the board another number from its next start on; 0 is that of its build. It must be unlocked."""
        self._write(_NODE, bytes([node]))

    def set_bitrate(self, bitrate: int) -> None:
        """Has the board use another bit rate from its next start on; 0 is that of its build. It must be unlocked."""
        self._write(_BITRATE, struct.pack(">I", bitrate))

    def install(self, image: SlotImage, progress: Callable[[int], None]) -> None:
        """Writes an image to the free slot and selects it; `progress` gets the bytes written. Call `enter` first.

        Raises:
            UpdateError: The board refuses it.
            TimeoutException: The bus loses too many frames.
        """
        for number in range(_ROUNDS):
            try:
                return self._install(image, progress, _BLOCKS[min(number, len(_BLOCKS) - 1)])
            except (TimeoutException, NegativeResponseException) as error:  # noqa: PERF203 - a round takes seconds
                if isinstance(error, NegativeResponseException) and not self._may_go_on(error.response.code):
                    self._explain(error)
                if number == _ROUNDS - 1:
                    raise
                self.enter()
                self.unlock()
        return None

    def restart(self) -> None:
        """Leaves the boot loader."""
        with suppress(TimeoutException, NegativeResponseException):  # 5 s later it does so by itself
            self._persist(lambda: self._client.ecu_reset(1), tries=_FEW)

    def running(self) -> tuple[int, bool]:
        """Version of the running image, and whether it is on trial; waits until one runs.

        Raises:
            UpdateError: No image runs.
        """
        deadline = self._connection.now() + _START_S
        while self._connection.now() < deadline:
            with suppress(TimeoutException):
                version = int.from_bytes(self._read(_VERSION, tries=1), "big")
                return version, bool(self._read(_RUNNING, tries=1)[1])
        raise UpdateError(f"node {self.node}: no image answers after the restart")

    def confirmed(self, version: int) -> int:
        """The version that runs once its trial is over.

        Raises:
            UpdateError: It is another version, or still on trial.
        """
        runs, trial = self.running()
        deadline = self._connection.now() + _START_S
        while runs == version and trial and self._connection.now() < deadline:
            time.sleep(_WAIT_S)
            runs, trial = self.running()
        if runs != version:
            raise UpdateError(f"node {self.node} rolled back: version {runs} runs, and not {version}")
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
            ask = partial(client.transfer_data, number & 0xFF, piece)
            self._persist(ask, *((_FEW, _WAIT_S) if block > min(_BLOCKS) else (_TRIES, _QUICK_S)))
            progress(at + len(piece))
        self._persist(client.request_transfer_exit)
        self._check(image)

    def _check(self, image: SlotImage) -> None:
        """Checks the image. The last request may have been carried out although its answer was lost."""
        try:
            self._persist(lambda: self._client.start_routine(_CHECK), tries=1)
        except (TimeoutException, NegativeResponseException):
            status = self.status()
            done = status.slot == image.slot and status.versions[image.slot] == image.version
            if not (done and status.installed >> image.slot & 1):
                raise

    def _written(self, image: SlotImage) -> int:
        """The offset at which an interrupted update resumes."""
        count, crc = struct.unpack(">II", self._read(_WRITTEN))
        page = LAYOUTS[image.board].page
        count = min(count, image.size // page * page)
        return count if count and zlib.crc32(image.data[_CRC_FROM:count]) == crc else 0

    def _may_go_on(self, code: int | None) -> bool:
        """Whether another round may help: the session ended, or less is written than expected."""
        return code in (_NO_SESSION, _LOCKED) or (code == _OUT_OF_RANGE and not self.status().reason)

    def _explain(self, error: NegativeResponseException) -> None:
        reason = REASONS.get(self.status().reason)
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
            answer = self._client.conn.wait_frame(timeout=self._client.config["p2_timeout"], exception=True) or b""
            if answer[:3] != bytes([service | 0x40]) + request[1:]:
                raise TimeoutException("an answer to something else")  # type: ignore[no-untyped-call]
            return bytes(answer[3:])

        return self._persist(ask, tries)

    def _persist(self, ask: Callable[[], _T], tries: int = _TRIES, wait_s: float = _WAIT_S) -> _T:
        """Repeats an unanswered request, and waits longer for the answer after a few attempts."""
        for number in range(tries):
            self._client.config["p2_timeout"] = min(wait_s * 2 ** (number // _FEW), _WAIT_S_MAX)
            if number == tries - 1:
                break
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
