"""One open page: its rights, the updates sent to it, and its commands."""

import asyncio
import contextlib
from collections import deque
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from typing import Protocol

from aiohttp import WSCloseCode, WSMsgType, web

from host_sim.base.errors import OctetError
from host_sim.live.paced_run import PacedRun
from host_sim.live.page_commands import NameTag, PageCommand, Play, Question, RobotCommand, page_command_from
from host_sim.live.seats import Seat, Seats

_REFUSALS_MAX = 100
_THE_BOARDS = "the board does that for all: here you can change your own robot"
_ONLY_WATCHING = "every robot has a page of its own already: here you can watch"


class NotYoursError(OctetError):
    """The page may not give this command."""


@dataclass(frozen=True)
class Rights:
    """The rights of a page.

    Attributes:
        seats: The assignment of robots to pages; None for a page that may do everything.
        seat: The page's own robot; None if it has none.
    """

    seats: Seats | None = None
    seat: Seat | None = None

    @classmethod
    @contextlib.contextmanager
    def of(cls, seats: Seats | None, key: str) -> "Iterator[Rights]":
        """The rights of a page while it is open.

        Args:
            seats: The assignment if each page has a robot of its own; None for a page that may do everything.
            key: Key that identifies the page.
        """
        seat = seats.take(key) if seats else None
        try:
            yield cls(seats, seat)
        finally:
            if seats and seat:
                seats.leave(seat)

    def rename(self, text: str) -> None:
        """Puts a name tag on the page's robot.

        Raises:
            NotYoursError: It has none.
        """
        if self.seats is None or self.seat is None:
            raise NotYoursError("this page has no robot of its own to name")
        self.seats.rename(self.seat, text)

    def admit(self, command: PageCommand) -> PageCommand:
        """A command that the page may give; one without a node is for its own robot.

        Raises:
            NotYoursError: The command is for all, or for another robot.
        """
        if self.seats is None:
            return command
        if self.seat is None:
            raise NotYoursError(_ONLY_WATCHING)
        if not isinstance(command, RobotCommand):
            raise NotYoursError(_THE_BOARDS)
        return _for_node(command, self.seat.node)


def _for_node(command: RobotCommand, node: int) -> PageCommand:
    if command.node not in (None, node):
        raise NotYoursError(f"robot {command.node} is not yours: yours is robot {node}")
    return replace(command, node=node)


class Feed(Protocol):
    """The messages to a page."""

    notes: deque[str]

    def next(self) -> str | None:
        """The next message; None if there is nothing new."""


@dataclass
class Visitor:
    """One page, or a board.

    Attributes:
        socket: Its connection.
        feed: The messages to it.
        rights: Its rights.
        pause_s: Returns the minimum time between two messages to it, s.
        begins: Whether its Play command begins a waiting run.
        ask: Receives the page's questions to a robot; None for a board, which does not talk.
    """

    socket: web.WebSocketResponse
    feed: Feed
    rights: Rights
    pause_s: Callable[[], float]
    begins: bool = False
    ask: Callable[[Question], None] | None = None

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
        except NotYoursError as error:
            live.change += 1
            self.feed.notes.append(str(error))
        except ValueError as error:
            live.refused += 1
            live.change += 1
            self.feed.notes.append(f"not understood: {error}"[:200])
            return False
        return True

    def _obey(self, text: str, live: PacedRun) -> None:
        command = page_command_from(text)
        if isinstance(command, NameTag):
            self.rights.rename(command.text)
            live.change += 1
            return
        if isinstance(command, Question):
            if self.ask is None:
                raise ValueError("a board does not talk")
            self.ask(command)
            live.change += 1
            return
        live.offer(self.rights.admit(command), self.feed.notes.append)
        if self.begins and command == Play(on=True):
            live.seen()
