"""The words of the pages: every text in each language, none that no page shows, and none anywhere else."""

import copy
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from host_sim.base.paths import WEB
from host_sim.base.toml_file import parse_toml
from host_sim.protocol.generated import BODY_SENTENCES, PATTERNS, PROFILES, SENTENCES, SIDES
from host_sim.talk import languages as module
from host_sim.talk.conversation import SCRIPTS as SCRIPTS_FOLDER
from host_sim.talk.languages import languages, template
from host_sim.world.names import STILL_WORLDS
from tests.runs.support import ROOT

TEXTS = languages()
SCRIPTS = {it["language"]: it for path in SCRIPTS_FOLDER.glob("*.toml") for it in [parse_toml(path.read_text())]}
GAPS = re.compile(r"\{\w+\}")
TEMPLATES = sorted(path.name for path in WEB.glob("*.html"))
SAID_IN_ENGLISH = {
    "host_sim/world/native/edits.c": r'(?:return|:|=) "([^"]+)"',
    "host_sim/web/sim": r'(?:Error|LineError|error)\((?:\w+, )?(["`][^"`]+["`])\)',
    "host_sim/web/lab": r"Error\((`[^`]+`)\)",
    "host_sim/report/laboratory.py": r'"why": f?("[^"]+")',
    "host_sim/live/server.py": r'_told\(("[^"]+")',
    "host_sim/live/join_code.py": r'Error\(("[^"]+")',
    "host_sim/live/paced_run.py": r'EditError\(("[^"]+")',
}
"""Where sentences come from that a page hears in English, and how they stand there."""


def code() -> str:
    return "".join(path.read_text() for path in (*WEB.rglob("*.ts"), *WEB.rglob("*.html"), Path(module.__file__)))


def own(words: dict[str, Any]) -> dict[str, Any]:
    """The parts that every language has; the others stand for English ones."""
    return {part: text for part, text in words.items() if part not in ("robot", "heard", "refused", "language")}


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


@pytest.mark.parametrize("code", [code for code in TEXTS if code != "en"])
def test_languages_have_all_texts_of_english(code):
    english, other = (copy.deepcopy(own(TEXTS[it])) for it in ("en", code))
    for words in (english, other):
        del words["program"]["expected"]  # in English they are the program's own

    assert different(english, other) == set()
    assert {"sentences", "patterns", "sides", "point", "many"} == set(TEXTS[code]["robot"])
    assert len(TEXTS[code]["robot"]["patterns"]) == len(PATTERNS)
    assert len(TEXTS[code]["robot"]["sides"]) == len(SIDES)
    assert [it for it in SENTENCES if it not in TEXTS[code]["robot"]["sentences"] and "plant" not in it] == []


def test_german_texts_are_not_left_in_english():
    english, german = dict(places(own(TEXTS["en"]))), dict(places(own(TEXTS["de"])))
    words = {place: text for place, text in german.items() if re.search("[a-z]{3}", GAPS.sub("", text))}
    same = {text for place, text in words.items() if english.get(place) == text}

    assert same == {"Arena", "Atlas", "Code", "Link", "Listing", "Name", "Pause", "ideal", "live"}


@pytest.mark.parametrize("code", [code for code in TEXTS if code != "en"])
def test_lessons_name_controls_as_the_page_does(code):
    english, shown = {*TEXTS["en"]["page"].values(), *SIDES}, set(TEXTS[code]["page"].values())
    quoted = {it for _, text in places(TEXTS[code]["lessons"]) for it in re.findall("„([^“]+)“", text)}

    assert quoted & shown != set()
    assert quoted & english - shown == set()


QUOTES = {"en": "“([^”]+)”", "de": "„([^“]+)“"}
ELSEWHERE = {"en": r"above|at the bottom|below", "de": r"\boben|\bunten"}
"""Words for places that depend on the screen."""


def unknown_in_steps(code: str, words: dict[str, Any]) -> set[str]:
    """What a step names that the page does not show by that name, and where it sends readers to look."""
    shown = {text for part in (words["page"], words["kinds"], words["lessons"]["words"]) for _, text in places(part)}
    shown |= {*words["robot"].get("patterns", PATTERNS), "ELIZA"}
    shown |= {words["heard"].get(it, it) for it in ("front", "front-left", "front-right")}
    steps = [step for lesson in words["lessons"]["lessons"].values() for step in lesson["steps"]]
    named = {it for step in steps for it in re.findall(QUOTES[code], step) if not it.endswith("?")}
    known = {it.casefold() for it in shown}
    missing = {it for it in named if not any(text.startswith(it.casefold()) for text in known)}
    return missing | {it for step in steps for it in re.findall(ELSEWHERE[code], step)}


