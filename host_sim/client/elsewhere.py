"""Brings a client up to date with ticks whose frames C code exchanged and logged."""

from collections.abc import Sequence
from dataclasses import dataclass

from host_sim.client.report_checks import holds, is_as_started
from host_sim.client.robot_client import RobotClient
from host_sim.client.robot_reports import FIRST_HALF
from host_sim.protocol.codec import Frame


@dataclass(frozen=True)
class Ticks:
    """Ticks that a robot has answered elsewhere.

    Attributes:
        count: Number of ticks.
        drive: The last DRIVE.
    """

    count: int
    drive: Frame


def take_ticks(client: RobotClient, ticks: Ticks) -> None:
    """Takes over ticks, but not the robot's reports in them."""
    drive = client.protocol.decode_drive(ticks.drive)
    assert drive is not None
    client.inbox.catch_up(ticks.count, drive, ticks.drive)
    client.frames.sent += ticks.count


def take_last_reports(client: RobotClient, reports: Sequence[Frame]) -> None:
    """Takes over the reports of the last of these ticks, in order; earlier reports are not passed on."""
    client.reports.forget()
    if reports:
        client.unsettled = None
    for frame in reports:
        decoded = client.protocol.decode(frame)
        if decoded is not None:
            client.reports.judge(frame, decoded, client.frames.missing)
            client.reports.take(decoded)


def routine_reports(client: RobotClient) -> list[tuple[str, Frame]]:
    """The last report of each kind whose repetition with the next counter needs no further handling."""
    heartbeat = client.reports.heartbeat
    names = {"FAULTS"}
    if holds(client.inbox):
        names.add("HEALTH")
    if client.reports.memory_is_last:
        names.add("MEMORY")
    is_ours = heartbeat.get("state") and not heartbeat["silent"] and heartbeat["owner"] in (0, client.inbox.owner)
    if is_ours and is_as_started(client.inbox):
        names.add("HEARTBEAT")
    return client.reports.last_of(names)


def take_routine_reports(client: RobotClient, reports: Sequence[tuple[str, Frame]]) -> None:
    """Takes over routine reports that came with the next counters; of several of a kind, the last is enough."""
    for kind, frame in reports:
        client.reports.go_on(kind, frame, client.frames.missing)
        client.inbox.last = frame
        is_last = frame is reports[-1][1]
        if kind == "HEARTBEAT" or (kind == FIRST_HALF and is_last):  # the other half of a memory is still to come
            decoded = client.protocol.decode(frame)
            assert decoded is not None
            client.reports.take(decoded)
