"""A class: who is in it, what each has reached, and what a file, a report or a code may do.

The code that is typed: how many wrong ones are looked at.
"""

import csv
import io
import json

import pytest

from host_sim.base.errors import UsageError
from host_sim.live.class_roster import (
    LINK_MAX,
    NAME_MAX,
    PUPILS_MAX,
    Roster,
    RosterError,
    code_of,
    lesson_goals,
    name_from,
)
from host_sim.live.join_code import _WORDS, ALL_MAX, EACH_MAX, PERIOD_S, JoinCode, TooManyGuessesError

A, B = "a" * 32, "b" * 32
REPORT = {
    "key": A,
    "name": "Ada",
    "lesson": "watch",
    "step": 1,
    "goals": {"watch": [0]},
    "memory": [0] * 8,
    "link": "#v=1",
}


@pytest.fixture
def roster(tmp_path) -> Roster:
    return Roster(tmp_path / "class.json")


@pytest.mark.parametrize(
    ("typed", "name"),
    [
        ("  Ada \n\t Lovelace ", "Ada Lovelace"),
        ("x" * 1000, "x" * NAME_MAX),
        ("\x00\x1b[31m\u202eevil\u200b", "[31m evil"),
        ("<script>", "<script>"),
        ("Zoe\u0308", "Zo\u00eb"),
        ("", ""),
    ],
)
def test_pupil_name_is_shortened_and_made_printable(typed, name):
    assert name_from(typed) == name


def test_saved_roster_is_the_same_after_a_restart(tmp_path, roster):
    roster.report(REPORT)
    roster.take_code("Ben", code_of("Ben", {"boredom": [0, 2]}))
    roster.save()

    again = Roster(tmp_path / "class.json")

    assert again.pupils == roster.pupils
    assert list(again.pupils.values())[1].heard_s == 0
    assert not again.changed


def test_goal_once_reached_stays_when_the_lesson_is_begun_again(roster):
    roster.report(REPORT)
    roster.report({**REPORT, "goals": {"watch": [2], "talk": []}})

    assert roster.pupils[A].goals == {"watch": [0, 2], "talk": []}


@pytest.mark.parametrize(
    "wrong",
    [
        {"key": "a"},
        {"key": A.upper()},
        {"key": 7},
        {"name": None},
        {"lesson": "dance"},
        {"step": -1},
        {"step": True},
        {"step": 1e300},
        {"goals": [0]},
        {"goals": {"watch": [3]}},
        {"goals": {"watch": [True]}},
        {"goals": {"watch": 0}},
        {"goals": {"dance": [0]}},
        {"memory": [3] * 8},
        {"memory": [0] * 7},
        {"memory": "00000000"},
        {"link": "/evil"},
        {"link": "#" + "x" * LINK_MAX},
        {"link": "#\n"},
        {"link": 1},
    ],
)
def test_report_with_a_wrong_field_is_refused_and_changes_nothing(roster, wrong):
    with pytest.raises(RosterError):
        roster.report({**REPORT, **wrong})

    assert roster.pupils == {}


def test_full_class_refuses_a_new_pupil_until_one_is_removed(roster):
    for i in range(PUPILS_MAX):
        roster.report({**REPORT, "key": f"{i:032x}"})

    with pytest.raises(RosterError, match=f"the class is full: it has {PUPILS_MAX} pupils"):
        roster.report({**REPORT, "key": B})
    roster.report({**REPORT, "key": f"{0:032x}", "name": "Zoe"})
    roster.remove(f"{1:032x}")
    roster.report({**REPORT, "key": B})


def test_code_holds_its_goals_and_is_valid_only_for_its_name(roster):
    goals = {"watch": [0, 1], "share": [2]}
    code = code_of("Ada", goals)

    roster.take_code(" ada ", code.lower().replace("-", " "))

    (pupil,) = roster.pupils.values()
    assert {lesson: reached for lesson, reached in pupil.goals.items() if reached} == goals
    for name, wrong in (("Ben", code), ("Ada", code_of("Ada", {})[:-1] + "!"), ("Ada", code + "0"), ("Ada", "")):
        with pytest.raises(RosterError):
            roster.take_code(name, wrong)
    changed = "".join("1" if digit == "0" else "0" for digit in code[:1]) + code[1:]
    with pytest.raises(RosterError, match="do not fit"):
        roster.take_code("Ada", changed)


def test_class_table_has_a_column_for_each_goal_and_no_formulas(roster):
    roster.report({**REPORT, "name": "=1+2"})
    roster.report({**REPORT, "key": B, "name": 'Zoe, "Z"', "goals": {"watch": [0, 1, 2]}})

    head, first, second = csv.reader(io.StringIO(roster.table()))

    assert len(head) == 2 + sum(lesson_goals().values())
    assert first[:4] == ["'=1+2", "1", "1", "0"]
    assert second[:5] == ['Zoe, "Z"', "3", "1", "1", "1"]


@pytest.mark.parametrize(
    "text",
    ["", "[]", "{}", '{"pupils": 1}', '{"pupils": {"x": {}}}', json.dumps({"pupils": {A: {**REPORT}}}), "\xff"],
)
def test_roster_refuses_a_malformed_file_and_leaves_it_unchanged(tmp_path, text):
    path = tmp_path / "class.json"
    path.write_text(text, encoding="latin-1")

    with pytest.raises(UsageError, match="is not the file of a class"):
        Roster(path)
    assert path.read_text(encoding="latin-1") == text


def is_refused(code: JoinCode, given: str, address: str) -> bool:
    try:
        return not code.opens(given, address)
    except TooManyGuessesError:
        return True


def test_address_must_wait_after_wrong_codes_and_others_need_not():
    now = [0.0]
    code = JoinCode(lambda: now[0])
    assert not any(code.opens("mint-", "a") for _ in range(EACH_MAX))

    with pytest.raises(TooManyGuessesError, match="wait a minute"):
        code.opens(code.text, "a")
    assert code.opens(code.text, "b")
    now[0] = PERIOD_S
    assert code.opens(code.text, "a")


def test_other_addresses_must_wait_too_after_many_wrong_codes():
    code = JoinCode(lambda: 0.0)
    for i in range(ALL_MAX):
        code.opens("mint-", f"{i}")

    assert is_refused(code, code.text, "one that has not guessed")


def test_join_code_is_a_short_word_and_digits_typed_in_any_case():
    assert len(set(_WORDS)) == len(_WORDS) > 128
    assert all(word.isascii() and word.islower() and 4 <= len(word) <= 7 for word in _WORDS)
    assert all(code.opens(code.text.replace("-", "").upper(), "a") for code in (JoinCode() for _ in range(20)))
