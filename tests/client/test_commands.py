"""Commands: what they change, and what becomes of one that is not answered or not taken."""

import gzip
import hashlib
import os
import resource
from pathlib import Path

import pytest

from host_sim.base.errors import OctetError, RefusedError, RobotError, UsageError
from host_sim.base.files import CompressedFile
from host_sim.client.commands import erase_memory, freeze, handshake, start, stop, write_cells
from host_sim.client.frame_log import FrameLog, digest_of, line_of
from host_sim.client.robot_client import INCIDENTS_MAX
from host_sim.client.session import HeldCheck, Session
from host_sim.protocol.codec import Frame, Protocol
from host_sim.protocol.generated import Result
from host_sim.sim.make import make
from host_sim.sim.run_config import RunConfig
from tests.client.support import PROTOCOL, MeddledLink, altered, connected, drive_for, learned

NOTHING = (0,) * 8


def test_turns_are_written_and_erased():
    client = learned(MeddledLink(), 10)

    write_cells(client, {1: 2, 6: 1})
    assert client.memory == (0, 2, 0, 0, 0, 0, 1, 0)
    write_cells(client, {3: 1})
    assert client.memory == (0, 2, 0, 1, 0, 0, 1, 0)

    erase_memory(client)
    assert client.memory == NOTHING


def test_start_with_an_empty_memory_clears_both_halves(link):
    link.reboot((0, 1, 0, 0, 2, 0, 0, 0))
    with connected(link) as client:
        handshake(client, 1.0)
        start(client, Session(1), NOTHING)

    assert client.memory == NOTHING


def test_robot_can_be_frozen_before_a_start():
    with connected(MeddledLink()) as client:
        handshake(client, 1.0, shared=True)
        freeze(client, on=True)

    assert client.inbox.session is None


def test_unanswered_command_is_named(link):
    client = learned(link, 10, deadline_s=0.1)
    link.change = lambda _: []

    with pytest.raises(RobotError, match=r"the robot did not answer freeze within 0.1 s; last frame from it: "):
        freeze(client, on=True)


def test_command_that_stays_out_of_sequence_raises_refused(link):
    client = learned(link, 10)
    link.change = altered("ANSWER", lambda _: {"result": Result.OUT_OF_SEQUENCE, "which": 0, "value": 0})

    with pytest.raises(RefusedError, match="out_of_sequence"):
        freeze(client, on=True)


@pytest.mark.parametrize("message", ["MEMORY", "HEALTH", "DRIVE"])
def test_missing_report_after_stop_is_named_within_60_s(link, message):
    client = learned(link, 10)
    link.change = lambda frame: [] if frame.id == PROTOCOL.id_of(message) else [frame]
    began_s = client.connection.now()

    with pytest.raises(RobotError, match=f"after stop, the robot did not send .*{message}"):
        stop(client)

    assert client.connection.now() - began_s < 60


def test_restart_between_memory_halves_fails_the_start(link):
    half = PROTOCOL.id_of("MEMORY")

    def restart(frame: Frame) -> list[Frame]:
        if frame.id == half and frame.data[1] >> 4 == 1:
            link.reboot()
            link.change = lambda frame: [frame]
        return [frame]

    with connected(link) as client:
        handshake(client, client.connection.deadline_s)
        link.change = restart
        with pytest.raises(RobotError, match="node 1 does not hold the memory that was just written to it"):
            start(client, Session(1), (0, 1, 0, 1, 2, 0, 2, 0))


def test_ranges_are_sent_and_repeated_before_senses():
    with connected(faults=("drop:30%",)) as client:
        handshake(client, client.connection.deadline_s)
        start(client, Session(1, PROTOCOL.choices("COMMAND", "profile")["distance"]))
        drive_for(client, 50)

    sent = [name for frame in client.log.frames if (name := PROTOCOL.decode(frame).name) in ("RANGES", "SENSES")]
    assert sent == ["RANGES", "SENSES"] * 50
    assert client.frames.repeated > 0


def test_incidents_beyond_the_limit_are_only_counted():
    client = learned(MeddledLink(), 1)

    for _ in range(INCIDENTS_MAX + 2):
        client.distrust("it rattles")

    assert (len(client.incidents), client.unlisted) == (INCIDENTS_MAX, 2)


def test_log_has_handshake_reports_if_the_first_answer_is_lost(link):
    lost = []

    def lose_first_answer(frame: Frame) -> list[Frame]:
        lost.append(frame.id == PROTOCOL.id_of("ANSWER") and True not in lost)
        return [] if lost[-1] else [frame]

    link.change = lose_first_answer
    with connected(link) as client:
        handshake(client, client.connection.deadline_s)

    names = [decoded.name for frame in client.log.frames if (decoded := PROTOCOL.decode(frame)) is not None]
    assert True in lost
    assert names[:2] == ["COMMAND", "ANSWER"]
    assert {"HEARTBEAT", "BOOT", "MEMORY", "FAULTS", "HEALTH"} <= set(names)


