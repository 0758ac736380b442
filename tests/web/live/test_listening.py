"""A run that other machines may watch: the short address, and what waits for the first page."""

import asyncio
import re

import aiohttp

from host_sim.live.join_code import EACH_MAX


def test_join_code_opens_the_page_and_guesses_are_limited(watch):
    watched = watch("--listen", "127.0.0.1", "--robots", "2")
    home = "/".join(watched.url.split("/")[:3])
    line = next(line for line in watched.process.stdout if line.startswith("to type"))
    code = re.search(r"/([a-z]+-\d{4})", line)[1]

    async def ask(*codes: str) -> list[tuple[int, str]]:
        async with aiohttp.ClientSession() as session:
            answers = [await session.get(f"{home}/{code}", allow_redirects=False) for code in codes]
            return [(answer.status, answer.headers.get("Location", "")) for answer in answers]

    to_the_page = (302, watched.url.removeprefix(home))
    wrong = ["zzz-0000"] * EACH_MAX
    assert asyncio.run(ask(code, code.upper(), code.replace("-", ""))) == [to_the_page] * 3
    assert asyncio.run(ask(*wrong, code)) == [(403, "")] * EACH_MAX + [(429, "")]


def test_robot_does_not_move_before_someone_watches(watch):
    watched = watch("--listen", "127.0.0.1", "--limit-s", "600")
    next(line for line in watched.process.stdout if line.startswith("waits"))
    watched.end()

    said = watched.said()
    assert [it for it in said if it.name == "SENSES"] == []
    assert {it.signals["left"] for it in said if it.name == "DRIVE"} == {0}