@pytest.mark.parametrize("code", TEXTS)
def test_lesson_steps_name_only_what_the_page_shows(code):
    assert unknown_in_steps(code, TEXTS[code]) == set()


@pytest.mark.parametrize(
    ("said", "instead"), [("“Play”", "“Begin now”"), ("with the slider here", "with the slider above")]
)
def test_lesson_step_that_names_something_not_shown_is_found(said, instead):
    words = copy.deepcopy(TEXTS["en"])
    for lesson in words["lessons"]["lessons"].values():
        lesson["steps"] = [step.replace(said, instead) for step in lesson["steps"]]

    assert len(unknown_in_steps("en", words)) == 1


OTHER_MEANINGS = r"Food left|rules can each be right|right in front of|right away"
"""Where left and right are no sides."""
SIDES_OF = {"links": "left", "link": "left", "left": "left", "rechts": "right", "recht": "right", "right": "right"}


def sides(text: str) -> list[str]:
    """The sides that a text names, in order."""
    words = re.findall("[a-zäöüß]+", re.sub(OTHER_MEANINGS, "", text).lower())
    return [SIDES_OF[stem] for word in words if (stem := re.sub("(?<=link|echt)e[nrs]?$", "", word)) in SIDES_OF]


def numbers(text: str) -> list[str]:
    """The numbers in a text."""
    return sorted(number.replace(",", ".") for number in re.findall(r"\d+(?:[.,:]\d+)*", text))


def buttons(english: str, german: str, calls: dict[str, set[str]]) -> set[str]:
    """What the English text quotes of the page, and the German one not as the page calls it there."""
    quoted = set(re.findall("„([^“]+)“", german))
    return {it for it in re.findall("“([^”]+)”", english) if it in calls and not calls[it] & quoted}


def contradictions(english: dict[str, str], german: dict[str, str]) -> set[str]:
    """Texts that name other sides, numbers or buttons than in English. Glossaries are sorted in each language."""
    calls: dict[str, set[str]] = {}
    for place, text in english.items():
        calls.setdefault(text, set()).add(german.get(place, ""))
    pairs = {place: (text, german[place]) for place, text in english.items() if "/glossary/" not in place}
    return {
        place
        for place, (one, other) in pairs.items()
        if sides(one) != sides(other) or numbers(one) != numbers(other) or buttons(one, other, calls)
    }


MEANT_OTHERWISE = {
    "/lessons/lessons/watch/goals/2": ("nach links zu drehen", "nach rechts zu drehen"),
    "/lessons/lessons/program/notes/expect": ("0,196", "0,169"),
    "/lessons/lessons/plant/steps/0": ("„Abspielen“", "„Pause“"),
}


def test_german_texts_name_the_sides_numbers_and_buttons_of_english():
    assert contradictions(dict(places(own(TEXTS["en"]))), dict(places(own(TEXTS["de"])))) == set()


def told_otherwise(words: dict[str, str]) -> set[str]:
    """English words that name other sides or numbers than what is said for them."""
    return {told for told, said in words.items() if sides(told) != sides(said) or numbers(told) != numbers(said)}


@pytest.mark.parametrize("section", ["heard", "refused"])
def test_german_replies_keep_the_sides_and_numbers_of_english(section):
    assert told_otherwise(TEXTS["de"][section]) == set()


@pytest.mark.parametrize(
    ("told", "said"),
    [("left", "rechts"), ("front-left", "vorne rechts"), ("there are 40 obstacles", "es gibt schon 20")],
)
def test_translation_with_another_side_or_number_is_found(told, said):
    assert told_otherwise({told: said, "right": "rechts"}) == {told}


def test_german_robot_names_the_sides_and_numbers_of_the_english_one():
    words = TEXTS["de"]["robot"]
    english, german = (SCRIPTS[code]["facts"] for code in ("en", "de"))

    for told, said in ((PATTERNS, words["patterns"]), (SIDES, words["sides"])):
        assert told_otherwise(dict(zip(told, said, strict=True))) == set()
    assert told_otherwise({SENTENCES[it]: said for it, said in words["sentences"].items()}) == set()
    assert contradictions(dict(places(english)), dict(places(german))) == set()


