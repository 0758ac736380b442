"""Runs that are ended in every way, and whether what was learned last is in the memory file.

`.venv/bin/python -m tests.runs.endurance.kills 500` kills 500 runs at any Python instruction, half of them while the
file is written; ends 50 runs each by SIGTERM, SIGHUP and SIGINT; fills the disk up at any byte; loses what is sent to
the robot from any frame on, closing commands included; and starts 50 pairs of runs into one folder. The exit code is
1 if anything that was learned is lost. A sample is among the tests.
"""

import argparse
import json
import signal
import sys
from collections.abc import Iterator
from pathlib import Path
from random import Random
from tempfile import TemporaryDirectory
from typing import NamedTuple

from tests.runs.endurance.interrupted_runs import Outcome, Witness, at_instruction, run_interrupted, with_full_disk
from tests.runs.support import octet, start_octet, unpacked

SIGNALS = (signal.SIGTERM, signal.SIGHUP, signal.SIGINT)
USAGE = 2


class Tally(NamedTuple):
    """One way to end runs: how many there were, how many lost something, and the first of those."""

    name: str
    runs: int
    lost: int
    example: str

    def __str__(self) -> str:
        return f"{self.name:34} {self.runs:5} runs, {self.lost} lost{self.example and ': '}{self.example}"


def tally(name: str, fates: Iterator[tuple[str, bool]]) -> Tally:
    """Counts fates: what happened, and whether all was well."""
    ends = list(fates)
    bad = [what for what, is_well in ends if not is_well]
    return Tally(name, len(ends), len(bad), bad[0] if bad else "")


def undisturbed(folder: Path) -> Witness:
    """A run that nothing happens to."""
    witness = Witness()
    outcome = run_interrupted(folder, at_instruction(0, 0, witness), witness)
    assert (outcome.status, outcome.errors) == (0, ""), outcome.errors
    assert witness.saves > 2, "a run that learns nothing shows nothing"
    return witness


def told(what: str, outcome: Outcome) -> str:
    """What happened, for a person."""
    memories = f"{outcome.memory.hex(' ')}, not {outcome.witness.last.hex(' ')}"
    return f"{what}: {memories} (exit code {outcome.status}) {outcome.errors[-100:]!r}"


def kills(folder: Path, count: int, whole: Witness, dice: Random) -> Iterator[tuple[str, bool]]:
    """SIGKILL at any instruction."""
    for _ in range(count):
        witness, number = Witness(), dice.randrange(1, whole.instructions)
        outcome = run_interrupted(folder, at_instruction(number, signal.SIGKILL, witness), witness)
        yield told(f"killed at instruction {number}", outcome), outcome.status == -signal.SIGKILL and outcome.is_kept


def kills_in_saving(folder: Path, count: int, whole: Witness, dice: Random) -> Iterator[tuple[str, bool]]:
    """SIGKILL at any instruction of those that write the file."""
    for _ in range(count):
        witness, number = Witness(), dice.randrange(1, whole.saving)
        outcome = run_interrupted(folder, at_instruction(number, signal.SIGKILL, witness, only_saving=True), witness)
        yield (
            told(f"killed at instruction {number} of saving", outcome),
            outcome.status == -signal.SIGKILL and outcome.is_kept,
        )


def signals(folder: Path, number: signal.Signals, whens: list[int]) -> Iterator[tuple[str, bool]]:
    """A signal at some instructions: the run ends in order."""
    for at in whens:
        witness = Witness()
        outcome = run_interrupted(folder, at_instruction(at, number, witness), witness)
        is_well = outcome.memory == witness.last and outcome.is_orderly and outcome.status in (0, 128 + number)
        yield told(f"{number.name} at instruction {at}", outcome), is_well


def full_disks(folder: Path, count: int, most: int, dice: Random) -> Iterator[tuple[str, bool]]:
    """A disk that is full at any byte of any file. What does not fit is said, and what was there stays."""
    for size in [most - 1, *range(9), *(dice.randrange(9, most) for _ in range(count))][:count]:
        witness = Witness()
        outcome = run_interrupted(folder, with_full_disk(size), witness)
        expected = witness.saved if size < len(witness.saved) else witness.last
        is_well = outcome.memory == expected and outcome.status == 1 and outcome.is_orderly
        yield told(f"disk full at byte {size}", outcome), is_well


def lost_commands(folder: Path, count: int, dice: Random) -> Iterator[tuple[str, bool]]:
    """Nothing that is sent arrives any more, from a frame on. The last frames are the closing commands."""
    last = json.loads((folder / "out/summary.json").read_text())["robots"][0]["frames"]["sent"]
    for number in [last, last - 1, *(dice.randrange(1, last) for _ in range(count))][:count]:
        witness = Witness()
        outcome = run_interrupted(folder, lambda: None, witness, "--fault", f"drop@{number}-/to")
        is_well = outcome.memory == witness.last and outcome.status == 1 and outcome.is_orderly
        yield told(f"frames lost from {number} on", outcome), is_well


def pairs(folder: Path, count: int, dice: Random) -> Iterator[tuple[str, bool]]:
    """Two runs at once in one folder: one of them writes it, the other one says so and goes."""
    for _ in range(count):
        seeds = dice.sample(range(1, 100), 2)
        words = ("--environments", "1", "--limit-s", "3", "--bus", "none", "--quiet", "--out", folder / "both")
        both = [start_octet("run", *words, "--seed", str(seed)) for seed in seeds]
        errors = [process.communicate()[1] for process in both]
        codes = [process.returncode for process in both]
        one_was_refused = sorted(codes) == [0, USAGE] and "is in use by another run" in "".join(errors)
        is_well = (one_was_refused or codes == [0, 0]) and is_of_one_run(folder / "both", seeds)
        yield f"seeds {seeds}: exit codes {codes} {''.join(errors)}", is_well


def is_of_one_run(out: Path, seeds: list[int]) -> bool:
    """Whether log, world, summary and page are whole and belong together."""
    summary = json.loads((out / "summary.json").read_text())
    world = json.loads((out / "run.world.json").read_text())
    page = f'"seed {summary["seed"]}"' in unpacked((out / "replay.html").read_text())
    is_one = summary["seed"] == world["seed"] and summary["seed"] in seeds and page
    return is_one and octet("replay", out / "run.log").returncode == 0 and not list(out.glob("*.part"))


def every_way(folder: Path, count: int, seed: int = 1) -> Iterator[Tally]:
    """All of them; each but the kills a tenth as often."""
    dice, some, whole = Random(seed), max(count // 10, 1), undisturbed(folder)
    sizes = [path.stat().st_size for path in (folder / "out").iterdir()]
    yield tally("commands lost from any frame on", lost_commands(folder, 2 * some, dice))
    yield tally("disk full at any byte", full_disks(folder, 4 * some, max(sizes), dice))
    yield tally("SIGKILL at any instruction", kills(folder, count - count // 2, whole, dice))
    yield tally("SIGKILL while the file is written", kills_in_saving(folder, count // 2, whole, dice))
    for number in SIGNALS:
        whens = [dice.randrange(1, whole.instructions) for _ in range(some)]
        yield tally(f"{number.name} at any instruction", signals(folder, number, whens))
    yield tally("two runs at once in one folder", pairs(folder, some, dice))


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("count", type=int)
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    lost = 0
    with TemporaryDirectory() as folder:
        for each in every_way(Path(folder), arguments.count, arguments.seed):
            sys.stdout.write(f"{each}\n")
            sys.stdout.flush()
            lost += each.lost
    return int(lost > 0)


if __name__ == "__main__":
    sys.exit(main())
