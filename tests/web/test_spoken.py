"""All pages speak their reader's language, and what goes wrong is said in it: shown by one that nobody speaks."""

import json
import re
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Page

from host_sim.protocol.generated import PARAMETERS, PATTERNS, SENTENCES, SIDES
from host_sim.report.octet_page import octet_page
from host_sim.talk import languages as module
from host_sim.talk.languages import languages
from tests.runs.support import octet
from tests.web.board.test_board import READY as BOARD_READY
from tests.web.lab.support import READY, go, settle
from tests.web.looks import violations_at
from tests.web.support import next_frame, wait_for

ENGLISH, GERMAN = (languages()[code] for code in ("en", "de"))
SEEN = """() => {
  const NOT_WORDS = "code, textarea, script, #language, #listing, #talk-said, #program-variables, #urls b";
  const said = [];
  for (const element of document.querySelectorAll("body *")) {
    if (!element.checkVisibility() || element.closest(NOT_WORDS)) continue;
    said.push(...["aria-label", "title", "placeholder"].map((name) => element.getAttribute(name)));
    said.push(...[...element.childNodes].filter(({ nodeType }) => nodeType === 3).map(({ data }) => data));
  }
  return said.filter(Boolean);
}"""
TEACH = """((eo) => {
  const texts = document.getElementById("texts");
  texts.textContent = JSON.stringify({ ...JSON.parse(texts.textContent), eo });
})"""
"""Gives a page that is served a third language, before its modules run."""
NAMES = re.compile("|".join(["Octet|ELIZA|English|Deutsch|Esperanto|mm/s|mm|ms", *PARAMETERS]))
"""What is called so in every language."""


def made_up(words: Any) -> Any:
    """Words in letters that no other language has."""
    if isinstance(words, str):
        wide = {letter: letter + 0xFEE0 for letter in range(ord("!"), ord("~") + 1)}
        return "".join(it if it.startswith("{") else it.translate(wide) for it in re.split(r"(\{\w+\})", words))
    return {k: made_up(v) for k, v in words.items()} if isinstance(words, dict) else [made_up(it) for it in words]


def third_language() -> dict[str, Any]:
    robot = {"sentences": SENTENCES, "patterns": PATTERNS, "sides": SIDES}
    parts = {part: {it: made_up(it) for it in GERMAN[part]} for part in ("heard", "refused")}
    return {**made_up({**ENGLISH, "robot": robot}), **parts, "language": "Esperanto"}


@pytest.fixture(scope="module")
def esperanto(tmp_path_factory) -> Iterator[Path]:
    """A folder for pages that have a third language, of which nothing is known but its file."""
    home = tmp_path_factory.mktemp("web")
    (home / "texts").mkdir()
    for code, words in {**languages(), "eo": third_language()}.items():
        (home / f"texts/{code}.json").write_text(json.dumps(words))
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(module, "TEXTS", home / "texts")
        octet("run", "--bus", "none", "--quiet", "--world", "small", "--out", home / "run")
        yield home


KEPT = {"run/replay.html": "window.octet?.scene?.state"}


def foreign(page: Page) -> set[str]:
    """What a page says in letters that its language does not have."""
    next_frame(page)
    return {it for it in page.evaluate(SEEN) if re.search("[A-Za-z]{2}", NAMES.sub("", it))}


@pytest.fixture(scope="module")
def third(esperanto: Path, open_shared: Callable[..., Page]) -> Page:
    (esperanto / "octet.html").write_text(octet_page())
    page = open_shared((esperanto / "octet.html").as_uri(), ready=READY, locale="eo", reduced_motion="reduce")
    settle(page)
    return page


@pytest.mark.parametrize("tab", ["run", "parameters", "listing", "program", "curves", "files", "talk", "lessons"])
def test_page_speaks_a_language_that_is_added_as_one_file(tab, third):
    third.click(f"#tab-{tab}")
    third.click("summary >> visible=true >> nth=-1")
    for tick in (0, 400, third.evaluate("octet.last")):
        go(third, tick)
        assert foreign(third) == set()


def test_errors_and_news_are_in_the_added_language(third):
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


def test_replay_speaks_the_added_language(esperanto, open_page):
    page = open_page((esperanto / "run/replay.html").as_uri(), locale="eo")
    for tick in (0, 400, page.evaluate("octet.last")):
        page.evaluate("tick => octet.go(tick)", tick)
        assert foreign(page) == set()

    page.click("#what-if")
    page.click("#after")
    assert foreign(page) == set()


def test_board_and_live_pages_speak_the_added_language(watch, hold_class, open_page):
    def speak(page: Page) -> None:
        lesson = f"{TEACH}({json.dumps(third_language())})"
        page.add_init_script(f"document.addEventListener('readystatechange', () => {lesson})")

    watched = watch("--listen", "127.0.0.1", "--robots", "2")
    board = open_page(hold_class()[1], BOARD_READY, speak, locale="eo")
    pages = [open_page(watched.url, "window.octet?.scene?.state", speak, locale="eo") for _ in range(3)]
    pages[0].evaluate("octet.send({ do: 'remove_bar', id: 99 })")
    pages[1].evaluate("octet.send({ do: 'put', at: [100, 100], heading: 0 })")
    pages[2].evaluate("octet.send({ do: 'erase', node: 9 })")
    for page in pages:
        wait_for(page, "document.querySelector('#note').textContent !== ''")

    assert [foreign(page) for page in (board, *pages)] == [set()] * 4


def test_axe_finds_nothing_in_german_on_a_phone_in_landscape(third, esperanto, watch, hold_class, open_page):
    watched = watch("--listen", "127.0.0.1", "--robots", "2")
    kept = [((esperanto / name).as_uri(), ready) for name, ready in KEPT.items()]
    served = [(hold_class()[1], BOARD_READY), (watched.url, "window.octet?.scene?.state")]
    for page in (third, *(open_page(url, ready) for url, ready in (*kept, *served))):
        page.select_option("#language", "de")
        assert violations_at(page, [(740, 360)]) == []


def test_language_changes_without_reloading_the_page(third):
    third.select_option("#language", "de")
    assert third.inner_text("#erase") == GERMAN["page"]["erase"]
    assert third.get_attribute("html", "lang") == "de"

    third.select_option("#language", "eo")
    assert foreign(third) == set()
