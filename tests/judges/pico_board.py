"""A Raspberry Pi Pico in rp2040js that runs only as long as a test tells it."""

from pathlib import Path

from host_sim.base.paths import image_path
from host_sim.sim.pico import SteppedPico
from tests.judges.labwired_board import Frame

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
