"""`python -m tests.sim.native_equality [TICKS]`: compares the tick loop in C with the one in Python, with pymunk.

It compares the logs, trajectories and results of runs in which people intervene, by default for ten million ticks.
"""

import random
import socket
import struct
import sys
import threading
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field, replace
from itertools import count
from pathlib import Path
from typing import NamedTuple

from host_sim.base.errors import RobotError
from host_sim.client.commands import erase_memory, handshake, stop, write_cells
from host_sim.client.connection import Connection
from host_sim.client.frame_log import FrameLog
from host_sim.client.robot_client import RobotClient
from host_sim.protocol.codec import Frame, Protocol, crc8
from host_sim.protocol.generated import PROFILES
from host_sim.recording.run_recorder import RunRecorder
from host_sim.recording.trajectory import Trajectory
from host_sim.sim.in_process_link import InProcessLink
from host_sim.sim.make import assemble, make
from host_sim.sim.native_loop import BLOCK_TICKS
from host_sim.sim.run_config import RunConfig
from host_sim.sim.simulation import Simulation
from host_sim.sim.world_record import EpisodeResult
from host_sim.transport.socket_pair import SocketPairLink
from host_sim.world.edits import Edit, EditError
from host_sim.world.geometry import Bar, Point
from host_sim.world.names import PYMUNK

_ENVIRONMENTS, _LIMIT_S = 2, 300.0
_ROBOTS_MAX = 3
_CHANGE_EVERY_TICKS = 400
_BODY_FAULTS = (
    *("mirror", "swap-motors", "stuck-on:front", "stuck-off:left", "noise:50/1000", "weak-motor:right:70%"),
    *("swap-odometers", "odometer:left:0%", "odometer:right:-100%", "odometer:left:133%", "false-beacon:100"),
    *("repair", "repair", "repair"),
)


class LoopVerdict(NamedTuple):
    """The comparison of one run.

    Attributes:
        seed: The run's seed.
        ticks: Number of ticks, all robots together.
        difference: The difference in words; None if there is none.
    """

    seed: int
    ticks: int
    difference: str | None


class _Outcome(NamedTuple):
    log: str
    results: list[EpisodeResult]
    trajectory: Trajectory


def compare_loops(ticks: int) -> Iterator[LoopVerdict]:
    """Compares runs of every behaviour with one robot or several, until they have this many ticks in all.

    Yields:
        A verdict for each run.

    Raises:
        RobotError: A robot does not answer.
    """
    done, profiles = 0, sorted(PROFILES)
    for seed in count(1):
        if done >= ticks:
            return
        config = RunConfig(
            seed=seed,
            environments=_ENVIRONMENTS,
            limit_s=_LIMIT_S,
            robots=1 + seed % _ROBOTS_MAX,
            profile=profiles[seed % len(profiles)],
        )
        readable = _run(replace(config, physics=PYMUNK), native=False)
        pairs = zip(_Outcome._fields, readable, _run(config, native=True), strict=True)
        differences = [name for name, a, b in pairs if a != b]
        run_ticks = config.robots * readable.trajectory.ticks
        done += run_ticks
        yield LoopVerdict(seed, run_ticks, ", ".join(differences) or None)


def _run(config: RunConfig, native: bool) -> _Outcome:
    log, draws, results = FrameLog(), random.Random(config.seed), []
    with make(config, log) as simulation:
        simulation.native = native
        recorder = RunRecorder.of(simulation, config.boredom_limit)
        for number in range(1, config.environments + 1):
            simulation.enter(number)
            while not simulation.over:
                _meddle(simulation, draws)
                _run_on(simulation, simulation.tick + draws.randint(1, _CHANGE_EVERY_TICKS))
            results.append(simulation.leave())
        for client in simulation.clients:
            stop(client)
    return _Outcome(log.close(), results, recorder.trajectory)


def _run_on(simulation: Simulation, tick: int) -> None:
    while not simulation.over and simulation.tick < tick:
        simulation.step(min(BLOCK_TICKS, tick - simulation.tick))


def _meddle(simulation: Simulation, draws: random.Random) -> None:
    """Intervenes at random, as a person may between two ticks; impossible edits are skipped."""
    client = simulation.clients[draws.randrange(len(simulation.clients))]
    simulation.set_clock()
    if draws.random() < 0.1:
        erase_memory(client)
    elif draws.random() < 0.1:
        write_cells(client, {draws.randint(1, 7): draws.randint(0, 2)})
    with suppress(EditError):
        simulation.edit(_EDITS[draws.randrange(len(_EDITS))](simulation, draws))


def _point(simulation: Simulation, draws: random.Random) -> Point:
    return draws.uniform(0.0, simulation.params.width_mm), draws.uniform(0.0, simulation.params.height_mm)


def _bar(simulation: Simulation, draws: random.Random) -> Bar:
    a = _point(simulation, draws)
    return Bar(a, (min(simulation.params.width_mm, a[0] + draws.uniform(50.0, 400.0)), a[1]))


def _bar_id(simulation: Simulation, draws: random.Random) -> int:
    return draws.choice(list(simulation.arena.obstacles.bars) or [0])


