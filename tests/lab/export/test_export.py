"""What `tools/octet export` writes, opened by readers that share no code with what wrote it; a log as a table."""

import re
import subprocess
import sys
from pathlib import Path

import cantools
import fastparquet
import mdfreader
import pandas as pd
import pytest
from vblf.can import CanMessage
from vblf.reader import BlfReader

from host_sim.api import RunConfig, log_table, run
from host_sim.base.extra_library import library
from host_sim.cli.main import main
from host_sim.lab.export.export_command import FORMATS as WRITERS
from host_sim.protocol.codec import Frame, Protocol
from host_sim.protocol.every_node import hear
from host_sim.protocol.generated import MESSAGES
from host_sim.recording.log_reader import Recorded, read_log
from host_sim.report.dbc_file import dbc_text
from tests.recording.support import record_run

FORMATS = ("csv", "parquet", "asc", "blf", "trc", "mf4")
LAST_S = {name: int(it.last_s) for name, it in WRITERS.items() if it.last_s < float("inf")}


@pytest.fixture(scope="module")
def log(tmp_path_factory) -> Path:
    """Five seconds of a run, with a frame of node 2, a damaged one, and two that are no robot's."""
    path = record_run(tmp_path_factory.mktemp("run"), seed=333, limit_s=5.0).log
    first = path.read_text().splitlines()[0].split()[0]
    protocol = Protocol(2)
    senses, damaged = protocol.id_of("SENSES"), protocol.id_of("DRIVE")
    lines = f"{first} octet {senses:03X}#{0:016X}\n{first} octet {damaged:03X}#0011\n"
    path.write_text(f"{lines}{path.read_text()}(9.000000) octet 7FF#01\n(9.000000) octet 12345678#01\n")
    return path


@pytest.fixture(scope="module")
def recorded(log) -> list[Recorded]:
    return list(read_log(log))


@pytest.fixture(scope="module")
def exported(log, tmp_path_factory) -> dict[str, Path]:
    """The log in each format."""
    paths = {name: tmp_path_factory.mktemp("out") / f"a.{name}" for name in FORMATS}
    words = [word for name, path in paths.items() for word in (f"--{name}", str(path))]
    assert main(["export", str(log), *words]) == 0
    return paths


def test_asc2log_reads_the_asc_file(exported, recorded):
    done = subprocess.run(["asc2log", "-I", exported["asc"]], check=True, capture_output=True, text=True)

    lines = [line.split() for line in done.stdout.splitlines()]
    times = [int(time[1:-1].replace(".", "")) for time, *_ in lines]
    assert [line[2] for line in lines] == [f"{it.frame.id:03X}#{it.frame.data.hex().upper()}" for it in recorded]
    assert [time - times[0] for time in times] == [it.time_us - recorded[0].time_us for it in recorded]


def test_vblf_reads_the_blf_file(exported, recorded):
    with BlfReader(exported["blf"]) as reader:
        messages = list(reader)

    assert all(isinstance(it, CanMessage) for it in messages)
    assert [Frame(it.frame_id, it.data[: it.dlc]) for it in messages] == [it.frame for it in recorded]
    times = [round(it.header.object_time_stamp / 1000) for it in messages]
    assert [time - times[0] for time in times] == [it.time_us - recorded[0].time_us for it in recorded]


def test_mdfreader_reads_the_mf4_file(exported, recorded):
    mdf = mdfreader.Mdf(str(exported["mf4"]))

    def column(name: str) -> list:
        return mdf.get_channel_data(f"CAN_DataFrame.{name}").tolist()

    data = [bytes(it)[:length] for it, length in zip(column("DataBytes"), column("DataLength"), strict=True)]
    assert [Frame(*pair) for pair in zip(column("ID"), data, strict=True)] == [it.frame for it in recorded]
    times = mdf.get_channel_data("time").tolist()
    assert [round(time * 1e6) for time in times] == [it.time_us - recorded[0].time_us for it in recorded]


TRC_LINE = re.compile(r" *\d+ +(\d+\.\d{3}) DT +1 +0([0-9A-F]{3}) Rx -  (\d) +((?:[0-9A-F]{2} ?)*)")


def test_trc_file_follows_peak_s_description_of_version_2_1(exported, recorded):
    """By the columns of PEAK's own description: of libraries, only python-can reads TRC, and it wrote the file."""
    lines = exported["trc"].read_text().splitlines()
    assert lines[0] == ";$FILEVERSION=2.1"
    assert ";$COLUMNS=N,O,T,B,I,d,R,L,D" in lines

    read = [TRC_LINE.fullmatch(line).groups() for line in lines if not line.startswith(";")]
    assert [(int(id_, 16), bytes.fromhex(data)) for _, id_, _, data in read] == [it.frame for it in recorded]
    assert all(int(length) == len(bytes.fromhex(data)) for *_, length, data in read)
    times = [round(float(ms) * 1000) for ms, *_ in read]
    assert times == [it.time_us - recorded[0].time_us for it in recorded]


def test_mf4_file_starts_at_the_time_of_its_first_frame(tmp_path):
    """Absolute times, and negative ones would show if it began when it was written."""
    log, path = tmp_path / "a.log", tmp_path / "a.mf4"
    log.write_text("".join(f"(1700000000.{us:06d}) can0 041#0011\n" for us in (250_000, 270_000)))
    assert main(["export", str(log), "--mf4", str(path)]) == 0

    mdf = mdfreader.Mdf(str(path))

    assert [round(time * 1e6) for time in mdf.get_channel_data("time").tolist()] == [0, 20_000]
    with library("asammdf", "export").MDF(path) as file:
        assert file.header.start_time.timestamp() == 1700000000.25


