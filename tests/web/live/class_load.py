"""A class at work: pages that each watch their own robot, and a board.

`python -m tests.web.live.class_load 30 10` has 30 pages watch for 10 s and prints the figures.
"""

import argparse
import asyncio
import json
import os
import secrets
import sys
import time
from dataclasses import dataclass, field
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import aiohttp

from tests.web.support import DEADLINE_S, Watched, start_watched


@dataclass
class Pupil:
    """One page.

    Attributes:
        key: What it is recognised by.
        first: Its first message.
        last: Its last message.
        messages: Number of its messages.
        size: Their length, characters.
        lag_s: The age of each message when it came.
    """

    key: str = field(default_factory=lambda: secrets.token_hex(16))
    first: dict[str, Any] = field(default_factory=dict)
    last: dict[str, Any] = field(default_factory=dict)
    messages: int = 0
    size: int = 0
    lag_s: list[float] = field(default_factory=list)

    async def watch(self, url: str, ticks: int) -> None:
        """Watches until the run has come so far."""
        async with (
            aiohttp.ClientSession() as session,
            session.ws_connect(url + f"&page={self.key}", origin=home(url)) as ws,
        ):
            while not self.last or self.last["states"][0]["tick"] < ticks:
                self._take(await ws.receive_str(timeout=DEADLINE_S))

    def _take(self, text: str) -> None:
        self.last = json.loads(text)
        self.first = self.first or self.last
        self.messages += 1
        self.size += len(text)
        self.lag_s.append(time.time() - self.last["at"] / 1000)


def home(url: str) -> str:
    """The origin of an address."""
    return "/".join(url.split("/")[:3])


def socket_url(watched: Watched) -> str:
    """Where a page's WebSocket connects to."""
    return watched.url.replace("/?", "/live?")


async def attend(url: str, pupils: list[Pupil], ticks: int) -> None:
    """Lets pages watch, all at once."""
    await asyncio.gather(*(pupil.watch(url, ticks) for pupil in pupils))


def _cpu_s(pid: int) -> float:
    fields = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("pages", type=int)
    parser.add_argument("seconds", type=int)
    arguments = parser.parse_args()
    pupils = [Pupil() for _ in range(arguments.pages)]
    with TemporaryDirectory() as folder:
        options = ("--listen", "127.0.0.1", "--robots", str(arguments.pages), "--environments", "100")
        watched = start_watched(Path(folder) / "run", *options)
        began, cpu_s = time.monotonic(), _cpu_s(watched.process.pid)
        asyncio.run(attend(socket_url(watched), pupils, 50 * arguments.seconds))
        wall_s, cpu_s = time.monotonic() - began, _cpu_s(watched.process.pid) - cpu_s
        watched.end()
    _report(pupils, wall_s, cpu_s)
    return 0


def _report(pupils: list[Pupil], wall_s: float, cpu_s: float) -> None:
    rates = sorted(pupil.messages / wall_s for pupil in pupils)
    lags = sorted(lag for pupil in pupils for lag in pupil.lag_s)
    kilobytes = sum(pupil.size for pupil in pupils) / wall_s / 1000
    late = pupils[0].last["health"]["late"]
    middle, most = (1000 * lags[int(len(lags) * share)] for share in (0.5, 0.99))
    sys.stdout.write(
        f"{len(pupils)} pages for {wall_s:.1f} s: {rates[0]:.1f} to {rates[-1]:.1f} messages a second each, "
        f"{kilobytes:.0f} kB a second in all; a message is {middle:.0f} ms old in the middle, {most:.0f} ms at the "
        f"99th of 100; the server took {cpu_s / wall_s:.0%} of a processor, {late} ticks were late\n"
    )


if __name__ == "__main__":
    sys.exit(main())
