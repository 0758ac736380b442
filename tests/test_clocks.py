"""Nothing that a run depends on reads the wall clock, which may be set at any time: only a monotonic one."""

import re
from pathlib import Path

import pytest

from tests.runs.support import ROOT

READS = {
    ".c": re.compile(r"CLOCK_REALTIME|\b(gettimeofday|localtime|gmtime|time|ftime|clock)\s*\("),
    ".py": re.compile(r"\btime\.(time|time_ns|localtime|gmtime|strftime)\b|\bdate(time)?\.(now|utcnow|today)\b"),
}
"""What reads it, by the ends of files' names."""

ALLOWED = {
    "host_sim/lab/campaign/host_events.py": "sets it, for those who read it",
    "host_sim/live/class_roster.py": "tells when a page last reported",
    "host_sim/live/class_server.py": "tells how long ago that was",
    "host_sim/live/feed.py": "tells the page when a message was made",
    "host_sim/sim/own_brain.py": "keeps in its cache what another run may be about to use",
    "host_sim/transport/socket_pair_bus.py": "the time stamp that python-can wants of a frame",
}


def readers(suffix: str) -> set[str]:
    folders = (ROOT / name for name in ("firmware", "hal", "host_sim"))
    paths = [path for folder in folders for path in folder.rglob(f"*{suffix}")]
    return {str(path.relative_to(ROOT)) for path in paths if READS[suffix].search(path.read_text())}


@pytest.mark.parametrize("suffix", READS)
def test_only_what_is_listed_reads_the_wall_clock(suffix):
    assert readers(suffix) == {name for name in ALLOWED if Path(name).suffix == suffix}


@pytest.mark.parametrize(
    ("suffix", "line"),
    [
        (".c", "clock_gettime(CLOCK_REALTIME, &now);"),
        (".c", "srand(time(NULL));"),
        (".py", "began_s = time.time()"),
        (".py", "datetime.now(timezone.utc)"),
    ],
)
def test_a_reading_of_the_wall_clock_is_found(suffix, line):
    assert READS[suffix].search(line)


@pytest.mark.parametrize(
    ("suffix", "line"),
    [(".c", "clock_gettime(CLOCK_MONOTONIC, &now);"), (".py", "time.monotonic() + self.now()")],
)
def test_a_monotonic_clock_is_none(suffix, line):
    assert not READS[suffix].search(line)
