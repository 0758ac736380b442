"""The port in examples/port_mps2, for a machine that is no STM32: QEMU judges it, by the host's frames."""

import subprocess
from pathlib import Path

import pytest

from host_sim.base.paths import ROOT
from host_sim.client.connection import Connection
from host_sim.sim.qemu import Qemu
from tests.image.support import run_robot
from tests.runs.equality import REFERENCE, first_difference, record

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


def test_the_port_answers_in_qemu_as_the_host_does(image, tmp_path):
    logs = [tmp_path / "host.log", tmp_path / "port.log"]
    record(REFERENCE, 1, TICKS, logs[0])
    qemu = Qemu(image, "mps2-an385")
    try:
        run_robot(Connection(qemu.link, "mps2", qemu.status, pid=qemu.pid, deadline_s=60.0), 1, TICKS, logs[1])
    finally:
        qemu.close()

    assert first_difference(*logs) is None


def test_the_port_is_short():
    lines = [
        line.strip()
        for name in ("mcu.c", "mps2.ld")
        for line in (PORT / name).read_text().splitlines()
        if line.strip() and not line.startswith("/*")
    ]

    assert len(lines) <= LINES


@pytest.mark.parametrize("core", ["cortex-m0", "cortex-m0plus", "cortex-m3", "cortex-m4", "cortex-m33"])
def test_what_every_cortex_m_has_compiles_for_each_core(core, image, tmp_path):
    built_id = ROOT / "hal/port/cortex_m/build_id.c"  # the text of an image, from its own definitions
    sources = sorted({*(ROOT / "hal/port/cortex_m").glob("*.c")} - {built_id})
    compiler = ("arm-none-eabi-gcc", "-std=c99", "-Wall", "-Wextra", "-Werror", "-Os", "-mthumb", f"-mcpu={core}")
    options = ("-I", ROOT, "-I", image.parent / "generated", "-DOCTET_NODE=1", "-c")
    subprocess.run((*compiler, *options, *sources), cwd=tmp_path, check=True)
