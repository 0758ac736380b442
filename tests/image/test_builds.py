"""An image depends on the sources, and not on the folder or the time in which it was built.

The port in examples/port_mps2, for a machine that is no STM32: QEMU judges it, by the host's frames.

A board outside the tree.
"""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from host_sim.base.errors import OctetError
from host_sim.client.connection import Connection
from host_sim.sim.qemu import Qemu
from tests.image.support import run_robot
from tests.runs.support import REFERENCE, first_difference, record
from tools.flashing.images import all_boards, built, identify, node_max

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
def test_build_in_another_folder_gives_the_same_bytes(preset: str, tmp_path: Path) -> None:
    there = tmp_path / "a longer way" / "there"

    build(there, preset)

    here, built = images(ROOT, preset), images(there, preset)
    assert len({Path(name).suffix for name in built} & KINDS) == 3
    assert [name for name in built if built[name] != here.get(name)] == []


PORT = ROOT / "examples/port_mps2"
TICKS, LINES = 300, 32


@pytest.fixture(scope="module")
def image(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The port's image, built as docs/porting.md says."""
    build = tmp_path_factory.mktemp("port")
    core = ROOT / "tools/cmake/cortex-m3.cmake"
    setup = ("-G", "Ninja", f"-DCMAKE_TOOLCHAIN_FILE={core}", f"-DOCTET_PORT={PORT}", "-DOCTET_WERROR=ON")
    kind = ("-DCMAKE_BUILD_TYPE=MinSizeRel", "-DBUILD_TESTING=OFF")
    subprocess.run(("cmake", "-S", ROOT, "-B", build, *setup, *kind), check=True, stdout=subprocess.DEVNULL)
    subprocess.run(("cmake", "--build", build, "--target", "octet-mps2"), check=True, stdout=subprocess.DEVNULL)
    return build / "octet-mps2.elf"


def test_port_in_qemu_answers_like_the_host(image, tmp_path):
    logs = [tmp_path / "host.log", tmp_path / "port.log"]
    record(REFERENCE, 1, TICKS, logs[0])
    qemu = Qemu(image, "mps2-an385")
    try:
        run_robot(Connection(qemu.link, "mps2", qemu.status, pid=qemu.pid, deadline_s=60.0), 1, TICKS, logs[1])
    finally:
        qemu.close()

    assert first_difference(*logs) is None


def test_port_has_at_most_32_lines():
    lines = [
        line.strip()
        for name in ("mcu.c", "mps2.ld")
        for line in (PORT / name).read_text().splitlines()
        if line.strip() and not line.startswith("/*")
    ]

    assert len(lines) <= LINES


@pytest.mark.parametrize("core", ["cortex-m0", "cortex-m0plus", "cortex-m3", "cortex-m4", "cortex-m33"])
def test_cortex_m_sources_compile_for_every_core(core, image, tmp_path):
    built_id = ROOT / "hal/port/cortex_m/build_id.c"  # the text of an image, from its own definitions
    sources = sorted({*(ROOT / "hal/port/cortex_m").glob("*.c")} - {built_id})
    compiler = ("arm-none-eabi-gcc", "-std=c99", "-Wall", "-Wextra", "-Werror", "-Os", "-mthumb", f"-mcpu={core}")
    options = ("-I", ROOT, "-I", image.parent / "generated", "-DOCTET_NODE=1", "-c")
    subprocess.run((*compiler, *options, *sources), cwd=tmp_path, check=True)


FOREIGN_LINES = re.compile(r"^(cmake .*)$", re.MULTILINE)


def test_board_in_a_separate_folder_is_built(tmp_path):
    boards, made = tmp_path / "my boards", tmp_path / "made"
    boards.mkdir()
    text = (ROOT / "hal/stm32/boards/blue_pill.cmake").read_text()
    (boards / "mine.cmake").write_text(text.replace("OCTET_LED PC13", "OCTET_LED PC14"))
    page = (ROOT / "docs/porting.md").read_text()
    (configure,) = (line for line in FOREIGN_LINES.findall(page) if "OCTET_BOARD_DIR" in line)
    words = configure.replace("build/mine", str(made)).split()
    words = [word.replace("my_boards", str(boards)) for word in words]

    subprocess.run(words, cwd=ROOT, check=True, capture_output=True)
    subprocess.run(["cmake", "--build", made, "--target", "octet-mine-slcan"], check=True, capture_output=True)

    assert "BOARD_LED = 0x2E" in (made / "generated/mine/board_pins.h").read_text()
    assert b"board=mine chip=stm32f103" in (made / "octet-mine-slcan.bin").read_bytes()


def test_image_is_built_for_a_node_and_a_bit_rate() -> None:
    board = all_boards()["nucleo_g431rb"]  # builds of one board share a folder

    with built(board, "fdcan", node_max(), 125_000) as path:
        image = identify(path, board)

    assert (image.node, image.bitrate) == (str(node_max()), "125000")


def test_node_beyond_the_protocol_is_refused() -> None:
    board = all_boards()["feather_stm32f405"]
    with pytest.raises(OctetError, match="NODE_IS_IN_RANGE"), built(board, "bxcan", node_max() + 1, 500_000):
        pass
