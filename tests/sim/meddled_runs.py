"""A run whose robot somebody meddles with, on a socket pair: by the loop in C, and by the readable one."""

import socket
import struct
import threading
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path

from host_sim.base.errors import RobotError
from host_sim.client.commands import handshake, stop
from host_sim.client.connection import Connection
from host_sim.client.frame_log import FrameLog
from host_sim.client.robot_client import RobotClient
from host_sim.protocol.codec import Frame, Protocol, crc8
from host_sim.recording.run_recorder import RunRecorder
from host_sim.sim.in_process_link import InProcessLink
from host_sim.sim.make import assemble
from host_sim.sim.native_loop import BLOCK_TICKS
from host_sim.sim.run_config import RunConfig
from host_sim.sim.simulation import Simulation
from host_sim.transport.socket_pair import SocketPairLink

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
