"""The words of the pages: every text in each language, none that no page shows, and none anywhere else."""

import copy
import json
import re
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Page

from host_sim.base.paths import WEB
from host_sim.protocol.generated import BODY_SENTENCES, PARAMETERS, PATTERNS, SENTENCES, SIDES
from host_sim.report.octet_page import octet_page
from host_sim.view import languages as module
from host_sim.view.languages import languages
from tests.runs.support import ROOT
from tests.web.lab.support import READY, go, settle
from tests.web.support import next_frame

TEXTS = languages()
GAPS = re.compile(r"\{\w+\}")
TEMPLATES = ("octet.html", "live.html", "replay.html", "board.html", "fleet.html")
SAID_IN_ENGLISH = {
    "host_sim/world/native/edits.c": r'(?:return|:|=) "([^"]+)"',
    "host_sim/web/sim": r'(?:Error|LineError|error)\((?:\w+, )?(["`][^"`]+["`])\)',
    "host_sim/web/lab": r"Error\((`[^`]+`)\)",
}
"""Where sentences come from that a page hears in English, and how they stand there."""
INSIDE = re.compile("the worker has|no program")
"""What is wrong with the page itself."""


def code() -> str:
    return "".join(path.read_text() for path in (*WEB.rglob("*.js"), *WEB.glob("*.html"), Path(module.__file__)))


def own(words: dict[str, Any]) -> dict[str, Any]:
    """The parts that every language has; the others stand for English ones."""
    return {part: text for part, text in words.items() if part not in ("robot", "heard", "language")}


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
def test_every_language_has_every_text(code):
    english, other = (copy.deepcopy(own(TEXTS[it])) for it in ("en", code))
    for words in (english, other):
        del words["program"]["expected"]  # in English they are the program's own

    assert different(english, other) == set()
    assert {"sentences", "patterns", "sides", "point", "many"} == set(TEXTS[code]["robot"])
    assert len(TEXTS[code]["robot"]["patterns"]) == len(PATTERNS)
    assert len(TEXTS[code]["robot"]["sides"]) == len(SIDES)
    assert [it for it in SENTENCES if it not in TEXTS[code]["robot"]["sentences"] and "plant" not in it] == []


def test_no_text_is_left_in_english():
    english, german = dict(places(own(TEXTS["en"]))), dict(places(own(TEXTS["de"])))
    words = {place: text for place, text in german.items() if re.search("[a-z]{3}", GAPS.sub("", text))}
    same = {text for place, text in words.items() if english.get(place) == text}

    assert same == {"Arena", "Listing", "Name", "Pause", "ideal", "live"}


def test_every_text_is_used():
    words = {part: TEXTS["en"][part] for part in ("page", "wall", "lessons")}

    assert unused(words, code()) == set()


def said_in_english() -> set[str]:
    """The sentences that may come from the firmware, the worker or a robot's description, with {0} for each gap."""
    said = {*BODY_SENTENCES.values(), *(text for name, text in SENTENCES.items() if "plant" in name)}
    said |= set(re.findall(r'meaning: "([^"]+)"', (WEB / "generated.js").read_text()))
    for where, how in SAID_IN_ENGLISH.items():
        place = ROOT / where
        for path in sorted(place.rglob("*.js")) if place.is_dir() else [place]:
            said |= {numbered(it.strip('`"')) for it in re.findall(how, path.read_text())}
    return {it for it in said if " " in it and not INSIDE.search(it)}


def numbered(text: str) -> str:
    gaps = iter(range(9))
    return re.sub(r"\$\{[^}]*\}", lambda _: f"{{{next(gaps)}}}", text)


@pytest.mark.parametrize("code", [code for code in TEXTS if code != "en"])
def test_what_is_heard_in_english_is_said_in_every_language(code):
    heard = TEXTS[code]["heard"]

    assert said_in_english() - heard.keys() == set()
    assert [it for it, own in heard.items() if gaps(it) != gaps(own)] == []


def texts_in_html(html: str) -> list[str]:
    """The words that a page has of its own."""
    body = re.sub(r"<(script|style)\b.*?</\1>|<!--.*?-->", "", html, flags=re.DOTALL)
    named = re.findall(r'\s(?:aria-label|title|placeholder|alt)="([^"]*)"', body)
    found = [text.strip() for text in (*named, *re.findall(r">([^<]+)<", body))]
    return [text for text in found if re.search("[A-Za-z]{2}", text) and text != "Octet"]


@pytest.mark.parametrize("name", TEMPLATES)
def test_no_template_has_a_text(name):
    html = (WEB / name).read_text()

    assert texts_in_html(html) == []
    assert texts_in_html(html.replace("<main>", '<main><p title="a title">words</p>')) == ["a title", "words"]


