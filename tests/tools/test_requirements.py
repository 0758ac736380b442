"""Sentences about the robot have code and tests; packages have a licence that was judged, and are pinned."""

import re
import sys
from collections.abc import Sequence
from importlib import metadata
from importlib.machinery import SourceFileLoader
from importlib.util import module_from_spec, spec_from_loader
from pathlib import Path
from types import ModuleType

import pytest

ROOT = Path(__file__).resolve().parents[2]
PAGE = (ROOT / "docs/requirements.md").read_text()


@pytest.fixture
def script(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> ModuleType:
    """tools/requirements as a module, with a copy of the page."""
    loader = SourceFileLoader("tools_requirements", str(ROOT / "tools/requirements"))
    module = module_from_spec(spec_from_loader(loader.name, loader))
    loader.exec_module(module)
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


LICENCES = (ROOT / "docs/licences.md").read_text()


@pytest.fixture
def judged(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> ModuleType:
    """tools/licences as a module, with a copy of the page, and with --check."""
    loader = SourceFileLoader("tools_licences", str(ROOT / "tools/licences"))
    module = module_from_spec(spec_from_loader(loader.name, loader))
    loader.exec_module(module)
    monkeypatch.setattr(module, "PAGE", tmp_path / "licences.md")
    monkeypatch.setattr(sys, "argv", ["tools/licences", "--check"])
    module.PAGE.write_text(LICENCES)
    return module


def installed_as(judged: ModuleType, monkeypatch: pytest.MonkeyPatch, **licences: str) -> None:
    found = judged.installed()
    monkeypatch.setattr(judged, "installed", lambda: {**found, **licences})


def test_the_page_is_what_the_packages_say_today(judged, capsys):
    assert (judged.main(), capsys.readouterr().err) == (0, "")


def test_a_package_without_a_row_is_noticed_where_it_is_installed(judged, capsys):
    judged.PAGE.write_text(LICENCES.replace("| numpy |", "| nompy |"))

    assert judged.main() == 1
    assert "not up to date" in capsys.readouterr().err


def test_a_package_without_a_row_is_noticed_where_it_is_not_installed(judged, monkeypatch, capsys):
    monkeypatch.setattr(judged, "locked", lambda: {"no-such-package": "run"})

    assert judged.main() == 1
    assert "no-such-package is not installed here and has no row yet" in capsys.readouterr().err


def test_a_licence_that_has_changed_is_noticed(judged, monkeypatch):
    installed_as(judged, monkeypatch, numpy="MIT")

    assert judged.main() == 1


@pytest.mark.parametrize(("package", "licence"), [("numpy", "Proprietary"), ("numpy", "MIT AND GPL-2.0-only")])
def test_a_licence_that_was_not_judged_fit_is_named(judged, monkeypatch, capsys, package, licence):
    installed_as(judged, monkeypatch, **{package: licence})

    assert judged.main() == 1
    assert f"{package}: {licence.split()[-1]} is not among" in capsys.readouterr().err


def test_without_check_the_page_is_written(judged, monkeypatch):
    judged.PAGE.write_text(LICENCES.replace("| numpy | BSD", "| numpy | ABC"))
    monkeypatch.setattr(sys, "argv", ["tools/licences"])

    assert judged.main() == 0
    assert judged.PAGE.read_text() == LICENCES


RUN = ROOT / "requirements/run.lock"
LOCKS = sorted(ROOT.glob("requirements/*.lock"))


def test_the_lock_files_pin_by_hash_and_name_no_address() -> None:
    for path in LOCKS:
        text = path.read_text()
        assert "://" not in text
        assert 0 < text.count("==") <= text.count("--hash=sha256:")


def megabytes(locks: Sequence[Path]) -> float:
    """The size of the packages of lock files, as they are installed here."""
    names = set(re.findall(r"^([\w.-]+)==", "".join(lock.read_text() for lock in locks), re.MULTILINE))
    installed = {it.name.lower().replace("_", "-"): it for it in metadata.distributions()}
    files = [
        Path(it.locate_file(file)) for name in names & set(installed) for it in [installed[name]] for file in it.files
    ]
    return sum(file.stat().st_size for file in files if file.exists()) / 1e6


def test_a_run_installs_less_than_200_mb() -> None:
    pip = 20
    assert 50 < megabytes([RUN]) < 200 - pip


def test_a_run_that_installed_what_the_tests_need_would_be_noticed() -> None:
    assert megabytes(LOCKS) > 200
