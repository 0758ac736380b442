"""The pins of a board, checked against the pin functions of its chip: for C, documentation and emulation.

A board's file in the folder `boards` of its family names a pin for each signal; `pins.toml` in its chip's folder has
the functions of pins.
"""

import re
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from host_sim.base.errors import UsageError
from host_sim.base.paths import ROOT
from host_sim.base.toml_file import parse_toml

HAL = Path("hal")
"""The folder of the families of chips, relative to the root."""

ADC = "ADC"
"""Function of an analogue input."""

_SET = re.compile(r"^set\((\w+) ([^)]*)\)", re.MULTILINE)
_PIN = re.compile(r"P([A-I])(\d+)|GP(\d+)")
_ALWAYS = ("LED", "UART_RX", "UART_TX")
_CAN = ("CAN_RX", "CAN_TX")


def settings(path: Path) -> dict[str, str]:
    """The variables that a CMake file sets."""
    return dict(_SET.findall(path.read_text()))


def place_of(pin: str) -> tuple[int, int]:
    """Port number (0 for A, or if there is only one) and pin number of a pin."""
    return 0 if pin.startswith("GP") else ord(pin[1]) - ord("A"), int(pin[2:])


def board_files(root: Path = ROOT) -> dict[str, Path]:
    """The file of each board."""
    return {path.stem: path for path in sorted((root / HAL).glob("*/boards/*.cmake"), key=lambda path: path.stem)}


class ChipPins:
    """The functions of a chip's pins.

    Attributes:
        signals: The pin function of each signal, such as `CAN rx`; plain inputs and outputs are omitted.
        channels: The ADC channel of each pin that has one.
        wiring: By part, the terminals of signals that end elsewhere than on other boards.
    """

    def __init__(self, name: str, root: Path = ROOT) -> None:
        """Reads a chip's pin table."""
        path = next(it for pattern in ("", "*/") for it in (root / HAL).glob(f"{pattern}{name}/pins.toml"))
        table = parse_toml(path.read_text())
        self.name = name
        self._all = {f"P{port}{n}" for port, count in table.get("ports", {}).items() for n in range(count)}
        self._all |= set(table.get("more", ()))
        self._reserved: dict[str, str] = table["reserved"]
        self._functions: dict[str, list[dict[str, Any]]] = table["functions"]
        self.signals: dict[str, str] = table["signals"]
        self.channels: dict[str, int] = table.get("channels", {})
        self.wiring: dict[str, dict[str, str]] = table.get("wiring", {})

    def check(self, signals: dict[str, str]) -> None:
        """Checks that each signal has a pin of its own that the chip has.

        Raises:
            UsageError: A pin is missing, shared or unsuitable.
        """
        taken = dict(self._reserved)
        for signal, pin in signals.items():
            if pin not in self._all:
                raise UsageError(f"{signal} is on {pin}, which an {self.name} does not have")
            if pin in taken:
                raise UsageError(f"{taken[pin]} and {signal} are both on {pin}")
            taken[pin] = signal
            if self.signals.get(signal) == ADC and pin not in self.channels:
                raise UsageError(f"{signal} is on {pin}, which has no ADC on an {self.name}")

    def remap(self, signals: dict[str, str]) -> int:
        """The AFIO_MAPR fields that route each function to its pins, all of them in one of its mappings.

        0 for chips whose pins select their functions themselves.

        Raises:
            UsageError: No mapping of a function has these pins.
        """
        wanted: dict[tuple[str, str], dict[str, str]] = {}
        for signal in (name for name, use in self.signals.items() if use != ADC and name in signals):
            function, role = self.signals[signal].split()
            together = "" if "at" in self._functions[function][0] else role
            wanted.setdefault((function, together), {})[role] = signal
        return sum(self._remap(function, roles, signals) for (function, _), roles in wanted.items())

    def pin_of(self, use: str, mapr: int) -> str | None:
        """The pin to which AFIO_MAPR routes a function such as `CAN rx`; None if there is none."""
        function, role = use.split()
        options = self._functions[function]
        width = max(option["set"] for option in options).bit_length()
        for option in options:
            if mapr >> option["at"] & (1 << width) - 1 == option["set"]:
                pin: str | None = option.get(role)
                return pin
        return None

    def function_of(self, use: str, pin: str) -> int | None:
        """The alternate function number that makes a pin, for example, `CAN rx`; None if there is none.

        0 for chips without such numbers.
        """
        function, role = use.split()
        return next((option.get("af", 0) for option in self._functions[function] if option.get(role) == pin), None)

    def _remap(self, function: str, roles: dict[str, str], signals: dict[str, str]) -> int:
        wanted = [signals[name] for name in roles.values()]
        options = [option for option in self._functions[function] if all(role in option for role in roles)]
        places = [[option[role] for role in roles] for option in options]
        if wanted not in places:
            given = " and ".join(f"{name} on {signals[name]}" for name in roles.values())
            there = " or ".join(dict.fromkeys(map(", ".join, places)))
            raise UsageError(f"{given}: an {self.name} has {function} {', '.join(roles)} on {there}")
        option = options[places.index(wanted)]
        return int(option.get("set", 0)) << int(option.get("at", 0))


