"""tools/licences: each package's licence is on the page, and none comes in that nobody has judged."""

import sys
from importlib.machinery import SourceFileLoader
from importlib.util import module_from_spec, spec_from_loader
from pathlib import Path
from types import ModuleType

import pytest

ROOT = Path(__file__).resolve().parents[2]
PAGE = (ROOT / "docs/licences.md").read_text()


@pytest.fixture
def script(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> ModuleType:
    """tools/licences as a module, with a copy of the page, and with --check."""
    loader = SourceFileLoader("tools_licences", str(ROOT / "tools/licences"))
    module = module_from_spec(spec_from_loader(loader.name, loader))
    loader.exec_module(module)
    monkeypatch.setattr(module, "PAGE", tmp_path / "licences.md")
    monkeypatch.setattr(sys, "argv", ["tools/licences", "--check"])
    module.PAGE.write_text(PAGE)
    return module


def installed_as(script: ModuleType, monkeypatch: pytest.MonkeyPatch, **licences: str) -> None:
    found = script.installed()
    monkeypatch.setattr(script, "installed", lambda: {**found, **licences})


def test_the_page_is_what_the_packages_say_today(script, capsys):
    assert (script.main(), capsys.readouterr().err) == (0, "")


def test_a_package_without_a_row_is_noticed_where_it_is_installed(script, capsys):
    script.PAGE.write_text(PAGE.replace("| numpy |", "| nompy |"))

    assert script.main() == 1
    assert "not up to date" in capsys.readouterr().err


def test_a_package_without_a_row_is_noticed_where_it_is_not_installed(script, monkeypatch, capsys):
    monkeypatch.setattr(script, "locked", lambda: {"no-such-package": "run"})

    assert script.main() == 1
    assert "no-such-package is not installed here and has no row yet" in capsys.readouterr().err


def test_a_licence_that_has_changed_is_noticed(script, monkeypatch):
    installed_as(script, monkeypatch, numpy="MIT")

    assert script.main() == 1


@pytest.mark.parametrize(("package", "licence"), [("numpy", "Proprietary"), ("numpy", "MIT AND GPL-2.0-only")])
def test_a_licence_that_was_not_judged_fit_is_named(script, monkeypatch, capsys, package, licence):
    installed_as(script, monkeypatch, **{package: licence})

    assert script.main() == 1
    assert f"{package}: {licence.split()[-1]} is not among" in capsys.readouterr().err


def test_without_check_the_page_is_written(script, monkeypatch):
    script.PAGE.write_text(PAGE.replace("| numpy | BSD", "| numpy | ABC"))
    monkeypatch.setattr(sys, "argv", ["tools/licences"])

    assert script.main() == 0
    assert script.PAGE.read_text() == PAGE
