"""The robot to be checked: a program that is started for each check, or an external robot on a bus."""

import os
import signal
import threading
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, ExitStack, closing, contextmanager

from host_sim.base.errors import LinkDownError, UsageError
from host_sim.lab.check.talk import Said, Talk
from host_sim.protocol.codec import COUNTERS, Protocol
from host_sim.protocol.generated import Opcode
from host_sim.transport.bus_process import BusProcess, start_on_socket_pair
from host_sim.transport.buses import open_bus_link
from host_sim.transport.clock import WallClock
from host_sim.transport.link import LineStats, Link

Robots = Callable[[], AbstractContextManager[Talk]]

WAKE_S = 5.0
"""Time after which a robot counts as not answering, s."""

_AGAIN_S = 0.25
_ANYBODY = 254
"""Owner ID of a sender whose stop cannot be an old one of the actual owner."""


def wake(talk: Talk) -> None:
    """Sends stop until the robot answers, and receives its reports.

    Raises:
        UsageError: The robot does not answer.
    """
    for _ in range(round(WAKE_S / _AGAIN_S)):
        talk.counter = (talk.counter + 1) % COUNTERS
        talk.send(talk.order(Opcode.STOP, owner=_ANYBODY))
        said = talk.hear(_AGAIN_S, lambda said: _answers(said, talk.counter))
        if said and _answers(said[-1], talk.counter):
            talk.hear(_AGAIN_S, lambda said: said.is_answer)
            return
    heard = sum(said.by_robot for said in talk.said)
    why = f"it sent {heard} frames, but no such ANSWER" if heard else "it sent nothing at all"
    raise UsageError(f"the robot does not answer stop within {WAKE_S:g} s: {why}")


def _answers(said: Said, counter: int) -> bool:
    return said.name == "ANSWER" and said.signals.get("counter") == counter and not said.signals["result"]


def _hang(pid: int, span_ms: int) -> None:
    os.killpg(pid, signal.SIGSTOP)
    threading.Timer(span_ms / 1000, os.killpg, (pid, signal.SIGCONT)).start()


@contextmanager
def started(command: str, bus: str, node: int) -> Iterator[Talk]:
    """Starts a program as the robot, on a bus of python-can or, for `fd`, on a socket pair.

    Raises:
        UsageError: The robot cannot be started, or does not answer.
    """
    environment = {"OCTET_NODE": str(node)}
    with ExitStack() as stack:
        link: Link
        if bus == "fd":
            link, process = start_on_socket_pair(command, environment)
            stack.callback(link.close)
        else:
            link = stack.enter_context(closing(_open(bus, node)))
            process = BusProcess(command, bus, environment)
        stack.callback(process.close)
        talk = Talk(link, WallClock(), Protocol(node), lambda span_ms: _hang(process.pid, span_ms))
        try:
            wake(talk)
        except LinkDownError as error:
            raise UsageError(str(error)) from None
        yield talk


def _open(bus: str, node: int) -> Link:
    return open_bus_link(bus, Protocol(node).ids_from("ROBOT"), LineStats())


@contextmanager
def external(bus: str, node: int) -> Iterator[Talk]:
    """Connects to a robot on a bus; it remains in the state left by the last check.

    Raises:
        UsageError: The bus cannot be opened, or the robot does not answer.
    """
    with closing(_open(bus, node)) as link:
        talk = Talk(link, WallClock(), Protocol(node))
        wake(talk)
        yield talk
