"""Each option of each command does something that can be seen: the table options.toml says what."""

import re
from types import SimpleNamespace
from unittest import mock

import pytest

from host_sim.base.errors import UsageError
from host_sim.lab.check.checking import Verdict
from tests.cli.option_rows import LAB, TABLE, Trial, options, parsers, rows, tried
from tests.runs.support import ROOT, octet

OTHERS = sorted(set(TABLE) - set(LAB))


@pytest.mark.parametrize("command", sorted(parsers()))
def test_option_rows_equal_the_options_of_the_parser(command):
    assert set(rows(command)) == options(parsers()[command])


def test_option_table_has_no_row_of_a_removed_option():
    assert set(TABLE) == set(parsers())
    assert [name for name in TABLE if not set(TABLE[name]) - {"words"} <= options(parsers()[name])] == []


def test_file_named_in_an_option_row_gives_that_option():
    named = [(name, ROOT / row) for command in TABLE for name, row in rows(command).items() if isinstance(row, str)]

    assert [(name, path) for name, path in named if not re.search(rf"{name}\b", path.read_text())] == []


@pytest.fixture(scope="module")
def trial(tmp_path_factory: pytest.TempPathFactory) -> Trial:
    return Trial(tmp_path_factory.mktemp("options"))


@pytest.mark.parametrize(("command", "name"), tried(*OTHERS))
def test_option_has_the_effect_in_its_row(command, name, trial):
    trial.check(command, name)


def handed(target: str, *words: str) -> mock._Call:
    """With which arguments a command calls a function, which ends it."""
    with mock.patch(target, side_effect=UsageError("far enough")) as called:
        assert octet(*words).stderr == "octet: far enough\n"
    return called.call_args


def test_check_asks_the_given_node_on_the_given_bus():
    assert handed("host_sim.lab.check.checking.external", "check", "--bus", "virtual:1", "--node", "3").args == (
        "virtual:1",
        3,
    )


@pytest.mark.parametrize(("words", "lines"), [((), 1), (("--all",), 2)])
def test_check_prints_sentences_that_hold_only_with_option_all(monkeypatch, words, lines):
    verdict = Verdict("T1", "It answers.", "holds")
    monkeypatch.setattr("host_sim.lab.check.checking.check_robot", lambda *_, **__: [verdict])

    assert octet("check", "--bus", "virtual:1", *words).stdout.count("\n") == lines


def test_campaign_in_real_time_runs_in_lockstep_too():
    words = ("campaign", "--html", "a.html", "--links", "fd", "--profiles", "article")

    paces = [handed("host_sim.lab.campaign.matrix.groups", *words, *more).args[2] for more in ((), ("--real-time",))]

    assert paces == [("lockstep",), ("lockstep", "real-time")]


def test_compare_runs_profiles_on_the_given_robot():
    words = ("compare", "article", "--robot", "emulated", "--seeds", "1")

    assert [
        each.config.robot for each in handed("host_sim.lab.study.compare_command.with_progress", *words).args[1]
    ] == ["emulated"]


def test_calibrate_opens_the_given_bus_node_and_bit_rate():
    words = ("calibrate", "--bus", "slcan:/dev/nowhere", "--node", "3", "--bitrate", "250000")

    access = handed("host_sim.sim.connect.Connector", *words).args[1]

    assert (access.bus, list(access.nodes), access.bitrate) == ("slcan:/dev/nowhere", [3], 250_000)


@pytest.mark.parametrize(("words", "asks"), [((), True), (("--yes",), False)])
def test_calibrate_asks_before_each_step_unless_yes_is_given(monkeypatch, words, asks):
    calibration = SimpleNamespace(stored_values=dict)
    monkeypatch.setattr("host_sim.lab.calibrate.calibrate_command._reached", lambda *_: (calibration, None))

    call = handed("host_sim.lab.calibrate.calibrate_command._measures", "calibrate", "--bus", "virtual:1", *words)

    assert call.kwargs == {"ask": asks}


@pytest.mark.parametrize(("words", "ignores"), [((), False), (("--no-world",), True)])
def test_talk_with_no_world_ignores_the_world_of_the_run(words, ignores):
    call = handed("host_sim.recording.resimulation.resimulate", "talk", "--log", "run.log", *words)

    assert call.kwargs["ignore_world"] is ignores
