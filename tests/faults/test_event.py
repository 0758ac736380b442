"""Events of a campaign, as a person writes them."""

import pytest

from host_sim.base.errors import UsageError
from host_sim.faults.event import Event


@pytest.mark.parametrize("text", ["hang:300@150", "reset@150"])
def test_an_event_is_written_as_it_was_read(text):
    assert str(Event.parse(text)) == text


@pytest.mark.parametrize("text", ["", "hang", "hang@", "hang:@5", "Hang@5", "hang:300@150s"])
def test_what_is_no_event_is_refused(text):
    with pytest.raises(UsageError, match="is not an event"):
        Event.parse(text)
