"""A robot's answers: those that are marked rest on its log, and other code finds the same in the frames."""

import random
import re
from pathlib import Path

import numpy as np
import pytest

from host_sim.api import RunConfig, resimulate, run
from host_sim.client.frame_log import line_of
from host_sim.protocol.codec import Protocol
from host_sim.protocol.generated import PATTERNS, SENTENCES, SIDES, Reason
from host_sim.recording.log_reader import read_log
from host_sim.recording.trajectory import Trajectory
from host_sim.talk.conversation import Conversation, Source, about_memory, about_nothing, script_named, texts_of
from host_sim.talk.facts import FACTS, RobotFacts
from host_sim.talk.log_index import index_log
from host_sim.talk.texts import POINT, Texts
from tests.runs.support import octet, octet_process
from tests.talk.frames import differences

HERE = Path(__file__).parent

LANGUAGES = {"robot": "questions.txt", "robot-de": "fragen.txt"}


def questions(script: str) -> list[tuple[str, str]]:
    """What pupils ask in a script's language, each with the kind of answer that it must get."""
    lines = (HERE / LANGUAGES[script]).read_text().splitlines()
    return [(line.partition(" ")[0], line.partition(" ")[2]) for line in lines if not line.startswith(";")]


PROTOCOL = Protocol(1)


@pytest.fixture(scope="module")
def log(tmp_path_factory):
    path = tmp_path_factory.mktemp("talk") / "run.log"
    run(RunConfig(seed=3, environments=3, bus="none"), path)
    return path


@pytest.fixture(scope="module")
def trajectory(log):
    return resimulate(log).trajectory


@pytest.fixture(scope="module")
def index(log):
    return index_log(log, 1)


@pytest.fixture
def ask(log, trajectory, index):
    """Asks one question of a fresh conversation, and returns the line that is printed."""

    def answer(question: str, at_s: float | None = None, script: str = "robot") -> str:
        tick = trajectory.ticks - 1 if at_s is None else round(at_s / 0.02)
        texts = texts_of(script)
        facts = RobotFacts(trajectory, index, tick, texts).by_name()
        return Source(log, index).line_of(Conversation(script_named(script), facts, texts).answer(question))

    return answer


@pytest.mark.parametrize("script", LANGUAGES)
def test_nine_of_ten_questions_are_answered_from_the_log_none_invented(ask, script):
    asked = [(kind, ask(text, script=script).split()[0].strip("[]"), text) for kind, text in questions(script)]

    invented = [text for kind, mark, text in asked if kind == "words" and mark != "words"]
    missed = [text for kind, mark, text in asked if kind == "log" and mark != "log"]
    assert len(asked) >= 80
    assert invented == []
    assert len(missed) <= 0.1 * sum(kind == "log" for kind, _, _ in asked), missed


@pytest.mark.parametrize("script", LANGUAGES)
def test_robot_scripts_never_need_a_built_in_answer(script):
    rules = script_named(script).rules.values()

    open_ended = [it.key for it in rules if it.can_answer and not it.link and it.transformations[-1].parts != (0,)]
    assert open_ended == []


def test_german_texts_cover_the_english_ones_with_equal_placeholders():
    english, german = texts_of("robot"), texts_of("robot-de")
    said = {name for name in SENTENCES if not re.search("_exact$|plant", name)}
    gaps = {name: [set(re.findall(r"{\w+}", it.facts[name])) for it in (english, german)] for name in english.facts}

    assert german.facts.keys() == english.facts.keys()
    assert [name for name, (one, other) in gaps.items() if one != other] == ["changed_item"]  # news are in English
    assert [name for name in said if german.words.sentences[name] == SENTENCES[name]] == []
    assert (len(german.words.patterns), len(german.words.sides)) == (len(PATTERNS), len(SIDES))


