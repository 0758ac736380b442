"""The images stay within their budget, and an image that does not is noticed."""

import json
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT))

from tools.image_size.stack import CallGraph, StackError, worst_stack  # noqa: E402 - found by the line above

GRAPH = """
node: { title: "top" label: "top\\na.c:1:1\\n16 bytes (static)" }
node: { title: "a.c:small" label: "small\\na.c:2:1\\n8 bytes (static)" }
node: { title: "a.c:big" label: "big\\na.c:3:1\\n24 bytes (static)" }
node: { title: "memset" label: "memset\\n<built-in>" shape : ellipse }
edge: { sourcename: "top" targetname: "a.c:small" label: "a.c:1:2" }
edge: { sourcename: "top" targetname: "a.c:big" label: "a.c:1:3" }
edge: { sourcename: "a.c:small" targetname: "memset" label: "a.c:2:2" }
"""


def size(*options: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run([ROOT / "tools" / "size", *options], capture_output=True, text=True, check=False)


def graph(text: str) -> CallGraph:
    made = CallGraph()
    made.add(text)
    return made


def test_everything_is_within_its_budget() -> None:
    result = size()

    assert result.returncode == 0, result.stdout + result.stderr
    tables = {line for line in result.stdout.splitlines() if not line.startswith(" ")}
    assert {"octet-blue_pill-bxcan", "octet-feather_stm32f405-slcan", "octet-nucleo_g431rb-fdcan"} <= tables
    assert {"core on Cortex-M0", "core on RV32"} <= tables


def test_what_is_over_its_limit_is_named_and_fails(tmp_path: Path) -> None:
    budget = json.loads((ROOT / "tools" / "size_budget.json").read_text())
    budget["limits"]["octet-blue_pill-bxcan"]["flash"] = 4000
    tight = tmp_path / "budget.json"
    tight.write_text(json.dumps(budget))

    result = size(f"--budget={tight}")

    assert result.returncode == 1
    assert result.stdout.count("OVER ITS LIMIT") == 1


def test_the_worst_stack_is_that_of_the_deepest_way() -> None:
    assert worst_stack(graph(GRAPH), ["top"]) == (16 + 8 + 32, ["top", "a.c:small", "memset"])


@pytest.mark.parametrize(
    ("line", "reason"),
    [
        ('edge: { sourcename: "memset" targetname: "top" label: "" }', "calls itself"),
        ('edge: { sourcename: "top" targetname: "__indirect_call" label: "" }', "through a pointer"),
    ],
)
def test_a_stack_that_cannot_be_known_is_refused(line: str, reason: str) -> None:
    with pytest.raises(StackError, match=reason):
        worst_stack(graph(GRAPH + line), ["top"])


def test_a_stack_that_grows_as_it_runs_is_refused() -> None:
    with pytest.raises(StackError, match="dynamic"):
        graph(GRAPH.replace("(static)", "(dynamic)"))
