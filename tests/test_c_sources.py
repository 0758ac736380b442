"""Every C source is part of a unit test, and no calls form a cycle of sources.

A test program calls it, directly or through what it calls. A library that a test is linked with does not count as a
whole: only those of its sources do that the test's own code leads to, from symbol to symbol. Without cycles, a reader
of one source does not have to read all of them at once.
"""

import json
import re
import subprocess
from collections import defaultdict
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
BUILD = ROOT / "build/host-vcan"
FOLDERS = ("firmware", "hal", "host_sim")

# Sources that cannot be part of a program on the host. The tests of images run the first.
NOT_ON_THE_HOST = {
    "hal/port/cortex_m/startup.c": "written in the core's own assembler, and in symbols of the linker script",
    "hal/pins_body/body_main.c": "a main of its own; tests/image/test_body_node.py runs it",
    "hal/rp2040/check_main.c": "a main of its own; tests/judges/test_check_wiring.py runs it",
    "hal/stm32/stm32g431/nmi.c": "written in the core's own assembler; what it calls is tested as flash_forgives",
    "hal/rp2040/boot2.c": "as above; tests/judges/test_pico.py runs it",
    "hal/rp2040/divide.c": "as above; tests/judges/test_pico.py runs it",
    "hal/rp2040/reset_chip.c": "it never ends; tests/judges/test_pico.py runs it",
    "hal/rp2040/rom.c": "it calls the boot ROM; tests/judges/test_pico.py runs it",
    "hal/port/cortex_m/build_id.c": "a text in the image, and no code",
    **{
        f"host_sim/program/own/{name}.c": "linked with a file of its user's; tests/sim/test_own_brain.py runs it"
        for name in ("guard", "undefined", "checked", "fast", "mine")
    },
    "host_sim/program/examples/wall_follower.c": "the same; tests/lab/study/test_own_behaviour.py runs it",
    "host_sim/program/own/image.c": "linked with a file of its user's; tests/image/test_own_image.py runs it",
    "host_sim/lab/grade/native/judge.c": "linked with a pupil's file; tests/lab/grade/test_grade.py runs it",
}


FOR_OTHERS = "/octet_brain.dir/"
"""The brain without the robot, for projects that ask for it; tests/tools/test_release.py builds it."""

PAGE_PARTS = ("commands", "layouts", "memory", "open", "program", "world")


@dataclass
class Object:
    """What the compiler makes of a source.

    Attributes:
        source: Its path from the root of the project.
        defined: The symbols that it has for others.
        needed: Those that it wants from others.
    """

    source: str
    defined: set[str] = field(default_factory=set)
    needed: set[str] = field(default_factory=set)


def output_of(*command: object) -> str:
    return subprocess.run([str(word) for word in command], capture_output=True, text=True, check=True).stdout


def sources_of_objects(build: Path) -> dict[str, str]:
    """For each object of a build, its source; both by their paths from build and project."""
    entries = json.loads(output_of("ninja", "-C", build, "-t", "compdb"))
    compiled = {entry["output"]: Path(entry["file"]) for entry in entries if entry["output"].endswith(".o")}
    compiled = {it: path for it, path in compiled.items() if FOR_OTHERS not in it}
    return {it: str(path.relative_to(ROOT)) for it, path in compiled.items() if path.is_relative_to(ROOT)}


def objects_of(build: Path, sources: Mapping[str, str]) -> dict[str, Object]:
    """The objects, by their paths, with the symbols that nm finds in them."""
    objects = {path: Object(source) for path, source in sources.items()}
    for line in output_of("nm", "-A", "-g", *(build / path for path in objects)).splitlines():
        path, _, symbol = line.rpartition(":")
        *_, kind, name = symbol.split()
        found = objects[str(Path(path).relative_to(build))]
        (found.needed if kind == "U" else found.defined).add(name)
    return objects


def linked_in(build: Path) -> dict[str, set[str]]:
    """For each program and library of a build, the objects and libraries that it is linked from."""
    rules = [line.rpartition(": ") for line in output_of("ninja", "-C", build, "-t", "targets", "all").splitlines()]
    targets = [path for path, _, rule in rules if "_LINKER" in rule]
    linked: dict[str, set[str]] = {}
    for line in output_of("ninja", "-C", build, "-t", "query", *targets).splitlines():
        if not line.startswith(" "):
            inputs = linked[line.removesuffix(":")] = set()
        elif line.startswith("  outputs:"):
            inputs = set()  # its outputs are of no interest
        elif line.startswith("    ") and "||" not in line:  # those are made before it, and no part of it
            inputs.add(line.split()[-1])
    return linked


def parts_of(target: str, linked: Mapping[str, set[str]]) -> set[str]:
    """All that a program is linked from, with what is in its libraries."""
    found: set[str] = set()
    waiting = [target]
    while waiting:
        it = waiting.pop()
        if it not in found:
            found.add(it)
            waiting += linked.get(it, ())
    return found


def led_to(objects: Iterable[Object]) -> set[str]:
    """The sources among these that the code of tests leads to; those of the tests, too."""
    makers: dict[str, list[Object]] = defaultdict(list)
    waiting = []
    for it in objects:
        if it.source.startswith("tests/"):
            waiting.append(it)
        for symbol in it.defined:
            makers[symbol].append(it)
    found: dict[int, Object] = {}  # not by source: one may be compiled twice, with other names
    while waiting:
        it = waiting.pop()
        if id(it) not in found:
            found[id(it)] = it
            waiting += [maker for symbol in it.needed for maker in makers[symbol]]
    return {it.source for it in found.values()}


