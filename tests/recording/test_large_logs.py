"""Large logs: how far it is with one is shown, what one unpacks to is limited, and no more than a line is kept."""

import gzip
import lzma
import tracemalloc

import pytest

from host_sim.base.errors import UsageError
from host_sim.base.progress_line import ProgressLine
from host_sim.recording import log_files
from host_sim.recording.log_reader import read_log


@pytest.mark.parametrize("pack", [bytes, gzip.compress, lzma.compress])
def test_a_log_that_takes_long_shows_how_far_it_is(tmp_path, monkeypatch, pack):
    shown: list[tuple[str, int, int]] = []

    class Line(ProgressLine):
        def __init__(self, total: int) -> None:
            super().__init__(shown=False)
            self.total = total

        def is_due(self) -> bool:
            return True

        def show(self, text: str, done: int = 0) -> None:
            shown.append((text, done, self.total))

    monkeypatch.setattr(log_files, "ProgressLine", Line)
    monkeypatch.setattr(log_files, "_SILENT_S", 0.0)
    path = tmp_path / "a.log"
    path.write_bytes(pack(b"".join(b"(%d.000000) can0 123#%04X\n" % (i, i % 65536) for i in range(20_000))))

    assert sum(1 for _ in log_files.frames_in(path)) == 20_000
    assert {(text, total) for text, _, total in shown} == {(f"reading {path}", path.stat().st_size)}
    assert shown[-1][1] == path.stat().st_size
    assert len(shown) > 1


def test_a_log_that_is_too_large_unpacked_is_refused(tmp_path, monkeypatch):
    monkeypatch.setattr(log_files, "_SIZE_MAX", 1_000_000)
    path = tmp_path / "a.log.gz"
    path.write_bytes(gzip.compress(b"(1.000000) can0 123#00\n" * 60_000))

    with pytest.raises(UsageError, match=r"a.log.gz: it is larger than 1,000,000 bytes when it is unpacked$"):
        sum(1 for _ in log_files.frames_in(path))


@pytest.mark.parametrize("name", ["big.log", "big.log.gz"])
def test_a_log_is_read_a_line_at_a_time(tmp_path, name):
    path = tmp_path / name
    text = b"(1795285590.648617) can0 682#C311000000000000\n" * 60_000
    path.write_bytes(gzip.compress(text, 1) if name.endswith(".gz") else text)
    assert len(text) > 2_500_000

    tracemalloc.start()
    count = sum(1 for _ in read_log(path))
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()

    assert count == 60_000
    assert peak < 500_000
