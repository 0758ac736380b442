"""Whether one and the same firmware does the same everywhere: every frame of it, byte for byte."""

from collections.abc import Iterator, Sequence
from itertools import zip_longest
from pathlib import Path
from typing import NamedTuple

from host_sim.backends.images import BOARDS
from host_sim.bench.short_run import run_ticks
from host_sim.client.frame_log import FrameLog
from host_sim.sim.run_config import RunConfig

REFERENCE = "host"
"""The firmware built for the host, in this process: what the others are held against."""

IMAGES = ("qemu", *BOARDS)
"""Where the images that are flashed run."""


class Verdict(NamedTuple):
    """How one run compares with the reference's.

    Attributes:
        seed: The run's.
        where: One of `IMAGES`.
        difference: None if all frames are the same; else the first line that is not, for people.
    """

    seed: int
    where: str
    difference: str | None


def record(where: str, seed: int, ticks: int, log: Path) -> None:
    """Records a run.

    Args:
        where: `REFERENCE`, or one of `IMAGES`.
        seed: Of environments and random turns.
        ticks: Its length.
        log: The file for its frames.

    Raises:
        OctetError: The robot cannot be had there, or it fails.
    """
    robots = {REFERENCE: "spawn", **dict.fromkeys(BOARDS, "emulated")}
    board = where if where in BOARDS else ""
    run_ticks(RunConfig(seed=seed, robot=robots.get(where, where), board=board), ticks, FrameLog(log))


def first_difference(reference: Path, other: Path) -> str | None:
    """The first line in which two logs differ; None if there is none."""
    if reference.read_bytes() == other.read_bytes():
        return None
    lines = (path.read_text(encoding="ascii").splitlines() for path in (reference, other))
    for number, (ours, theirs) in enumerate(zip_longest(*lines, fillvalue="(end)"), start=1):
        if ours != theirs:
            return f"line {number}: {ours} on the {REFERENCE}, {theirs} in {other.name}"
    return "only the ends of lines differ"


def compare(seeds: Sequence[int], ticks: int, folder: Path, images: Sequence[str] = IMAGES) -> Iterator[Verdict]:
    """Compares runs on the host and on images.

    Args:
        seeds: One run each.
        ticks: Length of each.
        folder: For the logs; that of the reference and of a run that differs are left there.
        images: Some of `IMAGES`.

    Yields:
        A verdict for each seed and image.

    Raises:
        OctetError: As `record`.
    """
    for seed in seeds:
        reference = folder / f"{REFERENCE}-{seed}.log"
        record(REFERENCE, seed, ticks, reference)
        for where in images:
            log = folder / f"{where}-{seed}.log"
            record(where, seed, ticks, log)
            verdict = Verdict(seed, where, first_difference(reference, log))
            if verdict.difference is None:
                log.unlink()
            yield verdict
