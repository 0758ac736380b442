"""A robot of one's own: started, watched, started again; and what is none is told."""

import json
import os
import signal
import sys
import xml.etree.ElementTree as ET
from pathlib import Path

import pytest

from host_sim.api import RunConfig, make
from host_sim.base.errors import LinkDownError, RobotError
from host_sim.cli.main import main
from host_sim.sim import robot_process
from host_sim.transport.link import LineStats

EXAMPLE = f"{sys.executable} {Path(__file__).resolve().parents[2] / 'examples' / 'robot' / 'robot.py'}"


@pytest.fixture
def pids(tmp_path):
    """A command that notes the process id of each robot that it starts, and gives those so far."""
    noted = tmp_path / "pids"
    return f"sh -c 'echo $$ >> {noted}; exec {EXAMPLE}'", lambda: list(map(int, noted.read_text().split()))


def test_own_robot_gives_the_same_log_for_the_same_seed(tmp_path):
    for name in ("one", "two"):
        words = ["--environments", "1", "--limit-s", "5", "--quiet", "--out", str(tmp_path / name)]
        assert main(["run", "--robot-command", EXAMPLE, *words]) == 0

    assert (tmp_path / "one/run.log").read_bytes() == (tmp_path / "two/run.log").read_bytes()


def test_own_robots_get_different_node_numbers(pids):
    command, known = pids
    with make(RunConfig(bus="fd", robot_command=command, robots=2, limit_s=1.0)) as simulation:
        simulation.enter(1)
        go_on(simulation, 10)

        assert [drive.tick for drive in simulation.drives] == [9, 9]
    assert len(known()) == 2


def test_killed_robot_is_restarted_and_the_result_doubtful(pids):
    command, known = pids
    with make(RunConfig(bus="fd", robot_command=command, limit_s=10.0, reconnect_s=10.0)) as simulation:
        simulation.enter(1)
        simulation.step(50)
        os.killpg(known()[-1], signal.SIGKILL)
        go_on(simulation, 100)

        (client,) = simulation.clients
        assert simulation.tick == 100
        assert len(known()) == 2
        assert any("restarted" in str(incident) for incident in client.incidents)


def test_robot_that_does_not_restart_ends_the_run(tmp_path):
    command = f"sh -c '[ ! -e {tmp_path}/dead ] && exec {EXAMPLE}'"
    with make(RunConfig(bus="fd", robot_command=command, limit_s=10.0, reconnect_s=0.3)) as simulation:
        simulation.enter(1)
        simulation.step(5)
        (tmp_path / "dead").touch()
        kill_robots()
        with pytest.raises(RobotError, match=r"the robot has been gone for 0.3 s: .*was killed by signal 9"):
            go_on(simulation, 100)


def test_robot_that_restarts_silent_is_reported_as_lost(monkeypatch):
    monkeypatch.setattr(robot_process, "BOOT_S", 0.1)
    robot = robot_process.OwnRobot("sleep 60", 1, was_there=True)
    try:
        with pytest.raises(LinkDownError, match=r"says nothing within 0\.1 s"):
            robot.on_socket_pair(LineStats())
    finally:
        robot.close()


def go_on(simulation, until):
    """To a tick; on a busy host, blocks of ticks end early."""
    while simulation.tick < until:
        simulation.step(until - simulation.tick)


def kill_robots():
    children = Path(f"/proc/{os.getpid()}/task/{os.getpid()}/children").read_text().split()
    for pid in map(int, children):
        if "robot.py" in Path(f"/proc/{pid}/cmdline").read_text():
            os.kill(pid, signal.SIGKILL)


@pytest.mark.parametrize(
    ("command", "message"),
    [
        ("no-such-robot", "cannot start 'no-such-robot': No such file"),
        ("sh -c 'echo no bus; exit 3'", "ended with exit code 3 and printed no bus"),
        ("sleep 60", "says nothing within 0.3 s: at power-up it sends BOOT"),
        (" ", "--robot-command is empty"),
    ],
)
def test_command_that_is_no_robot_is_reported_in_one_line(capsys, monkeypatch, tmp_path, command, message):
    monkeypatch.setattr(robot_process, "BOOT_S", 0.3)

    code = main(["run", "--robot-command", command, "--quiet", "--out", str(tmp_path / "out")])

    said = capsys.readouterr().err
    assert code == 2
    assert message in said
    assert said.count("\n") == 1


@pytest.mark.parametrize("words", [("--bus", "none"), ("--robot", "qemu"), ("--robots", "40")])
def test_robot_command_is_refused_where_it_cannot_apply(capsys, words):
    assert main(["run", "--robot-command", EXAMPLE, *words]) == 2
    assert "--robot-command" in capsys.readouterr().err


@pytest.mark.vcan
def test_killed_robot_on_vcan_is_restarted(pids):
    command, known = pids
    with make(RunConfig(bus="socketcan:vcan0", robot_command=command, limit_s=10.0)) as simulation:
        simulation.enter(1)
        simulation.step(50)
        os.killpg(known()[-1], signal.SIGKILL)
        go_on(simulation, 100)

        assert simulation.tick == 100
    assert len(known()) == 2


@pytest.mark.parametrize(("event", "seen"), [("kill@50", "1 outages"), ("hang:300@50", "repeated")])
def test_campaign_injects_process_faults_into_an_own_robot(capsys, event, seen):
    cell = f"article external lockstep seed=12 limit=4 event={event}"

    assert main(["campaign", "--robot-command", EXAMPLE, "--repeat", cell]) == 0
    assert seen in capsys.readouterr().out


def test_campaign_requires_external_links_and_own_robot_together(capsys):
    assert main(["campaign", "--html", "x.html", "--links", "external"]) == 2
    assert main(["campaign", "--html", "x.html", "--robot-command", EXAMPLE]) == 2
    assert capsys.readouterr().err.count("go together") == 2


def test_campaign_writes_its_outcomes_as_json_and_junit(monkeypatch, tmp_path):
    from host_sim.lab.campaign import matrix  # noqa: PLC0415 - the campaign is above

    few = [each for each in matrix.CLASSES if each.name in ("frames come twice", "the robot restarts")]
    monkeypatch.setattr(matrix.groups, "__defaults__", (few,))
    files = {f"--{kind}": tmp_path / f"c.{ending}" for kind, ending in (("json", "json"), ("junit", "xml"))}
    words = [str(word) for pair in files.items() for word in pair]
    where = ["--links", "external", "--robot-command", EXAMPLE, "--profiles", "article", "--limit-s", "4"]

    main(["campaign", "--html", str(tmp_path / "c.html"), *where, *words])

    cases = json.loads(files["--json"].read_text())
    assert [case["name"].rpartition(": ")[2] for case in cases] == ["no fault", *(each.name for each in few)]
    assert all("--robot-command" in case["text"] for case in cases)
    assert ET.parse(files["--junit"]).getroot().get("tests") == "3"
