"""tools/pins: what a board's pins can be, and what is refused."""

import math
import operator
import re
import runpy
import shutil
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

import pytest

from host_sim.base.errors import UsageError
from host_sim.emulator.board_pins import STM32, read_pins
from tools.drawings import draw_plate, draw_wiring, write_drawings
from tools.flashing.images import ROOT, all_boards


@pytest.fixture
def root(tmp_path: Path) -> Path:
    """A copy of what is known of boards and chips."""
    for path in (
        *(ROOT / STM32).glob("boards/*.cmake"),
        *(ROOT / STM32).glob("*/pins.toml"),
        ROOT / "hal/pins_body/wiring.toml",
    ):
        copy = tmp_path / path.relative_to(ROOT)
        copy.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(path, copy)
    return tmp_path


def change(root: Path, old: str, new: str) -> None:
    path = root / STM32 / "boards" / "blue_pill.cmake"
    text = path.read_text()
    assert old in text
    path.write_text(text.replace(old, new))


@pytest.mark.parametrize("board", sorted(all_boards()))
def test_each_board_has_pins_that_its_chip_has(board: str) -> None:
    assert len(read_pins(board).signals) >= 5


def test_a_blue_pill_is_a_robot() -> None:
    pins = read_pins("blue_pill")
    assert pins.remap == 2 << 13 | 1 << 8
    assert pins.channels["BATTERY"] == 5
    assert pins.chip.pin_of("TIM1 ch3n", pins.remap) == pins.signals["RIGHT_PWM"]
    assert pins.chip.pin_of("CAN rx", 0) == "PA11"


@pytest.mark.parametrize(
    ("old", "new", "why"),
    [
        ("(OCTET_BUTTON PA8)", "(OCTET_BUTTON PB10)", "BUMPER_LEFT and BUTTON are both on PB10"),
        ("(OCTET_BUTTON PA8)", "(OCTET_BUTTON PA13)", "SWDIO and BUTTON are both on PA13"),
        ("(OCTET_BUTTON PA8)", "(OCTET_BUTTON PC1)", "BUTTON is on PC1, which an stm32f103 does not have"),
        ("(OCTET_BATTERY PA5)", "(OCTET_BATTERY PB2)", "BATTERY is on PB2, which has no ADC"),
        (
            "(OCTET_CAN_RX PB8)",
            "(OCTET_CAN_RX PA11)",
            "CAN_RX on PA11 and CAN_TX on PB9: an stm32f103 has CAN rx, tx on PA11, PA12 or PB8, PB9",
        ),
        (
            "(OCTET_RIGHT_ENCODER_A PB6)",
            "(OCTET_RIGHT_ENCODER_A PB4)",
            "RIGHT_ENCODER_A on PB4 and RIGHT_ENCODER_B on PB7: an stm32f103 has TIM4 ch1, ch2 on PB6, PB7",
        ),
        ("(OCTET_LED PC13)", "(OCTET_LED 13)", "no pin for LED"),
    ],
)
def test_pins_that_cannot_be_are_refused_by_name(root: Path, old: str, new: str, why: str) -> None:
    change(root, old, new)
    with pytest.raises(UsageError) as refused:
        read_pins("blue_pill", root)
    assert why in str(refused.value)


def test_a_board_that_is_refused_is_not_built(root: Path, tmp_path: Path) -> None:
    change(root, "(OCTET_BUTTON PA8)", "(OCTET_BUTTON PB10)")
    header = tmp_path / "board_pins.h"
    done = subprocess.run(
        [ROOT / "tools/pins", "blue_pill", "--root", root, "--c", header], capture_output=True, text=True, check=False
    )
    assert (done.returncode, done.stderr.count("\n"), header.exists()) == (2, 1, False)


def test_the_wiring_in_the_documents_is_that_of_the_board() -> None:
    assert read_pins("blue_pill").table() in (ROOT / "docs" / "hardware.md").read_text()


def test_the_pictures_and_the_table_in_the_documents_are_those_of_the_board(tmp_path: Path) -> None:
    pins = read_pins("blue_pill")

    drawn = write_drawings(pins, tmp_path)

    assert pins.table() in (ROOT / "docs/hardware.md").read_text()
    assert {path.name: path.read_text() for path in drawn} == {
        path.name: (ROOT / "docs/images" / path.name).read_text() for path in drawn
    }


def test_the_wiring_shows_where_each_signal_ends_but_those_that_stay_on_the_board() -> None:
    pins = read_pins("blue_pill")
    texts = re.findall("<text[^>]*>([^<]*)</text>", draw_wiring(pins))

    for signal in pins.signals.keys() - {"LED"}:
        assert ": ".join(pins.ends[signal]) in texts
    assert len(texts) == 1 + len(pins.ends) + 40


def test_a_board_whose_headers_are_not_known_is_not_drawn() -> None:
    with pytest.raises(UsageError, match=r"nucleo_g431rb: its file .* does not say"):
        draw_wiring(read_pins("nucleo_g431rb"))


def test_what_the_plates_hold_is_on_them_and_not_in_each_other_s_way() -> None:
    radius = 95.0
    for upper in (False, True):
        text = draw_plate(upper=upper)
        holes = [tuple(map(float, found)) for found in re.findall(r'cx="(.*?)" cy="(.*?)" r="(.*?)"', text)]
        assert len(holes) == (16 if upper else 4)
        for number, (x, y, r) in enumerate(holes):
            assert math.hypot(x, y) + r < radius - 3
            assert all(math.dist((x, y), (u, v)) > r + s + 3 for u, v, s in holes[:number])


class StoppedError(Exception):
    """The time of the beacon's test is over."""


def test_a_beacon_sends_four_strong_and_four_weak_bursts_in_a_tick(monkeypatch: pytest.MonkeyPatch) -> None:
    now_us, begun, lengths = 7, [], []

    class FakePwm:
        def __init__(self, pin: int, freq: int, duty_u16: int) -> None:
            assert (freq, duty_u16) == (38000, 0)
            self.pin = pin

        def duty_u16(self, duty: int) -> None:
            if duty:
                begun.append((now_us, self.pin))
            else:
                lengths.append(now_us - begun[-1][0])

    def sleep(us: int) -> None:
        nonlocal now_us
        now_us += us + 3  # the program itself takes time
        if now_us > 100_000:
            raise StoppedError

    clock = {"ticks_us": lambda: now_us, "ticks_add": operator.add, "ticks_diff": operator.sub}
    monkeypatch.setitem(sys.modules, "machine", SimpleNamespace(PWM=FakePwm, Pin=int))
    monkeypatch.setitem(sys.modules, "time", SimpleNamespace(sleep_us=sleep, **clock))
    with pytest.raises(StoppedError):
        runpy.run_path(str(ROOT / "examples/beacon/beacon.py"))

    ticks = [[pin for at, pin in begun if start <= at < start + 20_000] for start in range(20_000, 80_000, 20_000)]
    assert ticks == [[14, 15] * 4] * 3
    assert set(lengths) == {603}
