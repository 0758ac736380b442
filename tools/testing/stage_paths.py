"""The Python tests of each stage; the stage python runs those that no other stage names."""

from collections.abc import Mapping
from pathlib import Path

PROVE: Mapping[str, tuple[str, ...]] = {
    "web": ("tests/web", "tests/report/test_laboratory.py"),
    "boards": (
        "tests/image",
        "tests/lab/study/test_emulated_board.py",
        "tests/tools/test_build_environment.py",
    ),
    "documents": ("tests/docs/test_commands.py",),
    "campaign": ("tests/lab/campaign",),
    "browsers": ("tests/web/lab/test_school_screens.py", "tests/web/test_browsers.py"),
    "coverage": ("tests/tools/test_coverage.py",),
    "judges": tuple(
        f"tests/judges/test_{name}.py"
        for name in ("calibrate", "check_wiring", "closed_loop", "pico", "pico_pins", "starts")
    ),
    "studies": ("tests/lab/study",),
    "eva": ("tests/proof/test_proof.py",),
    "mutants": ("tests/tools/test_mutate.py",),
    "wheels": ("tests/wheel",),
    "misra": ("tests/tools/test_misra.py",),
    "exhaustive": ("tests/firmware/test_every_case.py", "tests/talk/test_every_answer.py"),
    "fuzz": ("tests/proof/test_fuzz.py",),
    "endurance": ("tests/runs/endurance",),
    "formats": ("tests/lab/export",),
}
"""The tests of each stage of tools/prove, the longest first: short ones at the end leave no core idle for long."""

QUICK = ("studies", "web")
"""The stages of tools/prove that tools/test --quick runs as well, if a change concerns their tests."""

PROVE_ON_VCAN = (*PROVE["boards"], *PROVE["campaign"])
"""The parts of tools/prove with tests that need vcan0."""


def named() -> list[str]:
    """All paths that a stage of tools/prove names."""
    return [path for paths in PROVE.values() for path in paths]


def of_stage(name: str) -> list[str]:
    """The pytest arguments of a stage of tools/prove, which leave out what other stages name within it."""
    within = (path for path in named() if path not in PROVE[name] and path.startswith(PROVE[name]))
    return [*PROVE[name], *(f"--ignore={path}" for path in within)]


def is_of(name: str, test: str) -> bool:
    """Whether a test file belongs to a stage of tools/prove."""
    return test.startswith(PROVE[name]) and f"--ignore={test}" not in of_stage(name)


def with_vcan_tests(root: Path) -> list[str]:
    """The files of stage python with tests that need vcan0: in User-Mode Linux, loading all the others takes long."""
    files = (path.relative_to(root).as_posix() for path in sorted(root.glob("tests/**/test_*.py")))
    python = (path for path in files if not any(f"{path}/".startswith(f"{own}/") for own in named()))
    return [path for path in python if "pytest.mark.vcan" in (root / path).read_text()]
