"""The server of a class: who may see and do what, and what sixty pupils report at once."""

import asyncio
import json
import re
from collections.abc import Awaitable, Callable

import aiohttp
import pytest

from host_sim.live.class_roster import Roster, code_of, lesson_goals
from host_sim.live.class_server import ClassServer
from host_sim.live.join_code import EACH_MAX
from host_sim.live.listener import Listener
from tests.live.test_class_roster import REPORT, A

POLICY = "default-src 'none'; img-src data:"
PAGE = f'<head>\n<meta http-equiv="Content-Security-Policy" content="{POLICY}">\n<title>Octet</title>'


class Desk:
    """A browser, and the server in the same event loop."""

    def __init__(self, session: aiohttp.ClientSession, listener: Listener, roster: Roster) -> None:
        self.session, self.listener, self.roster = session, listener, roster
        self.home = f"http://127.0.0.1:{listener.port}"

    async def get(self, path: str, **more) -> tuple[int, str]:
        async with self.session.get(f"{self.home}{path}", **more) as answer:
            return answer.status, await answer.text()

    async def post(self, path: str, said: object, origin: str | None = None) -> int:
        text = said if isinstance(said, str) else json.dumps(said)
        headers = {"Origin": origin or self.home}
        async with self.session.post(f"{self.home}{path}", data=text, headers=headers) as answer:
            return answer.status

    async def come_as(self, who: str) -> tuple[int, str]:
        is_teacher = who == "teacher"
        token = self.listener.board_token if is_teacher else self.listener.token
        return await self.get(f"{'/board' if is_teacher else '/'}?token={token}")


@pytest.fixture
def at_desk(tmp_path) -> Callable[[Callable[[Desk], Awaitable[None]]], Roster]:
    """Lets somebody come to a class; returns what the class has come to."""

    def run(visit: Callable[[Desk], Awaitable[None]]) -> Roster:
        async def serve() -> Roster:
            listener, roster = Listener("127.0.0.1", 0), Roster(tmp_path / "class.json")
            jar = aiohttp.CookieJar(unsafe=True)  # takes the cookies of an address in numbers, as browsers do
            async with (
                ClassServer(roster, listener, PAGE).serving(),
                aiohttp.ClientSession(cookie_jar=jar) as session,
            ):
                await visit(Desk(session, listener, roster))
            return roster

        asyncio.run(serve())
        return Roster(tmp_path / "class.json")

    return run


def test_pupil_opens_the_page_reports_and_is_saved(at_desk):
    async def visit(desk: Desk) -> None:
        status, page = await desk.come_as("pupil")
        assert (status, page) == (200, PAGE)
        assert await desk.get("/") == (200, page)
        assert await desk.post("/report", REPORT) == 204

    assert at_desk(visit).pupils[A].goals == {"watch": [0]}


def test_board_cookie_is_http_only_and_same_site_strict(at_desk):
    async def visit(desk: Desk) -> None:
        async with desk.session.get(f"{desk.home}/board?token={desk.listener.board_token}") as answer:
            assert re.search("HttpOnly.*SameSite=Strict", answer.headers["Set-Cookie"])

    at_desk(visit)


@pytest.mark.parametrize("path", ["/", "/board", "/pupils", "/class.csv"])
def test_server_refuses_requests_without_a_valid_token(at_desk, path):
    async def visit(desk: Desk) -> None:
        for query in ("", "?token=", "?token=x"):
            assert (await desk.get(path + query))[0] == 403

    at_desk(visit)


def test_pupil_cannot_see_the_board_or_change_another_pupil(at_desk):
    async def visit(desk: Desk) -> None:
        await desk.come_as("pupil")
        for path in ("/board", "/pupils", "/class.csv", f"/board?token={desk.listener.token}"):
            assert (await desk.get(path))[0] == 403
        assert await desk.post("/code", {"name": "Ada", "code": code_of("Ada", {})}) == 403
        assert await desk.post("/remove", {"key": A}) == 403

    at_desk(visit)


def test_teacher_sees_all_pupils_takes_codes_and_removes_pupils(at_desk):
    async def visit(desk: Desk) -> None:
        goals = sum(lesson_goals().values())
        desk.roster.report(REPORT)
        assert (await desk.come_as("teacher"))[0] == 200
        assert await desk.post("/code", {"name": "Ben", "code": code_of("Ben", {"watch": [2]})}) == 200
        assert await desk.post("/code", {"name": "Ben", "code": "AAA-AAA"}) == 200
        told = json.loads((await desk.get("/pupils"))[1])
        assert [(it["name"], it["goals"]["watch"]) for it in told["pupils"]] == [("Ada", [0]), ("Ben", [2])]
        assert told["pupils"][0]["silent_s"] < 60
        assert told["join"]["urls"] == desk.listener.short_urls
        assert (await desk.get("/class.csv"))[1].splitlines()[1:] == [
            f"Ada,1,1{',0' * (goals - 1)}",
            f"Ben,1,0,0,1{',0' * (goals - 3)}",
        ]
        assert (await desk.get("/"))[0] == 200  # for pupils' runs
        assert await desk.post("/remove", {"key": A}) == 200

    assert [pupil.name for pupil in at_desk(visit).pupils.values()] == ["Ben"]


def test_requests_from_another_site_are_refused_despite_cookies(at_desk):
    async def visit(desk: Desk) -> None:
        await desk.come_as("teacher")
        await desk.come_as("pupil")
        for path, said in (("/report", REPORT), ("/remove", {"key": A}), ("/code", {})):
            assert await desk.post(path, said, origin="http://evil.example") == 403
        assert (await desk.get("/pupils", headers={"Host": "evil.example"}))[0] == 403

    assert at_desk(visit).pupils == {}


WRONG = [("", 400), ("[]", 400), ("{", 400), ('{"key": 1}', 400), ("x" * 20_000, 413), ("[" * 15_000, 400)]


@pytest.mark.parametrize(("said", "status"), WRONG)
def test_malformed_report_is_refused(at_desk, said, status):
    async def visit(desk: Desk) -> None:
        await desk.come_as("pupil")
        assert await desk.post("/report", said) == status

    assert at_desk(visit).pupils == {}


def test_join_code_opens_the_page_and_guesses_are_limited(at_desk):
    async def visit(desk: Desk) -> None:
        code = desk.listener.code.text
        assert (await desk.get(f"/{code.upper()}"))[0] == 200
        assert [(await desk.get("/zzz-0000"))[0] for _ in range(EACH_MAX)] == [403] * EACH_MAX
        assert (await desk.get(f"/{code}"))[0] == 429

    at_desk(visit)


def test_sixty_pupils_can_report_at_once(at_desk):
    async def visit(desk: Desk) -> None:
        await desk.come_as("pupil")
        reports = [{**REPORT, "key": f"{i:032x}", "name": f"Pupil {i}", "link": "#" + "x" * 3000} for i in range(60)]
        assert await asyncio.gather(*(desk.post("/report", each) for each in reports * 3)) == [204] * 180

    assert [pupil.name for pupil in at_desk(visit).pupils.values()] == [f"Pupil {i}" for i in range(60)]
