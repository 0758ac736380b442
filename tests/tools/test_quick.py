"""tools/test --quick: the tests that a change selects."""

import re
import subprocess
import sys
from argparse import Namespace
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT))

from tools.testing import affected, quick, stage_paths  # noqa: E402 - found by the line above

FILES = {
    "host_sim/world/near.py": "X = 1\n",
    "host_sim/world/far.py": "from host_sim.world.near import X\n",
    "host_sim/world/lonely.py": "",
    "tests/world/test_far.py": "from host_sim.world import far\n",
    "tests/world/test_lonely_things.py": "",
    "tests/runs/test_far_runs.py": "import tests.world.test_far\n",
    "host_sim/web/core/storage.ts": "",
    "host_sim/web/core/model.ts": "",
    "host_sim/web/core/alone.ts": "",
    "host_sim/web/core/app.ts": 'import { kept } from "./storage.js";\nimport type { Model } from "./model.js";\n',
    "host_sim/web/head.html": '<link rel="stylesheet" href="style.css">\n',
    "host_sim/web/page.html": '{head.html}<script src="app.js"></script>\n',
    "host_sim/web/style.css": "",
    "host_sim/web/texts/de.json": "{}",
    "host_sim/report/page.py": 'PAGE, WORDS = "page.html", WEB / "texts"\n',
    "tests/web/test_page.py": "from host_sim.report import page\n",
    "tests/docs/test_links.py": "",
    "docs/words.md": "",
    "tests/tools/test_words.py": 'WORDS = ROOT / "tools/words"\n',
    "tests/tools/test_wordsmith.py": 'WORDS = ROOT / "tools/wordsmith"\n',
}
BUILD = """\
build lib.o: C_COMPILER__lib_Debug {source}/hal/lib.c || order
build liball.a: C_STATIC_LIBRARY_LINKER__all_Debug lib.o
build tests/test_one: C_EXECUTABLE_LINKER__one_Debug one.o | liball.a || order
build one.o: C_COMPILER__one_Debug {source}/tests/test_one.c
build made.h | ${{cmake_ninja_workdir}}made.h: CUSTOM_COMMAND {source}/hal/bus.dbc
build tests/test_two: C_EXECUTABLE_LINKER__two_Debug two.o
build two.o: C_COMPILER__two_Debug {source}/tests/test_two.c
"""


@pytest.fixture
def project(tmp_path: Path) -> Path:
    for name, text in FILES.items():
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text(text)
    return tmp_path


def found_for(project: Path, changed: str) -> tuple[set[str], int]:
    found, farther = quick.python_tests(project, [changed])
    return found[changed], farther


def test_changed_module_selects_its_nearest_tests_and_counts_the_others(project):
    assert found_for(project, "host_sim/world/near.py") == ({"tests/world/test_far.py"}, 1)


def test_module_that_nobody_imports_selects_the_tests_of_its_name(project):
    assert found_for(project, "host_sim/world/lonely.py") == ({"tests/world/test_lonely_things.py"}, 0)


def test_changed_test_selects_itself(project):
    found, _ = found_for(project, "tests/runs/test_far_runs.py")

    assert found == {"tests/runs/test_far_runs.py"}


def test_changed_file_selects_only_tests_that_name_exactly_it(project):
    assert found_for(project, "tools/words") == ({"tests/tools/test_words.py"}, 0)


@pytest.mark.parametrize("changed", ["core/storage.ts", "core/model.ts", "texts/de.json", "style.css"])
def test_source_of_a_page_selects_the_tests_of_the_page(project, changed):
    assert found_for(project, f"host_sim/web/{changed}") == ({"tests/web/test_page.py"}, 0)


def test_file_of_no_page_selects_no_test_of_a_page(project):
    assert found_for(project, "host_sim/web/core/alone.ts") == (set(), 0)


def test_document_selects_the_tests_of_the_documents(project):
    assert found_for(project, "docs/words.md") == ({"tests/docs/test_links.py"}, 0)


