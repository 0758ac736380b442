"""Whole reports: each ends a run with one stop, whatever the robot was about to say."""

import pytest

from tests.client.support import PROTOCOL, connected, run

STOP = PROTOCOL.choices("COMMAND", "opcode")["stop"]


@pytest.mark.parametrize("ticks", range(48, 58))  # in ticks 50 to 55 the robot says its parts of the second's report
def test_a_stop_during_a_report_is_sent_once(ticks):
    with connected() as client:
        run(client, ticks)

    said = [decoded for frame in client.log.frames if (decoded := PROTOCOL.decode(frame)) is not None]
    at = max(i for i, decoded in enumerate(said) if decoded.name == "ANSWER")
    stops = [it for it in said if it.name == "COMMAND" and it.signals["opcode"] == STOP]
    assert len(stops) == 2  # that of the handshake, and the last one
    assert [it.signals["page"] for it in said[at:] if it.name == "FAULTS"] == [0, 1]
