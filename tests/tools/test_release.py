"""tools/release names what a release lacks, in a checkout of its own with one fault each; and in this checkout.

Octet in other projects and in editors, as CMake and compile_commands.json offer it.
"""

import json
import os
import re
import shutil
import subprocess
from pathlib import Path
from types import ModuleType

import pytest

from tests.tools.project import ROOT, script_named

FILES = {
    "pyproject.toml": 'version = "2.1"\n',
    "CMakeLists.txt": "project(octet VERSION 2.1 LANGUAGES C)\n",
    "CITATION.cff": "version: 2.1\n",
    "CHANGELOG.md": "# Changelog\n\n## 2.1 - 2030-01-31\n",
    ".gitignore": "/build\n",
}


def git(folder: Path, *words: str) -> None:
    who = ("-c", "user.name=a", "-c", "user.email=a")
    subprocess.run(["git", *who, *words], cwd=folder, check=True, capture_output=True)


def write(folder: Path, name: str, text: str) -> None:
    (folder / name).parent.mkdir(parents=True, exist_ok=True)
    (folder / name).write_text(text)


@pytest.fixture
def checkout(tmp_path):
    """A checkout that can be released."""
    (tmp_path / "tools").mkdir()
    for name, text in FILES.items():
        write(tmp_path, name, text)
    shutil.copy(ROOT / "tools/release", tmp_path / "tools")
    write(tmp_path, "build/wheelhouse/octet_robot-2.1-py3-none-any.whl", "")
    git(tmp_path, "init", "-q")
    commit(tmp_path, "tools: add all")
    return tmp_path


def commit(folder: Path, subject: str) -> None:
    git(folder, "add", ".")
    git(folder, "commit", "-q", "--allow-empty", "-m", subject)


def missing(folder: Path) -> list[str]:
    done = subprocess.run(
        [folder / "tools/release", "--check"], capture_output=True, text=True, check=False, cwd=folder
    )
    lines = [line.removeprefix("missing ").strip() for line in done.stdout.splitlines() if line.startswith("missing")]
    assert done.returncode == bool(lines), done.stderr
    return lines


def test_releasable_checkout_lacks_nothing(checkout):
    assert missing(checkout) == []


@pytest.mark.parametrize(
    ("name", "text", "title"),
    [
        ("CMakeLists.txt", "project(octet VERSION 2.0 LANGUAGES C)\n", "one version everywhere"),
        ("CITATION.cff", "title: Octet\n", "one version everywhere"),
        ("CHANGELOG.md", "# Changelog\n\n## Unreleased\n\n## 2.1 - 2030-01-31\n", "CHANGELOG.md"),
        ("CHANGELOG.md", "# Changelog\n\n## 2.0 - 2030-01-31\n", "CHANGELOG.md"),
        ("pyproject.toml", 'version = "2.2"\n', "wheels"),
    ],
)
def test_file_with_another_version_is_found(checkout, name, text, title):
    write(checkout, name, text)
    commit(checkout, "tools: change one")

    assert title in missing(checkout)


@pytest.mark.parametrize("subject", ["Change something", "tools: " + "x" * 66, "Tools: change one"])
def test_malformed_commit_subject_is_found(checkout, subject):
    commit(checkout, subject)

    assert missing(checkout) == ["subjects of commits"]


def test_uncommitted_changes_and_an_existing_tag_are_found(checkout):
    git(checkout, "tag", "v2.1")
    write(checkout, "README.md", "more\n")

    assert missing(checkout) == ["no uncommitted changes", "no tag yet"]


def test_project_has_one_version_and_well_formed_subjects():
    assert {"one version everywhere", "subjects of commits"}.isdisjoint(missing(ROOT))


