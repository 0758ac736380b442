"""Each tool calls itself as a person calls it from the project's folder."""

import ast

import pytest

from host_sim.base.paths import ROOT

PYTHON = b"#!/usr/bin/env python3\n"
TOOLS = sorted(
    path.name for path in (ROOT / "tools").iterdir() if path.is_file() and path.read_bytes().startswith(PYTHON)
)


def programs(source: str) -> list[str]:
    """What each argument parser of a source is called; empty for one that calls itself by its file's name."""
    calls = [node for node in ast.walk(ast.parse(source)) if isinstance(node, ast.Call)]
    parsers = [call for call in calls if ast.unparse(call.func) == "argparse.ArgumentParser"]
    names = [[ast.literal_eval(word.value) for word in call.keywords if word.arg == "prog"] for call in parsers]
    return [name for found in names for name in found or [""]]


def test_a_parser_without_a_name_is_found():
    assert programs("argparse.ArgumentParser(description=__doc__)") == [""]


@pytest.mark.parametrize("name", TOOLS)
def test_its_usage_begins_with_its_path(name):
    source = (ROOT / "tools" / name).read_text()

    assert set(programs(source)) <= {f"tools/{name}"}
