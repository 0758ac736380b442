"""A log of any firmware is checked for the protocol alone; on a bus that loses frames it tells the whole story."""

import re
import shutil
from contextlib import ExitStack
from pathlib import Path

import pytest

from host_sim.client.commands import stop
from host_sim.client.frame_log import line_of
from host_sim.protocol.codec import Frame, Protocol, crc8
from host_sim.protocol.generated import MESSAGES, Opcode, Reason
from host_sim.recording.conversation import check_conversation
from host_sim.recording.log_reader import read_log
from host_sim.recording.recording import read_recording
from host_sim.recording.replay import replay
from host_sim.sim.run_config import RunConfig
from tests.recording.support import open_simulation
from tests.runs.support import BUSY_HOST, octet

PROTOCOL = Protocol()
ASK = PROTOCOL.encode("COMMAND", {"counter": 9, "opcode": Opcode.REPORT, "owner": 1})


def replaced(log: Path, name: str, nth: int, change) -> None:
    """Puts other lines in the place of the line with the n-th frame of a message."""
    lines = log.read_text().splitlines(keepends=True)
    at = [i for i, line in enumerate(lines) if f" {PROTOCOL.id_of(name):03X}#" in line][nth]
    lines[at] = change(lines[at])
    log.write_text("".join(lines))


def edited(log: Path, name: str, nth: int, edit) -> None:
    """Gives the n-th frame of a message other bytes, or takes it away where there are none."""

    def change(line: str) -> str:
        head, data = line.rstrip().split("#")
        changed = edit(bytearray.fromhex(data))
        return f"{head}#{changed.hex().upper()}\n" if changed else ""

    replaced(log, name, nth, change)


def followed(log: Path, name: str, nth: int, frame: Frame) -> None:
    """Puts a frame after the n-th frame of a message, at the same time."""
    said = f"{frame.id:03X}#{frame.data.hex().upper()}"
    replaced(log, name, nth, lambda line: f"{line}{line.rsplit(maxsplit=1)[0]} {said}\n")


def with_bit(name: str, byte: int):
    """Another lowest bit in that byte of a message, under a right checksum."""

    def edit(data: bytearray) -> bytearray:
        data[byte] ^= 1
        data[0] = crc8(PROTOCOL.id_of(name), bytes(data))
        return data

    return edit


faster, of_another_tick, with_other_orders = with_bit("DRIVE", 3), with_bit("DRIVE", 2), with_bit("HEALTH", 6)


def test_recorded_run_keeps_to_the_protocol(short):
    found = check_conversation(read_log(short.log), PROTOCOL)

    assert found.problems == []
    assert (found.commands, found.drives > 50) == (3, True)


def test_conversation_check_ignores_the_decisions_of_a_robot(short):
    edited(short.log, "DRIVE", -2, faster)  # the last one of the run, which HEALTH does not cover

    assert octet("replay", short.log).returncode == 1
    assert octet("replay", short.log, "--protocol").returncode == 0


@pytest.mark.parametrize(
    ("name", "edit", "problem"),
    [
        ("DRIVE", lambda _: None, "senses were not answered"),
        ("DRIVE", of_another_tick, "a drive has another tick"),
        ("DRIVE", lambda data: data[:-1], "damaged or of a wrong length"),
        ("ANSWER", lambda _: None, "a command was not answered"),
        ("HEALTH", with_other_orders, "HEALTH holds something else"),
        ("DRIVE", faster, "HEALTH holds something else"),
    ],
)
def test_protocol_violation_is_reported_with_its_time(short, name, edit, problem):
    edited(short.log, name, 1, edit)

    done = octet("replay", short.log, "--protocol")

    assert done.returncode == 1
    assert problem in done.stdout
    assert " s " in done.stdout


def with_repeats(log: Path) -> None:
    """As candump sees it: in one tick of five the answer is lost and the senses come again, in one it comes twice."""
    lines: list[str] = []
    every = {f" {PROTOCOL.id_of(name):03X}#": n for name, n in (("SENSES", 5), ("DRIVE", 7))}
    for line in log.read_text().splitlines(keepends=True):
        lines.append(line)
        lines += [line for said, n in every.items() if said in line and len(lines) % n == 0]
    log.write_text("".join(lines))


