"""Each option of the commands for studies does something that can be seen: the table of tests/cli says what."""

import pytest

from tests.cli.option_rows import LAB, Trial, tried
from tests.runs.support import octet


@pytest.fixture(scope="module")
def trial(tmp_path_factory: pytest.TempPathFactory) -> Trial:
    folder = tmp_path_factory.mktemp("options")
    trial = Trial(folder)
    assert octet("study", folder / "plan.toml", "--jobs", "1", "--out", folder / "studied").returncode == 0
    return trial


@pytest.mark.parametrize(("command", "name"), tried(*LAB))
def test_an_option_changes_what_its_row_says(command, name, trial):
    trial.check(command, name)
