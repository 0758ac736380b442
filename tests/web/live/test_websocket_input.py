"""Bad input over the WebSocket is refused and counted, and the run goes on unharmed."""

import asyncio
import contextlib
import json
import socket
from collections.abc import Awaitable, Callable, Iterator
from pathlib import Path
from typing import Any

import aiohttp
import pytest

from host_sim.live.server import PAGES_MAX
from tests.runs.support import octet
from tests.web.support import DEADLINE_S, Watched, eventually, start_watched

Socket = aiohttp.ClientWebSocketResponse


@pytest.fixture(scope="module")
def shared(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Watched]:
    """A run for all tests of this module. However it was treated, no robot has counted a fault at its end."""
    watched = start_watched(tmp_path_factory.mktemp("watched") / "run", "--environments", "200")
    yield watched
    ends_well(watched)
    watched.process.communicate()


@pytest.fixture
def watched(shared: Watched) -> Iterator[Watched]:
    """The run; it must go on after the test."""
    yield shared
    goes_on(shared)


def goes_on(watched: Watched) -> None:
    first = talk(watched, tick)
    eventually(lambda: talk(watched, tick) > first, "the run goes on")


def ends_well(watched: Watched) -> None:
    assert watched.end() == 0
    assert set(watched.summary()["robots"][0]["faults"].values()) == {0}


@pytest.fixture
def refused_before(watched: Watched) -> int:
    """How many orders were refused before the test."""
    return talk(watched, refused)


def talk(watched: Watched, what: Callable[[Socket], Awaitable[Any]], query: str | None = None, **headers: str) -> Any:
    """Opens a WebSocket as the page would, and does something with it."""
    home, ours = watched.url.split("?")
    query = f"?{ours}" if query is None else query
    headers = {"Origin": home.rstrip("/"), **headers}

    async def connect() -> Any:
        url = f"{home}live{query}"
        async with aiohttp.ClientSession() as session, session.ws_connect(url, headers=headers) as ws:
            return await what(ws)

    return asyncio.run(connect())


async def message(ws: Socket) -> dict[str, Any]:
    return json.loads((await ws.receive(timeout=DEADLINE_S)).data)


async def tick(ws: Socket) -> int:
    return (await message(ws))["states"][0]["tick"]


async def refused(ws: Socket) -> int:
    return (await message(ws))["health"]["orders_refused"]


def speed(factor: int) -> Callable[[Socket], Awaitable[None]]:
    """Orders a speed, and waits until it is that."""

    async def order(ws: Socket) -> None:
        await ws.send_str(json.dumps({"do": "speed", "factor": factor}))
        while (await message(ws))["play"]["speed"] != factor:
            pass

    return order


def test_run_begins_when_someone_watches(watch):
    assert talk(watch(), tick) <= 2


JUNK = [
    "",
    "no JSON",
    "[]",
    "null",
    "7",
    '"play"',
    "{}",
    '{"do": null}',
    '{"do": ["play"]}',
    '{"do": "dance"}',
    '{"do": "speed"}',
    '{"do": "speed", "factor": "fast"}',
    '{"do": "speed", "factor": true}',
    '{"do": "speed", "factor": -1}',
    '{"do": "speed", "factor": 1e308}',
    '{"do": "speed", "factor": NaN}',
    '{"do": "speed", "factor": Infinity}',
    '{"do": "seed", "seed": 4294967296}',
    '{"do": "seed", "seed": 1.5}',
    '{"do": "seed", "seed": 1' + "0" * 400 + "}",
    '{"do": "seed", "seed": 1' + "0" * 4000 + "}",
    '{"do": "write", "cell": 0, "side": 1}',
    '{"do": "write", "cell": 8, "side": 1}',
    '{"do": "write", "cell": 1, "side": 3}',
    '{"do": "freeze", "on": "yes"}',
    '{"do": "move_bar", "id": 0}',
    '{"do": "move_bar", "id": 0, "a": [0], "b": [1, 2]}',
    '{"do": "move_bar", "id": 0, "a": [0, "x"], "b": [1, 2]}',
    '{"do": "push_bar", "id": 0, "a": [500, 500], "b": [700, 500]}',
    '{"do": "move_food", "id": 0, "at": [-1, 0]}',
    '{"do": "move_food", "id": 0, "at": [1e9, 0]}',
    '{"do": "put", "at": [0, 0], "heading": 99999}',
    "[" * 4000,
    "\x00" * 100,
]


def test_malformed_messages_are_refused_and_counted(watched, refused_before):
    async def send_all(ws: Socket) -> None:
        for junk in JUNK:
            await ws.send_str(junk)
        await ws.send_bytes(b"\xff" * 100)
        await ws.receive(timeout=DEADLINE_S)

    talk(watched, send_all)
    assert talk(watched, refused) == refused_before + len(JUNK) + 1