_EDITS: list[Callable[[Simulation, random.Random], Edit]] = [
    lambda simulation, draws: Edit("add_bar", **_bar(simulation, draws)._asdict()),
    lambda simulation, draws: Edit("move_bar", _bar_id(simulation, draws), **_bar(simulation, draws)._asdict()),
    lambda simulation, draws: Edit("remove_bar", _bar_id(simulation, draws)),
    lambda simulation, draws: Edit(
        "move_food", draws.randrange(len(simulation.arena.food.at)), at=_point(simulation, draws)
    ),
    lambda simulation, draws: Edit("plant", at=_point(simulation, draws), radius=draws.randint(20, 200)),
    lambda _, draws: Edit("grow_plant", 0, radius=draws.randint(20, 200)),
    lambda simulation, draws: Edit(
        "body", what=draws.choice(_BODY_FAULTS), robot=draws.randrange(len(simulation.clients)), seed=simulation.seed
    ),
    lambda simulation, draws: Edit("lift", robot=draws.randrange(len(simulation.clients))),
    *[
        lambda simulation, draws: Edit(
            "put",
            at=_point(simulation, draws),
            heading=1000 * draws.uniform(-3.0, 3.0),
            robot=draws.randrange(len(simulation.clients)),
        )
    ]
    * 3,
]


def main() -> int:
    """Prints each verdict; returns 0 if all runs are equal, else 1."""
    code = 0
    for seed, ticks, difference in compare_loops(int(sys.argv[1]) if sys.argv[1:] else 10_000_000):
        sys.stdout.write(f"seed {seed}, {ticks} ticks: {difference or 'equal'}\n")
        code = code or int(difference is not None)
    return code


if __name__ == "__main__":
    sys.exit(main())


PROTOCOL = Protocol()
RAW = struct.Struct("=IB3x8s")
SENSES, DRIVE = PROTOCOL.id_of("SENSES"), PROTOCOL.id_of("DRIVE")
LATE_S = 0.03


def packed(frame: Frame) -> bytes:
    return RAW.pack(frame.id, len(frame.data), frame.data)


def learned(recorder: RunRecorder) -> list[tuple]:
    """What each robot has learned."""
    return [(history.known(), history.trials, history.lessons) for history in recorder.histories]


def protected(frame_id: int, data: bytes) -> Frame:
    return Frame(frame_id, bytes((crc8(frame_id, data),)) + data[1:])


Meddle = Callable[[list[bytes]], Iterable[bytes]]
"""Makes something else of the datagrams by which a robot answers the senses of a tick."""


@dataclass
class Line:
    """A robot of this process at the far end of a socket pair, in a thread, whose answers somebody meddles with.

    Attributes:
        meddles: What happens, by the number of the senses that are heard for the first time, from 1.
    """

    far: socket.socket
    meddles: dict[int, Meddle] = field(default_factory=dict)

    def serve(self) -> None:
        robot, heard, last = InProcessLink(), 0, b""
        while datagram := self.far.recv(RAW.size):
            frame_id, length, data = RAW.unpack(datagram)
            robot.send(Frame(frame_id, data[:length]))
            answers = [packed(frame) for frame in robot.taken()]
            if frame_id == SENSES and datagram != last:
                heard, last = heard + 1, datagram
                answers = list(self.meddles.get(heard, list)(answers))
            for answer in answers:
                self.far.send(answer)


@contextmanager
def connected(meddles: dict[int, Meddle], log: FrameLog) -> Iterator[RobotClient]:
    near, far = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
    line = Line(far, meddles)
    thread = threading.Thread(target=line.serve)
    thread.start()
    link = SocketPairLink(near)
    client = RobotClient(Connection(link), PROTOCOL, log)
    try:
        handshake(client, client.connection.deadline_s)
        yield client
    finally:
        far.shutdown(socket.SHUT_RD)
        thread.join()
        far.close()
        link.close()


@dataclass
class Outcome:
    """What a run leaves behind that does not depend on how long things took."""

    log: bytes
    recorder: RunRecorder
    memory: tuple[int, ...]
    incidents: list[str]
    received: int
    refused: int
    garbled: int
    error: str
    blocks: list[int]
    repeated: int


def run_on(simulation: Simulation, commands: dict[int, Callable[[RobotClient], object]], blocks: list[int]) -> None:
    simulation.enter(1)
    while not simulation.over:
        if simulation.tick in commands:
            commands[simulation.tick](simulation.clients[0])
        coming = min((tick for tick in commands if tick > simulation.tick), default=simulation.tick + BLOCK_TICKS)
        before = simulation.tick
        simulation.step(coming - before)
        blocks.append(simulation.tick - before)
    simulation.leave()


def outcome(
    folder: Path,
    meddles: dict[int, Meddle],
    native: bool,
    commands: dict[int, Callable[[RobotClient], object]] | None = None,
) -> Outcome:
    log, blocks, error = FrameLog(folder / "run.log"), [], ""
    with connected(meddles, log) as client:
        simulation = assemble([client], RunConfig(seed=3, environments=1, limit_s=12.0))
        simulation.native = native
        recorder = RunRecorder.of(simulation, boredom_limit=10)
        try:
            run_on(simulation, commands or {}, blocks)
            stop(client)
        except RobotError as ended:
            error = str(ended)
        assert (simulation.loop is not None) == native
        garbled = client.connection.link.garbled
        log.close()
        return Outcome(
            *((folder / "run.log").read_bytes(), recorder, client.memory, [*map(str, client.incidents)]),
            *(client.frames.received, client.frames.refused, garbled, error, blocks, client.frames.repeated),
        )


def assert_alike(folder: Path, meddles: dict[int, Meddle], commands=None) -> Outcome:
    readable, native = (outcome(folder, meddles, native, commands) for native in (False, True))
    assert native.log == readable.log
    assert native.recorder.trajectory == readable.recorder.trajectory
    assert learned(native.recorder) == learned(readable.recorder)
    for name in ("memory", "incidents", "received", "refused", "garbled", "error"):
        assert getattr(native, name) == getattr(readable, name), name
    assert set(readable.blocks) == {1}
    return native
