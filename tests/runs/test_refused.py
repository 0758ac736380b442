"""What a run refused is kept beside its log, so that a doubtful run can be explained."""

import pytest

SHORT = ("--environments", "1", "--limit-s", "4", "--bus", "none")


@pytest.mark.faulty
def test_a_forged_command_is_kept_with_its_time(run):
    done = run(*SHORT, "--fault", "forge:freeze@100/from")

    line, *more = (done.out / "refused.log").read_text().splitlines()
    stamp, channel, frame, reason = line.split(maxsplit=3)
    assert (channel, frame[:4], reason, more) == ("octet", "021#", "; of another simulator", [])
    assert 1.0 < float(stamp.strip("()")) < 4.0


@pytest.mark.faulty
def test_no_more_are_kept_than_there_is_room_for(run, monkeypatch):
    monkeypatch.setattr("host_sim.client.incidents.REFUSED_MAX", 5)

    done = run(*SHORT, "--fault", "corrupt:10%/from")

    *kept, left_out = (done.out / "refused.log").read_text().splitlines()
    assert len(kept) == 5
    assert all(line.endswith("; damaged or foreign") for line in kept)
    assert left_out == f"# and {done.summary['robots'][0]['frames']['refused'] - 5} more, not recorded"


@pytest.mark.faulty
def test_a_run_that_refused_nothing_leaves_no_file_of_an_earlier_one(run):
    bad = run(*SHORT, "--fault", "corrupt:10%/from")
    assert (bad.out / "refused.log").exists()

    run(*SHORT, "--out", bad.out)

    assert not (bad.out / "refused.log").exists()
