"""What the documents say is so: files exist, quotations stand in the code, each protection has its test."""

import re
from pathlib import Path

import pytest

from host_sim.report.protocol_page import page

ROOT = Path(__file__).resolve().parents[2]
PAGES = sorted([*ROOT.glob("*.md"), *ROOT.glob("docs/*.md")])
IDS = [path.name for path in PAGES]


@pytest.mark.parametrize("path", PAGES, ids=IDS)
def test_every_file_that_a_document_names_exists(path):
    text = path.read_text()
    linked = [path.parent / link for link in re.findall(r"\]\((?!https?:|#)([^)#]+)", text)]
    named = re.findall(r"`((?:firmware|hal|host_sim|tests|tools|docs|\.ci)/[\w./-]+)`", text)

    missing = [str(file) for file in [*linked, *(ROOT / name for name in named)] if not file.exists()]

    assert missing == []


def anchors(path: Path) -> set[str]:
    """The anchors of a page's headings."""
    headings = re.findall(r"^#+ (.*)$", re.sub(r"^```.*?^```", "", path.read_text(), flags=re.DOTALL | re.M), re.M)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


@pytest.mark.parametrize("path", PAGES, ids=IDS)
def test_every_anchor_that_a_document_names_exists(path):
    links = re.findall(r"\]\(([^)#\s]*)#([^)]+)\)", path.read_text())
    targets = [(path.parent / file if file else path, anchor) for file, anchor in links]

    missing = [f"{file}#{anchor}" for file, anchor in targets if file.suffix == ".md" and anchor not in anchors(file)]

    assert missing == []


def test_an_anchor_that_does_not_exist_is_noticed():
    assert "a-conversation" in anchors(ROOT / "docs/protocol.md")
    assert "a-conversasion" not in anchors(ROOT / "docs/protocol.md")


def reached(page: Path, steps: int) -> set[Path]:
    """The pages that a reader of a page reaches in some steps."""
    links = {(page.parent / link).resolve() for link in re.findall(r"\]\((?!https?:)([^)#]+\.md)", page.read_text())}
    return links.union(*(reached(link, steps - 1) for link in links)) if steps > 1 else links


def test_there_are_few_pages_and_each_is_reached_from_the_readme_in_two_steps():
    pages = {*ROOT.glob("docs/*.md")}

    assert len(pages) <= 22
    assert pages - reached(ROOT / "README.md", 2) == set()
    assert ROOT / "docs/protocol.md" not in reached(ROOT / "THIRD-PARTY.md", 2)


def test_every_line_of_c_in_the_article_stands_in_the_file_named():
    rows = re.findall(r"^\| .*? \| `([^`]+)` \| `([\w/.]+)`", (ROOT / "docs/article.md").read_text(), re.MULTILINE)

    wrong = [(line, file) for line, file in rows if line not in (ROOT / file).read_text()]

    assert len(rows) > 15
    assert wrong == []


def test_the_page_about_the_wire_is_that_of_the_dbc():
    assert (ROOT / "docs/protocol.md").read_text() == page(), "make it anew: it says how"


def test_no_document_is_for_one_machine_only():
    places = (f"{ROOT}/", f"{Path.home()}/")

    assert [path.name for path in PAGES if any(place in path.read_text() for place in places)] == []


SESSIONS = (ROOT / "docs/sessions.md").read_text()
NAMED = re.compile(r"`(tests/[\w/]+\.(?:py|c))::(test_\w+)`")


@pytest.mark.parametrize(("head", "at_least"), [("| what happens |", 15), ("| threat |", 20)])
def test_each_fault_and_each_threat_of_a_session_names_a_test_that_exists(head, at_least):
    (table,) = [block for block in SESSIONS.split("\n\n") if block.startswith(head)]
    rows = table.splitlines()[2:]

    assert len(rows) > at_least
    for row in rows:
        ((path, name),) = NAMED.findall(row)
        defined = rf"^(def {name}\(|TEST\({name.removeprefix('test_')}\))"
        assert re.search(defined, (ROOT / path).read_text(), re.MULTILINE), row


def test_the_readme_leads_to_what_is_not_protected():
    assert "docs/sessions.md#what-is-not-protected" in (ROOT / "README.md").read_text()