def signals_of(row: dict[str, object], message: str) -> dict[str, int]:
    """The signals of a message that a row of a table has."""
    return {
        signal.name: int(row[f"{message}.{signal.name}"])
        for signal in MESSAGES[message].signals
        if pd.notna(row[f"{message}.{signal.name}"])
    }


@pytest.mark.parametrize("name", ["csv", "parquet"])
def test_exported_table_has_all_signals(exported, recorded, name):
    with exported[name].open("rb") as file:
        csv = name == "csv"
        table = pd.read_csv(file, dtype={"data": str}) if csv else fastparquet.ParquetFile(file).to_pandas()

    rows = table.to_dict("records")
    dbc = cantools.database.load_string(dbc_text((1, 2)), "dbc")
    assert [row["data"] for row in rows] == [it.frame.data.hex().upper() for it in recorded]
    assert [round(row["time_s"] * 1e6) for row in rows] == [it.time_us for it in recorded]
    for row, it in zip(rows, recorded, strict=True):
        heard = hear(it.frame)
        assert (row["node"], row["message"]) == (heard.node, heard.name)
        assert row["damaged"] == (heard.signals is None)
        if not row["damaged"]:
            decoded = dbc.decode_message(it.frame.id, it.frame.data, decode_choices=False)
            prefix = f"N{heard.node}_{heard.name}_"
            assert signals_of(row, heard.name) == {key.removeprefix(prefix): value for key, value in decoded.items()}
        for message in MESSAGES:
            expected = heard.signals if message == heard.name else None
            assert signals_of(row, message) == (expected or {})


def test_pandas_reads_columns_with_gaps_as_nullable_integers(exported):
    library("pyarrow", "export")
    table = pd.read_parquet(exported["parquet"], engine="pyarrow")

    assert {str(table[column].dtype) for column in ("node", "damaged", "SENSES.feel", "ANSWER.value")} == {"Int64"}
    assert table["time_s"].dtype == "float64"


def test_skipped_frames_are_reported(log, tmp_path, capsys):
    assert main(["export", str(log), "--csv", str(tmp_path / "a.csv")]) == 0

    output = capsys.readouterr()
    assert output.err == f"octet: {log}: skipped 1 extended and 1 foreign frames\n"
    assert output.out == f"wrote     {tmp_path / 'a.csv'}\n"


def test_missing_library_is_reported_with_its_install_command(log, tmp_path, capsys, monkeypatch):
    monkeypatch.setitem(sys.modules, "asammdf", None)

    assert main(["export", str(log), "--mf4", str(tmp_path / "a.mf4")]) == 2

    assert re.fullmatch(r"octet: this needs asammdf.*: run tools/setup export\n", capsys.readouterr().err)
    assert list(tmp_path.iterdir()) == []


def test_importing_the_buses_loads_no_export_library():
    loaded = (
        "import sys, host_sim.transport.buses; print(sorted({'asammdf', 'pandas', 'pyarrow'} & set(sys.modules)))"
    )

    assert subprocess.check_output([sys.executable, "-c", loaded], text=True) == "[]\n"


@pytest.mark.parametrize(
    "content", ["(0.000000) can0 7FF#01\n", "(0.000000) can0 041#0\n"], ids=["foreign", "malformed"]
)
def test_failed_export_leaves_the_old_file(tmp_path, capsys, content):
    (tmp_path / "a.log").write_text(content)
    (tmp_path / "a.blf").write_text("old")

    assert main(["export", str(tmp_path / "a.log"), "--blf", str(tmp_path / "a.blf")]) == 2

    assert re.fullmatch(r"octet: .*\n", capsys.readouterr().err)
    assert (tmp_path / "a.blf").read_text() == "old"
    assert len(list(tmp_path.iterdir())) == 2


def test_export_without_a_format_lists_the_formats(log, capsys):
    assert main(["export", str(log)]) == 2

    error = capsys.readouterr().err
    assert [name for name in FORMATS if f"--{name} FILE" not in error] == []


@pytest.mark.parametrize("name", LAST_S)
def test_time_beyond_the_range_of_a_format_leaves_the_old_file(tmp_path, capsys, name):
    log, path = tmp_path / "far.log", tmp_path / f"a.{name}"
    frame = f"octet {Protocol().id_of('DRIVE'):03X}#0011"
    log.write_text(f"({LAST_S[name]}.000000) {frame}\n")
    assert main(["export", str(log), f"--{name}", str(path)]) == 0
    written = path.read_bytes()

    log.write_text(f"({LAST_S[name] + 1}.000000) {frame}\n")

    assert main(["export", str(log), f"--{name}", str(path)]) == 1
    assert re.fullmatch("octet: a frame at [0-9]+ s is too late for .*\n", capsys.readouterr().err)
    assert path.read_bytes() == written


def test_log_table_is_an_arrow_table_that_converts_to_pandas(tmp_path):
    log = tmp_path / "run.log"
    done = run(RunConfig(seed=3, environments=2, limit_s=20), log=log)

    table = log_table(log)
    frames = table.to_pandas()

    assert table.column_names[:3] == ["time_s", "node", "message"]
    assert len(frames) == len(log.read_text().splitlines())
    assert frames["SENSES.feel"].dropna().tolist() == done.ticks()["feel"].tolist()
