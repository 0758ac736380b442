"""Frames as they were on the bus, in the formats of bus analysers: ASC and BLF (Vector), MF4 (ASAM)."""

from collections.abc import Iterable, Iterator, Sequence
from datetime import datetime, timezone
from itertools import chain, islice
from pathlib import Path
from typing import Any

import can
import numpy as np
from can.io.generic import MessageWriter

from host_sim.base.errors import OctetError
from host_sim.base.extra_library import library
from host_sim.recording.log_text import Recorded

_YEAR_9999_S = 253_370_764_800
_NANOSECONDS_S = 2**64 // 10**9 - 1

LAST_S = {"asc": _YEAR_9999_S, "blf": _YEAR_9999_S, "mf4": _NANOSECONDS_S, "mcap": _NANOSECONDS_S}
"""Latest time by format, s since 1970: limited by years of four digits, or by nanoseconds in 64 bits."""


def within_limits(frames: Iterable[Recorded], name: str) -> Iterator[Recorded]:
    """Yields the frames, in order.

    Raises:
        OctetError: A frame's time exceeds the limit of the named format.
    """
    last_s = LAST_S.get(name)
    for recorded in frames:
        if last_s is not None and recorded.time_us > last_s * 1_000_000:
            raise OctetError(
                f"a frame at {recorded.time_us / 1e6:.0f} s is too late for {name.upper()}, which ends at {last_s} s:"
                " is that log in seconds?"
            )
        yield recorded


_CHUNK = 50_000
_DATA_MAX = 8
_CHANNEL = 0  # python-can counts from 0, the formats from 1


def write_asc(path: Path, frames: Iterable[Recorded]) -> None:
    """Writes frames as text in Vector's ASC format."""
    _write(can.ASCWriter(path), frames)


def write_blf(path: Path, frames: Iterable[Recorded]) -> None:
    """Writes frames in Vector's BLF format."""
    with path.open("wb") as file:
        _write(can.BLFWriter(file), frames)


def _write(writer: MessageWriter, frames: Iterable[Recorded]) -> None:
    with writer:
        for time_us, frame in frames:
            writer.on_message_received(
                can.Message(
                    timestamp=time_us / 1e6,
                    arbitration_id=frame.id,
                    data=frame.data,
                    is_extended_id=False,
                    channel=_CHANNEL,
                    check=False,
                )
            )


_DATA_FRAME = np.dtype(
    [
        ("CAN_DataFrame.BusChannel", "<u1"),
        ("CAN_DataFrame.ID", "<u4"),
        ("CAN_DataFrame.IDE", "<u1"),
        ("CAN_DataFrame.DLC", "<u1"),
        ("CAN_DataFrame.DataLength", "<u1"),
        ("CAN_DataFrame.DataBytes", f"({_DATA_MAX},)u1"),
        ("CAN_DataFrame.Dir", "<u1"),
    ]
)
"""One frame in the bus logging of ASAM MDF 4."""


def write_mf4(path: Path, frames: Iterable[Recorded]) -> None:
    """Writes frames as the bus logging of ASAM MDF 4, from which a DBC file extracts the signals."""
    asammdf = library("asammdf", "export")
    every = iter(frames)
    first = next(every)
    start_us = first.time_us
    kinds = asammdf.Source
    source = kinds("CAN", "CAN", "", kinds.SOURCE_BUS, kinds.BUS_TYPE_CAN)
    with asammdf.MDF(version="4.10") as mdf:
        mdf.start_time = datetime.fromtimestamp(start_us / 1e6, timezone.utc)
        for i, chunk in enumerate(_chunks(chain([first], every))):
            times = np.array([it.time_us - start_us for it in chunk]) / 1e6
            samples = _samples(chunk)
            if i == 0:
                mdf.append(asammdf.Signal(samples, times, name="CAN_DataFrame", source=source))
            else:
                mdf.extend(0, [(times, None), (samples, None)])
        with path.open("wb") as file:
            mdf.save(file, compression=2)


def _chunks(frames: Iterable[Recorded]) -> Iterator[Sequence[Recorded]]:
    every = iter(frames)
    while chunk := list(islice(every, _CHUNK)):
        yield chunk


def _samples(chunk: Sequence[Recorded]) -> np.ndarray[Any, Any]:
    samples = np.zeros(len(chunk), _DATA_FRAME)
    samples["CAN_DataFrame.BusChannel"] = _CHANNEL + 1
    samples["CAN_DataFrame.ID"] = [it.frame.id for it in chunk]
    lengths = [len(it.frame.data) for it in chunk]
    samples["CAN_DataFrame.DLC"] = samples["CAN_DataFrame.DataLength"] = lengths
    data = b"".join(it.frame.data.ljust(_DATA_MAX, b"\0") for it in chunk)
    samples["CAN_DataFrame.DataBytes"] = np.frombuffer(data, np.uint8).reshape(-1, _DATA_MAX)
    return samples
