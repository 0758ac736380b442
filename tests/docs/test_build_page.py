"""docs/build.md: its drawings and its table are those of the board, and its beacon sends what the robot sees."""

import math
import operator
import re
import runpy
import sys
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import pytest

from host_sim.base.errors import UsageError
from host_sim.emulator.board_pins import read_pins
from tools.drawings import draw_plate, draw_wiring, dxf_of, write_drawings
from tools.flashing.images import ROOT
from tools.schematic import MECHANICAL, read_robot


@pytest.mark.parametrize("board", ["blue_pill", "pico"])
def test_drawings_match_the_board(board: str, tmp_path: Path) -> None:
    drawn = write_drawings(read_pins(board), tmp_path)

    for path in drawn:
        if path.suffix == ".svg":
            assert path.read_text() == (ROOT / "docs/images" / path.name).read_text()


def test_tables_of_the_pages_match_the_pins_and_the_wiring() -> None:
    robot, text = read_robot(read_pins("pico")), (ROOT / "docs/build.md").read_text()

    assert read_pins("blue_pill").table() in (ROOT / "docs/hardware.md").read_text()
    assert robot.shopping() in text
    assert robot.wiring() in text


def test_parts_list_counts_each_part_of_the_wiring() -> None:
    robot = read_robot(read_pins("pico"))
    needed = {part for ends in robot.wires.values() for part, _, _ in (end.partition(".") for end in ends)}
    numbers = [int(n) for n in re.findall(r"^\| (\d+) \|", robot.shopping(), re.MULTILINE)]

    mechanical = [part for part, kind in robot.parts.items() if kind in MECHANICAL]
    assert sum(numbers) == len(needed) + len(mechanical) == len(robot.parts)


@pytest.mark.parametrize(
    ("old", "new", "why"),
    [
        ('"diode.cathode pico.VSYS"', '"diode.cathode"', "the wire VSYS ends nowhere"),
        ('button = "button"\n', "", "the wire GND goes to button, which is not among the parts"),
        ("gate.1", "gate.2", "gate.2 has two wires, infrared and gate"),
        ('bulk = "capacitor 470 uF"', 'bulk = "capacitor 470 uF"\nspare = "diode"', "spare has no wire"),
        ('beacon = "board.BEACON receiver.OUT"', "", "BEACON, GP13 of the pico, has no wire"),
    ],
    ids=["one end", "no part", "short circuit", "loose part", "open pin"],
)
def test_wiring_mistake_is_refused_by_name(tmp_path: Path, old: str, new: str, why: str) -> None:
    text = (ROOT / "hal/rp2040/boards/pico.toml").read_text()
    assert old in text
    path = tmp_path / "robot.toml"
    path.write_text(text.replace(old, new, 1))

    with pytest.raises(UsageError, match=re.escape(why)):
        read_robot(read_pins("pico"), path)


def test_board_without_a_parts_list_gets_only_a_wiring_drawing(tmp_path: Path) -> None:
    drawn = write_drawings(replace(read_pins("pico"), board="mine"), tmp_path)

    assert [path.name for path in drawn if path.name.startswith("mine")] == ["mine-wiring.svg"]


def test_wiring_drawing_labels_each_signal_that_leaves_the_board() -> None:
    pins = read_pins("blue_pill")
    texts = re.findall("<text[^>]*>([^<]*)</text>", draw_wiring(pins))

    for signal in pins.signals.keys() - {"LED"}:
        assert ": ".join(pins.ends[signal]) in texts
    assert len(texts) == 1 + len(pins.ends) + 40


def test_board_without_known_headers_is_not_drawn() -> None:
    with pytest.raises(UsageError, match=r"nucleo_g431rb: its file .* does not say"):
        draw_wiring(read_pins("nucleo_g431rb"))


def test_plate_holes_lie_on_the_plate_without_overlap() -> None:
    radius = 95.0
    for upper in (False, True):
        text = draw_plate(upper=upper)
        holes = [tuple(map(float, found)) for found in re.findall(r'cx="(.*?)" cy="(.*?)" r="(.*?)"', text)]
        assert len(holes) == (16 if upper else 4)
        for number, (x, y, r) in enumerate(holes):
            assert math.hypot(x, y) + r < radius - 3
            assert all(math.dist((x, y), (u, v)) > r + s + 3 for u, v, s in holes[:number])


def entities(dxf: str) -> list[tuple[str, dict[int, float]]]:
    """The shapes of a DXF file, with their values by group code."""
    lines = dxf.splitlines()
    pairs = list(zip(lines[::2], lines[1::2], strict=True))
    assert pairs[:2] == [("0", "SECTION"), ("2", "ENTITIES")]
    assert pairs[-2:] == [("0", "ENDSEC"), ("0", "EOF")]
    found: list[tuple[str, dict[int, float]]] = []
    for code, value in pairs[2:-2]:
        if code == "0":
            found.append((value, {}))
        else:
            found[-1][1][int(code)] = float(value)
    return found


def ends_of(kind: str, of: dict[int, float]) -> list[tuple[float, float]]:
    """Where a line or an arc begins and ends, mm."""
    if kind == "LINE":
        return [(of[10], of[20]), (of[11], of[21])]
    turns = [math.radians(of[code]) for code in (50, 51)]
    return [(of[10] + of[40] * math.cos(turn), of[20] + of[40] * math.sin(turn)) for turn in turns]


def test_dxf_plate_has_all_holes_and_closed_outlines() -> None:
    for upper, holes, slots in ((False, 4, 6), (True, 16, 0)):
        cut = entities(dxf_of(draw_plate(upper=upper)))
        ends = [end for kind, of in cut if kind != "CIRCLE" for end in ends_of(kind, of)]

        assert [kind for kind, _ in cut].count("CIRCLE") == holes + upper
        assert len(ends) == 2 * (4 * slots + (0 if upper else 8))
        assert all(sum(math.dist(one, other) < 0.02 for other in ends) == 2 for one in ends)
        assert max([of.get(40, 0) for _, of in cut] + [math.hypot(*end) for end in ends]) == pytest.approx(
            95, abs=0.01
        )
        assert [of[20] for kind, of in cut if of.get(40) == 4] == ([40, -45] if upper else [])  # the front is up


class StoppedError(Exception):
    """The test of the beacon has run long enough."""


def test_beacon_sends_four_strong_and_four_weak_bursts_per_tick(monkeypatch: pytest.MonkeyPatch) -> None:
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
