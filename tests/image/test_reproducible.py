"""An image depends on the sources, and not on the folder or the time in which it was built."""

import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
KINDS = {".elf", ".bin", ".hex"}
SOURCES = ("CMakeLists.txt", "CMakePresets.json", "firmware", "hal", "tools")


def built(folder: Path, preset: str) -> dict[str, bytes]:
    """Copies the sources into a folder and builds a preset's images there; their bytes by file name."""
    folder.mkdir(parents=True)
    for name in SOURCES:
        copy = shutil.copytree if (ROOT / name).is_dir() else shutil.copy
        copy(ROOT / name, folder / name)
    cantools = Path(sys.executable).parent / "cantools"
    for command in (["--preset", preset, f"-DCANTOOLS={cantools}"], ["--build", "--preset", preset]):
        subprocess.run(["cmake", *command], cwd=folder, check=True, capture_output=True)
    made = (folder / "build" / preset).glob("octet-*")
    return {path.name: path.read_bytes() for path in made if path.suffix in KINDS}


@pytest.mark.parametrize("preset", ["feather_stm32f405", "blue_pill", "nucleo_g431rb"])
def test_two_builds_from_different_folders_give_the_same_bytes(preset: str, tmp_path: Path) -> None:
    here = built(tmp_path / "here", preset)
    there = built(tmp_path / "a longer way" / "there", preset)

    assert {Path(name).suffix for name in here} == KINDS
    assert sorted(here) == sorted(there)
    assert [name for name in here if here[name] != there[name]] == []
