"""Runs that are obeyed between two ticks, and how a test has them played and ordered about."""

import asyncio
import time
from collections.abc import Callable

from host_sim.live.paced_run import PacedRun
from host_sim.live.page_commands import PageCommand, Play
from tests.runs.support import DEADLINE_S

Live = Callable[..., PacedRun]


def play(live: PacedRun, until: Callable[[], object], limit_s: float = DEADLINE_S) -> None:
    """Lets it run until something is so."""

    async def run() -> None:
        player = asyncio.create_task(live.play())
        give_up = time.monotonic() + limit_s
        while not (until() or player.done()):
            assert time.monotonic() < give_up
            await asyncio.sleep(0)
        player.cancel()

    asyncio.run(run())


def order(live: PacedRun, *orders: PageCommand) -> list[str]:
    """Has orders obeyed, with no tick in between; returns the complaints."""
    complaints: list[str] = []
    live.offer(Play(False), complaints.append)
    for one in orders:
        live.offer(one, complaints.append)
    live.offer(Play(False), complaints.append)
    play(live, lambda: not live.playing and not live._commands)
    return complaints