def reach_of_programs(build: Path) -> dict[str, set[str]]:
    """For each test program the sources that it leads to."""
    objects = objects_of(build, sources_of_objects(build))
    linked = linked_in(build)
    programs = (it for it in linked if it.startswith("tests/"))
    return {it: led_to(objects[path] for path in parts_of(it, linked) if path in objects) for it in programs}


def missing(reach: Mapping[str, set[str]]) -> set[str]:
    """The sources that none of the programs leads to."""
    every = {str(path.relative_to(ROOT)) for folder in FOLDERS for path in (ROOT / folder).rglob("*.c")}
    return every.difference(*reach.values())


@pytest.fixture(scope="module")
def reach() -> dict[str, set[str]]:
    """For each test program as it is built, the sources that it leads to."""
    return reach_of_programs(BUILD)


def test_c_sources_are_tested_or_have_a_reason(reach):
    assert missing(reach) == set(NOT_ON_THE_HOST)


@pytest.mark.parametrize(
    ("without", "named"),
    [
        ("tests/emulator/", {"core_blocks.c", "register_space.c", "board_clock.c"}),
        ("tests/web/", {f"page_{part}.c" for part in PAGE_PARTS}),
        ("tests/hal/stm32/test_pins", {"gpio.c", "pins.c"}),
    ],
)
def test_source_whose_tests_are_left_out_is_named(reach, without, named):
    fewer = {program: sources for program, sources in reach.items() if not program.startswith(without)}

    assert {Path(path).name for path in missing(fewer) - set(NOT_ON_THE_HOST)} == named


def test_library_counts_only_as_far_as_tests_reach():
    objects = [
        Object("tests/test_a.c", set(), {"a"}),
        Object("hal/a.c", {"a"}, {"b"}),
        Object("hal/b.c", {"b"}, set()),
        Object("hal/c.c", {"c"}, {"a"}),
    ]

    assert led_to(objects) == {"tests/test_a.c", "hal/a.c", "hal/b.c"}


def calls(objects: Iterable[Object]) -> dict[str, set[str]]:
    """For each source of the product the others that it calls; what several of them define may be any of them."""
    product = [it for it in objects if it.source.startswith(FOLDERS)]
    makers: dict[str, set[str]] = defaultdict(set)
    for it in product:
        for symbol in it.defined:
            makers[symbol].add(it.source)
    called: dict[str, set[str]] = defaultdict(set)
    for it in product:
        for symbol in it.needed:
            if len(makers[symbol]) == 1:
                called[it.source] |= makers[symbol] - {it.source}
    return called


def reached(called: Mapping[str, set[str]], source: str) -> set[str]:
    """All that a source calls, directly or not."""
    found: set[str] = set()
    waiting = [source]
    while waiting:
        new = called.get(waiting.pop(), set()) - found
        found |= new
        waiting += new
    return found


def in_rings(called: Mapping[str, set[str]]) -> set[str]:
    """The sources that call themselves through others."""
    return {source for source in called if source in reached(called, source)}


@pytest.fixture(scope="module")
def objects() -> list[Object]:
    return list(objects_of(BUILD, sources_of_objects(BUILD)).values())


def test_c_sources_call_each_other_without_cycles(objects):
    assert in_rings(calls(objects)) == set()


@pytest.mark.parametrize(
    ("low", "symbol", "ring"),
    [
        ("page_commands.c", "page_open", {"page_open.c", "page_commands.c"}),
        ("layout.c", "layouts_draw", {"layout.c", "layouts.c", "draw.c", "written.c"}),
    ],
)
def test_call_that_closes_a_cycle_is_found(objects, low, symbol, ring):
    planted = next(Object(it.source, set(), {symbol}) for it in objects if it.source.endswith(f"/{low}"))

    found = {source.rpartition("/")[2] for source in in_rings(calls([*objects, planted]))}

    assert found >= ring


def sanitizer_flags() -> list[str]:
    """What gcc builds the C tests with."""
    options = re.findall(r"add_compile_options\((.*)\)", (ROOT / "tools/cmake/sanitizers.cmake").read_text())
    return " ".join(options).split()


CRASHES = {
    "heap-buffer-overflow": "char *bytes = calloc(8, 1); int result = bytes[7 + argc]; free(bytes);",
    "heap-use-after-free": "char *bytes = malloc(8); free(bytes); int result = bytes[argc];",
    "signed integer overflow": "int result = INT_MAX; result += argc;",
    "shift exponent": "int result = 1 << (31 + argc);",
}


def run_sanitized(folder: Path, body: str) -> subprocess.CompletedProcess[str]:
    source = folder / "canary.c"
    source.write_text(
        "#include <limits.h>\n#include <stdlib.h>\n"
        f"int main(int argc, char *argv[]) {{ (void)argv; {body} return result == 42; }}\n"
    )
    program = folder / "canary"
    subprocess.run(["gcc", "-std=c99", *sanitizer_flags(), "-o", program, source], check=True)
    return subprocess.run([program], capture_output=True, text=True, check=False)


@pytest.mark.parametrize("error", CRASHES)
def test_sanitizers_end_a_faulty_program(tmp_path, error):
    ended = run_sanitized(tmp_path, CRASHES[error])

    assert ended.returncode != 0
    assert error in ended.stderr


def test_sanitizers_let_a_sound_program_finish(tmp_path):
    assert run_sanitized(tmp_path, "char *bytes = calloc(8, 1); int result = bytes[7]; free(bytes);").returncode == 0
