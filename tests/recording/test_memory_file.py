"""The memory file: eight bytes, saved at every lesson, and never replaced by less without keeping what there was."""

import os

import pytest

from host_sim.base.errors import UsageError
from host_sim.protocol.generated import MemoryKind
from host_sim.protocol.memory_kinds import translated
from host_sim.recording.memory_file import MemorySaver, load_memory

NOTHING, SOME, MORE = (0,) * 8, (0, 1, 0, 0, 2, 0, 0, 0), (0, 1, 0, 1, 2, 0, 0, 0)


@pytest.fixture
def path(tmp_path):
    return tmp_path / "robot.mem"


@pytest.fixture
def reported():
    return []


def test_what_is_saved_is_loaded(path, reported):
    MemorySaver(path, None, reported.append).save(SOME)

    assert load_memory(path) == SOME
    assert reported == []


def test_no_file_is_no_memory(path):
    assert load_memory(path) is None


def test_a_memory_that_knows_more_replaces_the_old_one_without_a_word(path, reported):
    path.write_bytes(bytes(SOME))

    MemorySaver(path, SOME, reported.append).save(MORE)

    assert load_memory(path) == MORE
    assert [file.name for file in path.parent.iterdir()] == ["robot.mem"]
    assert reported == []


def test_a_memory_that_knows_less_leaves_the_old_one_beside_it_and_says_so(path, reported):
    path.write_bytes(bytes(MORE))

    MemorySaver(path, MORE, reported.append).save(NOTHING)

    assert load_memory(path) == NOTHING
    assert load_memory(path.with_name("robot.mem.1")) == MORE
    assert len(reported) == 1
    assert "robot.mem.1" in reported[0]


def test_of_one_run_the_first_memory_that_knew_more_is_kept(path, reported):
    path.write_bytes(bytes(MORE))
    saver = MemorySaver(path, MORE, reported.append)

    for memory in (NOTHING, SOME, NOTHING):
        saver.save(memory)

    assert load_memory(path.with_name("robot.mem.1")) == MORE
    assert len(reported) == 1


def test_what_was_learned_in_this_run_is_forgotten_without_a_word(path, reported):
    saver = MemorySaver(path, SOME, reported.append)
    saver.save(MORE)
    saver.save(SOME)
    assert reported == []


def test_a_memory_of_another_kind_that_knows_as_much_leaves_nothing_beside_it(path, reported):
    path.write_bytes(bytes(SOME))
    MemorySaver(path, SOME, reported.append).save(translated(SOME, MemoryKind.ALL_SENSORS))
    assert reported == []


@pytest.mark.parametrize("content", [b"\0\3\0\0\0\0\0\0", b"\0\1\5\0\0\0\0\0", b"\x1e" + b"\0" * 7])
def test_bytes_that_no_behaviour_writes_are_refused(path, content):
    path.write_bytes(content)
    with pytest.raises(UsageError, match=f"no behaviour writes {content.hex(' ')}"):
        load_memory(path)


def test_an_unchanged_memory_is_not_written(path, reported):
    saver = MemorySaver(path, None, reported.append)
    saver.save(SOME)
    path.unlink()

    saver.save(SOME)

    assert not path.exists()


def test_a_pipe_is_refused_at_once(path):
    os.mkfifo(path)

    with pytest.raises(UsageError, match="not a regular file"):
        load_memory(path)
