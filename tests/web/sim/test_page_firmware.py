"""The firmware as WebAssembly gives the answers that the firmware on this machine gave."""

from pathlib import Path

import pytest

from host_sim.protocol.generated import PROFILES
from tests.runs.support import octet
from tests.web.sim.node import in_node

REPLAY = 'return texts.map((text) => modules["sim/log_replay.js"].replayLog(page, text));'


def recorded(out: Path, *words: str) -> Path:
    assert octet("run", "--bus", "none", "--environments", "1", "--quiet", "--out", out, *words).returncode == 0
    return out / "run.log"


@pytest.fixture(scope="module")
def logs(tmp_path_factory) -> list[Path]:
    """A short run of each behaviour, and one of four robots."""
    folder = tmp_path_factory.mktemp("logs")
    runs = {name: ("--profile", name, "--limit-s", "20") for name in PROFILES}
    return [recorded(folder / name, *words) for name, words in (runs | {"four": ("--robots", "4")}).items()]


def test_every_recorded_log_is_answered_frame_by_frame(tmp_path, logs):
    compared = in_node(tmp_path, "sim/log_replay.js", REPLAY, *logs)

    assert [it.get("difference") for it in compared] == [None] * len(logs)
    assert [it["frames"] for it in compared] == [len(log.read_text().splitlines()) for log in logs]


def test_a_drive_that_differs_is_found(tmp_path, logs):
    lines = logs[0].read_text().splitlines()
    changed = next(i for i, line in enumerate(lines) if i > 100 and " 041#" in line)
    lines[changed] = lines[changed][:-1] + ("0" if lines[changed][-1] != "0" else "1")
    log = tmp_path / "run.log"
    log.write_text("\n".join(lines))

    (compared,) = in_node(tmp_path, "sim/log_replay.js", REPLAY, log)

    assert compared["difference"]["line"] == changed + 1
