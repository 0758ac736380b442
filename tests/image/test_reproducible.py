"""An image depends on the sources, and not on the folder or the time in which it was built."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
KINDS = {".elf", ".bin", ".hex", ".uf2"}
SOURCES = ("CMakeLists.txt", "CMakePresets.json", "firmware", "hal", "tools")


def images(folder: Path, preset: str) -> dict[str, bytes]:
    """The bytes of what was built for a preset, by file name."""
    made = (folder / "build" / preset).glob("octet-*")
    return {path.name: path.read_bytes() for path in made if path.suffix in KINDS}


def build(folder: Path, preset: str) -> None:
    """Copies the sources into a folder and builds a preset's images there; images name the commit they are of."""
    folder.mkdir(parents=True)
    for name in SOURCES:
        copy = shutil.copytree if (ROOT / name).is_dir() else shutil.copy
        copy(ROOT / name, folder / name)
    cantools = Path(sys.executable).parent / "cantools"
    repository = {**os.environ, "GIT_DIR": str(ROOT / ".git"), "GIT_WORK_TREE": str(ROOT)}
    for command in (["--preset", preset, f"-DCANTOOLS={cantools}"], ["--build", "--preset", preset]):
        subprocess.run(["cmake", *command], cwd=folder, env=repository, check=True, capture_output=True)


@pytest.mark.parametrize("preset", ["feather_stm32f405", "blue_pill", "nucleo_g431rb", "pico"])
def test_a_build_from_another_folder_gives_the_same_bytes(preset: str, tmp_path: Path) -> None:
    there = tmp_path / "a longer way" / "there"

    build(there, preset)

    here, built = images(ROOT, preset), images(there, preset)
    assert len({Path(name).suffix for name in built} & KINDS) == 3
    assert [name for name in built if built[name] != here.get(name)] == []
