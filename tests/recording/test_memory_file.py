"""The memory file: eight bytes, saved at every lesson, never replaced by less; one run at a time writes."""

import errno
import fcntl
import os
import subprocess
import sys
from pathlib import Path

import pytest

from host_sim.base.errors import UsageError
from host_sim.base.files import run_folder, write_bytes
from host_sim.protocol.generated import MemoryKind
from host_sim.recording import memory_file as module
from host_sim.recording.memory_file import MemorySaver, load_memory, memory_lock
from host_sim.world.memory_kinds import translated

NOTHING, SOME, MORE = (0,) * 8, (0, 1, 0, 0, 2, 0, 0, 0), (0, 1, 0, 1, 2, 0, 0, 0)


@pytest.fixture
def path(tmp_path):
    return tmp_path / "robot.mem"


@pytest.fixture
def reported():
    return []


def test_saved_memory_is_loaded(path, reported):
    MemorySaver(path, None, reported.append).save(SOME)

    assert load_memory(path) == SOME
    assert reported == []


def test_doubtful_run_removes_the_linked_memory_and_keeps_the_link(path, reported):
    path.symlink_to("own.mem")
    saver = MemorySaver(path, None, reported.append)
    saver.save(SOME)

    saver.save(MORE, doubtful=True)

    assert sorted(file.name for file in path.parent.iterdir()) == ["robot.mem", "robot.mem.doubtful"]
    assert load_memory(path) is None


def test_run_killed_as_it_turns_doubtful_leaves_the_earlier_memory(path, reported, monkeypatch):
    path.write_bytes(bytes(SOME))
    saver = MemorySaver(path, SOME, reported.append)
    saver.save(MORE)
    written = []

    def killed_after_one(target, content):
        if written:
            raise KeyboardInterrupt
        written.append(target)
        write_bytes(target, content)

    monkeypatch.setattr("host_sim.recording.memory_file.write_bytes", killed_after_one)
    with pytest.raises(KeyboardInterrupt):
        saver.save(NOTHING, doubtful=True)

    assert load_memory(path) == SOME


def test_missing_file_loads_no_memory(path):
    assert load_memory(path) is None


@pytest.mark.parametrize(
    ("content", "said"),
    [(bytes(n), f"is not a memory file: {n} bytes, expected 8") for n in (0, 7, 9, 8652, 1 << 20)]
    + [
        (content, f"no behaviour writes {content.hex(' ')}")
        for content in (b"\0\3\0\0\0\0\0\0", b"\0\1\5\0\0\0\0\0", b"\x1e" + b"\0" * 7)
    ],
)
def test_memory_of_another_size_or_that_no_behaviour_writes_is_refused(path, content, said):
    path.write_bytes(content)
    with pytest.raises(UsageError, match=said):
        load_memory(path)


def test_memory_that_knows_more_replaces_the_old_one_silently(path, reported):
    path.write_bytes(bytes(SOME))

    MemorySaver(path, SOME, reported.append).save(MORE)

    assert load_memory(path) == MORE
    assert [file.name for file in path.parent.iterdir()] == ["robot.mem"]
    assert reported == []


def test_memory_that_knows_less_keeps_the_old_one_beside_it_and_says_so(path, reported):
    path.write_bytes(bytes(MORE))

    MemorySaver(path, MORE, reported.append).save(NOTHING)

    assert load_memory(path) == NOTHING
    assert load_memory(path.with_name("robot.mem.1")) == MORE
    assert len(reported) == 1
    assert "robot.mem.1" in reported[0]


def test_run_keeps_the_first_memory_that_knew_more(path, reported):
    path.write_bytes(bytes(MORE))
    saver = MemorySaver(path, MORE, reported.append)

    for memory in (NOTHING, SOME, NOTHING):
        saver.save(memory)

    assert load_memory(path.with_name("robot.mem.1")) == MORE
    assert len(reported) == 1


