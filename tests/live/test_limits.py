"""What a connection to the page server may take: only a WebSocket is exempt from its limits."""

import asyncio

import aiohttp
import pytest

from host_sim.live import connections, server
from host_sim.live.listener import Listener
from host_sim.live.paced_run import PacedRun
from host_sim.live.server import LiveServer
from tests.runs.support import DEADLINE_S

PAGE = ""
UPGRADE = (
    "Upgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
    "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n"
)


def answer(run: PacedRun, headers: str = "", then: bytes = b"") -> bytes:
    """What a server says to a request for its run until it closes the connection, and to bytes behind the answer."""
    listener = Listener(None, 0)
    host = f"127.0.0.1:{listener.port}"
    request = f"GET /live?token={listener.token} HTTP/1.1\r\nHost: {host}\r\nOrigin: http://{host}\r\n{headers}\r\n"

    async def ask() -> bytes:
        async with LiveServer(run, listener, PAGE).serving():
            reader, writer = await asyncio.open_connection("127.0.0.1", listener.port)
            writer.write(request.encode())
            if then:
                await asyncio.wait_for(reader.readuntil(b"\r\n\r\n"), DEADLINE_S)
                writer.write(then)
            said = await asyncio.wait_for(reader.read(), DEADLINE_S)
            writer.close()
            return said

    return asyncio.run(ask())


def test_live_request_without_websocket_upgrade_keeps_its_time_limit(live, monkeypatch):
    monkeypatch.setattr(connections, "LIFETIME_S", 0.2)
    monkeypatch.setattr(connections, "_KEEP_ALIVE_S", 2.0 * DEADLINE_S)

    assert answer(live()).startswith(b"HTTP/1.1 400")


def frame(payload: bytes, mask: bytes) -> bytes:
    """A WebSocket frame with text, masked unless the mask is empty."""
    masked = bytes(byte ^ mask[i % 4] for i, byte in enumerate(payload)) if mask else payload
    size, flag = len(payload), 0x80 if mask else 0
    head = bytes([flag | size]) if size < 126 else bytes([flag | 126]) + size.to_bytes(2, "big")
    return b"\x81" + head + mask + masked


@pytest.mark.parametrize("step", [1, 2, 7, 1000])
def test_mask_check_finds_an_unmasked_frame_in_chunks_of_any_size(step):
    fine = b"".join(frame(b"x" * size, b"mask") for size in (0, 1, 125, 126, 1000))
    for data, masked in ((fine, True), (fine + frame(b"x", b""), False)):
        masks = connections._Masks()
        assert all(masks.are_in(data[at : at + step]) for at in range(0, len(data), step)) == masked


def test_frame_without_a_mask_closes_the_websocket(live):
    run = live()

    assert answer(run, UPGRADE, frame(b'{"do": "pause"}', b"")).endswith(b"\x88\x02\x03\xea")
    assert run.playing


def test_full_server_closes_the_longest_idle_page_for_a_new_one(live, monkeypatch):
    monkeypatch.setattr(server, "PAGES_MAX", 2)
    listener = Listener(None, 0)
    home = f"http://127.0.0.1:{listener.port}"

    async def open_three() -> list[bool]:
        async with LiveServer(live(), listener, PAGE).serving(), aiohttp.ClientSession() as session:

            async def page() -> aiohttp.ClientWebSocketResponse:
                return await session.ws_connect(f"{home}/live?token={listener.token}", headers={"Origin": home})

            first, second = await page(), await page()
            with pytest.raises(aiohttp.WSServerHandshakeError, match="503"):
                await page()
            await first.send_str('{"do": "nothing that a page can do"}')
            while "not understood" not in await first.receive_str():
                pass
            monkeypatch.setattr(server, "IDLE_S", 0.0)
            third = await page()
            while (await second.receive()).type is aiohttp.WSMsgType.TEXT:
                pass
            return [each.closed for each in (first, second, third)]

    assert asyncio.run(asyncio.wait_for(open_three(), DEADLINE_S)) == [False, True, False]


@pytest.mark.parametrize("origin", ["{home}0", "{home}.evil.example", "{home}/", "http://127.0.0.1", "", "null"])
def test_origin_that_does_not_match_exactly_is_refused(live, origin):
    listener = Listener(None, 0)
    home = f"http://127.0.0.1:{listener.port}"

    async def connect() -> None:
        async with LiveServer(live(), listener, PAGE).serving(), aiohttp.ClientSession() as session:
            headers = {"Origin": origin.format(home=home)}
            await session.ws_connect(f"{home}/live?token={listener.token}", headers=headers)

    with pytest.raises(aiohttp.WSServerHandshakeError, match="403"):
        asyncio.run(connect())
