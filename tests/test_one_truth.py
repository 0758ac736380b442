"""No number, word or rule of the robot is written twice: beside octet.dbc and robot.toml, or in two languages.

Three ways of copying a number or a word are found: a constant with the name of a word that is given a number, an enum
of the robot's that is written out, and the name of a pattern in a string. Tests may name the numbers that they
expect; what helps several tests may not.
"""

import re
import subprocess
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path

import pytest

from tests.runs.support import ROOT
from tools.robot_words.model import read

ROBOT = read(ROOT / "hal/protocol/octet.dbc", ROOT / "hal/protocol/robot.toml")
FOLDERS = ("firmware", "hal", "host_sim", "tests", "tools")
SUFFIXES = {".c", ".h", ".py", ".ts", ".html", ""}
NOT_SCANNED = (
    "host_sim/protocol/generated.py",
    "host_sim/web/generated.ts",
    "tests/firmware/oracles/",  # an independent implementation has numbers of its own
    "tools/robot_words/",  # the generators
)


def either(words: Iterable[str]) -> str:
    """A pattern for any of the words, in capitals."""
    return "|".join(sorted((word.upper() for word in words), key=len, reverse=True))


PLAIN = either(
    (*ROBOT.enums["reason"], *ROBOT.enums["side"], *(p.name for p in ROBOT.parameters), *ROBOT.numbers, "tick_mask")
)
# The words of commands and behaviours mean much else besides.
PREFIXED = "|".join(
    f"{name.upper()}_(?:{either(words)})" for name, words in {**ROBOT.enums, "profile": ROBOT.profiles}.items()
)
CONSTANT = f"(?:{PREFIXED}|(?:TURN_)?(?:{PLAIN}))"
# Words that mean nothing else, in any spelling; left and right are also wheels.
TELLING = "|".join(word for name in ("reason", "result") for word in ROBOT.enums[name] if "_" in word)
CAMEL = "|".join(re.sub(r"_(\w)", lambda match: match[1].upper(), word) for word in TELLING.split("|"))
COPIES = {
    "a constant with a number": re.compile(
        rf"\b_?{CONSTANT}\b\]?(?::[^=\n]*=|\s*=|:)\s*(?!\{{0\}})\{{?-?\d",  # but an array may begin as zeros
        re.ASCII,
    ),
    "several constants with numbers": re.compile(
        rf"^\s*(?:\w+, )*_?{CONSTANT}(?:, \w+)+ = \d", re.ASCII | re.MULTILINE
    ),
    "a table with a number": re.compile(rf"\b[\"']?(?:{TELLING}|{CAMEL})[\"']?\s*:\s*\d"),
    "an enum of the robot's": re.compile(rf"\benum (?:{'|'.join([*ROBOT.enums, 'parameter', 'profile'])})\s*\{{"),
    "the name of a pattern": re.compile(
        "|".join(f"[\"'`]{re.escape(name)}[\"'`]" for name in ROBOT.patterns if " " in name)
    ),
    "several sensors' names": re.compile(r"[\"']front-(?:left|right)[\"'],\s*[\"']front"),
}


def copies_in(text: str) -> list[str]:
    """The copies in a text, each with its kind."""
    return [f"{what}: {match[0].strip()}" for what, pattern in COPIES.items() for match in pattern.finditer(text)]


def scanned() -> Iterator[Path]:
    """All files in which nothing may be copied."""
    for folder in FOLDERS:
        for path in sorted((ROOT / folder).rglob("*")):
            name = path.relative_to(ROOT).as_posix()
            is_source = path.is_file() and path.suffix in SUFFIXES and "__pycache__" not in path.parts
            is_test = folder == "tests" and path.name.startswith("test_")
            if is_source and not is_test and not name.startswith(NOT_SCANNED):
                yield path


def test_words_and_numbers_of_the_robot_are_not_copied_by_hand():
    paths = list(scanned())
    copies = {str(path.relative_to(ROOT)): copies_in(path.read_text()) for path in paths}

    assert len(paths) > 200
    assert {name: found for name, found in copies.items() if found} == {}


CANARIES = {
    "a reason in C": "enum { REASON_TRIAL = 5 };",
    "a reason in Python": "_REMEMBERED = 4",
    "a typed reason in Python": "TRIAL: Final = 5",
    "some reasons in Python": "WANDER, TOWARD_FOOD = 1, 2",
    "sides in Python": "_LEFT, _RIGHT = 1, 2",
    "reasons in JavaScript": "export const REASON = { stop: 0, towardFood: 2 };",
    "a reason in a Python table": 'NAMES = {"look_around": 3}',
    "a side in JavaScript": "const LEFT = 1;",
    "an opcode in C": "#define X 1\nstatic const int OPCODE_START = 2;",
    "a result in Python": "RESULT_DONE = 0",
    "a parameter's default in C": "static const uint8_t d[] = {[BOREDOM_LIMIT] = 10};",
    "a parameter's range in C": "static const struct range r[] = {[TURN_DEG] = {1, 180}};",
    "a parameter in Python": "TURN_DEG = 10",
    "how many cells there are": "CELL_COUNT = 8",
    "how ticks wrap": "_TICK_MASK = 4095",
    "an identifier": "UPDATE_REQUEST_ID = 0x6E0",
    "an enum": "enum side { A, B };",
    "a pattern's name": 'x = "front and front-right"',
    "sensors' names": 'x = ("front-right", "front")',
}


@pytest.mark.parametrize("text", CANARIES.values(), ids=CANARIES)
def test_copy_by_hand_is_found(text):
    assert copies_in(text)


