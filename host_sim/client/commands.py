"""The handshake with a robot, and the commands to it."""

from collections.abc import Collection, Mapping, Sequence
from dataclasses import replace

from host_sim.base.errors import RivalError, RobotError
from host_sim.client.inbox import holds
from host_sim.client.robot_client import RobotClient
from host_sim.client.session import HeldCheck, Session
from host_sim.protocol.codec import Frame
from host_sim.protocol.generated import ANSWER_WANTS_RANGES, CELL_COUNT, MEMORY_KINDS, MemoryKind
from host_sim.world.memory_kinds import translated, with_sides

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
        client.inbox.held_check = HeldCheck(takes_senses=client.connection.sense is None)
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


_HALF = CELL_COUNT // 2
_KINDS = dict(enumerate(MEMORY_KINDS.values()))


def start(client: RobotClient, session: Session, memory: Sequence[int] | None = None) -> None:
    """Starts the robot, which then learns; it moves with the next senses.

    Args:
        client: The robot's client.
        session: Its seed, its profile and its parameters.
        memory: Eight bytes to write, translated to the profile's kind of memory; None keeps the robot's memory.

    Raises:
        RefusedError: The robot refuses a command.
        RobotError: The robot does not answer, or does not hold the memory.
    """
    client.inbox.session = None
    how = {"profile": session.profile, "seed": session.seed, "lockstep": int(client.inbox.lockstep)}
    answer = client.dialogue.command("start", **how)
    client.wants_ranges = bool(answer.signals["value"] & ANSWER_WANTS_RANGES)
    client.memory_kind = _KINDS[session.profile]
    for name, value in session.settings.items():
        client.dialogue.command("set", parameter=client.protocol.choices("COMMAND", "parameter")[name], value=value)
    if memory is not None:
        cells = translated(tuple(memory), client.memory_kind)
        _write(client, cells, range(CELL_COUNT))
        if client.memory != cells:
            raise RobotError(f"node {client.node} does not hold the memory that was just written to it: start again")
    client.inbox.session = replace(session, frozen=False, halted=False, missing=client.frames.missing)


def stop(client: RobotClient) -> None:
    """Stops the robot's wheels and receives its final reports.

    Raises:
        RobotError: The robot does not answer.
    """
    client.inbox.session = None
    client.dialogue.demand_reports("stop")
    if not holds(client.inbox):
        client.dialogue.demand_reports("report")  # one of the two reports may have been damaged in transit
    client.check_held()
    client.check_settled()
    for doubt in client.deadlines.doubts():
        client.distrust(doubt)


def write_cells(client: RobotClient, sides: Mapping[int, int]) -> None:
    """Writes turns for patterns and waits until the robot reports its new memory.

    Args:
        client: The robot's client.
        sides: New turn by pattern, 1..7: 0 nothing, 1 left, 2 right.

    Raises:
        RefusedError: The robot refuses the command.
        RobotError: The robot does not answer.
    """
    before = client.memory
    after = with_sides(before, client.memory_kind, sides.items())
    named = sides if client.memory_kind != MemoryKind.ALL_SENSORS else ()
    _write(client, after, {i for i, byte in enumerate(after) if byte != before[i] or i in named})


def erase_memory(client: RobotClient) -> None:
    """Erases all cells and waits until the robot reports its new memory.

    Raises:
        RobotError: The robot does not answer.
    """
    client.dialogue.command("erase")
    client.await_memory()


def freeze(client: RobotClient, on: bool) -> None:
    """Stops the robot's learning, or lets it learn again.

    Raises:
        RobotError: The robot does not answer.
    """
    client.dialogue.command("freeze", freeze=int(on))
    if client.inbox.session is not None:
        client.inbox.session.frozen = on


def _write(client: RobotClient, memory: Sequence[int], written: Collection[int]) -> None:
    """Writes some bytes of a memory. All zeros erase it, so that no half of another memory is left."""
    if len(written) == CELL_COUNT and not any(memory):
        erase_memory(client)
        return
    for half in range(2):
        signals = {"half": half, "mask": 0}
        for i in range(_HALF):
            cell = half * _HALF + i
            signals["mask"] |= (cell in written) << i
            signals[f"byte_{i}"] = memory[cell] if cell in written else 0
        if signals["mask"]:
            client.dialogue.command("write", **signals)
            client.await_memory()