def test_log_with_repeated_frames_replays_as_the_same_run(short):
    clean = read_recording(read_log(short.log), PROTOCOL)
    drives = replay(read_log(short.log), PROTOCOL).drives
    size = short.log.stat().st_size

    with_repeats(short.log)

    assert short.log.stat().st_size > 1.1 * size
    assert list(read_recording(read_log(short.log), PROTOCOL).ticks) == list(clean.ticks)
    outcome = replay(read_log(short.log), PROTOCOL)
    assert (outcome.drives, outcome.difference) == (drives, None)


def test_missing_drive_is_found_as_a_difference(short):
    edited(short.log, "DRIVE", 100, lambda _: None)

    assert replay(read_log(short.log), PROTOCOL).difference is not None


def test_report_requested_within_a_tick_makes_no_difference(short):
    followed(short.log, "SENSES", 100, ASK)

    assert replay(read_log(short.log), PROTOCOL).difference is None


def test_report_requested_after_the_stop_belongs_to_the_end(short):
    with short.log.open("a") as log:
        log.write(f"{line_of(9_999_000_000, ASK)}\n")

    assert replay(read_log(short.log), PROTOCOL).stopped
    assert read_recording(read_log(short.log), PROTOCOL).stopped


def test_drive_for_silence_in_real_time_makes_no_difference(tmp_path):
    """The robot reports silence with the last tick, whose SENSES may have come by then and be unanswered yet."""
    config = RunConfig(environments=1, limit_s=0.4, real_time=True, late_max=100.0)
    with ExitStack() as stack:
        simulation = open_simulation(stack, tmp_path / "run.log", config)
        [*simulation.run()]
        stop(simulation.clients[0])
    nothing = dict.fromkeys((signal.name for signal in MESSAGES["DRIVE"].signals), 0)
    silence = PROTOCOL.encode("DRIVE", {**nothing, "reason": Reason.SILENCE})
    followed(tmp_path / "run.log", "SENSES", 0, silence)

    outcome = replay(read_log(tmp_path / "run.log"), PROTOCOL)

    assert (outcome.drives, outcome.difference) == (20, None)


def recorded(name: str) -> Path:
    """The log of a run in real time, in which frames were lost."""
    return Path(__file__).parent / f"data/{name}.log"


@pytest.mark.parametrize(
    ("name", "unanswered", "drives"), [("outages", 28, 37), ("a_gap", 6, 34), ("lost_answers", 6, 34)]
)
def test_unanswered_senses_make_no_difference(name, unanswered, drives):
    """--fault drop@13-27/to with drop@43-55/to, drop@13-18/to, and drop@13-18/from."""
    outcome = replay(read_log(recorded(name)), PROTOCOL)

    assert (outcome.unanswered, outcome.drives, outcome.difference) == (unanswered, drives, None)


@pytest.mark.parametrize(("name", "drives"), [("unsaid_outage", 25), ("late_answer", 25), ("gap_upon_gap", 38)])
def test_losses_recorded_on_a_busy_host_make_no_difference(name, drives):
    """An outage without EMERGENCY; a DRIVE after the next SENSES, which are lost; a gap that later DRIVEs explain."""
    outcome = replay(read_log(recorded(name)), PROTOCOL)

    assert (outcome.drives, outcome.difference) == (drives, None)


def test_new_run_with_losses_has_no_difference_or_many_unanswered_senses(tmp_path):
    """What a busy host adds to the loss may be more than its log can tell."""
    words = ("--bus", "fd", "--environments", "1", "--limit-s", "2", "--real-time", "--fault", "drop@23-28/from")
    assert octet("run", *words, *BUSY_HOST, "--out", tmp_path).returncode == 0

    outcome = replay(read_log(tmp_path / "run.log"), PROTOCOL)

    assert outcome.difference is None or outcome.unanswered > 6


def test_difference_after_unanswered_senses_mentions_them(tmp_path):
    log = Path(shutil.copy(recorded("a_gap"), tmp_path))
    edited(log, "DRIVE", 25, faster)

    done = octet("replay", log)

    assert done.returncode == 1
    assert re.search(r"differs after \d+ equal drives", done.stdout)
    assert re.search(r"\d+ senses before it were not answered", done.stdout)
