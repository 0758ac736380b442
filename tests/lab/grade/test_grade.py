"""`tools/octet grade`: solutions are right, mutants of them are wrong, and nobody else's decision is told."""

import csv
import json
import re
import shlex
import xml.etree.ElementTree as ET
from pathlib import Path

import pytest

from host_sim.base.toml_file import parse_toml
from host_sim.lab.grade.attempt import TITLES, Verdict
from host_sim.lab.grade.grade_command import EXERCISES
from host_sim.lab.grade.grading import grade
from tests.runs.support import data_in, octet_process

ROOT = Path(__file__).resolve().parents[3]
SOLUTIONS = Path(__file__).parent / "solutions"
MUTANTS = {
    int(number): changes
    for number, changes in parse_toml((Path(__file__).parent / "mutants.toml").read_text()).items()
}


def solution(number: int) -> str:
    return (SOLUTIONS / f"{number}.c").read_text()


def graded(folder: Path, number: int, *texts: str) -> list[Verdict]:
    """The verdicts on submissions for an exercise."""
    files = [folder / f"{place}.c" for place in range(len(texts))]
    for file, text in zip(files, texts, strict=True):
        file.write_text(text)
    return [it.verdict for it in grade(number, 1, files)]


def mutants(number: int) -> list[str]:
    """Wrong solutions of an exercise."""
    return [solution(number).replace(old, new) for old, new in MUTANTS[number]]


def test_exercises_have_a_solution_mutants_and_a_section():
    page = (ROOT / "docs/exercises.md").read_text()

    assert set(TITLES) == set(MUTANTS) == set(range(1, EXERCISES + 1))
    assert [f"\n## {number}: {title}\n" in page for number, title in TITLES.items()] == [True] * EXERCISES


@pytest.mark.parametrize("number", TITLES)
def test_grade_passes_the_solution_of_an_exercise_and_no_wrong_one(tmp_path, number):
    texts = [solution(number), *mutants(number)]

    right, *wrong = graded(tmp_path, number, *texts)

    assert len(set(texts)) == len(texts)
    assert right.status == "pass", right.message
    assert [change for change, it in zip(MUTANTS[number], wrong, strict=True) if it.status == "pass"] == []


def test_verdict_describes_the_first_wrong_decision_in_words(tmp_path):
    (first,) = graded(tmp_path, 1, mutants(1)[0])
    (fourth,) = graded(tmp_path, 4, mutants(4)[1])

    assert "front-right" in first.message
    assert first.message.endswith(": you chose a turn right by 10 degrees; asked is a turn left by 10 degrees")
    assert "asked is a turn to either side by 45 degrees" in fourth.message


def submissions(folder: Path) -> Path:
    """A right solution, a copy of it with other names, a wrong one, one that does not end, and no C at all."""
    texts = {
        "ada": solution(4),
        "bob": solution(4).replace("*config", "*c").replace("config->", "c->") + "/* all mine */\n",
        "eve": solution(4).replace("any_side(brain)", "SIDE_LEFT").replace("if (", "if (brain && "),
        "joe": solution(4).replace("    if (", "    for (;;)\n        ;\n    if ("),
        "kim": "no C <at all>",
    }
    for name, text in texts.items():
        (folder / name).mkdir(parents=True)
        (folder / name / "mine.c").write_text(text)
    return folder


def test_grading_a_folder_writes_html_csv_junit_and_json(tmp_path):
    folder = submissions(tmp_path / "submissions")
    outputs = [word for it in ("--html", "--csv", "--junit") for word in (it, tmp_path / f"grades.{it[2:]}")]

    done = octet_process("grade", "4", folder, *outputs, "--out", tmp_path / "results")

    statuses = ["pass", "pass", "fail", "fail", "error"]
    assert done.returncode == 1
    words = re.findall(r"^\S+/\w+/mine\.c: (right|wrong|no solution)", done.stdout, re.MULTILINE)
    assert words == ["right", "right", "wrong", "wrong", "no solution"]
    with (tmp_path / "grades.csv").open(newline="") as file:
        assert [row["status"] for row in csv.DictReader(file)] == statuses
    suite = ET.parse(tmp_path / "grades.junit").getroot()
    assert (suite.get("tests"), suite.get("failures"), suite.get("errors")) == ("5", "2", "1")
    results = [json.loads(path.read_text()) for path in sorted((tmp_path / "results").iterdir())]
    assert [(it["version"], it["status"]) for it in results] == [(2, status) for status in statuses]
    assert "no C &lt;at all&gt;" in (tmp_path / "grades.html").read_text()
    assert "mine.c" in done.stdout.splitlines()[0].partition("the same but for names and comments: ")[2]


def test_verdict_is_repeatable_and_changes_with_the_seed(tmp_path):
    wrong = tmp_path / "wrong.c"
    wrong.write_text(solution(5).replace(*MUTANTS[5][0]))

    once, again, other = (octet_process("grade", "5", wrong, "--seed", seed).stdout for seed in ("1", "1", "2"))

    assert once == again != other


def test_page_and_debugger_open_at_the_first_wrong_decision(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    Path("my robot.c").write_text(solution(5).replace("TRIAL_DEG", "TURN_DEG"))

    done = octet_process("grade", "5", "my robot.c", "--page")
    verdict, page, command = done.stdout.splitlines()
    tick = int(re.search(r"at tick (\d+), .* you chose a turn right by 10 degrees", verdict)[1])
    shown = octet_process(*shlex.split(command.partition("tools/octet")[2]), "--ex", "print sensed->feel").stdout

    assert data_in(Path(page.split()[-1]).read_text(), "run")["shown"] == tick
    assert re.search(rf"^tick {tick}, .*\n(.*\n)*\$1 = [1-9]", shown, re.MULTILINE)


def test_right_solution_has_no_page(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    Path("mine.c").write_text(solution(1))

    assert octet_process("grade", "1", "mine.c", "--page").stdout == "mine.c: right\n"
    assert list(Path("out").iterdir()) == []


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ("9 x.c", "is not a number from 1 to 8"),
        ("4 {out}/empty", "no C file is in "),
        ("4 x.c --html {out}", "it is a folder"),
        ("4 {out}/ada.c {out}/bob.c --page", "--page is for one file, not for 2"),
        ("4 {out}/no.c", "no.c: there is no such file or folder"),
    ],
)
def test_grade_refuses_wrong_numbers_files_and_options(tmp_path, words, said):
    (tmp_path / "empty/a folder.c").mkdir(parents=True)
    for name in ("ada.c", "bob.c"):
        (tmp_path / name).write_text("int x;")

    done = octet_process("grade", *words.format(out=tmp_path).split())

    assert done.returncode == 2
    assert said in done.stderr