def test_message_of_ten_megabytes_closes_the_connection_and_is_counted(watched, refused_before):
    async def flood(ws: Socket) -> int | None:
        with contextlib.suppress(ConnectionError):
            await ws.send_bytes(b"x" * 10_000_000)
        async for _ in ws:
            pass
        return ws.close_code

    assert talk(watched, flood) in (1009, 1006)
    assert talk(watched, refused) == refused_before + 1


def test_connection_is_closed_after_many_malformed_messages(watched):
    async def babble(ws: Socket) -> int | None:
        for _ in range(200):
            with contextlib.suppress(ConnectionError):
                await ws.send_str("blah")
        async for _ in ws:
            pass
        return ws.close_code

    assert talk(watched, babble) == 1008


def test_impossible_order_is_answered_in_words(watched):
    async def ask(ws: Socket) -> list[str]:
        await ws.send_str('{"do": "remove_bar", "id": 999}')
        while True:
            said = await message(ws)
            if "notes" in said:
                return said["notes"]

    assert talk(watched, ask) == ["there is no such number"]


def test_flood_of_orders_does_not_stop_the_run(watched):
    async def hurry(ws: Socket) -> None:
        for _ in range(5000):
            await ws.send_str('{"do": "play"}')

    talk(watched, hurry)


def test_foreign_origin_is_refused_and_counted(watched, refused_before):
    origins = ("http://evil.example", "null", "https://127.0.0.1", "")
    for origin in origins:
        with pytest.raises(aiohttp.WSServerHandshakeError) as refusal:
            talk(watched, tick, Origin=origin)
        assert refusal.value.status == 403
    assert talk(watched, refused) == refused_before + len(origins)


def test_page_that_stops_reading_does_not_hold_up_the_run(watched):
    host, port = watched.url.split("/")[2].split(":")
    query = watched.url.partition("?")[2]
    handshake = (
        f"GET /live?{query} HTTP/1.1\r\nHost: {host}:{port}\r\nOrigin: http://{host}:{port}\r\n"
        "Upgrade: websocket\r\nConnection: Upgrade\r\n"
        "Sec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==\r\nSec-WebSocket-Version: 13\r\n\r\n"
    )

    with socket.socket() as deaf:
        deaf.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
        deaf.connect((host, int(port)))
        deaf.sendall(handshake.encode())
        talk(watched, speed(0))
        first = talk(watched, tick)
        eventually(lambda: talk(watched, tick) > first + 5_000, "5000 ticks, which take 100 s in real time")
        assert memory_mb(watched.process.pid) < 400
    talk(watched, speed(1))


def test_page_beyond_the_limit_is_refused_and_the_run_goes_on(watch):
    watched = watch()
    home, query = watched.url.split("?")
    headers = {"Origin": home.rstrip("/")}

    async def crowd() -> int:
        async with aiohttp.ClientSession() as session, contextlib.AsyncExitStack() as stack:
            for _ in range(PAGES_MAX):
                await stack.enter_async_context(session.ws_connect(f"{home}live?{query}", headers=headers))
            with pytest.raises(aiohttp.WSServerHandshakeError) as refusal:
                await session.ws_connect(f"{home}live?{query}", headers=headers)
            return refusal.value.status

    assert asyncio.run(crowd()) == 503
    goes_on(watched)
    ends_well(watched)


def test_server_serves_only_the_page_and_its_parts(watched):
    home = watched.url.split("?")[0]

    async def get(path: str) -> int:
        async with aiohttp.ClientSession() as session, session.get(f"{home}{path}") as response:
            return response.status

    for path in ("octet.html", "../cli.py", "%2e%2e%2fcli.py", "replay.html", "nothing.js"):
        assert asyncio.run(get(path)) in (400, 403, 404)
    assert asyncio.run(get("octet.js")) == 200


@pytest.mark.parametrize("words", [(), ("--listen", "127.0.0.1")], ids=["this machine", "other machines"])
def test_page_needs_the_token(watch, words):
    watched = watch(*words)
    home, _ = watched.url.split("?")

    async def get(address: str) -> int:
        async with aiohttp.ClientSession() as session, session.get(address) as response:
            return response.status

    assert asyncio.run(get(home)) == 403
    assert asyncio.run(get(f"{home}?token=guess")) == 403
    assert asyncio.run(get(watched.url)) == 200
    with pytest.raises(aiohttp.WSServerHandshakeError):
        talk(watched, tick, query="")
    assert talk(watched, tick) >= 0


def test_port_in_use_is_reported_in_one_line(tmp_path):
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        port = taken.getsockname()[1]
        done = octet("watch", "--bus", "none", "--port", str(port), "--out", tmp_path)
    assert done.returncode == 2
    assert done.stderr.count("\n") == 1
    assert f"port {port}: address already in use; choose another with --port or --listen" in done.stderr


def memory_mb(pid: int) -> float:
    status = Path(f"/proc/{pid}/status").read_text()
    return next(int(line.split()[1]) / 1024 for line in status.splitlines() if line.startswith("VmRSS"))
