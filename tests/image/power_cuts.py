"""Cuts an emulated board's power at each write and erase of its flash in an update, and in recoveries from such cuts.

    .venv/bin/python -m tests.image.power_cuts
    .venv/bin/python -m tests.image.power_cuts --board nucleo_g431rb --recoveries 40 --jobs 8

Says after how many of them which image started, and how many left the board without one or without its memory; the
exit code is 1 if any did. The recoveries are those from cuts that are spread evenly over the update.
"""

import argparse
import sys
from collections import Counter
from collections.abc import Callable, Iterable
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, field
from functools import partial

from host_sim.emulator.board import EmulatedBoard
from host_sim.emulator.flash_kinds import FlashG4
from tests.image.support import Talk
from tests.image.update_rig import NEW, RIGS, Rig

WRITE_MAX = 8
"""Bytes of the longest write."""
LESSON = {"mask": 0b1111, "half": 0, "byte_0": 0, "byte_1": 1, "byte_2": 0, "byte_3": 0}
_START_S, _LOOK_S = 0.1, 0.005


@dataclass
class Recording:
    """What was done to a flash: its bytes before; of each change place, bytes after, and bytes if it was cut.

    And what cuts have left when a change begins: pages that are half erased, places that are unreadable.
    """

    rig: Rig
    before: bytes = b""
    changes: list[tuple[int, bytes, bytes]] = field(default_factory=list)
    left: list[tuple[set[int], set[int]]] = field(default_factory=list)

    def cut_at(self, number: int) -> bytes:
        """The flash as it is if the power fails within that change."""
        memory = bytearray(self.before)
        for offset, whole, _ in self.changes[:number]:
            memory[offset : offset + len(whole)] = whole
        offset, _, partial_ = self.changes[number]
        memory[offset : offset + len(partial_)] = partial_
        return bytes(memory)

    def cut(self, board: EmulatedBoard, number: int) -> bytes:
        """Gives a board the flash as it is if the power fails within that change; returns its bytes."""
        flash, memory = board.hardware.flash, self.cut_at(number)
        offset, whole, _ = self.changes[number]
        half_erased, unreadable = self.left[number]
        flash.memory[:] = memory
        flash._half_erased = set(half_erased)
        if isinstance(flash, FlashG4):
            flash.unreadable = set(unreadable)
        flash.changed(offset, len(whole), cut=True)
        return memory


def recording_of(rig: Rig, board: EmulatedBoard, work: Callable[[EmulatedBoard], None]) -> Recording:
    """Has that work done, and notes all changes of the board's flash."""
    flash = board.hardware.flash
    found = Recording(rig, bytes(flash.memory))
    change = flash._change

    def recorded(offset: int, whole: bytes, partial_: bytes) -> None:
        found.changes.append((offset, whole, partial_))
        found.left.append((set(flash._half_erased), set(getattr(flash, "unreadable", ()))))
        change(offset, whole, partial_)

    flash._change = recorded  # type: ignore[method-assign]
    work(board)
    return found


def update_to_the_end(rig: Rig, board: EmulatedBoard) -> None:
    """To the new image, until that is confirmed."""
    updater = rig.put_on(board, NEW)
    updater.restart()
    updater.running()
    board.pass_time(6.0)
    assert updater.running() == (NEW, False)


def recording_of_an_update(rig: Rig) -> Recording:
    """On a board that has learned something."""
    board = rig.fresh_board()
    talk = Talk(board)
    talk.order("write", **LESSON)
    talk.wait(0.2)
    return recording_of(rig, board, partial(update_to_the_end, rig))


def restarted(rig: Rig, memory: bytes) -> EmulatedBoard:
    """A board with that flash."""
    return rig.board_with((rig.layout.boot, memory[rig.layout.boot :]))


def slot_after(rig: Rig, board: EmulatedBoard, memory: bytes) -> int | None:
    """The slot of the image that starts on a board with that flash, if one does and the memory is as it was."""
    begin, store_end = rig.store
    board.cut_power()
    end = board.now() + _START_S
    while rig.runs_in(board) is None and board.now() < end:
        board.pass_time(_LOOK_S)
    return rig.runs_in(board) if board.hardware.flash.memory[begin:store_end] == memory[begin:store_end] else None


def slots_after(recording: Recording, cuts: Iterable[int]) -> list[int | None]:
    """The same after each of these cuts."""
    board = restarted(recording.rig, recording.before)
    return [slot_after(recording.rig, board, recording.cut(board, number)) for number in cuts]


def _all_slots(recording: Recording, pool: ProcessPoolExecutor, parts: int) -> Counter[int | None]:
    count = len(recording.changes)
    found = pool.map(partial(slots_after, recording), (range(part, count, parts) for part in range(parts)))
    return Counter(slot for slots in found for slot in slots)


def _said(what: str, slots: Counter[int | None]) -> str:
    return (
        f"{what}: {slots.total():,} cuts, {slots[0]:,} start the old image, {slots[1]:,} the new one, "
        f"{slots[None]:,} none or without the memory\n"
    )


def main() -> int:
    """Cuts them all."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    boards = [rig.board for rig in RIGS]
    parser.add_argument("--board", choices=boards, default=boards[0], help="which board (default: %(default)s)")
    parser.add_argument("--recoveries", type=int, default=4, metavar="N", help="recoveries to cut, too (default: 4)")
    parser.add_argument("--jobs", type=int, default=2, metavar="N", help="processes (default: 2)")
    arguments = parser.parse_args()
    rig = Rig(arguments.board)
    update = recording_of_an_update(rig)
    bricks = 0
    with ProcessPoolExecutor(arguments.jobs) as pool:
        slots = _all_slots(update, pool, arguments.jobs)
        sys.stdout.write(_said("an update", slots))
        bricks += slots[None]
        for number in range(arguments.recoveries):
            cut = (2 * number + 1) * len(update.changes) // (2 * arguments.recoveries)
            board = restarted(rig, update.before)
            update.cut(board, cut)
            board.cut_power()
            board.pass_time(_START_S)
            recovery = recording_of(rig, board, partial(update_to_the_end, rig))
            slots = _all_slots(recovery, pool, arguments.jobs)
            sys.stdout.write(_said(f"the recovery from cut {cut:,}", slots))
            bricks += slots[None]
    return 1 if bricks else 0


if __name__ == "__main__":
    sys.exit(main())
