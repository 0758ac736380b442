"""tools/requirements: each sentence about the robot has code and tests."""

from pathlib import Path
from types import ModuleType

import pytest

from tests.tools.project import ROOT, script_named

PAGE = (ROOT / "docs/requirements.md").read_text()


@pytest.fixture
def script(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> ModuleType:
    """tools/requirements as a module, with a copy of the page."""
    module = script_named("requirements")
    monkeypatch.setattr(module, "PAGE", tmp_path / "requirements.md")
    monkeypatch.setattr("sys.argv", ["tools/requirements"])
    module.PAGE.write_text(PAGE)
    return module


def test_there_is_no_gap(script, capsys):
    result = script.main()
    out, err = capsys.readouterr()

    assert (result, err) == (0, "")
    assert "    code  listing_step  firmware/behaviours/listing.c\n" in out


@pytest.mark.parametrize(
    ("before", "after", "complaint"),
    [
        ("`listing_step`", "`listing_stop`", "C1: there is no code listing_stop"),
        ("`test_a_clear_way_ends_the_count`", "`test_a`", "C1: there is no test test_a"),
        ("`test_a_clear_way_ends_the_count`", "`setUp`", "C1: there is no test setUp"),
        ("Code: `listing_step`.", "Code: .", "C1: names no code"),
        ("- **C2**", "- **C1**", "C1: 2 requirements have this name"),
        ("- **", "- ", "requirements.md has no requirement"),
    ],
)
def test_a_gap_is_named(script, capsys, before, after, complaint):
    assert before in PAGE
    script.PAGE.write_text(PAGE.replace(before, after))

    assert script.main() == 1
    assert complaint in capsys.readouterr().err.splitlines()


def test_a_requirement_without_a_test_is_named(script, capsys):
    item = PAGE[PAGE.index("- **C1**") :]
    tests = item[item.index("Tests:") : item.index("- **C2**")]
    script.PAGE.write_text(PAGE.replace(tests, "\n"))

    assert script.main() == 1
    assert "C1: names no test" in capsys.readouterr().err.splitlines()


def test_a_call_and_a_declaration_are_no_definition(script, tmp_path):
    (tmp_path / "a.c").write_text("int one(void);\nint two(void)\n{\n    return one();\n}\n")

    assert script.functions(tmp_path, ["*.c"]).keys() == {"two"}


def test_a_c_test_is_a_definition(script, tmp_path):
    (tmp_path / "a.c").write_text("TEST(one)\n{\n}\nTEST_IF(two, is_pair)\n{\n    TEST_ASSERT(1);\n}\n")

    assert script.functions(tmp_path, ["*.c"]).keys() == {"test_one", "test_two"}
