"""The images stay within their budget, and an image that does not is noticed."""

from pathlib import Path

import pytest

from tests.tools.project import ROOT, script_named
from tools.verify import command
from tools.verify.command import ChoiceError, VerifyError
from tools.verify.sizes import CallGraph, compiler_of, read, read_pieces, worst_stack

BUDGET = ROOT / "tools" / "verify" / "size.md"
HEAD = "# Budgets\n\n| what | compiler | flash | ram | stack | instructions |\n| - | - | - | - | - | - |\n"
GRAPH = """
node: { title: "top" label: "top\\na.c:1:1\\n16 bytes (static)" }
node: { title: "a.c:small" label: "small\\na.c:2:1\\n8 bytes (static)" }
node: { title: "a.c:big" label: "big\\na.c:3:1\\n24 bytes (static)" }
node: { title: "memset" label: "memset\\n<built-in>" shape : ellipse }
edge: { sourcename: "top" targetname: "a.c:small" label: "a.c:1:2" }
edge: { sourcename: "top" targetname: "a.c:big" label: "a.c:1:3" }
edge: { sourcename: "a.c:small" targetname: "memset" label: "a.c:2:2" }
"""


def table(path: Path) -> None:
    """A table of one image."""
    path.write_text(f"{HEAD}| an image | gcc 12 | 90 / 100 | | | |\n")


def graph(text: str) -> CallGraph:
    made = CallGraph()
    made.add(text)
    return made


def test_size_reports_only_the_lowered_limits_as_exceeded(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    budget = read(BUDGET)
    lowered = {"flash": 4000, "stack": 200, "instructions": 1000}
    row = budget.rows["octet-blue_pill-bxcan", compiler_of("arm-none-eabi-")]
    row |= {name: row[name]._replace(limit=limit) for name, limit in lowered.items()}
    tight = tmp_path / "size.md"
    budget.write(tight)

    size = script_named("size")
    monkeypatch.setattr(size, "build", lambda board: ROOT / "build" / board)  # other tests run these images
    monkeypatch.setattr("sys.argv", ["tools/size", f"--budget={tight}"])
    code = size.main()

    output, errors = capsys.readouterr()
    over = [line.split() for line in output.splitlines() if "OVER ITS LIMIT" in line]
    assert code == 1, errors
    assert {line[0] for line in over} == lowered.keys(), output
    assert errors.count("is over its limit") == len(lowered)
    tables = {line.partition(",")[0] for line in output.splitlines() if not line.startswith(" ")}
    assert {"octet-blue_pill-bxcan", "octet-feather_stm32f405-slcan", "octet-nucleo_g431rb-fdcan"} <= tables
    assert {"core on Cortex-M0", "core on RV32"} <= tables


def test_bytes_of_an_image_are_assigned_to_their_modules() -> None:
    pieces = read_pieces(ROOT / "build" / "blue_pill" / "octet-blue_pill-bxcan.elf")

    flash = sum(piece.flash for piece in pieces)
    motion = [piece for piece in pieces if piece.module == "motion"]
    rest = [piece.flash for piece in pieces if piece.module == "rest"]
    assert sum(piece.flash for piece in motion) > 300
    assert "startup_begin" in {piece.symbol for piece in motion}, "nothing was put into the main loop"
    assert 0 <= sum(rest) < flash // 50


@pytest.mark.parametrize(
    ("compiler", "flash", "complaint"),
    [
        ("gcc 12", 100, ""),
        ("gcc 12", 101, "size: an image: flash is over its limit\n"),
        ("gcc 13", 1, "size: no budget for an image with gcc 13: add a row, and tools/size --record fills it in\n"),
    ],
)
def test_exceeded_or_missing_limit_is_an_error(
    compiler: str, flash: int, complaint: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    table(tmp_path / "size.md")
    sizes = {("an image", compiler): {"flash": flash}}

    over = command.run("size", lambda: script_named("size").show(sizes, {}, read(tmp_path / "size.md"), depth=2))

    assert over == (1 if complaint else 0)
    assert capsys.readouterr().err == complaint


def test_recording_sizes_changes_no_limit(tmp_path: Path) -> None:
    path = tmp_path / "size.md"
    table(path)
    budget = read(path)

    budget.record("an image", "gcc 12", {"flash": 97, "flash main": 50})
    budget.write(path)

    assert read(path).rows == {("an image", "gcc 12"): {"flash": (97, 100)}}
    assert path.read_text().startswith("# Budgets\n")


def test_images_have_a_budget_for_every_compiler() -> None:
    compilers: dict[str, set[str]] = {}
    for what, compiler in read(BUDGET).rows:
        compilers.setdefault(what, set()).add(compiler)

    assert {len(each) for each in compilers.values()} == {2}


@pytest.mark.parametrize(
    "text", ["", "| what | compiler |\n| - | - |\n| a |\n", HEAD + "| a | gcc 12 | 90 | | | |\n"]
)
def test_unreadable_budget_table_is_an_error(text: str, tmp_path: Path) -> None:
    (tmp_path / "size.md").write_text(text)

    with pytest.raises(ChoiceError, match=r"cannot read .*size\.md"):
        read(tmp_path / "size.md")


def test_worst_stack_is_that_of_the_deepest_call_path() -> None:
    assert worst_stack(graph(GRAPH), ["top"]) == (16 + 8 + 32, ["top", "a.c:small", "memset"])


@pytest.mark.parametrize(
    ("line", "reason"),
    [
        ('edge: { sourcename: "memset" targetname: "top" label: "" }', "calls itself"),
        ('edge: { sourcename: "top" targetname: "__indirect_call" label: "" }', "through a pointer"),
    ],
)
def test_recursion_and_indirect_calls_are_refused(line: str, reason: str) -> None:
    with pytest.raises(VerifyError, match=reason):
        worst_stack(graph(GRAPH + line), ["top"])


def test_dynamic_stack_is_refused() -> None:
    with pytest.raises(VerifyError, match="dynamic"):
        graph(GRAPH.replace("(static)", "(dynamic)"))
