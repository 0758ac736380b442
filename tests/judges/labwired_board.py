"""Boards in LabWired, a third-party emulator: its chips, and communication with images.

LabWired clocks SysTick by the core even where the image chose an eighth of that clock: in STM32F1, F4 and G4 its
CLKSOURCE = 0 means HCLK/8 (PM0056 4.5.1, PM0214 4.5.1). With a core clock of an eighth its time is right, and
computing takes 8 times as long. A chip with fewer peripherals is twice as fast.

It differs from the manuals in other ways, too, which are not judged there: flash writes land as in RAM and erases
do nothing (PM0075, RM0090 3, RM0440 5); bxCAN sends in no time, never fails and has no FIFO 1 (RM0008 24); FDCAN and
the independent watchdog are missing; a UART takes 9 cycles a byte and has no overrun (RM0008 27). Its pytest plug-in,
which would turn an exception into a skip, is switched off.
"""

import re
from collections.abc import Mapping
from pathlib import Path
from typing import NamedTuple

import labwired

from host_sim.base.paths import image_path
from host_sim.sim.pico import SteppedPico

_LEAN = {
    *("rcc", "gpioa", "gpiob", "gpioc", "systick", "uart1"),
    *("afio", "flash_ctrl", "pwr", "iwdg", "bxcan1", "nvic"),
}
_CONFIGS = Path(labwired.__file__).parent / "configs"
_BXCAN = """  - id: "bxcan1"
    type: "bxcan"
    base_address: 0x40006400
    size: "1KB"
    clock: { reg: "apb1enr", bit: 25 }
"""
_STEP, _STEPS_MAX = "50us", 2000


class Kind(NamedTuple):
    """A chip of LabWired's that can run the images of one of our boards.

    Attributes:
        name: Its name there.
        core_hz: The core clock that the images set.
        more: A peripheral that its description lacks.
        lean: Whether to leave out what only a stand-alone robot needs.
        divisor: Of the core clock, to what SysTick counts on the chip.
    """

    name: str
    core_hz: int
    more: str = ""
    lean: bool = False
    divisor: int = 8


KINDS: Mapping[str, Kind] = {
    "blue_pill": Kind("stm32f103", 72_000_000, lean=True),
    "feather_stm32f405": Kind("stm32f405", 168_000_000, more=_BXCAN),
    "nucleo_g431rb": Kind("stm32g474re", 80_000_000),
    "pico": Kind("rp2040", 125_000_000, divisor=1),
}
INPUTS: Mapping[str, tuple[str, int]] = {
    "bumper_left": ("gpiob", 10), "bumper_right": ("gpiob", 11), "button": ("gpiob", 0), "fault": ("gpiob", 12),
}  # fmt: skip
"""Contacts of a stand-alone robot, open: at a high level."""
STAND_ALONE = ("pins", "mute", "body")
"""Images of robots with sensors and motors on pins."""


def write_system(board: str, folder: Path, memories: Mapping[str, int] = {}, *, alone: bool = False) -> str:
    """Writes LabWired's description of a board.

    Args:
        board: One of `KINDS`.
        folder: The folder to write to.
        memories: Peripherals that are plain memory, for a harness to be that hardware, by their addresses.
        alone: Whether it is a stand-alone robot, which needs timers and more, and has `INPUTS`.
    """
    kind = KINDS[board]
    text = (_CONFIGS / f"chips/{kind.name}.yaml").read_text().replace('"../peripherals', f'"{_CONFIGS}/peripherals')
    text, count = re.subn(r"(?m)^cpu_hz: [\d_]+", f"cpu_hz: {kind.core_hz // kind.divisor}", text)
    assert count == 1, "LabWired describes chips in another format now"
    head, rest = text.split("peripherals:\n", 1)
    blocks = re.split(r"(?m)^(?=  - id:)", re.split(r"(?m)^(?:# Regular ADC|analog_pins:)", rest)[0])
    named = {match[1]: block for block in blocks if (match := re.match(r'  - id: "(\w+)"', block))}
    kept = (
        block for name, block in named.items() if name not in memories and (name in _LEAN or alone or not kind.lean)
    )
    if memories:
        rows = (f'  - name: "{name}"\n    base: {base:#x}\n    size: "1KB"\n' for name, base in memories.items())
        head += "memory_regions:\n" + "".join(rows)
    (folder / "chip.yaml").write_text(head + "peripherals:\n" + "".join(kept) + kind.more)
    pins = "".join(
        f'  - id: "{name}"\n    kind: "button"\n    peripheral: "{port}"\n    pin: {pin}\n    signal: "input"\n'
        "    active_high: true\n"
        for name, (port, pin) in INPUTS.items()
    )
    system = folder / "system.yaml"
    board_io = f"\n{pins}" if alone else " []\n"
    system.write_text(f"name: judged\nchip: {folder}/chip.yaml\nexternal_devices: []\nboard_io:{board_io}")
    return str(system)