def test_memory_written_after_an_environment_is_no_incident():
    with make(RunConfig(environments=1, limit_s=1.0)) as simulation:
        list(simulation.run())
        (client,) = simulation.clients
        write_cells(client, {1: 1})
        stop(client)

    assert client.incidents == []


@pytest.mark.parametrize(("lockstep", "takes_senses"), [(True, True), (False, True), (True, False)])
def test_check_value_covers_senses_only_in_lockstep(lockstep, takes_senses):
    told, asked = HeldCheck(takes_senses=takes_senses), Frame(0x101, bytes(range(8)))

    told.ask(asked if lockstep else None)
    told.take_drive(Frame(0x201, bytes(8)))

    assert (told.heard != 0) == (lockstep and takes_senses)


FRAME = Frame(0x081, bytes(range(8)))


@pytest.fixture(params=["run.log", "run.log.gz"])
def path(request, tmp_path):
    return tmp_path / request.param


def text_in(path: Path) -> bytes:
    content = path.read_bytes()
    return gzip.decompress(content) if path.suffix == ".gz" else content


def test_log_writes_frames_and_returns_their_digest(path):
    log = FrameLog(path)
    log.set_time(1_020_000)
    log.add(FRAME)

    digest = log.close()

    assert text_in(path).decode() == line_of(1_020_000, FRAME) + "\n"
    assert digest == hashlib.sha256(text_in(path)).hexdigest()


def test_digest_ignores_the_build_in_boot(tmp_path):
    digests, boot = [], Protocol(3).id_of("BOOT")
    for build in (bytes(8), bytes(range(8))):
        log = FrameLog(tmp_path / "run.log")
        for frame in (FRAME, Frame(boot, build), FRAME):
            log.add(frame)
        digests.append(log.close())

        assert digest_of(text_in(tmp_path / "run.log")) == digests[-1]
    assert digests[0] == digests[1]
    assert digest_of(b"(1.0) octet 081#00\n") != digest_of(b"(1.0) octet 081#01\n")


def test_added_blocks_keep_their_order_in_the_log(path):
    log = FrameLog(path)
    log.add(FRAME)
    log.add_block(b"elsewhere\n")
    log.add(FRAME)

    digest = log.close()

    line = line_of(0, FRAME).encode() + b"\n"
    assert text_in(path) == line + b"elsewhere\n" + line
    assert digest == hashlib.sha256(text_in(path)).hexdigest()


def test_old_log_stays_until_the_new_one_is_closed(path):
    path.write_text("old")
    log = FrameLog(path)
    log.add(FRAME)

    assert path.read_text() == "old"
    log.close()
    assert path.read_bytes() != b"old"


def test_empty_log_does_not_replace_the_old_one(path):
    path.write_text("old")

    FrameLog(path).close()

    assert path.read_text() == "old"
    assert [file.name for file in path.parent.iterdir()] == [path.name]


@pytest.mark.parametrize("path", ["", ".", "/"])
def test_path_without_a_name_is_refused(path):
    with pytest.raises(UsageError, match="not the name of a file"):
        FrameLog(Path(path))


def test_failed_log_does_not_replace_the_old_one(path):
    path.write_text("old")
    log = FrameLog(path)
    log._file.close()
    full = Path("/dev/full").open("wb", buffering=0)  # noqa: SIM115 - the log closes it
    log._file = CompressedFile(full) if path.suffix == ".gz" else full

    with pytest.raises(OctetError, match=r"cannot write .*run\.log.*\.part: No space left on device"):
        add_many(log)
    log.close()

    assert path.read_text() == "old"


def add_many(log):
    for _ in range(5000):
        log.add(FRAME)


def make_pipe(part):
    os.mkfifo(part)


def make_pipe_with_a_reader(part):
    os.mkfifo(part)
    return os.open(part, os.O_RDONLY | os.O_NONBLOCK)


def make_link(part):
    (part.parent / "elsewhere").write_text("mine")
    part.symlink_to("elsewhere")


@pytest.mark.parametrize("make", [make_pipe, make_pipe_with_a_reader, make_link])
def test_part_file_of_another_kind_is_refused_and_left(path, make):
    part = path.with_name(f"{path.name}.part")
    reader = make(part)

    with pytest.raises(UsageError, match="choose another folder"):
        FrameLog(path)

    assert not path.exists()
    elsewhere = path.parent / "elsewhere"
    assert not elsewhere.exists() or elsewhere.read_text() == "mine"
    if reader is not None:
        os.close(reader)


def test_log_keeps_its_part_file_if_the_path_is_a_folder(path):
    log = FrameLog(path)
    log.add(FRAME)
    path.mkdir()

    with pytest.raises(OctetError, match=r"cannot write .*: Is a directory"):
        log.close()

    assert path.with_name(f"{path.name}.part").stat().st_size > 0


def test_log_on_a_full_disk_fails_once(path):
    log = FrameLog(path)
    log.add(Frame(1, bytes(8)))
    _, most = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (10, most))
    try:
        with pytest.raises(OctetError, match="File too large"):
            log.flush()
        with pytest.raises(OctetError, match="an earlier write failed"):
            log.flush()
        assert log.close() == log.close()
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, (most, most))