PAGE = (ROOT / "docs/porting.md").read_text()
LISTS = "cmake_minimum_required(VERSION 3.22)\nproject(foreign VERSION 1.0 LANGUAGES C)\n{how}\n"
FETCHED = f"""\
include(FetchContent)
FetchContent_Declare(octet SOURCE_DIR {ROOT})
FetchContent_MakeAvailable(octet)
"""
FOUND = "find_package(Octet 1.0 REQUIRED)\n"
PROGRAMS = """\
add_executable(whole whole.c)
target_link_libraries(whole PRIVATE Octet::core)
add_executable(decides decides.c)
target_link_libraries(decides PRIVATE Octet::brain)
"""
WHOLE = """\
#include <stdio.h>

#include "firmware/robot.h"

int main(void)
{
    struct input start = {.command = {.opcode = OPCODE_START, .which = PROFILE_FIXED}};
    struct senses senses = {.tick = 1, .feel = FEEL_FRONT};
    struct robot robot;
    struct output out;
    struct drive drive;

    robot_init(&robot, 1);
    robot_respond(&robot, INPUT_COMMAND, &start, &out);
    robot_step(&robot, &senses, &drive);
    printf("%d %d %d\\n", drive.reason == REASON_REMEMBERED, drive.left_mm_s < 0, drive.right_mm_s > 0);
    return 0;
}
"""
DECIDES = """\
#include <stdio.h>

#include "firmware/brain.h"

int main(void)
{
    struct senses senses = {.feel = FEEL_FRONT_LEFT};
    struct config config;
    struct brain brain = {.changed = false};

    config_reset(&config);
    (void)brain_start(&brain, PROFILE_FIXED, 1);
    printf("%d\\n", brain_next(&brain, &config, &senses).turn_deg);
    return 0;
}
"""


def cmake(*words: object, **kwargs) -> subprocess.CompletedProcess[str]:
    clean = {name: value for name, value in os.environ.items() if name not in ("CC", "CFLAGS", "LDFLAGS")}
    command = ["cmake", *map(str, words)]
    return subprocess.run(command, capture_output=True, text=True, check=False, **{"env": clean, **kwargs})


def outcome(folder: Path, how: str, *options: str) -> list[str]:
    """The output of two programs of a foreign project, one with the whole robot, one with only its brain."""
    (folder / "CMakeLists.txt").write_text(LISTS.format(how=how + PROGRAMS))
    (folder / "whole.c").write_text(WHOLE)
    (folder / "decides.c").write_text(DECIDES)
    made = folder / "build"
    for words in (("-G", "Ninja", "-S", folder, "-B", made, *options), ("--build", made)):
        done = cmake(*words)
        assert done.returncode == 0, done.stdout + done.stderr
    ran = [subprocess.run([made / it], capture_output=True, text=True, check=True) for it in ("whole", "decides")]
    return [it.stdout.strip() for it in ran]


RIGHT = ["1 1 1", "10"]
"""Blocked in front, the robot turns left; blocked front-left, the brain turns right by ten degrees."""


def test_foreign_project_fetches_the_robot(tmp_path):
    assert outcome(tmp_path, FETCHED) == RIGHT


def test_foreign_project_finds_the_installed_robot(tmp_path):
    (commands,) = re.findall(r"^```sh by-hand\n(cmake -B build/package .*?)^```$", PAGE, re.DOTALL | re.MULTILINE)
    prefix = tmp_path / "prefix"
    for line in commands.replace("build/package", str(tmp_path / "package")).splitlines():
        words = line.replace("/usr/local", str(prefix)).split()[1:]
        done = cmake(*words, cwd=ROOT)
        assert done.returncode == 0, done.stdout + done.stderr
    foreign = tmp_path / "foreign"
    foreign.mkdir()

    assert outcome(foreign, FOUND, f"-DCMAKE_PREFIX_PATH={prefix}") == RIGHT
    assert [
        str(path) for path in prefix.rglob("*") if path.is_file() and str(ROOT) in path.read_text("latin-1")
    ] == []


@pytest.mark.parametrize("how", [FETCHED + "add_subdirectory(none)\n", "find_package(Octet 2.0 REQUIRED)\n"])
def test_foreign_project_fails_on_a_missing_folder_or_version(tmp_path, how):
    with pytest.raises(AssertionError):
        outcome(tmp_path, how)


