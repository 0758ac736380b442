"""Determines what happened to a robot that dropped out of its session, and restarts it if possible."""

from host_sim.base.errors import FirmwareError, OctetError, RivalError, SessionLostError, TwinError
from host_sim.client.commands import freeze, handshake, start
from host_sim.client.robot_client import RobotClient
from host_sim.client.session import Session
from host_sim.protocol.codec import COUNTERS
from host_sim.protocol.generated import Drive

_FIRMWARE = ("commit", "modified", "version_major", "version_minor")
_ATTEMPTS = 5
_LAST_S = 1.0
_LOST_MIN = 50
"""With this many frames missing since the start, lost drives explain wheels that do not follow."""
_AHEAD_MAX = COUNTERS // 2


def drive_after(client: RobotClient, lost: SessionLostError) -> Drive:
    """In lockstep, for a lost robot: waits for the answer to the last senses after its recovery.

    Raises:
        TwinError: As in `recover`.
        RivalError: As in `recover`.
        FirmwareError: As in `recover`.
        RobotError: The robot does not answer, or is lost again and again.
    """
    for _ in range(_ATTEMPTS):
        recover(client, lost)
        client.repeat_senses()
        try:
            return client.await_drive()
        except SessionLostError as again:
            if again.silent:
                raise client.dialogue.no_answer(f"tick {client.tick}") from None
            lost = again
    raise lost


def settle(client: RobotClient) -> None:
    """Makes sure that the last reported memory is the robot's.

    Raises:
        RobotError: As in `recover`.
    """
    client.check_settled()
    try:
        client.settle()
    except SessionLostError as lost:
        recover(client, lost)


def recover(client: RobotClient, lost: SessionLostError) -> None:
    """Queries a robot's state. If it has rebooted, starts it again with the memory that it had.

    Raises:
        TwinError: Two robots have this node number.
        RivalError: Another simulator commands the robot.
        FirmwareError: The robot runs another firmware than before.
        RobotError: The robot does not answer.
    """
    if lost.doubt:
        client.distrust(f"{lost.doubt}: {lost}")
    try:
        _find_out(client, lost)
    except OctetError as why:  # whatever the reason, the robot's state is unknown
        client.distrust(str(why))
        raise


def _find_out(client: RobotClient, lost: SessionLostError) -> None:
    session, memory, before = client.inbox.session, client.memory, _State(client)
    assert session is not None
    client.inbox.session = None
    _check_rival(client)
    _request_report(client, lost)
    has_restarted = _has_restarted(client, before, lost)
    # A restart sets the robot's counters to 0.
    _check_twins(client, 0 if has_restarted else before.faults.get("twins", 0))
    if _has_halted(client, before):
        _note_halt(client, session)
        return
    if has_restarted:
        _check_firmware(client)
        _start_again(client, session, memory)
        return
    _check_owner(client, lost)
    client.inbox.session = session
    client.frames.refused += lost.booted  # a BOOT although the robot did not reboot
    client.check_held()


def _request_report(client: RobotClient, lost: SessionLostError) -> None:
    client.reports.forget()
    client.dialogue.expect_reports("report")
    if client.dialogue.ask("report", {}, _LAST_S if lost.silent else client.connection.deadline_s) is None:
        raise client.dialogue.no_answer(f"tick {client.tick}")
    if not client.dialogue.await_reports():
        client.dialogue.demand_reports("report")


class _State:
    """The robot's reports before it was lost."""

    def __init__(self, client: RobotClient) -> None:
        reports = client.reports
        self.boot, self.heartbeat, self.faults = reports.boot, reports.heartbeat, dict(reports.faults)
        self.denied = reports.faults_before.get("denied", 0)  # the latest count may include the cause of its stop


def _has_restarted(client: RobotClient, before: _State, lost: SessionLostError) -> bool:
    """Whether the robot has rebooted: it is stopped, reports so, and counts time and BOOTs from 0 again."""
    after = client.reports
    if after.heartbeat["state"]:
        return False
    ahead = (after.boot["counter"] - before.boot.get("counter", 0)) % COUNTERS
    went_back = after.heartbeat["uptime"] < before.heartbeat.get("uptime", 0)
    return lost.booted or went_back or not 1 <= ahead <= _AHEAD_MAX


def _check_firmware(client: RobotClient) -> None:
    was, now = client.firmware, client.reports.boot
    if any(was[name] != now[name] for name in _FIRMWARE):
        raise FirmwareError(
            f"node {client.node} came back with another firmware at tick {client.tick}: commit {now['commit']:06x}, "
            f"not {was['commit']:06x}"
        )


def _start_again(client: RobotClient, session: Session, memory: tuple[int, ...]) -> None:
    cause = client.protocol.choice("BOOT", "reset_cause", client.reports.boot["reset_cause"])
    kept = client.memory == memory
    try:
        handshake(client, client.connection.deadline_s)
        _start_as_before(client, session, None if kept else memory)
    finally:
        client.reports.memory = memory  # its knowledge is kept, even if it cannot be written back
    client.distrust(
        f"the robot restarted ({cause}) with its memory {'kept' if kept else 'restored'}, and was started again"
    )


def _start_as_before(client: RobotClient, session: Session, memory: tuple[int, ...] | None) -> None:
    start(client, session, memory)
    if session.frozen:
        freeze(client, True)


def _check_rival(client: RobotClient) -> None:
    rival = client.inbox.rivals.heard
    if rival is not None:
        client.dialogue.stop_at_once()
        raise RivalError(
            f"another simulator commands node {client.node}, heard at tick {client.tick}: "
            f"{client.protocol.describe(rival)}; end one of the two, or use another --node"
        )


def _check_twins(client: RobotClient, before: int) -> None:
    if client.faults.get("twins", 0) > before:
        client.dialogue.stop_at_once()
        raise TwinError(
            f"two robots are node {client.node} on this bus, seen at tick {client.tick}: give each its own number"
        )


def _has_halted(client: RobotClient, before: _State) -> bool:
    """Whether the robot has stopped by itself because of its wheels."""
    return not client.reports.heartbeat["state"] and client.faults["denied"] > before.denied


def _note_halt(client: RobotClient, session: Session) -> None:
    """Leaves a robot at rest if its wheels do not follow; restarts it if drives were lost."""
    if client.frames.missing - session.missing < _LOST_MIN:
        session.halted, client.inbox.session = True, session
        client.distrust("the wheels did not do what they were told, and the robot has stopped")
        return
    _start_as_before(client, session, None)
    client.distrust("the robot stopped, for too many of its drives were lost, and was started again")


def _check_owner(client: RobotClient, lost: SessionLostError) -> None:
    heartbeat = client.reports.heartbeat
    if heartbeat["owner"] not in (0, client.inbox.owner):
        client.dialogue.stop_at_once()
        raise RivalError(f"simulator {heartbeat['owner']} has taken over node {client.node} at tick {client.tick}")
    if not heartbeat["state"]:
        client.dialogue.stop_at_once()
        how = "somebody else stopped" if client.tick else "a restart or somebody else stopped"
        raise RivalError(f"{how} node {client.node}: {lost}")
