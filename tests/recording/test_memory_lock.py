"""The memory file: one run at a time."""

import os
import subprocess
import sys

import pytest

from host_sim.base.atomic_file import write_bytes
from host_sim.base.errors import UsageError
from host_sim.recording import memory_lock as module
from host_sim.recording.memory_lock import memory_lock


@pytest.fixture
def path(tmp_path):
    return tmp_path / "robot.mem"


def assert_is_free(path):
    with memory_lock(path):
        pass


def test_a_second_run_is_told_who_is_using_it_and_what_to_do(path):
    said = f"{path} is in use by another run (process {os.getpid()}); choose another file with --memory"

    with memory_lock(path), pytest.raises(UsageError) as refused:
        assert_is_free(path)

    assert str(refused.value) == said


def test_a_link_to_it_is_the_same_file(path):
    link = path.with_name("link")
    link.symlink_to(path)

    with memory_lock(link), pytest.raises(UsageError, match="in use"):
        assert_is_free(path)


def test_it_stays_locked_when_it_is_replaced(path):
    path.write_bytes(bytes(8))

    with memory_lock(path):
        write_bytes(path, bytes(8))
        with pytest.raises(UsageError, match="in use"):
            assert_is_free(path)


def test_it_is_free_again_after_a_run_and_nothing_is_left(path):
    assert_is_free(path)
    assert_is_free(path)

    assert list(path.parent.iterdir()) == []


def test_it_is_free_again_when_the_process_is_killed(path):
    hold = "import sys, pathlib; from host_sim.recording.memory_lock import memory_lock\n"
    hold += "with memory_lock(pathlib.Path(sys.argv[1])): print('held', flush=True); sys.stdin.read()"
    command = [sys.executable, "-c", hold, path]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as holder:
        assert holder.stdout.readline() == "held\n"
        with pytest.raises(UsageError, match=f"in use by another run .process {holder.pid}."):
            assert_is_free(path)
        holder.kill()

    assert_is_free(path)


def test_what_a_killed_run_has_left_locks_nothing(path):
    path.with_name(".robot.mem.lock").touch()

    assert_is_free(path)


def test_a_lock_that_is_removed_before_it_is_had_is_taken_anew(path, monkeypatch):
    beside, lock, taken = path.with_name(".robot.mem.lock"), module.lock, []

    def lock_late(*words):
        if not taken:
            beside.unlink()
        taken.append(lock(*words))

    monkeypatch.setattr(module, "lock", lock_late)

    with memory_lock(path):
        assert beside.exists()
    assert len(taken) == 2


def test_a_lock_that_cannot_be_made_is_named(path):
    path.with_name(".robot.mem.lock").mkdir()

    with pytest.raises(UsageError, match=r"^cannot lock .*robot.mem by .*lock: Is a directory; choose another file"):
        assert_is_free(path)
