"""A class: thirty pages at once, each with a robot of its own."""

import asyncio
import json
import re
from collections.abc import Callable, Iterator

import aiohttp
import pytest

from host_sim.live.join_code import EACH_MAX
from tests.web.live.class_load import Pupil, attend, home, socket_url
from tests.web.support import DEADLINE_S, Watched, start_watched


def board_url(watched) -> str:
    """The board's address, which is printed after that of the page."""
    return next(re.search(r"http://\S+", line)[0] for line in watched.process.stdout if line.startswith("board"))


def test_thirty_pages_watch_at_once_and_each_has_a_robot_of_its_own(watch):
    watched = watch("--listen", "127.0.0.1", "--robots", "30", "--limit-s", "600")
    pupils = [Pupil() for _ in range(30)]

    asyncio.run(attend(socket_url(watched), pupils, 60))

    assert sorted(pupil.first["seat"]["node"] for pupil in pupils) == list(range(1, 31))
    assert all(len(pupil.last["states"]) == 30 for pupil in pupils)
    newcomer, again = Pupil(), Pupil(key=pupils[7].key)
    asyncio.run(attend(socket_url(watched), [again], 0))
    asyncio.run(attend(socket_url(watched), [newcomer], 0))
    assert again.first["seat"] == pupils[7].first["seat"]
    assert newcomer.first["seat"]["node"] in range(1, 31)
    assert newcomer.first["seat"]["node"] != again.first["seat"]["node"]


@pytest.fixture(scope="module")
def of_two(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Watched]:
    """A run of a class of two, for tests that leave it as it is."""
    watched = start_watched(tmp_path_factory.mktemp("watched") / "run", "--listen", "127.0.0.1", "--robots", "2")
    yield watched
    watched.process.kill()
    watched.process.communicate()


@pytest.fixture
def ask(of_two: Watched) -> Callable[..., list[str]]:
    """Sends messages to a run; returns what its page is told."""

    async def talk(url: str, words: list[dict]) -> list[str]:
        notes: list[str] = []
        async with (
            aiohttp.ClientSession() as session,
            session.ws_connect(f"{url}&page={'0' * 32}", origin=home(url)) as ws,
        ):
            for word in words:
                await ws.send_str(json.dumps(word))
            while len(notes) < len(words):
                notes += json.loads(await ws.receive_str(timeout=DEADLINE_S)).get("notes", [])
        return notes

    return lambda *words: asyncio.run(talk(socket_url(of_two), list(words)))


def test_a_page_cannot_change_what_is_not_its_own(ask):
    notes = ask({"do": "pause"}, {"do": "next"}, {"do": "write", "node": 2, "cell": 1, "side": 1})

    assert notes[:2] == ["the board does that for all: here you can change your own robot"] * 2
    assert notes[2] == "robot 2 is not yours: yours is robot 1"


def test_a_name_that_is_no_text_is_refused(ask):
    notes = ask({"do": "name", "name": 7}, {"do": "name"})

    assert notes == ["not understood: name must be a text"] * 2


@pytest.mark.parametrize(("path", "allowed"), [("/board", 403), ("/board-live", 403), ("/", 200)])
def test_a_pupil_cannot_open_the_board(of_two, path, allowed):
    token = of_two.url.partition("?")[2]

    async def status(query: str) -> int:
        async with aiohttp.ClientSession() as session, session.get(f"{home(of_two.url)}{path}?{query}") as answer:
            return answer.status

    assert asyncio.run(status(token)) == allowed
    if path == "/board":
        assert asyncio.run(status(board_url(of_two).partition("?")[2])) == 200


def test_the_code_leads_to_the_page_and_guesses_are_limited(watch):
    watched = watch("--listen", "127.0.0.1", "--robots", "2")
    line = next(line for line in watched.process.stdout if line.startswith("to type"))
    code = re.search(r"/([a-z]+-\d{4})", line)[1]

    async def ask(*codes: str) -> list[tuple[int, str]]:
        async with aiohttp.ClientSession() as session:
            answers = [await session.get(f"{home(watched.url)}/{code}", allow_redirects=False) for code in codes]
            return [(answer.status, answer.headers.get("Location", "")) for answer in answers]

    to_the_page = (302, watched.url.removeprefix(home(watched.url)))
    wrong = ["zzz-0000"] * EACH_MAX
    assert asyncio.run(ask(code, code.upper(), code.replace("-", ""))) == [to_the_page] * 3
    assert asyncio.run(ask(*wrong, code)) == [(403, "")] * EACH_MAX + [(429, "")]


def test_nothing_moves_before_someone_watches(watch):
    watched = watch("--listen", "127.0.0.1", "--limit-s", "600")
    board_url(watched)
    watched.end()

    said = watched.said()
    assert [it for it in said if it.name == "SENSES"] == []
    assert {it.signals["left"] for it in said if it.name == "DRIVE"} == {0}


def test_the_board_begins_the_run_if_it_is_open_first(watch):
    watched = watch("--listen", "127.0.0.1", "--robots", "2")
    url = board_url(watched)
    pupil = Pupil()

    async def teach() -> tuple[dict, dict]:
        async with (
            aiohttp.ClientSession() as session,
            session.ws_connect(url.replace("/board", "/board-live"), origin=home(url)) as board,
        ):
            first = json.loads(await board.receive_str(timeout=DEADLINE_S))
            await attend(socket_url(watched), [pupil], 0)
            await board.send_str('{"do": "play"}')
            while (last := json.loads(await board.receive_str(timeout=DEADLINE_S)))["states"][0]["tick"] == 0:
                pass
        return first, last

    first, last = asyncio.run(teach())

    assert first["play"]["waits"]
    assert re.fullmatch(r"127\.0\.0\.1:\d+/[a-z]+-\d{4}", first["board"]["join"]["urls"][0])
    assert (pupil.first["play"]["waits"], pupil.first["states"][0]["tick"]) == (True, 0)
    assert not last["play"]["waits"]
    assert [robot["page"] for robot in first["board"]["robots"]] == [False, False]
