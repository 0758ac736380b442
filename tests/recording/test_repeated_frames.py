"""On a bus that loses frames, what was lost is sent again; a log of such a bus tells the same run."""

from host_sim.client.commands import stop
from host_sim.client.frame_log import FrameLog
from host_sim.protocol.codec import Protocol
from host_sim.protocol.generated import MESSAGES, Opcode, Reason
from host_sim.recording.log_reader import read_log
from host_sim.recording.recording import read_recording
from host_sim.recording.replay import replay
from host_sim.sim.make import make
from host_sim.sim.run_config import RunConfig


def with_repeats(log) -> None:
    """As candump sees it: in one tick of five the answer is lost and the senses come again, in one it comes twice."""
    protocol = Protocol()
    senses, drive = (f" {protocol.id_of(name):03X}#" for name in ("SENSES", "DRIVE"))
    lines = []
    for line in log.read_text().splitlines(keepends=True):
        lines.append(line)
        if senses in line and len(lines) % 5 == 0:
            lines.append(line)
        if drive in line and len(lines) % 7 == 0:
            lines.append(line)
    log.write_text("".join(lines))


def test_a_log_with_repeated_frames_is_the_same_run(short):
    clean = read_recording(read_log(short.log), Protocol())
    drives = replay(read_log(short.log), Protocol()).drives
    size = short.log.stat().st_size

    with_repeats(short.log)

    assert short.log.stat().st_size > 1.1 * size
    assert list(read_recording(read_log(short.log), Protocol()).ticks) == list(clean.ticks)
    outcome = replay(read_log(short.log), Protocol())
    assert (outcome.drives, outcome.difference) == (drives, None)


def test_a_drive_that_is_missing_for_good_is_still_found(short):
    protocol = Protocol()
    lines = short.log.read_text().splitlines(keepends=True)
    drives = [i for i, line in enumerate(lines) if f" {protocol.id_of('DRIVE'):03X}#" in line]
    del lines[drives[100]]
    short.log.write_text("".join(lines))

    assert replay(read_log(short.log), protocol).difference is not None


def test_a_report_that_is_asked_for_in_the_middle_of_a_tick_is_no_difference(short):
    protocol = Protocol()
    lines = short.log.read_text().splitlines(keepends=True)
    senses = [i for i, line in enumerate(lines) if f" {protocol.id_of('SENSES'):03X}#" in line][100]
    ask = protocol.encode("COMMAND", {"counter": 9, "opcode": Opcode.REPORT, "owner": 1})
    lines.insert(senses + 1, f"{lines[senses].rsplit(maxsplit=1)[0]} {ask.id:03X}#{ask.data.hex().upper()}\n")
    short.log.write_text("".join(lines))

    assert replay(read_log(short.log), protocol).difference is None


def test_a_robot_that_says_in_real_time_that_it_heard_nothing_makes_no_difference(tmp_path):
    """It says so with the last tick, whose SENSES may have come by then, and are yet to be answered."""
    protocol, log = Protocol(), FrameLog(tmp_path / "run.log")
    with make(RunConfig(environments=1, limit_s=0.4, real_time=True, late_max=100.0), log) as simulation:
        [*simulation.run()]
        stop(simulation.clients[0])
    log.close()
    lines = (tmp_path / "run.log").read_text().splitlines(keepends=True)
    senses = next(i for i, line in enumerate(lines) if f" {protocol.id_of('SENSES'):03X}#" in line)
    nothing = dict.fromkeys((signal.name for signal in MESSAGES["DRIVE"].signals), 0)
    silence = protocol.encode("DRIVE", {**nothing, "reason": Reason.SILENCE})
    lines.insert(senses + 1, f"{lines[senses].rsplit(maxsplit=1)[0]} {silence.id:03X}#{silence.data.hex().upper()}\n")
    (tmp_path / "run.log").write_text("".join(lines))

    outcome = replay(read_log(tmp_path / "run.log"), protocol)

    assert (outcome.drives, outcome.difference) == (20, None)