@pytest.mark.parametrize("code", ["en", "de"])
def test_robot_recognizes_each_side_by_its_own_names(code):
    spoken = SCRIPTS[code]["spoken"]

    heard = {(side, *sides(name)) for side in ("left", "right", "front") for name in spoken[side]}
    assert heard == {("left", "left"), ("right", "right"), ("front",)}
    assert [it for name in spoken["turns"] for it in sides(name)] == ["left", "right"] * (len(spoken["turns"]) // 2)


@pytest.mark.parametrize("place", MEANT_OTHERWISE)
def test_german_text_with_another_meaning_is_found(place):
    german = dict(places(own(TEXTS["de"])))
    german[place] = german[place].replace(*MEANT_OTHERWISE[place])

    assert contradictions(dict(places(own(TEXTS["en"]))), german) == {place}


def test_texts_are_all_used():
    words = {part: TEXTS["en"][part] for part in ("page", "wall", "lessons")}

    assert unused(words, code()) == set()


def said_in_english() -> set[str]:
    """The sentences that may come from the firmware, the worker or a robot's description, with {0} for each gap."""
    said = {*BODY_SENTENCES.values(), *(text for name, text in SENTENCES.items() if "plant" in name)}
    said |= set(re.findall(r'meaning: "([^"]+)"', (WEB / "generated.ts").read_text()))
    for where, how in SAID_IN_ENGLISH.items():
        place = ROOT / where
        for path in sorted(place.rglob("*.ts")) if place.is_dir() else [place]:
            said |= {numbered(it.strip('`"')) for it in re.findall(how, path.read_text())}
    return {it for it in said if " " in it} | {*STILL_WORLDS, *PROFILES}


def numbered(text: str) -> str:
    gaps = iter(range(9))
    return re.sub(r"\$?\{[^}]*\}", lambda _: f"{{{next(gaps)}}}", text)


@pytest.mark.parametrize("code", [code for code in TEXTS if code != "en"])
def test_messages_heard_in_english_are_translated_in_each_language(code):
    heard = {**TEXTS[code]["heard"], **TEXTS[code]["refused"]}

    assert said_in_english() - heard.keys() == set()
    assert [it for it, own in heard.items() if gaps(it) != gaps(own)] == []


def texts_in_html(html: str) -> list[str]:
    """The words that a page has of its own."""
    body = re.sub(r"<(script|style)\b.*?</\1>|<!--.*?-->", "", html, flags=re.DOTALL)
    named = re.findall(r'\s(?:aria-label|title|placeholder|alt)="([^"]*)"', body)
    found = [text.strip() for text in (*named, *re.findall(r">([^<]+)<", body))]
    return [text for text in found if re.search("[A-Za-z]{2}", text) and text != "Octet"]


@pytest.mark.parametrize("name", TEMPLATES)
def test_templates_contain_no_text(name):
    html = template(name)

    assert texts_in_html(html) == []
    assert texts_in_html(html.replace("<main>", '<main><p title="a title">words</p>')) == ["a title", "words"]


@pytest.mark.parametrize("change", ["missing", "more", "empty", "gap", "shorter"])
def test_difference_between_the_texts_of_two_languages_is_found(change):
    german = copy.deepcopy(TEXTS["de"]["lessons"])
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

    assert len(different(TEXTS["en"]["lessons"], german)) == 1


def test_text_that_no_page_shows_is_found():
    words = {"nobodySaysThis": "What is never said"}

    assert unused(words, code() + "// nobodySaysThis") == {"nobodySaysThis"}


def test_lessons_have_checks_for_goals_plans_for_steps_answers_for_tasks():
    plan = r'^    id: "(\w+)",.*?^    steps: \[\n(.*?)^    \],\n    goals: \[(.*?)\],\n'
    plans = re.findall(plan, code(), re.DOTALL | re.MULTILINE)
    checks = {name: len(goals.split(", ")) for name, _, goals in plans}
    steps = {name: len(re.findall(r"^      \{", written, re.MULTILINE)) for name, written, _ in plans}

    for words in TEXTS.values():
        lessons = words["lessons"]["lessons"]
        assert {name: len(lesson["goals"]) for name, lesson in lessons.items()} == checks
        assert {name: len(lesson["steps"]) for name, lesson in lessons.items()} == steps
        assert all(len(lesson["tasks"]) == len(lesson["notes"]["answers"]) for lesson in lessons.values())
