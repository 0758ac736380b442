"""The images stay within their budget, and an image that does not is noticed."""

import json
import subprocess
import sys
from importlib.machinery import SourceFileLoader
from importlib.util import module_from_spec, spec_from_loader
from pathlib import Path
from types import ModuleType

import pytest

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT))

from tools.image_size.pieces import read_pieces  # noqa: E402 - found by the line above
from tools.image_size.stack import CallGraph, StackError, worst_stack  # noqa: E402

GRAPH = """
node: { title: "top" label: "top\\na.c:1:1\\n16 bytes (static)" }
node: { title: "a.c:small" label: "small\\na.c:2:1\\n8 bytes (static)" }
node: { title: "a.c:big" label: "big\\na.c:3:1\\n24 bytes (static)" }
node: { title: "memset" label: "memset\\n<built-in>" shape : ellipse }
edge: { sourcename: "top" targetname: "a.c:small" label: "a.c:1:2" }
edge: { sourcename: "top" targetname: "a.c:big" label: "a.c:1:3" }
edge: { sourcename: "a.c:small" targetname: "memset" label: "a.c:2:2" }
"""


def size_script() -> ModuleType:
    """tools/size as a module."""
    loader = SourceFileLoader("tools_size", str(ROOT / "tools" / "size"))
    module = module_from_spec(spec_from_loader(loader.name, loader))
    loader.exec_module(module)
    return module


def graph(text: str) -> CallGraph:
    made = CallGraph()
    made.add(text)
    return made


def test_everything_is_within_its_budget_but_for_the_limits_that_were_lowered(tmp_path: Path) -> None:
    budget = json.loads((ROOT / "tools" / "size_budget.json").read_text())
    for limits in budget["limits"]["octet-blue_pill-bxcan"].values():
        limits |= {"flash": 4000, "stack": 200}
    for limits in budget["limits"]["worst tick on blue_pill"].values():
        limits["instructions"] = 1000
    tight = tmp_path / "budget.json"
    tight.write_text(json.dumps(budget))

    command = [ROOT / "tools" / "size", f"--budget={tight}"]
    result = subprocess.run(command, capture_output=True, text=True, check=False)

    over = [line.split() for line in result.stdout.splitlines() if "OVER ITS LIMIT" in line]
    assert result.returncode == 1, result.stderr
    assert [line[0] for line in over] == ["flash", "stack", "instructions"], result.stdout
    tables = {line.split(",")[0] for line in result.stdout.splitlines() if not line.startswith(" ")}
    assert {"octet-blue_pill-bxcan", "octet-feather_stm32f405-slcan", "octet-nucleo_g431rb-fdcan"} <= tables
    assert {"core on Cortex-M0", "core on RV32"} <= tables


def test_nearly_all_of_an_image_is_known_by_its_file() -> None:
    pieces = read_pieces(ROOT / "build" / "blue_pill" / "octet-blue_pill-bxcan.elf")

    flash = sum(piece.flash for piece in pieces)
    motion = [piece for piece in pieces if piece.module == "motion"]
    rest = [piece.flash for piece in pieces if piece.module == "rest"]
    assert sum(piece.flash for piece in motion) > 300
    assert "startup_reset" in {piece.symbol for piece in motion}, "nothing was put into the main loop"
    assert 0 <= sum(rest) < flash // 50


@pytest.mark.parametrize(
    ("flash", "compiler", "code"), [(100, "a-gcc 14", 0), (101, "a-gcc 14", 1), (1, "a-gcc 15", 1)]
)
def test_the_exit_code_is_1_if_and_only_if_a_limit_is_passed_or_there_is_none_for_the_compiler(
    flash: int, compiler: str, code: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    script = size_script()
    budget = {"limits": {"an image": {"a-gcc 14": {"flash": 100}}}, "recorded": {}, "recorded_with": []}
    (tmp_path / "budget.json").write_text(json.dumps(budget))
    monkeypatch.setattr(script, "measured", lambda: ({"an image": {"flash": flash}}, {}))
    monkeypatch.setattr(script, "compiler_of", lambda _: compiler)
    monkeypatch.setattr(sys, "argv", ["tools/size", f"--budget={tmp_path}/budget.json"])

    assert script.main() == code


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
