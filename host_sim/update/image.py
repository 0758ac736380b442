"""Signed images: one program for each of two slots, in one file."""

import struct
import time
import zlib
from dataclasses import dataclass
from pathlib import Path

from host_sim.base.errors import OctetError, UsageError
from host_sim.base.paths import BUILD
from host_sim.update.keys import Ed25519PrivateKey

HEADER = struct.Struct("<8sIIIBBBx12s28s")
"""Magic, size, CRC-32, version, format, slot, layout, chip, board."""

SIGNATURE = 64
SLOTS = 2
_MAGIC, _FORMAT, _VECTORS, _PIECE, _CRC_FROM = b"OCTETIMG", 1, 256, 64, 16
_BLANK = b"\xff"


@dataclass(frozen=True)
class Layout:
    """The division of a chip's flash.

    Attributes:
        number: Number of the layout, as in `struct layout`.
        chip: Name of the chip, such as `stm32f103`.
        boot: End of the boot loader, bytes from the start of the flash.
        slots: Start of each slot, likewise.
        slot_bytes: Size of a slot.
        page: Size of an erase unit.
        link: The link of its CAN controller.
    """

    number: int
    chip: str
    boot: int
    slots: tuple[int, int]
    slot_bytes: int
    page: int
    link: str = "bxcan"


_F405 = Layout(1, "stm32f405", 0x4000, (0x20000, 0x40000), 0x20000, 0x20000)
LAYOUTS = {
    "blue_pill": Layout(2, "stm32f103", 0x4000, (0x4000, 0x9800), 0x5800, 1024),
    "feather_stm32f405": _F405,
    "olimex_stm32_h405": _F405,
    "nucleo_g431rb": Layout(1, "stm32g431", 0x5000, (0x5000, 0x11000), 0xC000, 2048, "fdcan"),
}
"""Of each board that has a boot loader, as hal/stm32 has them."""


@dataclass(frozen=True)
class SlotImage:
    """The content of one slot: header, program, signature.

    Attributes:
        data: The bytes of all three.
        slot: 0 or 1.
        version: Its version number; later ones are higher.
        board: Name of its board.
    """

    data: bytes
    slot: int
    version: int
    board: str

    @property
    def header(self) -> bytes:
        """Its first 64 bytes."""
        return self.data[: HEADER.size]

    @property
    def size(self) -> int:
        """Bytes up to the signature."""
        return len(self.data) - SIGNATURE


def sign(program: bytes, board: str, slot: int, version: int, key: Ed25519PrivateKey) -> SlotImage:
    """Puts a header in front of a program and a signature behind it.

    Args:
        program: The program as in flash, from its vectors on.
        board: Name of the board, such as `blue_pill`.
        slot: The slot for which it was linked, 0 or 1.
        version: 0..2^32 - 1.
        key: Key of the signer.

    Raises:
        UsageError: The board has no boot loader, or the program does not fit.
    """
    if board not in LAYOUTS:
        raise UsageError(f"no boot loader for {board}; there is one for {', '.join(LAYOUTS)}")
    layout = LAYOUTS[board]
    size = -(-(_VECTORS + len(program)) // _PIECE) * _PIECE
    if size + SIGNATURE > layout.slot_bytes:
        raise UsageError(f"the program is too long for its slot: {len(program)} bytes")
    body = (_BLANK * (_VECTORS - HEADER.size) + program).ljust(size - HEADER.size, _BLANK)

    def header(crc: int) -> bytes:
        names = layout.chip.encode(), board.encode()
        return HEADER.pack(_MAGIC, size, crc, version, _FORMAT, slot, layout.number, *names)

    text = header(zlib.crc32(header(0)[_CRC_FROM:] + body)) + body
    return SlotImage(text + key.sign(text), slot, version, board)


def read_image(data: bytes) -> SlotImage:
    """Reads one signed image; its signature is the board's to check.

    Raises:
        UsageError: It is not an image, or was cut short.
    """
    if len(data) < HEADER.size or not data.startswith(_MAGIC):
        raise UsageError("not an Octet image: it has no Octet header")
    _, size, crc, version, number, slot, _, _, board = HEADER.unpack_from(data)
    if number != _FORMAT or slot >= SLOTS or len(data) < size + SIGNATURE:
        raise UsageError("the image was cut short, or its header is damaged")
    data = data[: size + SIGNATURE]
    if zlib.crc32(data[_CRC_FROM:size]) != crc:
        raise UsageError("the image is damaged: its CRC is wrong")
    return SlotImage(data, slot, version, board.rstrip(b"\0").decode("ascii", "replace"))


def read_file(path: Path) -> dict[int, SlotImage]:
    """Reads an update: an image for each slot, one after the other.

    Raises:
        UsageError: It cannot be read, or is not an update.
    """
    try:
        data = path.read_bytes()
    except OSError as error:
        raise UsageError(f"cannot read {path}: {error.strerror}") from error
    images: dict[int, SlotImage] = {}
    try:
        while data:
            image = read_image(data)
            images[image.slot] = image
            data = data[len(image.data) :]
    except UsageError as error:
        raise UsageError(f"{path}: {error}") from error
    if len({(image.board, image.version) for image in images.values()}) != 1 or len(images) != SLOTS:
        raise UsageError(f"{path} is not an update: an update has an image for each slot")
    return images


def built_images(board: str, link: str, version: int, key: Ed25519PrivateKey) -> list[SlotImage]:
    """Signs the images that were built for a board, one for each slot.

    Raises:
        UsageError: The board has no boot loader.
        OctetError: It is not built.
    """
    images = []
    for slot, letter in enumerate("ab"):
        path = BUILD / board / f"octet-{board}-{link}-{letter}.bin"
        try:
            program = path.read_bytes()
        except OSError as error:
            raise OctetError(f"the image {path} is not built: run tools/setup images") from error
        images.append(sign(program, board, slot, version, key))
    return images


def version_now() -> int:
    """A version that is higher than all before: seconds since 1970."""
    return int(time.time())
