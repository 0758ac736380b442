"""Getting to know a robot: it is stopped, says who it is, and is refused if it speaks another protocol."""

import time

from host_sim.client.robot_client import RobotClient
from host_sim.errors import RobotError
from host_sim.protocol.codec import DecodedFrame


def handshake(client: RobotClient, timeout_s: float, retry_s: float | None = None) -> None:
    """Stops the robot and gets to know it; the log begins with this.

    Args:
        client: Has said nothing yet.
        timeout_s: Wall time to wait for the robot.
        retry_s: Wall time after which to ask again, for a robot that may not be there yet. None for one that is known
            to listen: it is asked once, so that the log is the same however long it takes.

    Raises:
        RobotError: None answers, or one that was built from another layout of the messages.
    """
    client.recording = False
    give_up = time.monotonic() + timeout_s
    while True:
        stop = client.send_command("stop", {})
        answer = client.await_answer(retry_s or timeout_s)
        if answer is not None:
            break
        if time.monotonic() >= give_up:
            raise RobotError(f"no robot of node {client.node} answered for {timeout_s:g} s; {client.account()}")
    _check_hash(client, client.expect("HEARTBEAT", "stop"))
    assert client.last is not None
    for frame in (stop, answer, client.last):
        client.log.add(frame)
    client.recording = True
    client.expect("MEMORY", "stop")


def _check_hash(client: RobotClient, heartbeat: DecodedFrame) -> None:
    theirs, ours = heartbeat.signals["dbc_hash"], client.protocol.dbc_hash
    if not client.protocol.fits(theirs):
        hashes = f"hash {theirs:04X}, ours {ours:04X}"
        raise RobotError(f"the robot was built from another octet.dbc ({hashes}): rebuild it")