def test_build_tells_editors_how_it_compiles():
    entries = json.loads((ROOT / "build/host/compile_commands.json").read_text())

    assert {"robot.c", "exchange.c", "world.c"} <= {Path(entry["file"]).name for entry in entries}


def test_fresh_clone_says_to_run_setup_first(tmp_path):
    clone, programs = tmp_path / "a clone", tmp_path / "bin"
    subprocess.run(["git", "clone", "-q", "--shared", ROOT, clone], check=True)
    programs.mkdir()
    for name in ("cmake", "ninja", "gcc", "cc", "ld", "as", "ar", "ranlib", "nm", "env", "git"):
        found = subprocess.run(["which", name], capture_output=True, text=True, check=True).stdout.strip()
        (programs / name).symlink_to(found)

    done = cmake("--preset", "host", cwd=clone, env={"PATH": str(programs), "HOME": str(tmp_path)})

    assert done.returncode != 0
    assert "run tools/setup first" in " ".join(done.stderr.split())


def test_fresh_clone_with_its_venv_configures(tmp_path):
    clone = tmp_path / "a clone"
    subprocess.run(["git", "clone", "-q", "--shared", ROOT, clone], check=True)
    (clone / ".venv").symlink_to(ROOT / ".venv")

    done = cmake("--preset", "host", cwd=clone)

    assert done.returncode == 0, done.stderr
    assert (clone / "build/host/compile_commands.json").exists()


REQUIREMENTS = (ROOT / "docs/requirements.md").read_text()


@pytest.fixture
def script(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> ModuleType:
    """tools/requirements as a module, with a copy of the page."""
    module = script_named("requirements")
    monkeypatch.setattr(module, "PAGE", tmp_path / "requirements.md")
    monkeypatch.setattr("sys.argv", ["tools/requirements"])
    module.PAGE.write_text(REQUIREMENTS)
    return module


def test_requirements_have_no_gap(script, capsys):
    result = script.main()
    out, err = capsys.readouterr()

    assert (result, err) == (0, "")
    assert "    code  listing_step  firmware/behaviours/listing.c\n" in out


@pytest.mark.parametrize(
    ("before", "after", "complaint"),
    [
        ("`listing_step`", "`listing_stop`", "C1: there is no code listing_stop"),
        ("`test_clear_way_resets_the_repeat_count`", "`test_a`", "C1: there is no test test_a"),
        ("`test_clear_way_resets_the_repeat_count`", "`setUp`", "C1: there is no test setUp"),
        ("Code: `listing_step`.", "Code: .", "C1: names no code"),
        ("- **C2**", "- **C1**", "C1: 2 requirements have this name"),
        ("- **", "- ", "requirements.md has no requirement"),
    ],
)
def test_gap_in_the_requirements_is_named(script, capsys, before, after, complaint):
    assert before in REQUIREMENTS
    script.PAGE.write_text(REQUIREMENTS.replace(before, after))

    assert script.main() == 1
    assert complaint in capsys.readouterr().err.splitlines()


def test_requirement_without_a_test_is_named(script, capsys):
    item = REQUIREMENTS[REQUIREMENTS.index("- **C1**") :]
    tests = item[item.index("Tests:") : item.index("- **C2**")]
    script.PAGE.write_text(REQUIREMENTS.replace(tests, "\n"))

    assert script.main() == 1
    assert "C1: names no test" in capsys.readouterr().err.splitlines()


def test_call_and_declaration_are_no_definition(script, tmp_path):
    (tmp_path / "a.c").write_text("int one(void);\nint two(void)\n{\n    return one();\n}\n")

    assert script.functions(tmp_path, ["*.c"]).keys() == {"two"}


def test_c_test_is_a_definition(script, tmp_path):
    (tmp_path / "a.c").write_text("TEST(one)\n{\n}\nTEST_IF(two, is_pair)\n{\n    TEST_ASSERT(1);\n}\n")

    assert script.functions(tmp_path, ["*.c"]).keys() == {"test_one", "test_two"}
