"""What is doubtful replaces nothing: the memory of a doubtful run is saved beside the good one."""

import pytest

GOOD = bytes((0, 1, 0, 0, 2, 0, 2, 0))
LONG = ("--environments", "1", "--limit-s", "20", "--bus", "none")
FORGED = ("--fault", "forge:write@500/to")


@pytest.mark.faulty
def test_the_good_memory_is_as_it_was(run, tmp_path):
    memory = tmp_path / "robot.mem"
    memory.write_bytes(GOOD)

    done = run(*LONG, *FORGED, "--memory", memory)

    assert done.code == 1
    assert memory.read_bytes() == GOOD
    assert (tmp_path / "robot.mem.doubtful").read_bytes() == bytes(done.memory) != GOOD
    assert f"its memory is in {memory}.doubtful" in done.errors


@pytest.mark.faulty
def test_a_run_that_somebody_ended_is_doubtful_too(run, tmp_path):
    memory = tmp_path / "robot.mem"
    memory.write_bytes(GOOD)

    done = run(*LONG, "--fault", "forge:stop@500/to", "--memory", memory)

    assert "somebody else stopped node 1" in done.errors
    assert memory.read_bytes() == GOOD
    assert "somebody else stopped node 1" in str(done.summary["incidents"])


@pytest.mark.faulty
def test_where_there_was_none_there_is_none(run, tmp_path):
    memory = tmp_path / "robot.mem"

    done = run(*LONG, *FORGED, "--memory", memory)

    assert not memory.exists()
    assert (tmp_path / "robot.mem.doubtful").read_bytes() == bytes(done.memory)


def test_a_good_run_sets_nothing_aside(run, tmp_path):
    memory = tmp_path / "robot.mem"

    done = run(*LONG, "--memory", memory)

    assert memory.read_bytes() == bytes(done.memory)
    assert list(tmp_path.glob("robot.mem*")) == [memory]
    assert done.errors == ""
