"""The handshake: the robot stops, identifies itself, and is rejected if it uses another protocol."""

from host_sim.base.errors import RivalError, RobotError
from host_sim.client.asked_commands import Told
from host_sim.client.report_checks import holds
from host_sim.client.robot_client import RobotClient
from host_sim.protocol.codec import Frame

_LISTEN_S = 0.1
"""A robot driven by another simulator receives senses at shorter intervals than this."""


def handshake(client: RobotClient, timeout_s: float, *, shared: bool = False) -> None:
    """Stops the robot and receives its reports; the log begins with these frames.

    Args:
        client: A client whose robot is not started.
        timeout_s: Time to wait for the robot, s.
        shared: Whether other simulators may be on the bus; if so, listens for them first.

    Raises:
        FirmwareError: The robot was built from another layout of the messages.
        RivalError: Another simulator drives the robot.
        RobotError: The robot does not answer.
    """
    held: list[Frame] = []
    client.inbox.record = held.append
    try:
        if shared:
            _listen(client)
        client.reports.forget()
        client.inbox.told = Told()
        client.dialogue.expect_reports("stop")
        if client.dialogue.ask("stop", {}, timeout_s) is None:
            raise RobotError(
                f"no robot answered as node {client.node} within {timeout_s:g} s; {client.dialogue.account()}"
            )
        assert client.inbox.last is not None
        held[:] = [client.inbox.asked.last, client.inbox.last]
        client.reports.await_all()  # reports before the answer are not in the log
        if not client.dialogue.await_reports():
            client.dialogue.demand_reports("stop")
        if not holds(client.inbox):  # it had an owner, and received other commands
            client.dialogue.demand_reports("stop")
        client.firmware = client.firmware or client.reports.boot
    finally:
        client.inbox.record = client.log.add
    for frame in held:
        client.log.add(frame)


def _listen(client: RobotClient) -> None:
    """Makes sure that no other simulator drives the robot, before it is stopped."""
    client.waiting.receive(client.inbox.take, _LISTEN_S)
    rival = client.inbox.rivals.heard
    if rival is not None:
        raise RivalError(
            f"node {client.node} is driven by another simulator: heard {client.protocol.describe(rival)}; "
            "end that one, or use another --node"
        )
