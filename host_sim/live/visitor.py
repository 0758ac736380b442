"""One open page: the updates sent to it, and its commands."""

import asyncio
import contextlib
import time
from collections.abc import Callable
from dataclasses import dataclass, field

from aiohttp import WSCloseCode, WSMsgType, web

from host_sim.live.feed import PageFeed
from host_sim.live.paced_run import PacedRun
from host_sim.live.page_commands import Question, page_command_from

_REFUSALS_MAX = 100


@dataclass
class Visitor:
    """One page.

    Attributes:
        socket: Its connection.
        feed: The messages to it.
        pause_s: Returns the minimum time between two messages to it, s.
        heard_s: When it was opened, or last sent a message, on the monotonic clock.
    """

    socket: web.WebSocketResponse
    feed: PageFeed
    pause_s: Callable[[], float]
    heard_s: float = field(default_factory=time.monotonic)

    async def serve(self, live: PacedRun) -> None:
        """Serves it until it disconnects, or has sent too many invalid messages."""
        sender = asyncio.create_task(self._send())
        try:
            await self._receive(live)
        finally:
            sender.cancel()

    async def _send(self) -> None:
        """Sends the latest state, as fast as the page reads."""
        with contextlib.suppress(ConnectionError):
            while not self.socket.closed:
                message = self.feed.next()
                if message is not None:
                    await self.socket.send_str(message)
                await asyncio.sleep(self.pause_s())

    async def _receive(self, live: PacedRun) -> None:
        refusals = 0
        while refusals < _REFUSALS_MAX:
            message = await self.socket.receive()
            self.heard_s = time.monotonic()
            if message.type is WSMsgType.TEXT:
                refusals += not self._accept(message.data, live)
            elif message.type is WSMsgType.BINARY:
                live.refused += 1
                refusals += 1
            else:
                live.refused += message.type is WSMsgType.ERROR
                return
        await self.socket.close(code=WSCloseCode.POLICY_VIOLATION, message=b"too many invalid messages")

    def _accept(self, text: str, live: PacedRun) -> bool:
        """Carries out a message; False if it is not a command."""
        try:
            self._obey(text, live)
        except ValueError as error:
            live.refused += 1
            live.change += 1
            self.feed.notes.append(f"not understood: {error}"[:200])
            return False
        return True

    def _obey(self, text: str, live: PacedRun) -> None:
        command = page_command_from(text)
        if isinstance(command, Question):
            self.feed.ask(command)
            live.change += 1
        else:
            live.offer(command, self.feed.notes.append)
