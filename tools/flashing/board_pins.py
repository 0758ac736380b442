"""The pins of a board: its signals, checked against what the chip's pins can be, for C and for people.

A board's file in hal/stm32/boards names a pin for each signal; `pins.toml` in its chip's folder, what a pin can be.
"""

import importlib
import re
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from tools.flashing import ChoiceError
from tools.flashing.images import ROOT, STM32, settings

_toml = importlib.import_module("tomllib" if sys.version_info >= (3, 11) else "tomli")

_PIN = re.compile(r"P([A-I])(\d+)")
_ALWAYS = ("LED", "CAN_RX", "CAN_TX", "UART_RX", "UART_TX")


@dataclass(frozen=True)
class Pins:
    """The pins of a board.

    Attributes:
        board: Its name.
        signals: The pin of each signal, such as PB8.
        functions: What the pin is used as, by signal, such as `CAN rx`; none for plain inputs and outputs.
        remap: The fields of AFIO_MAPR that go with it.
        channels: The channel of the ADC, by signal.
        led_high: Whether the LED shines while its pin is high.
    """

    board: str
    signals: dict[str, str]
    functions: dict[str, str]
    remap: int
    channels: dict[str, int]
    led_high: bool

    def header(self) -> str:
        """What board.h includes."""
        lines = [f"/* Generated from hal/stm32/boards/{self.board}.cmake. */"]
        for signal, pin in self.signals.items():
            port, number = _parts(pin)
            lines.append(f"static const struct pin BOARD_{signal} = {{PORT_{port}, {number}}};")
        lines += [f"enum {{ BOARD_{signal}_CHANNEL = {channel} }};" for signal, channel in self.channels.items()]
        lines += [f"enum {{ BOARD_REMAP = 0x{self.remap:X} }};"]
        lines += [f"static const bool BOARD_LED_HIGH = {str(self.led_high).lower()};   /* while it shines */"]
        return "\n".join(lines) + "\n"

    def table(self) -> str:
        """The wiring in Markdown."""
        lines = ["| signal | pin | as |", "| --- | --- | --- |"]
        for signal, pin in sorted(self.signals.items(), key=lambda row: _parts(row[1])):
            use = self.functions.get(signal, "input or output")
            lines.append(f"| {signal.lower().replace('_', ' ')} | {pin} | {use} |")
        return "\n".join(lines) + "\n"


def read_pins(board: str, root: Path = ROOT) -> Pins:
    """The pins of a board.

    Raises:
        ChoiceError: There is no such board, two signals have the same pin, or a pin cannot be what its signal needs.
    """
    path = root / STM32 / "boards" / f"{board}.cmake"
    if not path.exists():
        names = ", ".join(sorted(each.stem for each in path.parent.glob("*.cmake")))
        raise ChoiceError(f"no board {board}; there are {names}")
    given = {name.removeprefix("OCTET_"): value for name, value in settings(path).items()}
    chip = _Chip(board, given["CHIP"], root)
    signals = {name: pin for name, pin in given.items() if name in chip.signals or _PIN.fullmatch(pin)}
    for name in (name for name in _ALWAYS if name not in signals):
        raise ChoiceError(f"{board}: no pin for {name}")
    chip.check(signals)
    options = chip.options(signals)
    return Pins(
        board,
        signals,
        {name: use for name, use in chip.signals.items() if name in signals},
        sum(option.get("set", 0) << option.get("at", 0) for option in options),
        {name: chip.channels[pin] for name, pin in signals.items() if chip.signals.get(name) == "ADC"},
        given["LED_HIGH"] == "1",
    )


def _parts(pin: str) -> tuple[str, int]:
    return pin[1], int(pin[2:])


class _Chip:
    """What a chip's pins can be."""

    def __init__(self, board: str, name: str, root: Path) -> None:
        table: dict[str, Any] = _toml.loads((root / STM32 / name / "pins.toml").read_text())
        self._board, self._name = board, name
        self._all = {f"P{port}{n}" for port, count in table["ports"].items() for n in range(count)}
        self._all |= set(table.get("more", ()))
        self._reserved: dict[str, str] = table["reserved"]
        self._functions: dict[str, list[dict[str, Any]]] = table["functions"]
        self.signals: dict[str, str] = table["signals"]
        self.channels: dict[str, int] = table.get("channels", {})

    def check(self, signals: dict[str, str]) -> None:
        """Each signal has a pin of its own, which the chip has."""
        taken = dict(self._reserved)
        for signal, pin in signals.items():
            if pin not in self._all:
                raise ChoiceError(f"{self._board}: {signal} is on {pin}, which an {self._name} does not have")
            if pin in taken:
                raise ChoiceError(f"{self._board}: {taken[pin]} and {signal} are both on {pin}")
            taken[pin] = signal
            if self.signals.get(signal) == "ADC" and pin not in self.channels:
                raise ChoiceError(f"{self._board}: {signal} is on {pin}, which has no ADC on an {self._name}")

    def options(self, signals: dict[str, str]) -> list[dict[str, Any]]:
        """Where each function has its pins: all at one of the places that it can be."""
        wanted: dict[str, dict[str, str]] = {}
        for signal in (name for name, use in self.signals.items() if use != "ADC" and name in signals):
            function, role = self.signals[signal].split()
            wanted.setdefault(function, {})[role] = signal
        return [self._option(function, roles, signals) for function, roles in wanted.items()]

    def _option(self, function: str, roles: dict[str, str], signals: dict[str, str]) -> dict[str, Any]:
        wanted = [signals[name] for name in roles.values()]
        places = [[option[role] for role in roles] for option in self._functions[function]]
        if wanted not in places:
            raise ChoiceError(
                f"{self._board}: {' and '.join(f'{name} on {signals[name]}' for name in roles.values())}:"
                f" an {self._name} has {function} {', '.join(roles)} on {' or '.join(map(', '.join, places))}"
            )
        return self._functions[function][places.index(wanted)]
