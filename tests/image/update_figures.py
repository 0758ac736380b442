"""Prints what an update of an emulated board takes, and the start through its boot loader.

    .venv/bin/python -m tests.image.update_figures
    .venv/bin/python -m tests.image.update_figures --board nucleo_g431rb

Times are the board's. "bus" is what the frames take on the bus by themselves; "limit" is all of the update divided by
that, and "without flash" the same where erase and check do not count, during which the chip receives nothing.
"""

import argparse
import sys
from dataclasses import dataclass

from host_sim.base.frame import Frame
from host_sim.base.paths import image_path
from host_sim.emulator.board import EmulatedBoard
from host_sim.protocol.frame_bits import frame_bits
from host_sim.protocol.generated import UPDATE_REQUEST_ID
from host_sim.update.updater import Updater
from tests.image.update_rig import KEY, NEW, RIGS, Rig

_BITRATE = 500_000
_LOOK_S = 0.0005
_DONE, _PROVEN = b"\x05\x71\x01\xff", b"\x02\x67\x02"
"""How the answers begin of a routine, and to a proof, which is a signature."""


@dataclass(frozen=True)
class Figures:
    """Of one board; times in s.

    Attributes:
        start_s: From power-up to the image.
        update_s: From the first request to the answer that the image is chosen.
        erase_s: Of that, until the slot is erased.
        check_s: And until the image is checked.
        proof_s: What a signature of 32 bytes takes.
        bus_s: What all frames take.
        changes: Writes and erases of the flash.
        boot_bytes: Size of the boot loader.
        image_bytes: And of the image, with header and signature.
    """

    start_s: float
    update_s: float
    erase_s: float
    check_s: float
    proof_s: float
    bus_s: float
    changes: int
    boot_bytes: int
    image_bytes: int

    @property
    def limit(self) -> float:
        """How many times as long as its frames the update takes."""
        return self.update_s / self.bus_s

    @property
    def limit_without_flash(self) -> float:
        """The same without the time in which the chip receives nothing."""
        return (self.update_s - self.erase_s - self.check_s) / self.bus_s


class TimedLink:
    """A link to a board that notes when which frame was sent or came."""

    def __init__(self, board: EmulatedBoard) -> None:
        self._board, self.now = board, board.now
        self.frames: list[tuple[float, Frame]] = []

    def send(self, frame: Frame) -> None:
        self.frames.append((self.now(), frame))
        self._board.send(frame)

    def receive(self, timeout_s: float) -> Frame | None:
        frame = self._board.receive(timeout_s)
        if frame is not None:
            self.frames.append((self.now(), frame))
        return frame

    def close(self) -> None:
        self._board.close()

    def worked_s(self, answer: bytes) -> list[float]:
        """How long each answer that begins so took after the last frame that was sent."""
        asked_s, spans = 0.0, []
        for at, frame in self.frames:
            if frame.id > UPDATE_REQUEST_ID:
                asked_s = at
            elif frame.data.startswith(answer):
                spans.append(at - asked_s)
        return spans


def start_s_of(rig: Rig, board: EmulatedBoard) -> float:
    """From power-up until the image runs."""
    board.cut_power()
    began = board.now()
    while rig.runs_in(board) is None:
        board.pass_time(_LOOK_S)
    return board.now() - began


def figures_of(rig: Rig) -> Figures:
    """Starts a board, and updates it."""
    board = rig.fresh_board()
    start_s = start_s_of(rig, board)
    board.pass_time(0.2)
    flash, link = board.hardware.flash, TimedLink(board)
    changes, began, tester = flash.operations, board.now(), Updater(link, 1, KEY)
    tester.enter()
    tester.unlock()
    image = rig.images(NEW)[tester.status().free]
    tester.install(image, lambda _count: None)
    erase_s, check_s = link.worked_s(_DONE)
    return Figures(
        start_s,
        board.now() - began,
        erase_s,
        check_s,
        max(link.worked_s(_PROVEN)),
        sum(frame_bits(frame) for _, frame in link.frames) / _BITRATE,
        flash.operations - changes,
        image_path(rig.board, f"{rig.layout.link}-boot").with_suffix(".bin").stat().st_size,
        len(image.data),
    )


def main() -> int:
    """Prints a line for each board."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    boards = [rig.board for rig in RIGS]
    parser.add_argument("--board", choices=boards, help="which (default: all)")
    chosen = parser.parse_args().board
    for board in [chosen] if chosen else boards:
        it = figures_of(Rig(board))
        sys.stdout.write(
            f"{board}: start {1000 * it.start_s:.0f} ms; {it.image_bytes:,} bytes in {it.update_s:.2f} s: "
            f"bus {it.bus_s:.2f} s, erase {it.erase_s:.2f} s, check {it.check_s:.2f} s, "
            f"signature {1000 * it.proof_s:.0f} ms; "
            f"limit {it.limit:.1f}, without flash {it.limit_without_flash:.1f}; "
            f"{it.changes:,} writes and erases; boot loader {it.boot_bytes:,} bytes\n"
        )
        sys.stdout.flush()
    return 0


if __name__ == "__main__":
    sys.exit(main())
