"""The words of the lessons: the same keys in each language, and none that no page shows."""

import copy
import re
from collections.abc import Iterator
from typing import Any

import pytest

from host_sim.base.paths import WEB
from host_sim.report.octet_page import texts

TEXTS = texts("lessons")
FOLDER = WEB / "lessons"
GAPS = re.compile(r"\{\w+\}")


def code() -> str:
    return "".join(path.read_text() for path in (*FOLDER.glob("*.js"), WEB / "core/building.js"))


def places(words: Any, place: str = "") -> Iterator[tuple[str, str]]:
    """Each text with where it stands: its keys, and its place in a list."""
    if isinstance(words, str):
        yield place, words
        return
    entries = words.items() if isinstance(words, dict) else enumerate(words)
    for key, value in entries:
        yield from places(value, f"{place}/{key}")


def keys(words: Any) -> set[str]:
    """All keys in it."""
    if isinstance(words, list):
        return set().union(*map(keys, words))
    if isinstance(words, str):
        return set()
    return set(words) | set().union(*map(keys, words.values()))


def different(one: Any, other: Any) -> set[str]:
    """Where one has a text and the other has none, or only one has an empty one, or their gaps differ."""
    texts, others = dict(places(one)), dict(places(other))
    both = texts.keys() & others.keys()
    unlike = {it for it in both if bool(texts[it]) != bool(others[it]) or gaps(texts[it]) != gaps(others[it])}
    return unlike | (texts.keys() ^ others.keys())


def gaps(text: str) -> list[str]:
    return sorted(GAPS.findall(text))


def unused(words: dict[str, Any], source: str) -> set[str]:
    """The keys that no module names."""
    return {key for key in keys(words) if not re.search(rf"\b{key}\b", without_comments(source))}


def without_comments(source: str) -> str:
    return re.sub(r"/\*.*?\*/|//[^\n]*", "", source, flags=re.DOTALL)


def test_there_are_two_languages():
    assert {code: words["language"] for code, words in TEXTS.items()} == {"de": "Deutsch", "en": "English"}


def test_every_language_has_every_text():
    assert different(TEXTS["en"], TEXTS["de"]) == set()


def test_no_text_is_left_in_english():
    english, german = dict(places(TEXTS["en"])), dict(places(TEXTS["de"]))
    same = {text for place, text in german.items() if re.search("[a-z]{3}", text) and english[place] == text}

    assert same == {"Name"}


def test_every_text_is_used():
    assert unused(TEXTS["en"], code()) == set()


@pytest.mark.parametrize("change", ["missing", "more", "empty", "gap", "shorter"])
def test_a_text_that_is_not_in_both_is_found(change):
    german = copy.deepcopy(TEXTS["de"])
    if change == "missing":
        del german["words"]["start"]
    elif change == "more":
        german["words"]["stop"] = "Halt"
    elif change == "empty":
        german["words"]["start"] = ""
    elif change == "gap":
        german["words"]["score"] = german["words"]["score"].replace("{run}", "")
    else:
        german["lessons"]["watch"]["steps"].pop()

    assert len(different(TEXTS["en"], german)) == 1


def test_a_text_that_no_page_shows_is_found():
    words = copy.deepcopy(TEXTS["en"])
    words["words"]["nobodySaysThis"] = "What is never said"

    assert unused(words, code() + "// nobodySaysThis") == {"nobodySaysThis"}


def test_a_lesson_has_a_check_for_each_goal_and_an_answer_to_each_question():
    plans = re.findall(r'^    id: "(\w+)",.*?^    goals: \[\n(.*?)^    \],', code(), re.DOTALL | re.MULTILINE)
    check = re.compile(r"^      \(_?runs, _?tick(?:, talk)?\) =>", re.MULTILINE)
    checks = {name: len(check.findall(goals)) for name, goals in plans}

    for words in TEXTS.values():
        lessons = words["lessons"]
        assert {name: len(lesson["goals"]) for name, lesson in lessons.items()} == checks
        assert all(len(lesson["tasks"]) == len(lesson["notes"]["answers"]) for lesson in lessons.values())
