"""What a connection to the page server may take: only a WebSocket is exempt from its limits."""

import asyncio

from host_sim.live import connections
from host_sim.live.listener import Listener
from host_sim.live.server import LiveServer
from tests.runs.support import DEADLINE_S


def test_a_request_for_a_websocket_that_does_not_become_one_is_not_exempt(live, monkeypatch, tmp_path):
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path))
    monkeypatch.setattr(connections, "LIFETIME_S", 0.2)
    monkeypatch.setattr(connections, "_KEEP_ALIVE_S", 2.0 * DEADLINE_S)
    listener = Listener(None, 0)
    host = f"127.0.0.1:{listener.port}"
    request = f"GET /live?token={listener.token} HTTP/1.1\r\nHost: {host}\r\nOrigin: http://{host}\r\n\r\n"

    async def answer() -> bytes:
        async with LiveServer(live(), listener).serving():
            reader, writer = await asyncio.open_connection("127.0.0.1", listener.port)
            writer.write(request.encode())
            said = b""
            while some := await asyncio.wait_for(reader.read(4096), DEADLINE_S):
                said += some
            writer.close()
            return said

    assert asyncio.run(answer()).startswith(b"HTTP/1.1 400")