def test_answers_match_those_read_from_the_frames(log, trajectory):
    last = trajectory.ticks - 1

    count, found = differences(log, [0, last // 3, last], [7, last // 4, last - 1])

    assert count >= 75
    assert found == []


def test_comparison_with_the_frames_detects_wrong_answers(log, trajectory, monkeypatch):
    monkeypatch.setattr(Texts, "times", lambda self, count: self.say("times", count=count + 1))

    _, found = differences(log, [trajectory.ticks - 1], [])

    assert {it[2] for it in found} >= {"How sure are you?", "Were you bored?", "How often have you tried?"}


def test_answer_about_learning_lists_the_memory_at_the_end(log, trajectory, ask):
    said = ask("What have you learned?")

    memory = trajectory.at(trajectory.ticks - 1)["memory"]
    known = [f"{PATTERNS[i]} blocked, turn {SIDES[side]}".upper() for i, side in enumerate(memory) if i and side]
    assert len(known) >= 3
    assert said.startswith(f"[log] {'; '.join(known)} ({log}:")


def test_answer_cites_the_log_line_of_its_tick(log, ask):
    said = ask("Why did you turn left?")

    seconds, line = re.search(r"AT ([\d.]+) S:", said)[1], int(re.search(r":(\d+)\)$", said)[1])
    stamp = log.read_text().splitlines()[line - 1].split()[0]
    assert float(stamp.strip("()")) == pytest.approx(float(seconds), abs=0.02)


def test_candump_log_with_uneven_times_has_the_same_ticks(log, index, tmp_path):
    times = random.Random(1)
    text = [
        f"({1_700_000_000 + float(it[1:18]) + times.random() / 1000:.6f}{it[18:]}"
        for it in log.read_text().splitlines(True)
    ]
    (tmp_path / "candump.log").write_text("".join(text))

    assert index_log(tmp_path / "candump.log", 1) == index


def test_robot_knows_nothing_of_later_ticks(ask):
    assert ask("What have you learned?", 0.0).startswith("[log] I HAVE LEARNED NOTHING YET")
    assert ask("What did you do at 12.5 s?", 0.0).startswith("[words]")
    assert "I HAVE NOT HAD A MEAL YET" in ask("What did you eat?", 0.0)


def test_altered_drive_changes_only_the_answers_that_rest_on_it(log, index, tmp_path):
    before = resimulate(log, ignore_world=True).trajectory
    tick = int(np.flatnonzero(np.array(before.tracks[0].column("reason")) == Reason.REMEMBERED)[-1])
    lines, at = log.read_text().splitlines(keepends=True), index.lines[tick] - 1
    read = [*read_log(log)]
    place = next(i for i in range(at, len(read)) if PROTOCOL.decode_drive(read[i].frame))
    frame = PROTOCOL.decode(read[place].frame)
    left, right = frame.signals["left"], frame.signals["right"]
    altered = PROTOCOL.encode("DRIVE", {**frame.signals, "left": right, "right": left})
    lines[place] = line_of(read[place].time_us, altered) + "\n"
    (tmp_path / "run.log").write_text("".join(lines))
    after = resimulate(tmp_path / "run.log", ignore_world=True).trajectory

    def answers(trajectory):
        facts = RobotFacts(trajectory, index, trajectory.ticks - 1, texts_of("robot"))
        return {
            name: getattr(facts, name)([f"{tick // 50}{POINT}{tick % 50 * 2:02}"])
            for name in FACTS
            if name != "where"
        }

    changed = {name for name, answer in answers(before).items() if answers(after)[name] != answer}
    assert changed == {"why", "turn"}


def test_altered_cell_changes_only_the_answers_that_rest_on_it(log, index, tmp_path):
    before = resimulate(log, ignore_world=True).trajectory
    read = [*read_log(log)]
    said = [PROTOCOL.decode(it.frame) for it in read]
    place = [i for i, it in enumerate(said) if it and "cell_1" in it.signals][-3]
    tick, signals = sum(it is not None and it.name == "SENSES" for it in said[:place]), said[place].signals
    altered = PROTOCOL.encode("MEMORY", {**signals, "cell_1": 3 - signals["cell_1"]})
    lines = log.read_text().splitlines(keepends=True)
    lines[place] = line_of(read[place].time_us, altered) + "\n"
    (tmp_path / "run.log").write_text("".join(lines))
    after = resimulate(tmp_path / "run.log", ignore_world=True).trajectory

    def answers(trajectory):
        facts = RobotFacts(trajectory, index, tick, texts_of("robot"))
        return {name: getattr(facts, name)(["FRONT-RIGHT"]) for name in FACTS}

    changed = {name for name, answer in answers(before).items() if answers(after)[name] != answer}
    assert changed == {"learned", "sure", "cell", "told"}  # it did not do that itself


def test_answer_reads_at_most_two_states_of_the_run(ask, monkeypatch):
    looked = []
    at = Trajectory.at
    monkeypatch.setattr(Trajectory, "at", lambda self, *args: looked.append(args) or at(self, *args))
    for _, text in questions("robot"):
        looked.clear()
        ask(text)
        assert len(looked) <= 2, text


def test_robot_without_a_log_knows_only_its_memory(tmp_path):
    memory = tmp_path / "robot.mem"
    memory.write_bytes(bytes([0, 1, 0, 0, 2, 0, 0, 0]))
    robot, source = about_memory("robot", memory)

    told = source.line_of(robot.answer("What have you learned?"))
    assert told == f"[memory] FRONT-RIGHT BLOCKED, TURN LEFT; FRONT-LEFT BLOCKED, TURN RIGHT ({memory})"
    assert robot.answer("What do you do when the front is blocked?").text.startswith("FRONT BLOCKED: I DO NOT KNOW")
    assert robot.answer("What did you eat?").mark == "words"


def test_talk_answers_lines_of_any_kind(log):
    asked = b"What have you learned?\n\xff\xfe\x00\n\n" + b"x" * 1_000_000 + b"\nWhere are you?"

    done = octet_process("talk", "--log", log, input=asked.decode(errors="surrogateescape"), errors="surrogateescape")

    lines = done.stdout.splitlines()
    assert (done.returncode, len(lines)) == (0, 6)
    assert [line.split()[0] for line in lines[1:]] == ["[log]", "[words]", "[words]", "[words]", "[log]"]


@pytest.mark.parametrize(
    ("arguments", "error"),
    [
        (["--log", "nowhere.log"], "nowhere.log"),
        (["--script", "nowhere"], "there is no script nowhere: give a file, or one of robot, robot-de, eliza"),
        (["--memory", "nowhere.mem"], "there is no file nowhere.mem"),
        (["--memory", "x", "--at", "1"], "--memory is for a robot without a log"),
    ],
)
def test_talk_reports_unreadable_files_in_a_line_with_exit_code_2(arguments, error):
    done = octet("talk", *arguments)

    assert (done.returncode, done.stdout) == (2, "")
    assert error in done.stderr
    assert done.stderr.count("\n") == 1


FOREIGN = """(HELLO) (IF ((0 IF 0) (WHY IF 3))) (NO ((0 NO 0) (1 NO 3)))
(MEMORY NO (0 = 1) (0 = 1) (0 = 1) (0 = 1)) (NONE ((0) (GO ON)))"""


def test_script_from_a_file_gets_each_sentence_unchanged(tmp_path):
    """As the public reimplementation answers by these rules: a comma and a decimal point split the sentence."""
    path = tmp_path / "own.script"
    path.write_text(FOREIGN)

    talk = about_nothing(str(path))

    assert [talk.answer(it).text for it in ("You no, if x", "no 3.5")] == ["YOU NO", "NO 3"]
