"""A little fuzzing of each part; `python -m tests.proof.fuzz` does more."""

import pytest

from tests.proof import fuzz
from tests.proof.parts import FUZZED, HERE

FEW = "-runs=20000"


@pytest.mark.parametrize("name", FUZZED)
def test_no_input_does_harm(name, tmp_path):
    program = fuzz.build(name, [HERE / f"{name}.c", *FUZZED[name]], tmp_path)

    ended = fuzz.fuzz(program, FEW)

    assert ended.returncode == 0, ended.stderr
    assert "Done 20000 runs" in ended.stderr


@pytest.mark.parametrize(
    ("body", "found"),
    [
        ("static int table[4]; if (any_u8() == 77) table[any_u8()] = 1;", "out of bounds"),
        ("int sum = 2147483640; sum += any_u8();", "signed integer overflow"),
        ("while (any_u8() != 9) ;", "timeout"),
    ],
)
def test_what_can_go_wrong_is_found(body, found, tmp_path, monkeypatch):
    monkeypatch.setattr(fuzz, "TIMEOUT_S", 1)
    canary = tmp_path / "canary.c"
    canary.write_text(f'#include "tests/proof/any.h"\nvoid exercise(void)\n{{\n{body}\n}}\n')

    ended = fuzz.fuzz(fuzz.build("canary", [canary], tmp_path), FEW)

    assert ended.returncode != 0
    assert found in ended.stderr
    assert list(tmp_path.glob("*-*"))


@pytest.mark.parametrize(
    "fault",
    [
        "if (kind == INPUT_PEER) robot->brain.memory.cell[1] = SIDE_LEFT;",
        "if (kind == INPUT_SENSES && !robot->running) out->drive.right_mm_s = 1;",
    ],
)
def test_what_a_robot_must_not_do_in_a_session_is_found(fault, tmp_path):
    planted = tmp_path / "planted.c"
    parameters = "(struct robot *robot, enum input_kind kind, const struct input *in, struct output *out)"
    planted.write_text(
        '#include "firmware/robot.h"\n'
        f"void __real_robot_respond{parameters};\nvoid __wrap_robot_respond{parameters};\n"
        f"void __wrap_robot_respond{parameters}\n{{\n__real_robot_respond(robot, kind, in, out);\n{fault}\n}}\n"
    )
    sources = [HERE / "session.c", planted, *FUZZED["session"]]

    ended = fuzz.fuzz(fuzz.build("session", sources, tmp_path, ["-Wl,--wrap=robot_respond"]), FEW)

    assert ended.returncode != 0
    assert "deadly signal" in ended.stderr