FINE = {
    "a name used": "if (reason == REASON_TRIAL) x = 1;",
    "a name from a name": "TRIAL = Reason.TRIAL",
    "wheels": 'signals = {"left": -251, "right": 251}; left = 0; right: 0',
    "a setting": 'settings = {"boredom_limit": 5}',
    "a sentence": "nothing in the way; 1 left",
    "a use of an enum": "enum side side = SIDE_LEFT;",
    "a choice": "last = many ? NODE_MAX : 0;",
}


@pytest.mark.parametrize("text", FINE.values(), ids=FINE)
def test_use_of_a_word_is_not_taken_for_a_copy(text):
    assert copies_in(text) == []


TWIN = re.compile(
    r"\bas [\w/]+\.(?:c|h|ts|py) has (?:it|them)\b|\.(?:c|h|ts|py)`? has the same\b"
    r"|\bas (?:in )?`?[\w/]+\.(?P<suffix>c|h|ts|py)\b",
    re.IGNORECASE,
)
SOURCES = ("firmware/*.[ch]", "hal/*.[ch]", "host_sim/*.[ch]", "host_sim/*.py", "host_sim/*.ts")
LANGUAGES = {"c": "C", "h": "C", "ts": "TypeScript", "py": "Python"}

TWINS = {
    "host_sim/sim/native/fleet.c": "tests/lab/study/test_trial.py",
    "host_sim/sim/native/log_lines.h": "tests/sim/test_native_equality.py",
    "host_sim/web/lab/files.ts": "tests/web/sim/test_page_opening.py",
    "host_sim/web/native/page_open.c": "tests/web/sim/test_page_runs.py",
    "host_sim/web/talk/eliza.ts": "tests/web/talk/test_same_answers.py",
    "host_sim/web/talk/facts.ts": "tests/web/talk/test_same_answers.py",
}
"""Code that still exists in two languages: each with the test that compares the results of both."""


def twins(texts: Mapping[str, str]) -> set[str]:
    """The files whose comments name a twin in another language; line breaks do not matter."""
    return {file for file, text in texts.items() if _is_twin(file, " ".join(text.replace("*", " ").split()))}


def _is_twin(file: str, text: str) -> bool:
    language = LANGUAGES[file.rpartition(".")[2]]
    return any(LANGUAGES.get(found["suffix"]) != language for found in TWIN.finditer(text))


@pytest.fixture(scope="module")
def texts() -> dict[str, str]:
    command = ("git", "ls-files", "-z", "--cached", "--others", "--exclude-standard", *SOURCES)
    files = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True).stdout.split("\0")[:-1]
    return {file: (ROOT / file).read_text() for file in files if (ROOT / file).exists()}


def test_only_listed_files_say_to_be_a_twin(texts):
    assert len(texts) > 500
    assert twins(texts) == set(TWINS)
    assert all((ROOT / test).exists() for test in TWINS.values())


@pytest.mark.parametrize(
    "comment",
    [
        "/* Ranges: as host_sim/world/ranges.py has them. */",
        "// as host_sim/sim/loop.c\n// * has it",
        "The firmware's `memory.c` has the same rules.",
        "/* As in host_sim/world/change_effects.py. */",
    ],
)
def test_comment_that_names_a_twin_is_found(comment):
    assert twins({"one.ts": comment.replace("//", "*"), "other.ts": "/* As in the article. */"}) == {"one.ts"}


READS = {
    ".c": re.compile(r"CLOCK_REALTIME|\b(gettimeofday|localtime|gmtime|time|ftime|clock)\s*\("),
    ".py": re.compile(r"\btime\.(time|time_ns|localtime|gmtime|strftime)\b|\bdate(time)?\.(now|utcnow|today)\b"),
}
"""Patterns of code that reads the wall clock, by suffix of the file."""

ALLOWED = {
    "host_sim/lab/campaign/host_events.py": "sets it, for those who read it",
    "host_sim/live/class_roster.py": "tells when a page last reported",
    "host_sim/live/class_server.py": "tells how long ago that was",
    "host_sim/sim/own_brain.py": "keeps in its cache what another run may be about to use",
    "host_sim/transport/socket_pair_bus.py": "the time stamp that python-can wants of a frame",
}


def readers(suffix: str) -> set[str]:
    folders = (ROOT / name for name in ("firmware", "hal", "host_sim"))
    paths = [path for folder in folders for path in folder.rglob(f"*{suffix}")]
    return {str(path.relative_to(ROOT)) for path in paths if READS[suffix].search(path.read_text())}


@pytest.mark.parametrize("suffix", READS)
def test_only_listed_files_read_the_wall_clock(suffix):
    assert readers(suffix) == {name for name in ALLOWED if Path(name).suffix == suffix}


@pytest.mark.parametrize(
    ("suffix", "line"),
    [
        (".c", "clock_gettime(CLOCK_REALTIME, &now);"),
        (".c", "srand(time(NULL));"),
        (".py", "began_s = time.time()"),
        (".py", "datetime.now(timezone.utc)"),
    ],
)
def test_reading_of_the_wall_clock_is_found(suffix, line):
    assert READS[suffix].search(line)


@pytest.mark.parametrize(
    ("suffix", "line"),
    [(".c", "clock_gettime(CLOCK_MONOTONIC, &now);"), (".py", "time.monotonic() + self.now()")],
)
def test_monotonic_clock_is_not_taken_for_a_wall_clock(suffix, line):
    assert not READS[suffix].search(line)
