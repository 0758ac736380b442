"""Which stage runs which Python tests; those that no stage names are the stage python's."""

from collections.abc import Mapping, Sequence
from pathlib import Path

TEST: Mapping[str, Sequence[str]] = {
    "web": ("tests/web",),
}
"""Of tools/test, beside python."""

PROVE: Mapping[str, Sequence[str]] = {
    "boards": (
        "tests/image",
        "tests/lab/study/test_emulated_board.py",
        "tests/tools/test_build_environment.py",
    ),
    "eva": ("tests/proof/test_proof.py", "tests/proof/test_contracts.py"),
    "fuzz": ("tests/proof/test_fuzz.py", "tests/proof/test_readers.py"),
    "misra": ("tests/tools/test_misra.py",),
    "mutants": ("tests/tools/test_mutate.py", "tests/tools/test_equivalent_mutants.py"),
    "coverage": ("tests/tools/test_coverage.py", "tests/tools/test_python_coverage.py"),
    "campaign": ("tests/lab/campaign",),
    "endurance": ("tests/runs/endurance",),
    "browsers": ("tests/web/test_browsers.py",),
    "exhaustive": ("tests/firmware/test_every_case.py", "tests/talk/test_every_answer.py"),
    "formats": ("tests/lab/export",),
    "documents": ("tests/docs/test_commands.py", "tests/docs/test_python_blocks.py"),
}
"""Of tools/prove."""

PROVE_ON_VCAN = ("boards", "campaign")
"""The stages of tools/prove with tests that need vcan0."""


def named() -> list[str]:
    """All that some stage names."""
    return [path for places in (TEST, PROVE) for paths in places.values() for path in paths]


def with_vcan_tests(root: Path) -> list[str]:
    """The files of python's with tests that need vcan0: loading all the others takes long in a kernel of its own."""
    files = (path.relative_to(root).as_posix() for path in sorted(root.glob("tests/**/test_*.py")))
    python = (path for path in files if not any(f"{path}/".startswith(f"{own}/") for own in named()))
    return [path for path in python if "pytest.mark.vcan" in (root / path).read_text()]


def deep() -> tuple[str, ...]:
    """All that a stage of tools/prove names."""
    return tuple(path for paths in PROVE.values() for path in paths)