class Frame(NamedTuple):
    """A frame on the bus."""

    id: int
    data: bytes


class Board:
    """A board in LabWired that runs an image of ours.

    Attributes:
        sim: LabWired's simulation.
    """

    def __init__(self, board: str, link: str, folder: Path, memories: Mapping[str, int] = {}) -> None:
        """Prepares the image at power-up; arguments as for `write_system`."""
        alone = link in STAND_ALONE
        self.sim = labwired.Sim(
            str(image_path(board, link)), system=write_system(board, folder, memories, alone=alone)
        )
        for contact in INPUTS if alone else ():
            self.sim.set_pin(contact, True)
        self._serial = link == "slcan"
        self._begun, self._seen = b"", 0

    def flash(self, address: int, data: bytes) -> None:
        """Writes to the flash, as a probe does."""
        for at in range(0, len(data), 4):
            self.sim.write_u32(address + at, int.from_bytes(data[at : at + 4], "little"))

    def listen(self, span: str) -> list[Frame]:
        """What it sends in a time of its own."""
        self.sim.run_for(span)
        return self._lines() if self._serial else self._sent()

    def ask(self, frame: Frame, count: int, span: str = "") -> list[Frame]:
        """What it sends after a frame: in a time of its own, or until it has sent as many frames as expected."""
        if self._serial:
            self.sim.send_bytes(f"t{frame.id:03X}{len(frame.data)}{frame.data.hex().upper()}\r".encode())
        else:
            self.sim.inject_can("bxcan1", frame.id, frame.data)
        heard = self.listen(span or _STEP)
        for _ in range(0 if span else _STEPS_MAX):
            heard += self.listen(_STEP) if len(heard) < count else []
        return heard

    def _lines(self) -> list[Frame]:
        *lines, self._begun = (self._begun + self.sim.read_uart_bytes()).split(b"\r")
        texts = [line.decode("ascii") for line in lines]
        return [Frame(int(text[1:4], 16), bytes.fromhex(text[5:])) for text in texts]

    def _sent(self) -> list[Frame]:
        new = [it for it in self.sim.frames() if it["seq"] > self._seen]
        self._seen = new[-1]["seq"] if new else self._seen
        said = (it["payload"] for it in new if it["payload"].get("direction") == "tx")
        return [Frame(it["id"], bytes(it["data"])) for it in said]


_BOOT_S = 0.2
_STEP_S = 0.002
FLASH_SIZE = 2 << 20
SECTOR = 4096
STORE = 0x1FE000
"""Of two sectors, at the end of the flash."""


def flash_of(store: bytes = b"", link: str = "slcan") -> bytes:
    """What is in the flash: an image as it is built, and a store."""
    image = image_path("pico", link).with_suffix(".bin").read_bytes()
    return (image.ljust(STORE, b"\xff") + store).ljust(FLASH_SIZE, b"\xff")


class PicoBoard:
    """The board, at power-up; as `labwired_board.Board`, and as an emulated board of ours to `support.Talk`."""

    def __init__(self, folder: Path, *options: str, flash: bytes | None = None) -> None:
        path = folder / "flash.bin"
        path.write_bytes(flash_of() if flash is None else flash)
        self._pico = SteppedPico(path, *options)

    def order(self, *words: object) -> str:
        """Gives the harness an order; returns its answer."""
        return self._pico.order(" ".join(map(str, words)))[0]

    def send(self, frame: Frame) -> None:
        """Puts a frame on its line."""
        self._pico.send(frame)

    def pass_time(self, span_s: float) -> list[Frame]:
        """What it says in a time of its own."""
        self.order("run", round(span_s * 1e6))
        heard, self._pico.said = self._pico.said, []
        return [Frame(frame.id, frame.data) for frame in heard]

    def boot(self) -> list[Frame]:
        """What it says until it has started; it may erase a sector of its store first."""
        heard: list[Frame] = []
        for _ in range(round(_BOOT_S / _STEP_S)):
            heard += self.pass_time(_STEP_S)
            if heard:
                return heard
        raise AssertionError("it does not start")

    def listen(self, span: str) -> list[Frame]:
        """The same, with a time such as 20ms."""
        return self.pass_time(float(span.removesuffix("ms")) / 1000)

    def ask(self, frame: Frame, count: int, span: str = "") -> list[Frame]:
        """What it says to a frame: in a time of its own, or until it has said as much as is expected."""
        self.send(frame)
        heard: list[Frame] = self.listen(span) if span else []
        while not span and len(heard) < count:
            heard += self.listen("0.2ms")
        return heard

    def close(self) -> None:
        """Ends it."""
        self._pico.close()
