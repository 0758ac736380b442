"""A rule of the world is written once: no file of one language has a rule as a file of another has it."""

import re
import subprocess
from collections.abc import Mapping

import pytest

from tests.runs.support import ROOT

TWIN = re.compile(r"\bas [\w/]+\.(?:c|h|js|py) has (?:it|them)\b", re.IGNORECASE)
SOURCES = ("firmware/*.[ch]", "hal/*.[ch]", "host_sim/*.[ch]", "host_sim/*.py", "host_sim/*.js")


def twins(texts: Mapping[str, str]) -> set[str]:
    """The files that say to be another one's twin; where a line ends does not matter."""
    return {file for file, text in texts.items() if TWIN.search(" ".join(text.replace("*", " ").split()))}


@pytest.fixture(scope="module")
def texts() -> dict[str, str]:
    command = ("git", "ls-files", "-z", "--cached", "--others", "--exclude-standard", *SOURCES)
    files = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True).stdout.split("\0")[:-1]
    return {file: (ROOT / file).read_text() for file in files if (ROOT / file).exists()}


def test_no_file_says_to_be_the_twin_of_another(texts):
    assert len(texts) > 500
    assert twins(texts) == set()


@pytest.mark.parametrize(
    "comment", ["/* Ranges: as host_sim/world/ranges.py has them. */", "// as host_sim/sim/loop.c\n// * has it"]
)
def test_a_file_that_says_so_is_found(comment):
    assert twins({"one.js": comment.replace("//", "*"), "other.js": "/* As in the article. */"}) == {"one.js"}
