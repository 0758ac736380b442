"""The handshake: the robot stops, identifies itself, and is rejected if it uses another protocol."""

import time

from host_sim.client.robot_client import RobotClient
from host_sim.errors import RobotError
from host_sim.protocol.codec import DecodedFrame


def handshake(client: RobotClient, timeout_s: float, retry_s: float | None = None) -> None:
    """Stops the robot and receives its reports; the log begins with these frames.

    Args:
        client: A client that has not sent anything yet.
        timeout_s: Time to wait for the robot, s of wall-clock time.
        retry_s: Time after which to send the command again, for a robot that may not be on the bus yet, s of
            wall-clock time. None for a robot that is listening: the command is sent once.

    Raises:
        RobotError: The robot does not answer, or was built from another layout of the messages.
    """
    client.recording = False
    give_up = time.monotonic() + timeout_s
    while True:
        stop = client.send_command("stop", {})
        answer = client.await_answer(retry_s or timeout_s)
        if answer is not None:
            break
        if time.monotonic() >= give_up:
            raise RobotError(f"no robot answered as node {client.node} within {timeout_s:g} s; {client.account()}")
    _check_hash(client, client.expect("HEARTBEAT", "stop"))
    assert client.last is not None
    for frame in (stop, answer, client.last):
        client.log.add(frame)
    client.recording = True
    client.await_rest("stop")


def _check_hash(client: RobotClient, heartbeat: DecodedFrame) -> None:
    theirs, ours = heartbeat.signals["layout"], client.protocol.layout
    if not client.protocol.fits(theirs):
        hashes = f"hash {theirs:04X}, ours {ours:04X}"
        raise RobotError(f"the robot was built from another octet.dbc ({hashes}): rebuild it")