@pytest.mark.parametrize(
    ("path", "tests", "of_c", "is_named"),
    [
        ("host_sim/world/alone.py", (), (), True),
        ("host_sim/world/alone.py", ("tests/world/test_alone.py",), (), False),
        ("host_sim/web/alone.ts", (), (), True),
        ("hal/link/alone.c", (), (), True),
        ("hal/link/slcan.c", (), ("hal/link/slcan.c",), False),
        ("tools/words", (), (), True),
        ("LICENSE", (), (), False),
    ],
)
def test_changed_code_without_a_test_is_named(path, tests, of_c, is_named):
    assert quick.untested({path: set(tests)}, set(of_c)) == [path] * is_named


def test_changed_code_without_a_test_ends_with_exit_code_1(monkeypatch, capsys):
    monkeypatch.setattr(quick, "changed_files", lambda _root: ["host_sim/alone.ts"])
    monkeypatch.setattr(quick, "python_tests", lambda _root, _changed: ({"host_sim/alone.ts": set()}, 0))
    monkeypatch.setattr(quick, "run_stages", lambda _stages, _arguments: 0)

    code = quick.run(Namespace(allow_missing=[]))

    assert code == 1
    assert "no test is known for host_sim/alone.ts\n" in capsys.readouterr().out


def test_new_and_changed_files_count_as_changed(project):
    for words in ("init -q", "add tests", "-c user.name=a -c user.email=a commit -qm a"):
        subprocess.run(["git", *words.split()], cwd=project, check=True)
    (project / "tests/world/test_far.py").write_text("")
    (project / "tests/tools/test_words.py").unlink()

    new = sorted(path for path in FILES if not path.startswith("tests"))
    assert quick.changed_files(project) == ["tests/world/test_far.py", *new]


@pytest.mark.parametrize(
    ("changed", "tests"),
    [
        ("hal/lib.c", ["one"]),
        ("tests/test_two.c", ["two"]),
        ("hal/lib.h", ["one"]),
        ("hal/bus.dbc", ["one"]),
        ("hal/other.c", []),
    ],
)
@pytest.mark.parametrize("name", ["here", "in a folder"])
def test_c_source_selects_the_tests_built_from_it(name, changed, tests, tmp_path, monkeypatch):
    build = tmp_path / name / "build/host-san"
    build.mkdir(parents=True)
    source = tmp_path / name
    (build / "build.ninja").write_text(BUILD.format(source=str(source).replace(" ", "$ ")))
    noted = f"lib.o: #deps 3, deps mtime 1 (VALID)\n    {source}/hal/lib.c\n    {source}/hal/lib.h\n"
    noted += f"    {build}/made.h\n\n"
    monkeypatch.setattr(affected, "_noted_deps", lambda _: noted)

    assert affected.c_tests(build, [changed]) == tests


@pytest.mark.parametrize(("test", "is_one"), [("slcan", True), ("link_contract_fd", True), ("slcan_decoder2", False)])
def test_selection_matches_all_tests_of_a_program(test, is_one):
    assert bool(re.search(quick.selection(["slcan", "link_contract"]), test)) == is_one


@pytest.mark.parametrize("changed", ["hal/protocol/octet.dbc", "hal/protocol/robot.toml", "hal/link/slcan.c"])
def test_source_of_c_code_selects_the_c_stage(changed, monkeypatch):
    monkeypatch.setattr(quick, "set_up", lambda stages: stages)
    monkeypatch.setattr(affected, "c_tests", lambda _build, _changed: ["one"])

    assert [stage.name for stage in quick._c_stage([changed])[0]] == ["c"]


@pytest.mark.parametrize(
    ("name", "test", "is_one"),
    [
        ("web", "tests/web/lab/test_lab.py", True),
        ("web", "tests/web/test_browsers.py", False),
        ("studies", "tests/lab/study/test_study.py", True),
        ("studies", "tests/lab/study/test_emulated_board.py", False),
        ("studies", "tests/web/test_types.py", False),
    ],
)
def test_stage_has_the_tests_of_its_folders_that_no_other_stage_names(name, test, is_one):
    assert stage_paths.is_of(name, test) == is_one
