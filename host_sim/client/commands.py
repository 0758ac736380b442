"""Commands to a robot: start, stop, and changes of its memory."""

from collections.abc import Collection, Mapping, Sequence
from dataclasses import replace

from host_sim.base.errors import RobotError
from host_sim.client.report_checks import holds
from host_sim.client.robot_client import RobotClient
from host_sim.client.session import Session
from host_sim.protocol.generated import ANSWER_WANTS_RANGES, CELL_COUNT, MEMORY_KINDS, PROFILES, MemoryKind
from host_sim.world.memory_kinds import translated, with_sides

_HALF = CELL_COUNT // 2
_KINDS = {number: MEMORY_KINDS[name] for name, number in PROFILES.items()}


def start(client: RobotClient, session: Session, memory: Sequence[int] | None = None) -> None:
    """Starts the robot, which learns: it moves with the next senses.

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
    for doubt in client.punctuality.doubts():
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