SEEN = """() => {
  const NOT_WORDS = "code, textarea, script, #language, #listing, #talk-said, #program-variables";
  const said = [];
  for (const element of document.querySelectorAll("body *")) {
    if (!element.checkVisibility() || element.closest(NOT_WORDS)) continue;
    said.push(...["aria-label", "title", "placeholder"].map((name) => element.getAttribute(name)));
    said.push(...[...element.childNodes].filter(({ nodeType }) => nodeType === 3).map(({ data }) => data));
  }
  return said.filter(Boolean);
}"""
NAMES = re.compile("|".join(["Octet|ELIZA|English|Deutsch|Esperanto|mm/s|mm|ms", *PARAMETERS]))
"""What is called so in every language."""


def made_up(words: Any) -> Any:
    """Words in letters that no other language has."""
    if isinstance(words, str):
        wide = {letter: letter + 0xFEE0 for letter in range(ord("!"), ord("~") + 1)}
        return "".join(it if it.startswith("{") else it.translate(wide) for it in re.split(r"(\{\w+\})", words))
    return {k: made_up(v) for k, v in words.items()} if isinstance(words, dict) else [made_up(it) for it in words]


@pytest.fixture(scope="module")
def esperanto(tmp_path_factory) -> Path:
    """octet.html with a third language, of which nothing is known but its file."""
    home = tmp_path_factory.mktemp("web")
    (home / "texts").mkdir()
    for code, words in TEXTS.items():
        (home / f"texts/{code}.json").write_text(json.dumps(words))
    robot = {"sentences": SENTENCES, "patterns": PATTERNS, "sides": SIDES}
    heard = {it: made_up(it) for it in TEXTS["de"]["heard"]}
    third = {**made_up({**TEXTS["en"], "robot": robot}), "heard": heard, "language": "Esperanto"}
    (home / "texts/eo.json").write_text(json.dumps(third))
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(module, "WEB", home)
        (home / "octet.html").write_text(octet_page())
    return home / "octet.html"


def foreign(page: Page) -> set[str]:
    """What a page says in letters that its language does not have."""
    next_frame(page)
    return {it for it in page.evaluate(SEEN) if re.search("[A-Za-z]{2}", NAMES.sub("", it))}


@pytest.fixture(scope="module")
def third(esperanto: Path, open_shared: Callable[..., Page]) -> Page:
    page = open_shared(esperanto.as_uri(), ready=READY, locale="eo", reduced_motion="reduce")
    settle(page)
    return page


@pytest.mark.parametrize("tab", ["run", "parameters", "listing", "program", "curves", "files", "talk", "lessons"])
def test_a_language_whose_file_alone_is_added_is_spoken_by_the_whole_page(tab, third):
    third.click(f"#tab-{tab}")
    third.click("summary >> visible=true >> nth=-1")
    for tick in (0, 400, third.evaluate("octet.last")):
        go(third, tick)
        assert foreign(third) == set()


def test_what_goes_wrong_is_said_in_it_too(third):
    third.evaluate("octet.begin({ ...octet.lane.experiment, changes: [] })")
    settle(third)
    third.click("#what-if")
    third.evaluate("octet.change({ do: 'put', robot: 0, at: [100, 100], heading: 0 })")
    settle(third)
    assert third.inner_text("#note") == made_up("the robot is not in the air")
    third.evaluate("octet.change({ do: 'body', what: 'weak-motor:left:60%', robot: 0, seed: 1 })")
    settle(third)
    go(third, 2000)

    assert third.inner_text("#news") != ""
    assert foreign(third) == set()


def test_another_language_is_chosen_without_loading_the_page_again(third):
    third.select_option("#language", "de")
    assert third.inner_text("#erase") == TEXTS["de"]["page"]["erase"]
    assert third.get_attribute("html", "lang") == "de"

    third.select_option("#language", "eo")
    assert foreign(third) == set()


@pytest.mark.parametrize("change", ["missing", "more", "empty", "gap", "shorter"])
def test_a_text_that_is_not_in_both_is_found(change):
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


def test_a_text_that_no_page_shows_is_found():
    words = {"nobodySaysThis": "What is never said"}

    assert unused(words, code() + "// nobodySaysThis") == {"nobodySaysThis"}


def test_a_lesson_has_a_check_for_each_goal_and_an_answer_to_each_question():
    plans = re.findall(r'^    id: "(\w+)",.*?^    goals: \[\n(.*?)^    \],', code(), re.DOTALL | re.MULTILINE)
    check = re.compile(r"^      \(_?runs, _?tick(?:, talk)?\) =>", re.MULTILINE)
    checks = {name: len(check.findall(goals)) for name, goals in plans}

    for words in TEXTS.values():
        lessons = words["lessons"]["lessons"]
        assert {name: len(lesson["goals"]) for name, lesson in lessons.items()} == checks
        assert all(len(lesson["tasks"]) == len(lesson["notes"]["answers"]) for lesson in lessons.values())
