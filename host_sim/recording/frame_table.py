"""Frames as a table: a row for each frame, a column for every signal of every message, empty where there is none.

| column           | meaning                                                       |
| ---------------- | ------------------------------------------------------------- |
| `time_s`         | time of the frame; robot time in a run's own log              |
| `node`           | number of the robot                                           |
| `message`        | name of the message                                           |
| `damaged`        | 1 if CRC or length is wrong; the signals are empty then       |
| `data`           | the frame's bytes in hexadecimal                              |
| `SENSES.feel`... | the raw number of each signal, by message and name            |
"""

import csv
import json
from collections.abc import Iterable, Iterator
from itertools import islice
from pathlib import Path
from typing import Any

from host_sim.base.extra_library import library
from host_sim.protocol.every_node import hear
from host_sim.protocol.generated import MESSAGES
from host_sim.recording.log_text import Recorded

SIGNALS = tuple(f"{name}.{signal.name}" for name, message in MESSAGES.items() for signal in message.signals)
"""The columns of the signals."""

COLUMNS = ("time_s", "node", "message", "damaged", "data", *SIGNALS)

_CHUNK = 20_000
_FIRST = {name: SIGNALS.index(f"{name}.{message.signals[0].name}") for name, message in MESSAGES.items()}
_PLACES = {
    name: {signal.name: _FIRST[name] + i for i, signal in enumerate(message.signals)}
    for name, message in MESSAGES.items()
}

Row = list[float | int | str | None]


def rows(frames: Iterable[Recorded]) -> Iterator[Row]:
    """The rows of a table, in order."""
    for time_us, frame in frames:
        heard = hear(frame)
        if heard is None:
            continue
        numbers: list[int | None] = [None] * len(SIGNALS)
        places = _PLACES[heard.name]
        for name, number in (heard.signals or {}).items():
            numbers[places[name]] = number
        damaged = int(heard.signals is None)
        yield [time_us / 1e6, heard.node, heard.name, damaged, frame.data.hex().upper(), *numbers]


def write_csv(path: Path, frames: Iterable[Recorded]) -> None:
    """Writes the table as comma-separated values, with the columns' names in the first line."""
    with path.open("w", newline="", encoding="ascii") as file:
        writer = csv.writer(file)
        writer.writerow(COLUMNS)
        for time_s, *others in rows(frames):
            writer.writerow([f"{time_s:.6f}", *others])


def write_parquet(path: Path, frames: Iterable[Recorded]) -> None:
    """Writes the table as Parquet."""
    parquet = library("pyarrow.parquet", "export")
    with parquet.ParquetWriter(path, _schema(), compression="zstd") as writer:
        for batch in _batches(frames):
            writer.write_batch(batch)


def arrow_table(frames: Iterable[Recorded]) -> Any:
    """The table as a `pyarrow.Table`."""
    return library("pyarrow", "export").Table.from_batches(_batches(frames), schema=_schema())


def _schema() -> Any:
    pyarrow = library("pyarrow", "export")
    kinds = {"time_s": pyarrow.float64(), "message": pyarrow.string(), "data": pyarrow.string()}
    columns = [(name, kinds.get(name, pyarrow.int64())) for name in COLUMNS]
    return pyarrow.schema(columns, metadata={"pandas": json.dumps(_for_pandas(kinds))})


def _for_pandas(others: Iterable[str]) -> dict[str, Any]:
    """Metadata that makes pandas read integers as nullable Int64 instead of floating-point numbers."""
    integers = [name for name in COLUMNS if name not in others]
    columns = [
        {"name": name, "field_name": name, "pandas_type": "int64", "numpy_type": "Int64", "metadata": None}
        for name in integers
    ]
    return {"index_columns": [], "column_indexes": [], "columns": columns}


def _batches(frames: Iterable[Recorded]) -> Iterator[Any]:
    """The table in batches of rows."""
    pyarrow, schema, every = library("pyarrow", "export"), _schema(), rows(frames)
    while chunk := list(islice(every, _CHUNK)):
        columns = [
            pyarrow.array(column, it.type) for column, it in zip(zip(*chunk, strict=True), schema, strict=True)
        ]
        yield pyarrow.record_batch(columns, schema=schema)
