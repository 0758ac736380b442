"""Changes as a person writes them."""

import pytest

from host_sim.base.errors import UsageError
from host_sim.world.changes import Change, read_changes


@pytest.mark.parametrize(
    ("text", "change"),
    [
        ("plant@120s", Change("plant", None, 120.0)),
        ("plant:2000,1500@0.5s", Change("plant:2000,1500", None, 0.5)),
        ("grow@env2+20s", Change("grow", 2, 20.0)),
        ("grow:15@env2", Change("grow:15", 2, 0.0)),
        ("swap-motors@env6", Change("swap-motors", 6)),
        ("swap-motors@env6/2", Change("swap-motors", 6, 0.0, 2)),
        ("stuck-on:front-left@7s", Change("stuck-on:front-left", None, 7.0)),
        ("noise:10/1000@env1+3.25s/31", Change("noise:10/1000", 1, 3.25, 31)),
        ("weak-motor:left:60%@1s", Change("weak-motor:left:60%", None, 1.0)),
    ],
)
def test_a_change_is_read_and_written(text, change):
    assert Change.parse(text) == change
    assert str(change) == text


@pytest.mark.parametrize(
    ("text", "meant"),
    [
        ("plnat@120s", "did you mean plant?"),
        ("swap@env6", "choose from plant, grow, swap-motors"),
        ("swap-motor@env6", "did you mean swap-motors?"),
        ("plant@120", "write NAME@120s, NAME@env6 or NAME@env6+20s"),
        ("plant@", "write NAME@120s"),
        ("@5s", "write NAME@120s"),
        ("plant@environment6", "write NAME@120s"),
        ("plant@-5s", "write NAME@120s"),
        ("plant @5s", "write NAME@120s"),
        ("plant:5@5s", "write plant, or plant:X,Y for a place in mm"),
        ("grow:big@5s", "write grow, or grow:MM for so many mm"),
        ("stuck-on:nose@5s", "write stuck-on:SENSOR"),
        ("plant@5s/2", "only what happens to a body is for one robot"),
        ("mirror@env0", "environments and robots are counted from 1"),
        ("mirror@5s/0", "environments and robots are counted from 1"),
    ],
)
def test_a_mistake_is_named_with_what_was_meant(text, meant):
    with pytest.raises(UsageError) as raised:
        Change.parse(text)

    assert str(raised.value).startswith(f"{text!r} is not a change: {meant}")


SCHEDULE = """\
# A day in the life of a robot.
plant@120s

  swap-motors@env6   # somebody was at the plugs
"""


@pytest.mark.parametrize("form", ["{}", "@{}"])
def test_a_file_has_a_change_in_each_line(tmp_path, form):
    path = tmp_path / "changes.txt"
    path.write_text(SCHEDULE)

    assert read_changes(form.format(path)) == ["plant@120s", "swap-motors@env6"]


def test_a_word_with_an_at_is_a_change():
    assert read_changes("plant@120.0s") == ["plant@120s"]


def test_a_mistake_in_a_file_is_named_with_its_line(tmp_path):
    path = tmp_path / "changes.txt"
    path.write_text(SCHEDULE + "grwo@5s\n")

    with pytest.raises(UsageError) as raised:
        read_changes(str(path))

    assert str(raised.value) == f"{path}:5: 'grwo@5s' is not a change: did you mean grow?"


def test_what_is_neither_a_change_nor_a_file_is_refused():
    with pytest.raises(UsageError, match=r"'plant' is neither a change nor a file of changes .*: write NAME@120s"):
        read_changes("plant")


def test_a_file_that_is_not_text_is_refused(tmp_path):
    (tmp_path / "changes").write_bytes(b"\xff\xfe")

    with pytest.raises(UsageError, match="is not text"):
        read_changes(str(tmp_path / "changes"))
