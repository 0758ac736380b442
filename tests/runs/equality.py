"""Compares the firmware's frames on the host with those of the flash images, byte for byte."""

from collections.abc import Iterator, Sequence
from itertools import zip_longest
from pathlib import Path
from typing import NamedTuple

from host_sim.client.frame_log import FrameLog
from host_sim.lab.bench.short_run import run_ticks
from host_sim.sim.access import BOARDS
from host_sim.sim.run_config import RunConfig

REFERENCE = "host"
"""The firmware built for the host, in this process: the reference for the images."""

IMAGES = ("qemu", *BOARDS)
"""The machines on which the flash images run."""


class Verdict(NamedTuple):
    """The comparison of one run with the reference.

    Attributes:
        seed: The run's seed.
        where: One of `IMAGES`.
        difference: The first line that differs, as text; None if all frames are the same.
    """

    seed: int
    where: str
    difference: str | None


def record(where: str, seed: int, ticks: int, log: Path, profile: str = "article") -> None:
    """Records the frames of a run on the `REFERENCE`, or on one of the `IMAGES`.

    Raises:
        OctetError: The robot cannot be started there, or it fails.
    """
    robots = {REFERENCE: "spawn", **dict.fromkeys(BOARDS, "emulated")}
    board = where if where in BOARDS else ""
    config = RunConfig(seed=seed, profile=profile, robot=robots.get(where, where), board=board)
    run_ticks(config, ticks, FrameLog(log))


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
    """Compares runs on the host and on images; yields a verdict for each seed and image.

    The logs of the reference, and of runs that differ, stay in the folder.

    Raises:
        OctetError: As for `record`.
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
