"""The profile `article`: the listing as it is."""

from tests.firmware.oracles.listing import Listing


class Oracle(Listing):
    """It learns from trials, and never forgets."""
