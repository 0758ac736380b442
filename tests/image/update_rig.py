"""What the tests of updates share: a board that starts through its boot loader, and images for it."""

import time
from collections import deque
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cache
from random import Random

from host_sim.backends.images import BOARDS
from host_sim.base.frame import Frame
from host_sim.base.paths import BUILD
from host_sim.emulator.board import EmulatedBoard, Slots, start_board
from host_sim.emulator.chips import CHIPS
from host_sim.emulator.hardware import Faults
from host_sim.transport.link import Link
from host_sim.update.image import LAYOUTS, Layout, SlotImage, built_images
from host_sim.update.keys import development_key
from host_sim.update.updater import Updater

OLD, NEW = 1000, 1001
KEY = development_key()


@dataclass(frozen=True)
class Rig:
    """Updates of one kind of board."""

    board: str

    @property
    def layout(self) -> Layout:
        return LAYOUTS[self.board]

    @property
    def store(self) -> tuple[int, int]:
        """Where the memory is kept: begin and end."""
        return {"feather_stm32f405": (0x4000, 0xC000), "nucleo_g431rb": (0x1F000, 0x20000)}.get(
            self.board, (0xF800, 0x10000)
        )

    @property
    def span(self) -> tuple[int, int]:
        """Where the slots are: begin and end."""
        return self.layout.slots[0], self.layout.slots[1] + self.layout.slot_bytes

    def images(self, version: int) -> list[SlotImage]:
        return _images(self.board, version)

    def board_with(self, *parts: tuple[int, bytes], faults: Faults | None = None) -> EmulatedBoard:
        """A board with a boot loader, and these bytes at these offsets of its flash."""
        boot = BUILD / self.board / f"octet-{self.board}-{self.layout.link}-boot.elf"
        return EmulatedBoard(CHIPS[self.board], boot, faults, slots=Slots(self.span, parts))

    def fresh_board(self, faults: Faults | None = None) -> EmulatedBoard:
        """As a probe leaves it: the old image in slot A."""
        return start_board(self.board, faults, boot=True, version=OLD)

    def runs_in(self, board: EmulatedBoard) -> int | None:
        """The slot of the image that runs; None for the boot loader."""
        at = board.hardware.core.vectors - 0x08000000
        return next((slot for slot in (1, 0) if at >= self.layout.slots[slot]), None)

    def put_on(self, board: EmulatedBoard, version: int) -> Updater:
        """Enters the boot loader and installs a version; the boot loader still runs."""
        tester = Updater(board, 1, KEY)
        tester.enter()
        tester.unlock()
        tester.install(self.images(version)[tester.status().free], lambda _count: None)
        return tester


@cache
def _images(board: str, version: int) -> list[SlotImage]:
    return built_images(board, LAYOUTS[board].link, version, KEY)


RIGS = [Rig(board) for board in BOARDS]
BLUE_PILL = Rig("blue_pill")


class Crowd:
    """Several boards on one bus. Their time passes together, and never faster than the wall clock."""

    def __init__(self, boards: Iterable[EmulatedBoard]) -> None:
        self._boards = list(boards)
        self._said: deque[Frame] = deque()

    def send(self, frame: Frame) -> None:
        for board in self._boards:
            board.send(frame)

    def receive(self, timeout_s: float) -> Frame | None:
        began = time.monotonic()
        if not self._said:
            for board in self._boards:
                self._said.extend(board.pass_time(timeout_s))
        if self._said:
            return self._said.popleft()
        time.sleep(max(timeout_s - (time.monotonic() - began), 0.0))
        return None

    def close(self) -> None:
        self._said.clear()


class LossyLink:
    """Loses frames, both ways."""

    def __init__(self, board: Link, share: float, seed: int) -> None:
        self._board, self._share, self._random = board, share, Random(seed)

    def send(self, frame: Frame) -> None:
        if self._random.random() >= self._share:
            self._board.send(frame)

    def receive(self, timeout_s: float) -> Frame | None:
        frame = self._board.receive(timeout_s)
        return None if self._random.random() < self._share else frame

    def close(self) -> None:
        self._board.close()


def written(board):
    """Writes and erases of the flash so far, and a copy of it."""
    flash = board.hardware.flash
    return flash.operations, bytes(flash.memory)
