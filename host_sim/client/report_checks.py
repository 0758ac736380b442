"""Compares a robot's reports with its session."""

from typing import TYPE_CHECKING

from host_sim.base.errors import FirmwareError
from host_sim.protocol.codec import DecodedFrame
from host_sim.protocol.generated import Fault

if TYPE_CHECKING:
    from host_sim.client.inbox import Inbox


def check_report(inbox: "Inbox", report: DecodedFrame) -> None:
    """Checks a report that was just received.

    Raises:
        SessionLostError: The robot may no longer be the one that was started, or no longer be alone.
        FirmwareError: The robot was built from another layout of the messages.
    """
    if report.name == "HEARTBEAT":
        check_heartbeat(inbox, report)
        if inbox.asked.answered and not inbox.is_as_started():
            inbox.lose("does not run as it was told here")
    elif report.name == "EMERGENCY" and report.signals["kinds"] >> Fault.TWIN & 1:
        inbox.lose("hears another robot with its number")
    elif report.name == "HEALTH" and inbox.asked.answered and not inbox.holds():
        inbox.lose("does not hold what it was told here")
    elif report.name == "BOOT" and not inbox.reporting:
        inbox.lose("started anew", booted=True)


def check_heartbeat(inbox: "Inbox", heartbeat: DecodedFrame) -> None:
    """Checks a heartbeat, including those sent in silence.

    Raises:
        SessionLostError: As in `check_report`.
        FirmwareError: As in `check_report`.
    """
    theirs, ours = heartbeat.signals["layout"], inbox.protocol.layout
    if not inbox.protocol.fits(theirs):
        inbox.lose("reports another layout of the messages")
        hashes = f"hash {theirs:04X}, ours {ours:04X}"
        raise FirmwareError(f"the robot was built from another octet.dbc ({hashes}): rebuild it")
    if not heartbeat.signals["state"] and inbox.session is not None and not inbox.session.halted:
        inbox.lose("reports that it is stopped")
    if heartbeat.signals["owner"] not in (0, inbox.owner):
        inbox.lose(f"obeys simulator {heartbeat.signals['owner']}")