@dataclass(frozen=True)
class Pins:
    """The pins of a board.

    Attributes:
        board: Name of the board.
        signals: The pin of each signal, such as PB8.
        chip: The pin functions of its chip.
        remap: The AFIO_MAPR fields for these pins.
        led_high: Whether the LED is on while its pin is high.
        headers: Pin labels of the board's two headers, top to bottom; empty if unknown.
        top: What is at the top end of the board; empty for nothing.
        ends: By signal, the component and terminal at the far end of the wire, for a robot with a body on pins.
    """

    board: str
    signals: dict[str, str]
    chip: ChipPins
    remap: int
    led_high: bool
    headers: list[list[str]]
    top: str
    ends: dict[str, tuple[str, str]]

    @property
    def channels(self) -> dict[str, int]:
        """The ADC channel of each analogue signal."""
        return {
            name: self.chip.channels[pin] for name, pin in self.signals.items() if self.chip.signals.get(name) == ADC
        }

    def header(self) -> str:
        """The contents of the header that gpio.h includes."""
        lines = [f"/* Generated from the board's file, {self.board}.cmake. */"]
        numbers: dict[str, object] = {}
        for signal, pin in self.signals.items():
            port, number = place_of(pin)
            numbers[signal] = f"0x{port:X}{number:X}"
            if self.chip.signals.get(signal, ADC) != ADC:
                numbers[f"{signal}_FUNCTION"] = self.chip.function_of(self.chip.signals[signal], pin)
        numbers |= {f"{signal}_CHANNEL": channel for signal, channel in self.channels.items()}
        numbers |= {"REMAP": f"0x{self.remap:X}", "LED_HIGH": int(self.led_high)}
        lines += [f"enum {{ BOARD_{name} = {number} }};" for name, number in numbers.items()]
        return "\n".join(lines) + "\n"

    def table(self) -> str:
        """The wiring table in Markdown."""
        lines = ["| signal | pin | as | goes to |", "|---|---|---|---|"]
        for signal, pin in sorted(self.signals.items(), key=lambda row: place_of(row[1])):
            use = self.chip.signals.get(signal, "GPIO")
            end = ": ".join(self.ends.get(signal, ("",)))
            lines.append(f"| {signal.lower().replace('_', ' ')} | {pin} | {use} | {end} |")
        return "\n".join(lines) + "\n"


def _ends(root: Path, chip: ChipPins) -> dict[str, tuple[str, str]]:
    parts = parse_toml((root / "hal" / "pins_body" / "wiring.toml").read_text())
    return {
        signal: (part, end)
        for table in (parts, chip.wiring)
        for part, ends in table.items()
        for signal, end in ends.items()
    }


def read_pins(board: str, root: Path = ROOT) -> Pins:
    """Reads the pins of a board, by its name or its file.

    Raises:
        UsageError: There is no such board, two signals share a pin, or a pin lacks the function of its signal.
    """
    files = board_files(root)
    path = Path(board) if board.endswith(".cmake") else files.get(board, Path(f"{board}.cmake"))
    board = path.stem
    if not path.exists():
        raise UsageError(f"no board {board}; there are {', '.join(files)}")
    given = {name.removeprefix("OCTET_"): value for name, value in settings(path).items()}
    chip = ChipPins(given["CHIP"], root)
    signals = {name: pin for name, pin in given.items() if name in chip.signals or _PIN.fullmatch(pin)}
    try:
        needed = (*_ALWAYS, *(name for name in _CAN if name in chip.signals))
        for name in (name for name in needed if name not in signals):
            raise UsageError(f"no pin for {name}")
        chip.check(signals)
        headers = [given[f"HEADER_{number}"].strip('"').split() for number in (1, 2) if f"HEADER_{number}" in given]
        top = given.get("HEADER_END", "").strip('"')
        remap, led_high = chip.remap(signals), given["LED_HIGH"] == "1"
        return Pins(board, signals, chip, remap, led_high, headers, top, _ends(root, chip))
    except UsageError as error:
        raise UsageError(f"{board}: {error}") from None
