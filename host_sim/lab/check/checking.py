"""Runs the checks, each on a robot just powered up: a program started for it, or a robot on a bus."""

import os
import signal
import threading
from collections.abc import Callable, Collection, Iterator, Mapping
from concurrent.futures import ThreadPoolExecutor
from contextlib import AbstractContextManager, ExitStack, closing, contextmanager
from dataclasses import dataclass

from host_sim.base.errors import LinkDownError, RobotError, UsageError
from host_sim.base.terminal import counted
from host_sim.lab.check import conversation, session, silence  # noqa: F401 - each registers its checks
from host_sim.lab.check.sentences import NOT_CHECKED, breaches, sentences
from host_sim.lab.check.talk import CHECKS, BrokenError, SeenFrame, Talk
from host_sim.protocol.codec import COUNTERS, Protocol
from host_sim.protocol.generated import Opcode
from host_sim.transport.bus_process import BusProcess, start_on_socket_pair
from host_sim.transport.buses import open_bus_link
from host_sim.transport.link import LineStats, Link, WallClock

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
        seen = talk.hear(_AGAIN_S, lambda seen: _answers(seen, talk.counter))
        if seen and _answers(seen[-1], talk.counter):
            talk.hear(_AGAIN_S, lambda seen: seen.is_answer)
            return
    heard = sum(seen.by_robot for seen in talk.frames)
    why = f"it sent {heard} frames, but no such ANSWER" if heard else "it sent nothing at all"
    raise UsageError(f"the robot does not answer stop within {WAKE_S:g} s: {why}")


def _answers(seen: SeenFrame, counter: int) -> bool:
    return seen.name == "ANSWER" and seen.signals.get("counter") == counter and not seen.signals["result"]


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


_FRAMES = 12


@dataclass(frozen=True)
class Verdict:
    """The verdict on a sentence.

    Attributes:
        number: Number of the sentence, or the name of a message or a signal.
        text: The sentence.
        state: `holds`, `fails`, or `not checked`.
        why: The fault, or the reason why it is not checked.
        frames: The last frames before the fault, for people.
    """

    number: str
    text: str
    state: str
    why: str = ""
    frames: tuple[str, ...] = ()


def check_robot(robots: Robots, missing: Collection[str] = (), jobs: int = 1, tries: int = 1) -> list[Verdict]:
    """Judges each sentence.

    Args:
        robots: Provides a robot for each check.
        missing: Checks that are not possible with this robot.
        jobs: Maximum number of robots at once.
        tries: Attempts per check before it counts as failed, since a busy machine may cause delays.

    Raises:
        UsageError: There is no robot, or it does not answer at all.
    """
    with robots():
        pass  # any reason for not answering is reported at once
    possible = [number for number in CHECKS if number not in missing]
    possible.sort(key=lambda number: CHECKS[number].__module__ != silence.__name__)  # slowest checks first
    with ThreadPoolExecutor(jobs) as pool:
        results = pool.map(lambda number: _run(number, robots, tries), possible)
        done = dict(zip(possible, counted(results, len(possible), "sentences"), strict=True))
        return list(_judge(done, missing))


def _run(number: str, robots: Robots, tries: int) -> tuple[str, Talk | None]:
    """Runs a check until it succeeds or has failed so often. Returns the fault, and the talk if there was one."""
    why, talk = "", None
    try:
        with robots() as talk:
            CHECKS[number](talk)
    except (BrokenError, RobotError) as error:
        why = str(error)
    is_broken = why or (talk is not None and any(breaches(talk.frames)))
    return _run(number, robots, tries - 1) if is_broken and tries > 1 else (why, talk)


def _judge(results: Mapping[str, tuple[str, Talk | None]], missing: Collection[str]) -> Iterator[Verdict]:
    broken: dict[str, tuple[str, tuple[str, ...]]] = {}
    heard: set[str] = set()
    for number, (why, talk) in results.items():
        frames = talk.frames if talk is not None else []
        heard |= {each.name for each in frames if each.by_robot}
        if why:
            broken[number] = (why, tuple(talk.lines(len(frames), _FRAMES)) if talk is not None else ())
        for breach in breaches(frames):
            assert talk is not None
            end = 1 + next(i for i, each in enumerate(frames) if each is breach.seen)
            broken.setdefault(breach.number, (breach.why, tuple(talk.lines(end, _FRAMES // 3))))
    for number, text in sentences().items():
        message = number.partition(".")[0]
        if number in broken:
            yield Verdict(number, text, "fails", *broken[number])
        elif number in NOT_CHECKED or number in missing:
            reason = NOT_CHECKED.get(number, "it needs a robot that can be started and stopped: use --robot-command")
            yield Verdict(number, text, "not checked", reason)
        elif "." in number and message not in heard:
            yield Verdict(number, text, "not checked", f"no {message} came")
        else:
            yield Verdict(number, text, "holds")
