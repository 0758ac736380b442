"""Runs with faults made on purpose, as a person would type them."""

import pytest

from tests.runs.support import octet
from tests.runs.test_slcan import drives_in

SHORT = ("--environments", "1", "--limit-s", "8")
BAD = ("--fault", "drop:30%", "--fault", "duplicate:10%", "--fault", "reorder:10%", "--fault", "delay:0-300ms")


@pytest.mark.faulty
def test_a_run_over_a_bad_bus_has_the_drives_of_a_clean_one_and_counts_what_was_repeated(run):
    bad, clean = run(*SHORT, "--bus", "none", *BAD), run(*SHORT, "--bus", "none")

    assert (bad.code, bad.errors) == (0, "")
    assert drives_in(bad.log) == drives_in(clean.log)
    assert bad.summary["environments"] == clean.summary["environments"]
    assert bad.summary["robots"][0]["frames"]["repeated"] > 100
    assert "frames repeated" in bad.output
    assert "link" not in clean.output
    assert octet("replay", bad.out / "run.log").returncode == 0


@pytest.mark.faulty
def test_a_bad_socket_pair_changes_nothing_either(run):
    words = ("--environments", "1", "--limit-s", "1")

    bad = run(*words, "--bus", "fd", "--fault", "drop:20%", "--fault", "delay:10%:0-30ms")

    assert (bad.code, bad.errors) == (0, "")
    assert drives_in(bad.log) == drives_in(run(*words, "--bus", "none").log)


@pytest.mark.faulty
def test_recorded_faults_are_made_again(run):
    first = run(*SHORT, "--bus", "none", *BAD)

    again = run(*SHORT, "--bus", "none", "--fault", f"@{first.out / 'faults.txt'}")

    assert again.log == first.log
    assert (again.out / "faults.txt").read_bytes().count(b"\n") > 100


@pytest.mark.faulty
def test_faults_that_were_too_many_to_record_are_said_to_be_left_out(run, monkeypatch):
    monkeypatch.setattr("host_sim.faults.schedule.RECORD_MAX", 3)

    first = run("--environments", "1", "--limit-s", "1", "--bus", "none", "--fault", "duplicate:20%")

    *rules, left_out = (first.out / "faults.txt").read_text().splitlines()
    assert len(rules) == 3
    assert left_out.startswith("# and ")
    assert run("--environments", "1", "--bus", "none", "--fault", f"@{first.out / 'faults.txt'}").code == 0


@pytest.mark.faulty
def test_a_forged_stop_ends_a_run_with_its_tick(run):
    done = run(*SHORT, "--bus", "none", "--fault", "forge:stop@100/to")

    assert done.code == 1
    assert "somebody else stopped node 1" in done.errors
    assert "tick 8" in done.errors or "tick 9" in done.errors
    assert done.errors.count("\n") == 1


@pytest.mark.faulty
@pytest.mark.parametrize("rule", ["forge:DRIVE@100-102/to", "forge:HEARTBEAT@100-102/to"])
def test_a_twin_ends_a_run(run, rule):
    done = run(*SHORT, "--bus", "none", "--fault", rule)

    assert done.code == 1
    assert "two robots are node 1" in done.errors


@pytest.mark.faulty
@pytest.mark.parametrize("rule", ["forge:SENSES@100-110/from", "forge:COMMAND@100-110/from"])
def test_a_second_simulator_ends_a_run(run, rule):
    done = run(*SHORT, "--bus", "none", "--fault", rule)

    assert done.code == 1
    assert "another simulator commands node 1" in done.errors


@pytest.mark.faulty
@pytest.mark.parametrize(
    "message", ["MEMORY", "HEARTBEAT", "DRIVE", "BOOT", "FAULTS", "HEALTH", "ANSWER", "EMERGENCY"]
)
def test_forged_reports_never_make_a_wrong_result_look_right(run, message):
    forged = run(*SHORT, "--bus", "none", "--fault", f"forge:20%:{message}/from")

    clean = run(*SHORT, "--bus", "none")
    right = forged.memory == clean.memory if (forged.out / "summary.json").exists() else False
    assert right or forged.code == 1
    assert forged.errors.count("\n") == (forged.code == 1)


@pytest.mark.faulty
def test_a_forged_power_up_is_counted_and_changes_nothing(run):
    forged, clean = run(*SHORT, "--bus", "none", "--fault", "forge:BOOT@100/from"), run(*SHORT, "--bus", "none")

    assert (forged.code, forged.errors) == (0, "")
    assert drives_in(forged.log) == drives_in(clean.log)
    assert forged.summary["robots"][0]["frames"]["refused"] == 1


@pytest.mark.parametrize(
    ("words", "named"), [(("--fault", "meteor"), "meteor"), (("--fault", "@nowhere"), "nowhere")]
)
def test_what_is_no_fault_is_one_line(run, words, named):
    done = run(*SHORT, "--bus", "none", *words)

    assert done.code == 2
    assert named in done.errors
    assert done.errors.count("\n") == 1
