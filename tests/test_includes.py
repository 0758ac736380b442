"""The layers of the C code: includes only go down, as `MAY_INCLUDE` allows."""

import re
import shutil
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent
INCLUDE = re.compile(r'^\s*#\s*include\s*"([^"]+)"', re.MULTILINE)

# For each file or folder, what may be included from elsewhere; the longest name that fits a file counts.
MAY_INCLUDE = {
    "firmware/": (),
    "firmware/main.c": ("hal/hal.h",),
    "hal/hal.h": ("firmware/io.h",),
    "hal/link/": (),
    "hal/protocol/": ("firmware/io.h", "hal/flash_store/crc32.h", "hal/link/link.h"),
    "hal/can_body/": ("firmware/io.h", "hal/hal.h", "hal/link/link.h", "hal/protocol/"),
    "hal/flash_store/": ("firmware/io.h", "hal/hal.h"),
    "hal/port/": ("firmware/io.h", "hal/hal.h", "hal/can_body/port.h", "hal/protocol/health.h"),
    "hal/port/cortex_m/": (
        *("hal/hal.h", "hal/can_body/port.h", "hal/flash_store/", "hal/link/"),
        "hal/protocol/health.h",
    ),
    "hal/stm32/": (
        *("hal/can_body/port.h", "hal/flash_store/", "hal/link/"),
        *("hal/pins_body/", "hal/port/"),
    ),
    "hal/rp2040/": ("hal/flash_store/", "hal/link/", "hal/pins_body/", "hal/port/"),
    "hal/rp2040/check_main.c": ("hal/hal.h", "hal/pins_body/pins.h", "hal/port/cortex_m/"),
    "hal/library/": ("firmware/", "hal/protocol/"),
    "hal/pins_body/": (
        "firmware/io.h",
        "firmware/motion/speed_control.h",
        "hal/hal.h",
        "hal/can_body/port.h",
        "hal/protocol/",
    ),
    "host_sim/world/native/": ("firmware/io.h", "firmware/motion/speed_control.h"),
    "host_sim/program/native/": ("firmware/", "hal/library/", "host_sim/world/native/trig.h"),
    "host_sim/sim/native/": (
        *("firmware/", "hal/flash_store/crc32.h", "hal/link/link.h", "hal/protocol/e2e.h"),
        "host_sim/world/native/",
    ),
}
FOLDERS = ("firmware", "hal", "host_sim/world/native", "host_sim/program/native", "host_sim/sim/native")
GENERATED = ("octet.h", "board_pins.h", "build_id.h", "robot_words.h")


def includes(root: Path) -> list[tuple[str, str]]:
    """Every include between our own files: the includer, and the included."""
    files = sorted(file for folder in FOLDERS for file in (root / folder).rglob("*.[ch]"))
    found = [
        (file.relative_to(root).as_posix(), name) for file in files for name in INCLUDE.findall(file.read_text())
    ]
    return [(file, name) for file, name in found if name not in GENERATED]


def own_folder(file: str) -> str:
    """The folder whose files may include each other, with the folders in it."""
    parts = file.split("/")
    return "/".join(parts[: {"firmware": 1, "hal": 2, "host_sim": 3}[parts[0]]]) + "/"


def goes_down(file: str, name: str) -> bool:
    fitting = [place for place in MAY_INCLUDE if file.startswith(place)]
    if not fitting:
        return False
    floor = max(fitting, key=len)
    folder = own_folder(file)
    return name.startswith((folder, *MAY_INCLUDE[floor])) or name == file


def upward(root: Path) -> set[tuple[str, str]]:
    return {arrow for arrow in includes(root) if not goes_down(*arrow)}


def test_c_files_include_only_lower_layers():
    assert upward(ROOT) == set()


def test_c_sources_have_includes_to_check():
    assert len(includes(ROOT)) > 50


PLANTED = [
    ("firmware/brain.c", "hal/hal.h"),
    ("firmware/main.c", "hal/link/link.h"),
    ("hal/hal.h", "firmware/robot.h"),
    ("hal/hal.h", "hal/link/link.h"),
    ("hal/link/slcan.c", "hal/protocol/wire.h"),
    ("hal/link/slcan.c", "firmware/io.h"),
    ("hal/protocol/crc8.c", "hal/can_body/port.h"),
    ("hal/can_body/can_body.c", "hal/port/posix/file_store.h"),
    ("hal/can_body/can_body.c", "firmware/robot.h"),
    ("hal/port/posix/posix_port.c", "firmware/robot.h"),
    ("hal/stm32/planted.c", "hal/hal.h"),
    ("hal/library/exchange.c", "hal/can_body/port.h"),
    ("hal/a_new_folder/planted.c", "hal/hal.h"),
    ("hal/protocol/crc8.c", "host_sim/world/native/world.h"),
    ("host_sim/world/native/world.c", "hal/protocol/wire.h"),
    ("host_sim/world/native/world.c", "firmware/robot.h"),
    ("host_sim/world/native/world.c", "hal/pins_body/inputs.h"),
    ("host_sim/world/native/world.c", "host_sim/sim/native/loop.h"),
    ("host_sim/sim/native/loop.c", "hal/library/exchange.h"),
    ("host_sim/program/native/machine.c", "host_sim/sim/native/loop.h"),
]


@pytest.mark.parametrize("arrow", PLANTED, ids=" ".join)
def test_include_that_goes_up_or_across_is_found(arrow, tmp_path):
    for folder in FOLDERS:
        shutil.copytree(ROOT / folder, tmp_path / folder)
    file = tmp_path / arrow[0]
    file.parent.mkdir(exist_ok=True)
    with file.open("a") as text:
        text.write(f'\n#  include "{arrow[1]}"\n')

    assert upward(tmp_path) == {arrow}
