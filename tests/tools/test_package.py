"""Octet in other projects, and in editors: CMake, which nobody here wrote, finds what it needs."""

import json
import os
import re
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
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
    """What two programs of a foreign project print, one with the whole robot, one with only its brain."""
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


def test_a_project_fetches_the_robot(tmp_path):
    assert outcome(tmp_path, FETCHED) == RIGHT


def test_a_project_finds_the_installed_robot(tmp_path):
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
def test_what_is_not_there_is_not_found(tmp_path, how):
    with pytest.raises(AssertionError):
        outcome(tmp_path, how)


def test_each_build_tells_editors_how_it_compiles():
    entries = json.loads((ROOT / "build/host/compile_commands.json").read_text())

    assert {"robot.c", "exchange.c", "world.c"} <= {Path(entry["file"]).name for entry in entries}


def test_a_fresh_clone_says_what_to_run_first(tmp_path):
    clone, programs = tmp_path / "a clone", tmp_path / "bin"
    subprocess.run(["git", "clone", "-q", "--shared", ROOT, clone], check=True)
    programs.mkdir()
    for name in ("cmake", "ninja", "gcc", "cc", "ld", "as", "ar", "ranlib", "nm", "env", "git"):
        found = subprocess.run(["which", name], capture_output=True, text=True, check=True).stdout.strip()
        (programs / name).symlink_to(found)

    done = cmake("--preset", "host", cwd=clone, env={"PATH": str(programs), "HOME": str(tmp_path)})

    assert done.returncode != 0
    assert "run tools/setup first" in " ".join(done.stderr.split())


def test_with_its_environment_a_fresh_clone_configures(tmp_path):
    clone = tmp_path / "a clone"
    subprocess.run(["git", "clone", "-q", "--shared", ROOT, clone], check=True)
    (clone / ".venv").symlink_to(ROOT / ".venv")

    done = cmake("--preset", "host", cwd=clone)

    assert done.returncode == 0, done.stderr
    assert (clone / "build/host/compile_commands.json").exists()
