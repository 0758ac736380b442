"""`tools/octet check`: sound robots pass, one with a defect fails the sentence that it breaks, and no other."""

import json
import re
import sys
import xml.etree.ElementTree as ET
from types import SimpleNamespace

import pytest

from host_sim.base.errors import UsageError
from host_sim.cli.main import main
from host_sim.lab.check import checking
from host_sim.lab.check.checking import CHECKS, check_robot
from host_sim.lab.check.sentences import NOT_CHECKED, prose, sentences
from host_sim.sim.robot_process import PROGRAM
from host_sim.transport.link import Frame
from tests.lab.check.canaries import CANARIES, Robot
from tests.lab.check.virtual import EXAMPLE, example, one_for_all, virtual

OF_OTHERS = (
    "What is asked of a robot has a number",
    "**stop** (COMMAND).",
    "**start** with profile and seed",
    "This repeats every 20 ms",
    "[A program in Python]",
    "For example, ",
    "Somebody else may send",
    "Its owner computes the same",
    "A **start** could be computed",
)
"""How sentences begin that ask nothing of a robot."""


def check(capsys, command, *more):
    code = main(["check", "--robot-command", command, *map(str, more)])
    printed = capsys.readouterr()
    return code, printed.out, printed.err


def test_sentences_about_a_robot_have_numbers():
    bare = [text for text in prose() if not re.search(r"\([A-Z]\d+\)", text)]

    assert [text for text in bare if not text.startswith(OF_OTHERS)] == []


def test_sentences_have_a_check_or_a_reason_for_none():
    of_frames = {"B1", "B3", "B7", "B8", "P1"}
    rows = {number for number in sentences() if "." in number}

    assert set(sentences()) == set(CHECKS) | set(NOT_CHECKED) | of_frames | rows
    assert not (set(CHECKS) | of_frames | rows) & set(NOT_CHECKED)


def test_robot_of_the_project_passes_the_check(capsys):
    code, out, _ = check(capsys, f"sh -c 'exec {PROGRAM} --node $OCTET_NODE fd:$CAN_CHANNEL'")

    assert code == 0, out


def test_example_robot_passes_and_its_results_are_written(capsys, tmp_path):
    json_path, junit_path = tmp_path / "robot.json", tmp_path / "robot.xml"

    files = ("--json", json_path, "--junit", junit_path)
    code, out, _ = check(capsys, f"{sys.executable} {EXAMPLE}", *files, "--node", 3)

    assert code == 0, out
    cases = json.loads(json_path.read_text())
    suite = ET.parse(junit_path).getroot()
    assert len(cases) == len(suite) == len(sentences())
    assert suite.get("failures") == "0"
    assert {case["result"] for case in cases} == {"passed", "skipped"}


def test_failed_check_shows_the_frames_of_the_robot(capsys, tmp_path):
    defective = tmp_path / "robot.py"
    defective.write_text(EXAMPLE.read_text().replace("0x4B13", "0x4B14"))

    code, out, _ = check(capsys, f"{sys.executable} {defective}", "--junit", tmp_path / "robot.xml")

    assert code == 1
    assert "fails T6: HEARTBEAT has the hash" in out
    assert "layout is 0x4B14, not 0x4B13" in out
    assert "robot HEARTBEAT counter=" in out
    assert out.splitlines()[-1].endswith("1 fail: T6")
    assert "layout is 0x4B14" in ET.parse(tmp_path / "robot.xml").find(".//failure").get("message")


def test_frames_sent_before_stop_do_not_count_as_its_answer():
    with virtual(example.Robot)() as talk:
        talk.link.said.extend(Frame(*frame) for frame in talk.link.robot.report(example.HEARTBEAT))

        CHECKS["T2"](talk)


@pytest.mark.parametrize(
    ("command", "message"),
    [
        ("no-such-robot", "cannot start 'no-such-robot': No such file or directory"),
        ("", "cannot start '': it is empty"),
        ("sh -c 'echo no bus; exit 3'", "ended with exit code 3 and printed no bus"),
        ("sleep 60", "the robot does not answer stop within 0.5 s: it sent nothing at all"),
        ("'", "No closing quotation"),
    ],
)
def test_command_that_is_no_robot_is_reported_in_one_line(capsys, monkeypatch, command, message):
    monkeypatch.setattr(checking, "WAKE_S", 0.5)

    code, _, err = check(capsys, command)

    assert code == 2
    assert message in err
    assert err.count("\n") == 1


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--bus", "socketcan:no-such-bus"], "cannot open the bus socketcan:no-such-bus"),
        ([], "--robot-command CMD"),
    ],
)
def test_check_reports_an_unknown_bus_and_a_missing_robot(capsys, words, said):
    assert main(["check", *words]) == 2
    assert said in capsys.readouterr().err


class Dumb(Robot):
    """Falls silent for good with its first SENSES, without ending."""

    is_dumb = False

    def step(self, frames, now_ms):
        said = [] if self.is_dumb else super().step(frames, now_ms)
        self.is_dumb = self.is_dumb or any(frame_id == example.SENSES for frame_id, _ in frames)
        return said


class Short(Robot):
    """Sends DRIVE and MEMORY without their last byte."""

    def meddle(self, frame_id, data):
        return [(frame_id, data[:-1] if frame_id in (example.DRIVE, example.MEMORY) else data)]


@pytest.mark.parametrize(("robot", "number"), [(Dumb, "T5"), (Short, "B3")])
def test_check_judges_a_silent_robot_and_one_with_short_frames(robot, number):
    assert number in {verdict.number for verdict in check_robot(virtual(robot)) if verdict.state == "fails"}


def test_bus_is_closed_when_the_robot_cannot_be_started(monkeypatch):
    link = SimpleNamespace(closed=0)
    link.close = lambda: vars(link).update(closed=1)
    monkeypatch.setattr(checking, "_open", lambda *_: link)

    with pytest.raises(UsageError, match="cannot start"), checking.started("no-such-robot", "virtual:a", 1):
        pass

    assert link.closed


def test_running_robot_passes_without_checks_that_need_its_command():
    verdicts = check_robot(one_for_all(example.Robot()), missing=("T1", "S6"))

    assert [verdict for verdict in verdicts if verdict.state == "fails"] == []
    assert {verdict.number for verdict in verdicts if "--robot-command" in verdict.why} == {"T1", "S6"}


def test_all_checks_have_a_canary():
    assert sorted(set(CHECKS) - set(CANARIES)) == []


@pytest.mark.parametrize("number", sorted(CANARIES))
def test_robot_with_one_defect_fails_exactly_its_sentence(number):
    verdicts = check_robot(virtual(CANARIES[number]))

    assert [verdict.number for verdict in verdicts if verdict.state == "fails"] == [number]