@pytest.mark.parametrize("saved", [(MORE, SOME), (translated(SOME, MemoryKind.ALL_SENSORS),)])
def test_forgetting_what_this_run_learned_or_another_kind_is_not_reported(path, reported, saved):
    path.write_bytes(bytes(SOME))
    saver = MemorySaver(path, SOME, reported.append)
    for memory in saved:
        saver.save(memory)
    assert reported == []


def test_unchanged_memory_is_not_written(path, reported):
    saver = MemorySaver(path, None, reported.append)
    saver.save(SOME)
    path.unlink()

    saver.save(SOME)

    assert not path.exists()


def test_memory_file_that_is_a_pipe_is_refused_at_once(path):
    os.mkfifo(path)

    with pytest.raises(UsageError, match="not a regular file"):
        load_memory(path)


def assert_is_free(path):
    with memory_lock(path):
        pass


def test_memory_in_use_is_refused_with_its_process_and_what_to_do(path):
    said = f"{path} is in use by another run (process {os.getpid()}); choose another file with --memory"

    with memory_lock(path), pytest.raises(UsageError) as refused:
        assert_is_free(path)

    assert str(refused.value) == said


def test_link_to_a_memory_locks_the_same_file(path):
    link = path.with_name("link")
    link.symlink_to(path)

    with memory_lock(link), pytest.raises(UsageError, match="in use"):
        assert_is_free(path)


def test_memory_stays_locked_when_it_is_replaced(path):
    path.write_bytes(bytes(8))

    with memory_lock(path):
        write_bytes(path, bytes(8))
        with pytest.raises(UsageError, match="in use"):
            assert_is_free(path)


def test_memory_is_free_after_a_run_and_no_lock_file_is_left(path):
    assert_is_free(path)
    assert_is_free(path)

    assert list(path.parent.iterdir()) == []


def test_memory_is_free_again_when_the_process_is_killed(path):
    hold = "import sys, pathlib; from host_sim.recording.memory_file import memory_lock\n"
    hold += "with memory_lock(pathlib.Path(sys.argv[1])): print('held', flush=True); sys.stdin.read()"
    command = [sys.executable, "-c", hold, path]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as holder:
        assert holder.stdout.readline() == "held\n"
        with pytest.raises(UsageError, match=f"in use by another run .process {holder.pid}."):
            assert_is_free(path)
        holder.kill()

    assert_is_free(path)


def test_stale_lock_file_of_a_killed_run_locks_nothing(path):
    path.with_name(".robot.mem.lock").touch()

    assert_is_free(path)


def test_lock_file_removed_before_it_is_locked_is_made_again(path, monkeypatch):
    beside, lock, taken = path.with_name(".robot.mem.lock"), module.lock, []

    def lock_late(*words):
        if not taken:
            beside.unlink()
        taken.append(lock(*words))

    monkeypatch.setattr(module, "lock", lock_late)

    with memory_lock(path):
        assert beside.exists()
    assert len(taken) == 2


def test_lock_file_that_cannot_be_made_is_named(path):
    path.with_name(".robot.mem.lock").mkdir()

    with pytest.raises(UsageError, match=r"^cannot lock .*robot.mem by .*lock: Is a directory; choose another file"):
        assert_is_free(path)


def open_files() -> set[str]:
    """What this process has open, but for the folder that lists it."""
    return {path.readlink().as_posix() for path in Path("/proc/self/fd").iterdir() if path.is_symlink()}


def test_folder_in_use_is_refused_with_its_process_and_is_free_after_a_run(tmp_path):
    for _ in range(2):  # free again after the first
        with run_folder(tmp_path), pytest.raises(UsageError, match=f"by another run .process {os.getpid()}."):
            run_folder(tmp_path).__enter__()


def test_folder_that_cannot_be_locked_is_named_and_closed(tmp_path, monkeypatch):
    def fail(*_: object) -> None:
        raise OSError(errno.ENOLCK, os.strerror(errno.ENOLCK))  # as some network file systems do

    monkeypatch.setattr(fcntl, "flock", fail)
    before = open_files()

    with pytest.raises(UsageError, match=f"^cannot lock the folder {tmp_path}: No locks available; choose"):
        run_folder(tmp_path).__enter__()
    assert open_files() == before
