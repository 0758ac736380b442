"""A run as one HTML page that needs no server.

The page is that of octet_page.py; its element `run` has the run.

The run is one object. Measures, EnvironmentScene, State, Trial and Lesson are as in recording/state_types.py. The
value in a pair holds from the pair's tick until that of the next pair; the first pair is that of tick `first_tick`.

    version      3
    title        the page's title, such as "seed 7, 3 environments"
    measures     Measures
    first_tick   the first tick on the page; 0 except for very long runs, of which it shows the last part
    ticks        number of ticks
    shown        the tick at which the page opens; it may be left out
    log          the words that name its log to `tools/octet debug`; they may be left out
    scenes       [[tick, EnvironmentScene], ...]: one for each environment and for each change of it by a person
    news         [[tick, sentence], ...]: changes of the world and the bodies
    eaten        [[tick, [0 or 1 for each piece of the scene's food]], ...]
    robots       one object per robot, in the order of their nodes:
        node         its node number on the bus
        memory       [[tick, [8 cells]], ...]
        trials       [[tick, Trial or null], ...]: State.trial
        lessons      [Lesson, ...]: before first_tick the last one of each cell, and none after the last tick
        cells        [[tick, cell, uses, learned, by_hand], ...]: the fields of State for a cell, from that tick on
        events       [[tick, kind], ...], in order: kind is "environment", "change", "trial", "lesson", "boredom" or
                     "eat"
        columns      the names of the columns, in the order of the data
        data         base64 of a zlib stream (DecompressionStream "deflate") of the columns

A column has one whole number for each tick, the field of that name in the tick's State. x and y are in 0.1 mm,
heading is in mrad:

    x y heading lifted feel bump beacon left right reason repeat_count action pattern frozen

Two are stored so that they seldom change: `right` as the sum of left and right, and `heading` less the sum of
(left - right) >> 3 up to its tick, which is nearly what the wheels turn the robot by.

A column is stored as its differences, the first from 0, each zigzag-encoded (0, -1, 1, -2, ... is 0, 1, 2, 3, ...)
as a 32-bit number, in planes: the low bytes of all `ticks` differences, then the next higher bytes, and so on. In
JavaScript, with the inflated bytes b, column c, n ticks and value = 0 before the first:

    const low = 4 * c * n;
    const z = b[low + i] | b[low + n + i] << 8 | b[low + 2 * n + i] << 16 | b[low + 3 * n + i] << 24;
    value += z >>> 1 ^ -(z & 1);
"""

import base64
import struct
import zlib
from collections.abc import Iterable, Mapping, Sequence
from itertools import accumulate
from operator import add, sub
from pathlib import Path
from typing import Any, TypeVar

from host_sim.base.files import write_bytes
from host_sim.protocol.generated import COLUMNS, ROW
from host_sim.recording.state import measures
from host_sim.recording.trajectory import RobotTrack, Trajectory
from host_sim.report.laboratory import NO_FIRMWARE
from host_sim.report.octet_page import octet_page
from host_sim.report.page_bundle import packed_page, with_data

T = TypeVar("T", bound=tuple[Any, ...])

_POSE = {"x": (0, 10), "y": (1, 10), "heading": (2, 1000)}
_COLUMNS = (*_POSE, *COLUMNS)


def write_page(
    path: Path,
    trajectory: Trajectory,
    title: str,
    laboratory: Mapping[str, Any] = NO_FIRMWARE,
    **more: Any,
) -> None:
    """Writes the page of a run of at least one tick, with the data of laboratory.py.

    `more` has the fields of the run that may be left out.

    Equal runs give equal bytes.

    Raises:
        OctetError: The file cannot be written, or the WebAssembly for a run that can be repeated is not built.
    """
    write_bytes(path, page({**run_data(trajectory, title), **more}, laboratory).encode())


def run_data(trajectory: Trajectory, title: str) -> dict[str, Any]:
    """The run in the page's format; see above."""
    return {
        "version": 3,
        "title": ", ".join([title, *omissions(trajectory)]),
        "measures": measures(trajectory.params, trajectory.boredom_limit),
        "first_tick": trajectory.first_tick,
        "ticks": trajectory.ticks - trajectory.first_tick,
        "scenes": trajectory.scenes,
        "news": trajectory.retained_news(),
        "eaten": trajectory.meals,
        "robots": [_robot_data(trajectory, robot) for robot in range(len(trajectory.tracks))],
    }


def omissions(trajectory: Trajectory) -> list[str]:
    """Describes what the page of a very long run leaves out."""
    kept = len(trajectory.begun())
    return [f"the last {kept} of {trajectory.environments} environments"] if kept < trajectory.environments else []


def _robot_data(trajectory: Trajectory, robot: int) -> dict[str, Any]:
    track = trajectory.tracks[robot]
    return {
        "node": track.node,
        "memory": _shown(track.memories, trajectory.ticks),
        "trials": _shown(track.trials, trajectory.ticks),
        "lessons": [lesson for lesson in track.lessons if lesson["tick"] < trajectory.ticks],
        "cells": _shown(track.cells, trajectory.ticks),
        "events": trajectory.events(robot),
        "columns": list(_COLUMNS),
        "data": pack(_column(track, name) for name in _COLUMNS),
    }


def _shown(changes: Iterable[T], end: int) -> list[T]:
    """The changes before a tick: those made after the last tick are not visible in any."""
    return [change for change in changes if change[0] < end]


def pack(columns: Iterable[Sequence[int]]) -> str:
    """Encodes columns as text, one at a time, since all columns of a long run take much memory; see above.

    Args:
        columns: A number for each tick; differences from tick to tick must fit in 31 bits.
    """
    stream = zlib.compressobj(7)  # 9 takes seven times as long, for 3 % less
    parts = [stream.compress(_planes(column)) for column in columns]
    return base64.b64encode(b"".join([*parts, stream.flush()])).decode("ascii")


def _planes(column: Sequence[int]) -> bytes:
    """A column's differences as byte planes."""
    zigzag = [step << 1 ^ step >> 31 for step in map(sub, column, (0, *column))]
    packed = struct.pack(f"<{len(zigzag)}I", *zigzag)
    return b"".join(packed[byte::4] for byte in range(4))


def page(run: dict[str, Any], laboratory: Mapping[str, Any] = NO_FIRMWARE) -> str:
    """The page's HTML."""
    return packed_page(with_data(octet_page(laboratory), "run", run))


def _column(track: RobotTrack, name: str) -> Sequence[int]:
    """A column as integers, as it is stored."""
    if name in COLUMNS:
        values: Sequence[int] = track.column(ROW[COLUMNS[name]])
        return list(map(add, values, _column(track, "left"))) if name == "right" else values
    axis, scale = _POSE[name]
    values = [round(value * scale) for value in track.poses_flat[axis :: len(_POSE)]]
    if name != "heading":
        return values
    left, right = (track.column(ROW[COLUMNS[side]]) for side in ("left", "right"))
    return list(map(sub, values, accumulate(speed >> 3 for speed in map(sub, left, right))))
