"""Errors that people see, and the wording of their messages."""

from collections.abc import Iterable


class OctetError(Exception):
    """A fault while running: the command ends with exit code 1."""

    exit_code = 1


class UsageError(OctetError):
    """The command line, or a file that it names, is wrong: the command ends with exit code 2; nothing was changed."""

    exit_code = 2


class RobotError(OctetError):
    """The robot has ended, does not answer, or uses another protocol."""


class RefusedError(RobotError):
    """The robot understood a command and refused it; nothing was changed."""


class SessionLostError(RobotError):
    """The robot is no longer in the session that was started here; the message says how that was noticed.

    Attributes:
        doubt: Why the result is unreliable even if the robot recovers, as a sentence; empty if it is not.
        booted: Whether the robot reported that it has restarted.
        silent: Whether the robot did not answer in time.
    """

    def __init__(self, message: str, *, doubt: str = "", booted: bool = False, silent: bool = False) -> None:
        """Takes the message."""
        super().__init__(message)
        self.doubt, self.booted, self.silent = doubt, booted, silent


class RivalError(RobotError):
    """Somebody else commands the robot."""


class TwinError(RobotError):
    """Two robots have the same node number."""


class FirmwareError(RobotError):
    """The robot runs another firmware than at the start of the run, or one that this simulator does not know."""


class LinkDownError(RobotError):
    """The line to the robot is gone: the other end is closed, the bus is down, the adapter is unplugged."""


class BrainError(RobotError):
    """A behaviour in a C file of its user has made a mistake: the message says where, and with which senses.

    Attributes:
        node: The robot; 0 for one of a fleet.
        tick: The tick; None at the start of a run.
    """

    def __init__(self, message: str, tick: int | None = None, node: int = 0) -> None:
        """Takes the message and its attributes."""
        super().__init__(message)
        self.tick, self.node = tick, node

    @classmethod
    def from_failure(cls, failure: str, node: int = 0) -> "BrainError":
        """Of a failure in the form of `guard.h`: the tick, -1 at the start of a run, a space, and the message."""
        tick, _, message = failure.partition(" ")
        return cls(message, int(tick) if int(tick) >= 0 else None, node)


class PageNotBuiltError(OctetError):
    """The program of a page is not built."""


class DoubtfulError(OctetError):
    """The run went on to its end and its files were written, but its result is unreliable."""


def near_word(word: str, words: Iterable[str]) -> str | None:
    """The most similar word; None if none is similar.

    >>> near_word("corridor", ["random", "corridors"])
    'corridors'
    """
    from difflib import get_close_matches  # noqa: PLC0415 - only mistakes need it

    return next(iter(get_close_matches(word, list(words), 1)), None)


def meant(word: object, words: Iterable[object]) -> str:
    """The end of a message about an unknown word: the nearest known word, or all of them if none is near.

    >>> meant("artcle", ["article", "fixed"])
    'did you mean article?'
    """
    every = [str(each) for each in words]
    near = near_word(str(word), every)
    return f"did you mean {near}?" if near else f"choose from {', '.join(every)}"


def counted(count: int, what: str) -> str:
    """A number and what is counted, in the singular or in the plural.

    >>> counted(1, "seed"), counted(2, "seed")
    ('1 seed', '2 seeds')
    """
    return f"{count} {what}" if count == 1 else f"{count} {what}s"
