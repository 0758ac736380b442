"""tools/pins: valid pin assignments of a board, and refused ones."""

import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from host_sim.base.errors import UsageError
from host_sim.emulator.board_pins import HAL, read_pins
from tools.flashing.images import ROOT, all_boards


@pytest.fixture
def root(tmp_path: Path) -> Path:
    """A copy of the files about boards and chips."""
    for path in (
        *(ROOT / HAL).glob("*/boards/*.cmake"),
        *(ROOT / HAL).rglob("pins.toml"),
        ROOT / "hal/pins_body/wiring.toml",
    ):
        copy = tmp_path / path.relative_to(ROOT)
        copy.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(path, copy)
    return tmp_path


def change(root: Path, old: str, new: str) -> None:
    path = root / HAL / "stm32" / "boards" / "blue_pill.cmake"
    text = path.read_text()
    assert old in text
    path.write_text(text.replace(old, new))


@pytest.mark.parametrize("board", sorted(all_boards()))
def test_board_has_pins_that_its_chip_has(board: str) -> None:
    assert len(read_pins(board).signals) >= 3


def test_blue_pill_has_the_pins_of_a_robot() -> None:
    pins = read_pins("blue_pill")
    assert pins.remap == 2 << 13 | 1 << 8
    assert pins.channels["BATTERY"] == 5
    assert pins.chip.pin_of("TIM1 ch3n", pins.remap) == pins.signals["RIGHT_PWM"]
    assert pins.chip.pin_of("CAN rx", 0) == "PA11"


@pytest.mark.parametrize(
    ("old", "new", "why"),
    [
        ("(OCTET_BUTTON PB0)", "(OCTET_BUTTON PB10)", "BUMPER_LEFT and BUTTON are both on PB10"),
        ("(OCTET_BUTTON PB0)", "(OCTET_BUTTON PA13)", "SWDIO and BUTTON are both on PA13"),
        ("(OCTET_BUTTON PB0)", "(OCTET_BUTTON PC1)", "BUTTON is on PC1, which an stm32f103 does not have"),
        ("(OCTET_BATTERY PA5)", "(OCTET_BATTERY PB2)", "BATTERY is on PB2, which has no ADC"),
        (
            "(OCTET_CAN_RX PB8)",
            "(OCTET_CAN_RX PB4)",
            "CAN_RX on PB4 and CAN_TX on PB9: an stm32f103 has CAN rx, tx on PA11, PA12 or PB8, PB9",
        ),
        (
            "(OCTET_RIGHT_ENCODER_A PB6)",
            "(OCTET_RIGHT_ENCODER_A PB4)",
            "RIGHT_ENCODER_A on PB4 and RIGHT_ENCODER_B on PB7: an stm32f103 has TIM4 ch1, ch2 on PB6, PB7",
        ),
        ("(OCTET_LED PC13)", "(OCTET_LED 13)", "no pin for LED"),
    ],
)
def test_impossible_pins_are_refused_by_name(root: Path, old: str, new: str, why: str) -> None:
    change(root, old, new)
    with pytest.raises(UsageError) as refused:
        read_pins("blue_pill", root)
    assert why in str(refused.value)


def test_refused_board_gets_no_header(root: Path, tmp_path: Path) -> None:
    change(root, "(OCTET_BUTTON PB0)", "(OCTET_BUTTON PB10)")
    header = tmp_path / "board_pins.h"
    done = subprocess.run(
        [sys.executable, ROOT / "tools/pins", "blue_pill", "--root", root, "--c", header],
        capture_output=True,
        text=True,
        check=False,
    )
    assert (done.returncode, done.stderr.count("\n"), header.exists()) == (2, 1, False)


@pytest.mark.parametrize("option", ["--c", "--drawings"])
def test_unwritable_output_is_refused_in_one_line(option: str) -> None:
    command = [sys.executable, ROOT / "tools/pins", "blue_pill", option, ROOT / "README.md/a"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)

    assert (done.returncode, done.stderr.count("\n")) == (2, 1)
    assert f"cannot write {ROOT / 'README.md'}" in done.stderr
