"""The documents are right: named files exist, quoted lines are in the code, and each protection has its test.

docs/bench.md: its device of thirty lines works, and its commands end as it says.
"""

import os
import re
import subprocess
import sys
import textwrap
from pathlib import Path

import pytest
from PIL import Image

from host_sim.report.protocol_page import page

ROOT = Path(__file__).resolve().parents[2]
PAGES = sorted([*ROOT.glob("*.md"), *ROOT.glob("docs/*.md"), *ROOT.glob(".github/*.md")])
IDS = [path.name for path in PAGES]


@pytest.mark.parametrize("path", PAGES, ids=IDS)
def test_files_named_in_a_document_exist(path):
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
def test_anchors_named_in_a_document_exist(path):
    links = re.findall(r"\]\(([^)#\s]*)#([^)]+)\)", path.read_text())
    targets = [(path.parent / file if file else path, anchor) for file, anchor in links]

    missing = [f"{file}#{anchor}" for file, anchor in targets if file.suffix == ".md" and anchor not in anchors(file)]

    assert missing == []


def test_missing_anchor_is_detected():
    assert "a-conversation" in anchors(ROOT / "docs/protocol.md")
    assert "a-conversasion" not in anchors(ROOT / "docs/protocol.md")


def reached(page: Path, steps: int) -> set[Path]:
    """The pages that a reader of a page reaches in some steps."""
    links = {(page.parent / link).resolve() for link in re.findall(r"\]\((?!https?:)([^)#]+\.md)", page.read_text())}
    return links.union(*(reached(link, steps - 1) for link in links)) if steps > 1 else links


def test_readme_reaches_all_of_at_most_22_pages_in_two_steps():
    pages = {*ROOT.glob("docs/*.md")}

    assert len(pages) <= 22
    assert pages - reached(ROOT / "README.md", 2) == set()
    assert ROOT / "docs/protocol.md" not in reached(ROOT / "THIRD-PARTY.md", 2)


@pytest.mark.parametrize("path", sorted(ROOT.glob("docs/*.md")), ids=lambda path: path.name)
def test_first_sentence_of_a_page_says_whom_it_is_for(path):
    _, first, *_ = path.read_text().split("\n\n")

    assert first.startswith("For ")


def test_readme_is_short_and_shows_a_picture_for_each_of_three_paths():
    text = (ROOT / "README.md").read_text()
    section = text.partition("## Three paths")[2].partition("\n## ")[0]
    _, *paths = re.split(r"^\*\*(?=\w)", section, flags=re.MULTILINE)

    assert text.count("\n") <= 120
    assert [len(re.findall(r"^!\[.+\]\(.+\)$", path, re.MULTILINE)) for path in paths] == [1, 1, 1]


def test_lines_of_c_in_the_article_page_are_in_the_named_files():
    rows = re.findall(r"^\| .*? \| `([^`]+)` \| `([\w/.]+)`", (ROOT / "docs/article.md").read_text(), re.MULTILINE)

    wrong = [(line, file) for line, file in rows if line not in (ROOT / file).read_text()]

    assert len(rows) > 15
    assert wrong == []


def test_protocol_page_is_up_to_date_with_the_dbc():
    assert (ROOT / "docs/protocol.md").read_text() == page(), "make it anew: it says how"


def test_documents_name_no_path_of_this_machine():
    places = (f"{ROOT}/", f"{Path.home()}/")

    assert [path.name for path in PAGES if any(place in path.read_text() for place in places)] == []


SESSIONS = (ROOT / "docs/sessions.md").read_text()
NAMED = re.compile(r"`(tests/[\w/]+\.(?:py|c))::(test_\w+)`")


@pytest.mark.parametrize(("head", "at_least"), [("| what happens |", 15), ("| threat |", 20)])
def test_session_faults_and_threats_name_existing_tests(head, at_least):
    (table,) = [block for block in SESSIONS.split("\n\n") if block.startswith(head)]
    rows = table.splitlines()[2:]

    assert len(rows) > at_least
    for row in rows:
        ((path, name),) = NAMED.findall(row)
        defined = rf"^(def {name}\(|TEST\({name.removeprefix('test_')}\))"
        assert re.search(defined, (ROOT / path).read_text(), re.MULTILINE), row


def test_readme_links_to_what_is_not_protected():
    assert "docs/sessions.md#what-is-not-protected" in (ROOT / "README.md").read_text()


def test_preview_has_1280_by_640_pixels_and_less_than_200_kb():
    preview = ROOT / ".github/preview.png"

    with Image.open(preview) as image:
        assert image.size == (1280, 640)
    assert preview.stat().st_size < 200_000


PAGE = (ROOT / "docs/bench.md").read_text()
FILES = {
    name: textwrap.dedent(text)
    for name, text in re.findall(r"^ *```\w+ ([\w.]+\.\w+)\n(.*?)^ *```$", PAGE, re.DOTALL | re.MULTILINE)
}
(COMMANDS,) = re.findall(r"^```sh on-the-bench\n(.*?)^```$", PAGE, re.DOTALL | re.MULTILINE)


def run_pytest(folder, *words):
    environment = {**os.environ, "PYTHONPATH": str(ROOT), "PYTEST_ADDOPTS": ""}
    command = [sys.executable, "-m", "pytest", "-p", "no:cacheprovider", "-p", "tools.pytest_canbench.plugin", *words]
    return subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True, check=False)


@pytest.fixture
def folder(tmp_path):
    for name, text in FILES.items():
        (tmp_path / name).write_text(text)
    return tmp_path


def test_fan_of_the_bench_page_passes_and_takes_thirty_lines(folder):
    written = "".join(text for name, text in FILES.items() if name != "fan.dbc")

    assert run_pytest(folder).returncode == 0
    assert sorted(FILES) == ["fan.c", "fan.dbc", "pytest.ini", "test_fan.py"]
    assert len([line for line in written.splitlines() if line]) <= 30


def test_fan_that_does_not_cool_fails(folder):
    (folder / "fan.c").write_text(FILES["fan.c"].replace("duty = 100;", ""))

    assert run_pytest(folder).returncode == 1


def test_commands_of_the_bench_page_end_as_it_says():
    venv, pip, *tests = COMMANDS.splitlines()

    done = [run_pytest(ROOT, *line.split()[1:]) for line in tests]

    assert (venv, pip.split()[-1]) == ("python3 -m venv build/bench", "./tools/pytest_canbench")
    assert [it.returncode for it in done] == [0, 0, 1]
    assert (ROOT / pip.split()[-1] / "pyproject.toml").exists()


def test_options_and_methods_named_on_the_bench_page_exist():
    from tools.pytest_canbench.bench import Bench  # noqa: PLC0415 - what the page is about
    from tools.pytest_canbench.devices import ImageDevice  # noqa: PLC0415 - see above

    helped = run_pytest(ROOT, "--help").stdout
    options = re.findall(r"`(--can-[a-z]+)", PAGE)
    methods = re.findall(r"`(?:can_bench\.)?([a-z_]+)\(", PAGE.partition("of the fixture")[2])
    of_devices = re.findall(r"`device\.([a-z_]+)", PAGE)

    assert len(set(options)) == 7
    assert [option for option in options if option not in helped] == []
    assert [name for name in methods if not hasattr(Bench, name)] == []
    assert [name for name in of_devices if not hasattr(ImageDevice, name)] == []
