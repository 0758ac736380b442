"""A little fuzzing of each part; `python -m tests.proof.fuzz` does more."""

import pytest

from tests.proof import fuzz
from tests.proof.parts import HERE, PARTS

FEW = "-runs=20000"


@pytest.mark.parametrize("name", PARTS)
def test_no_input_does_harm(name, tmp_path):
    program = fuzz.build(name, [HERE / f"{name}.c", *PARTS[name]], tmp_path)

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
