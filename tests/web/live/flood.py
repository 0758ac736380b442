"""Idle, slow and malformed connections to the page server, while a page is loaded again and again.

`python -m tests.web.live.flood 5000` prints the figures; the exit code is 1 if a page was not served, or stderr
is too long.
"""

import argparse
import contextlib
import resource
import socket
import subprocess
import sys
import time
import urllib.request
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

from tests.web.support import DEADLINE_S, Watched, start_watched

STDERR_MAX = 100_000
_KINDS = (
    b"",
    b"GET / HTTP/1.1\r\nHost: loc",
    b"\x00\xff\r\n\r\n",
    b"GET / HTTP/9.9\r\n\r\n",
    b"GET /?\x7f\x80 HTTP/1.1\r\nHost: localhost\r\nContent-Length: -1\r\n\r\n",
    b"GET / HTTP/1.1\r\nHost: localhost\r\nX: " + b"y" * 20_000 + b"\r\n\r\n",
)
_PAGE_EVERY = 50


@dataclass(frozen=True)
class Outcome:
    """What came of it: pages asked for and served, the longest time that one took, and the length of stderr."""

    asked: int
    served: int
    slowest_s: float
    stderr: str


def flood(watched: Watched, count: int) -> Outcome:
    """Opens so many connections and leaves them open, then ends the run."""
    host, port = watched.url.split("/")[2].split(":")
    sockets: list[socket.socket] = []
    times: list[float | None] = []
    for i in range(count):
        sockets += _opened((host, int(port)), _KINDS[i % len(_KINDS)])
        if i % _PAGE_EVERY == 0:
            times.append(_page_s(watched.url))
    times.append(_page_s(watched.url))
    for one in sockets:
        one.close()
    watched.end()
    assert watched.process.stderr is not None
    served = [time_s for time_s in times if time_s is not None]
    return Outcome(len(times), len(served), max(served, default=0.0), watched.process.stderr.read())


def _opened(address: tuple[str, int], text: bytes) -> list[socket.socket]:
    """A connection that has sent something; none if the server has closed it already."""
    one = socket.socket()
    one.settimeout(DEADLINE_S)
    try:
        one.connect(address)
        one.sendall(text)
    except OSError:
        one.close()
        return []
    return [one]


def _page_s(url: str) -> float | None:
    """The time to load the page; None if it is not served."""
    began = time.monotonic()
    with contextlib.suppress(OSError), urllib.request.urlopen(url, timeout=DEADLINE_S) as page:
        if b"Octet" in page.read():
            return time.monotonic() - began
    return None


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("count", type=int)
    count = parser.parse_args().count
    _, most = resource.getrlimit(resource.RLIMIT_NOFILE)
    with TemporaryDirectory() as folder:
        watched = start_watched(Path(folder) / "run")
        resource.setrlimit(resource.RLIMIT_NOFILE, (min(most, 2 * count + 100), most))
        try:
            outcome = flood(watched, count)
        finally:
            with contextlib.suppress(subprocess.TimeoutExpired):
                watched.process.kill()
    pages = f"{outcome.served} of {outcome.asked} pages served, the slowest in {outcome.slowest_s:.2f} s"
    sys.stdout.write(f"{count} connections: {pages}; {len(outcome.stderr)} bytes on stderr\n")
    return int(outcome.served < outcome.asked or len(outcome.stderr) >= STDERR_MAX)


if __name__ == "__main__":
    sys.exit(main())
