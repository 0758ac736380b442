"""Each package has an approved licence, and is pinned by its hash."""

import json
import re
import sys
from collections.abc import Sequence
from importlib import metadata
from pathlib import Path
from types import ModuleType

import pytest

from tests.tools.project import ROOT, script_named

PAGE = (ROOT / "THIRD-PARTY.md").read_text()


@pytest.fixture
def script(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> ModuleType:
    """tools/licences as a module, with a copy of the page, and with --check."""
    module = script_named("licences")
    monkeypatch.setattr(module, "PAGE", tmp_path / "licences.md")
    monkeypatch.setattr(sys, "argv", ["tools/licences", "--check"])
    module.PAGE.write_text(PAGE)
    return module


def installed_as(script: ModuleType, monkeypatch: pytest.MonkeyPatch, **licences: str) -> None:
    found = script.installed()
    monkeypatch.setattr(script, "installed", lambda: {**found, **licences})


def test_licence_page_is_up_to_date(script, capsys):
    assert (script.main(), capsys.readouterr().err) == (0, "")


def test_installed_package_without_a_row_is_reported(script, capsys):
    script.PAGE.write_text(PAGE.replace("| numpy |", "| nompy |"))

    assert script.main() == 1
    assert "not up to date" in capsys.readouterr().err


def test_uninstalled_package_without_a_row_is_reported(script, monkeypatch, capsys):
    monkeypatch.setattr(script, "locked", lambda: {"no-such-package": "run"})

    assert script.main() == 1
    assert "no-such-package is not installed here and has no row yet" in capsys.readouterr().err


def test_changed_licence_is_detected(script, monkeypatch):
    installed_as(script, monkeypatch, numpy="MIT")

    assert script.main() == 1


@pytest.mark.parametrize(("package", "licence"), [("numpy", "Proprietary"), ("numpy", "MIT AND GPL-2.0-only")])
def test_unapproved_licence_is_named(script, monkeypatch, capsys, package, licence):
    installed_as(script, monkeypatch, **{package: licence})

    assert script.main() == 1
    assert f"{package}: {licence.split()[-1]} is not among" in capsys.readouterr().err


def test_call_without_check_writes_the_page(script, monkeypatch):
    script.PAGE.write_text(PAGE.replace("| numpy | BSD", "| numpy | ABC"))
    monkeypatch.setattr(sys, "argv", ["tools/licences"])

    assert script.main() == 0
    assert script.PAGE.read_text() == PAGE


RUN = ROOT / "requirements/run.lock"
LOCKS = sorted(ROOT.glob("requirements/*.lock"))


def unpinned(lock: str) -> list[str]:
    """The packages of a lock file that lack a version or a hash."""
    items = re.findall(r"^[^\s#].*(?:\n .*)*", lock, re.MULTILINE)
    pinned = re.compile(r"[\w.-]+==\S+ .*--hash=sha256:[0-9a-f]{64}", re.DOTALL)
    return [item.split()[0] for item in items if not pinned.match(item)]


def test_lock_files_pin_by_hash_and_name_no_address() -> None:
    for path in LOCKS:
        text = path.read_text()
        assert "==" in text
        assert "://" not in text
        assert unpinned(text) == []


def test_lock_file_of_node_pins_by_hash_and_names_no_address() -> None:
    (path,) = ROOT.glob("requirements/*/package-lock.json")
    text = path.read_text()
    packages = [it for name, it in json.loads(text)["packages"].items() if name]

    assert "://" not in text
    assert [it["integrity"].partition("-")[0] for it in packages] == ["sha512"]


def test_package_without_a_hash_or_a_version_is_detected() -> None:
    lock = re.sub(r"^(numpy==\S+).*(?:\n .*)*", r"\1", RUN.read_text(), count=1, flags=re.MULTILINE)
    assert unpinned(f"{lock}numpy>=1 --hash=sha256:0\n")[1:] == ["numpy>=1"]
    assert unpinned(lock)[0].startswith("numpy==")


def megabytes(locks: Sequence[Path]) -> float:
    """The size of the packages of lock files, as they are installed here."""
    names = set(re.findall(r"^([\w.-]+)==", "".join(lock.read_text() for lock in locks), re.MULTILINE))
    installed = {it.name.lower().replace("_", "-"): it for it in metadata.distributions()}
    files = [
        Path(it.locate_file(file)) for name in names & set(installed) for it in [installed[name]] for file in it.files
    ]
    return sum(file.stat().st_size for file in files if file.exists()) / 1e6


def test_run_stage_installs_less_than_200_mb() -> None:
    pip = 20
    assert 50 < megabytes([RUN]) < 200 - pip


def test_packages_of_all_stages_exceed_200_mb() -> None:
    assert megabytes(LOCKS) > 200
