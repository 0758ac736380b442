"""Assigns robots to pages where each page has its own."""

import re
import unicodedata
from collections.abc import Iterable
from dataclasses import dataclass

NAME_MAX = 20
"""Maximum length of a name tag, characters."""

_KEY = re.compile(r"[0-9a-f]{32}")


@dataclass
class Seat:
    """A robot, and the page that it belongs to.

    Attributes:
        node: The robot's node number.
        name: The name tag that the page gave it.
        key: Key that identifies the page when it is opened again; empty while the robot is free.
        pages: Number of pages with that key that are open.
        left: When the last of them was closed, as a count of such events.
    """

    node: int
    name: str = ""
    key: str = ""
    pages: int = 0
    left: int = 0


class Seats:
    """Gives each page a robot, and gives it back when the page comes again.

    Attributes:
        all: One for each robot.
    """

    def __init__(self, nodes: Iterable[int]) -> None:
        """Starts with all robots free.

        Args:
            nodes: The robots' node numbers.
        """
        self.all = [Seat(node) for node in nodes]
        self._closed = 0

    def take(self, key: str) -> Seat | None:
        """The robot of a page that has opened: its own, or a free one, or that of the page which left first.

        Args:
            key: Key that identifies the page; anything but 32 hexadecimal digits gets no robot.
        """
        seat = self._seat_for(key) if _KEY.fullmatch(key) else None
        if seat is None:
            return None
        if seat.key != key:
            seat.key, seat.name = key, ""
        seat.pages += 1
        return seat

    def leave(self, seat: Seat) -> None:
        """A page has closed. Its robot is kept for it until all others are taken."""
        self._closed += 1
        seat.pages, seat.left = seat.pages - 1, self._closed

    def rename(self, seat: Seat, text: str) -> None:
        """Puts a name tag on a robot."""
        seat.name = name_from(text)

    def _seat_for(self, key: str) -> Seat | None:
        own = next((seat for seat in self.all if seat.key == key), None)
        free = next((seat for seat in self.all if not seat.key), None)
        left = min((seat for seat in self.all if not seat.pages), key=lambda seat: seat.left, default=None)
        return own or free or left


def name_from(text: str) -> str:
    r"""A name tag: printable characters, single spaces, at most `NAME_MAX` long.

    >>> name_from("  Ada \x1b[1m  L.\n")
    'Ada [1m L.'
    """
    known = unicodedata.normalize("NFC", text[: 4 * NAME_MAX])
    printable = "".join(sign if sign.isprintable() else " " for sign in known)
    return " ".join(printable.split())[:NAME_MAX].rstrip()
