"""A run of so many ticks, for comparing and measuring robots."""

from pathlib import Path

from host_sim.backends.connection import Connection
from host_sim.client.frame_log import Recorder
from host_sim.client.pacing import Lockstep, Pace
from host_sim.client.session import Session
from host_sim.protocol.codec import Protocol
from host_sim.robot_io import Drive, Senses
from host_sim.sim.simulation import Simulation
from host_sim.world.params import SimParams

_PATIENCE_S = 5.0
_ENVIRONMENT_S = 600.0


class _Over(Exception):  # noqa: N818 - no fault
    """All ticks are done."""


class _Limited:
    """A pace that ends after so many ticks."""

    def __init__(self, pace: Pace, ticks: int) -> None:
        self._pace, self._left = pace, ticks

    def exchange(self, senses: Senses) -> Drive:
        if self._left == 0:
            raise _Over
        self._left -= 1
        return self._pace.exchange(senses)


def run_ticks(connection: Connection, seed: int, ticks: int, log: Path) -> Session:
    """Lets a robot learn in lockstep, one environment after the other, until that many ticks have passed.

    Args:
        connection: To the robot.
        seed: Of environments and random turns.
        ticks: How many.
        log: Where to record the frames.

    Returns:
        The conversation, as it ended.

    Raises:
        RobotError: The robot is gone.
    """
    params, recorder = SimParams(), Recorder(log)
    try:
        session = Session(connection.link, Protocol(), recorder, status=connection.status)
        session.handshake(_PATIENCE_S)
        session.start(seed, 0, {}, None)
        pace = _Limited(Lockstep(session), ticks)
        try:
            # An environment takes at least one tick, so that there are enough.
            for _ in Simulation(params, session, pace, seed, ticks + 1, _ENVIRONMENT_S).run():
                pass
        except _Over:
            session.stop()
        return session
    finally:
        recorder.close()
