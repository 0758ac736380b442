"""Compares a robot's reports with its session."""

from host_sim.base.errors import FirmwareError
from host_sim.client.inbox import Inbox
from host_sim.protocol.codec import DecodedFrame
from host_sim.protocol.generated import Fault


def check_report(inbox: Inbox, report: DecodedFrame) -> None:
    """Checks a new report, or a heartbeat sent in silence, which need not be new.

    Raises:
        SessionLostError: The robot may no longer be the one that was started, or no longer be alone.
        FirmwareError: The robot was built from another layout of the messages.
    """
    if report.name == "HEARTBEAT":
        _check_heartbeat(inbox, report)
        if not report.signals["silent"] and inbox.asked.answered and not is_as_started(inbox):
            inbox.lose("does not run as it was told here")
    elif report.name == "EMERGENCY" and report.signals["kinds"] >> Fault.TWIN & 1:
        inbox.lose("hears another robot with its number")
    elif report.name == "HEALTH" and inbox.asked.answered and not holds(inbox):
        inbox.lose("does not hold what it was told here")
    elif report.name == "BOOT" and not inbox.reporting:
        inbox.lose("started anew", booted=True)


def _check_heartbeat(inbox: Inbox, heartbeat: DecodedFrame) -> None:
    theirs, ours = heartbeat.signals["layout"], inbox.protocol.layout
    if not inbox.protocol.fits(theirs):
        inbox.lose("reports another layout of the messages")
        hashes = f"hash {theirs:04X}, ours {ours:04X}"
        raise FirmwareError(f"the robot was built from another octet.dbc ({hashes}): rebuild it")
    if not heartbeat.signals["state"] and inbox.session is not None and not inbox.session.halted:
        inbox.lose("reports that it is stopped")
    if heartbeat.signals["owner"] not in (0, inbox.owner):
        inbox.lose(f"obeys simulator {heartbeat.signals['owner']}")


def holds(inbox: Inbox) -> bool:
    """Whether the robot's last report shows that it holds exactly the commands sent here."""
    return inbox.told.agrees(inbox.reports.held, inbox.reports.memory)


def is_as_started(inbox: Inbox) -> bool:
    """Whether the robot's last heartbeat shows that it runs as it was started here."""
    session, said = inbox.session, inbox.reports.heartbeat
    if session is None or inbox.told.given_up:
        return True
    ours = session.profile, int(inbox.lockstep), int(session.frozen)
    return (said["profile"], said["lockstep"], said["frozen"]) == ours
