"""The code by which a pupil joins: short enough to read off a wall and to type, so guesses are limited."""

import secrets
import time
from collections import deque
from collections.abc import Callable

from host_sim.base.errors import OctetError

EACH_MAX, ALL_MAX, PERIOD_S = 5, 60, 60.0
"""Maximum number of wrong codes from one address, and from all, in this time."""

# fmt: off
_WORDS = (
    "acorn", "agate", "amber", "apple", "april", "arrow", "bacon", "badge", "banjo", "basil", "beach", "berry",
    "bison", "blaze", "bloom", "board", "bread", "brick", "bridge", "brook", "cabin", "cable", "camel", "candy",
    "canoe", "cedar", "chalk", "cherry", "chess", "cider", "clock", "cloud", "clover", "cobra", "comet", "coral",
    "cotton", "crane", "crown", "daisy", "delta", "dingo", "dream", "eagle", "earth", "ember", "fable", "falcon",
    "fern", "field", "finch", "flame", "flute", "forest", "frost", "galaxy", "garden", "gecko", "ginger", "globe",
    "grape", "gravel", "guitar", "harbor", "hazel", "honey", "horse", "igloo", "island", "ivory", "jacket", "jaguar",
    "jelly", "jungle", "kayak", "kettle", "koala", "ladder", "lagoon", "lemon", "lilac", "linen", "lizard", "llama",
    "magnet", "mango", "maple", "marble", "melon", "meteor", "mint", "mosaic", "moss", "nectar", "needle", "nickel",
    "nutmeg", "oasis", "ocean", "olive", "onion", "orbit", "orchid", "otter", "oyster", "panda", "paper", "peach",
    "pearl", "pepper", "piano", "pilot", "planet", "plaza", "pocket", "poppy", "prism", "pumpkin", "quartz", "rabbit",
    "radar", "raven", "ribbon", "river", "robin", "rocket", "saddle", "sailor", "salmon", "sand", "silver", "spider",
    "spruce", "squid", "summer", "sunset", "tango", "tiger", "toast", "topaz", "tulip", "turtle", "valley", "velvet",
    "violin", "walnut", "whale", "willow", "winter", "yogurt", "zebra",
)
# fmt: on


class TooManyGuessesError(OctetError):
    """There were too many wrong codes; this one was not checked."""


class JoinCode:
    """One code, which lasts as long as the run.

    Attributes:
        text: A word and four digits, such as "maple-4711".
    """

    def __init__(self, clock: Callable[[], float] = time.monotonic) -> None:
        """Draws a code; `clock` returns the time, s."""
        self.text = f"{secrets.choice(_WORDS)}-{secrets.randbelow(10_000):04}"
        self._clock = clock
        self._wrong: deque[tuple[float, str]] = deque()

    def opens(self, given: str, address: str) -> bool:
        """Whether a code is right; upper case and a missing hyphen do not matter.

        Args:
            given: The code typed.
            address: Network address of its sender.

        Raises:
            TooManyGuessesError: There were too many wrong ones; a right one would be refused, too.
        """
        now = self._clock()
        while self._wrong and self._wrong[0][0] <= now - PERIOD_S:
            self._wrong.popleft()
        if len(self._wrong) >= ALL_MAX or sum(who == address for _, who in self._wrong) >= EACH_MAX:
            raise TooManyGuessesError("too many wrong codes: wait a minute, or scan the QR code on the board")
        is_right = secrets.compare_digest(_plain(given), _plain(self.text))
        if not is_right:
            self._wrong.append((now, address))
        return is_right


def _plain(code: str) -> bytes:
    return code.replace("-", "").lower().encode()
