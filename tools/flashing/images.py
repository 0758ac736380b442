"""Boards, and the images that are built for them."""

import os
import re
import subprocess
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

from host_sim.base.errors import OctetError, UsageError
from host_sim.base.image_build import alone_in, build_image, complaints
from host_sim.emulator.board_pins import HAL, board_files, settings

ROOT = Path(__file__).resolve().parents[2]
_IDENTITY = re.compile(rb"octet-image board=(\S+) chip=(\S+) node=(\d+) bitrate=(\d+) version=(\S+) dbc=(\w+)\0")


@dataclass(frozen=True)
class Board:
    """A board that we build for.

    Attributes:
        name: Name of the board, of its file in hal/*/boards, and of its CMake preset.
        chip: Such as stm32f405.
        links: Its images: one for each link of its chip, such as bxcan or slcan, and those that drive pins.
    """

    name: str
    chip: str
    links: tuple[str, ...]


@dataclass(frozen=True)
class Image:
    """An image, and the information built into it.

    Attributes:
        path: The .elf file; .bin and .hex lie beside it.
        board: The board that it was built for.
        chip: The board's chip.
        node: The robot's node number on the bus.
        bitrate: Bus bit rate of its build, bit/s; of no use on a serial line.
        version: Version, from `git describe`.
        dbc: Hash of the protocol.
    """

    path: Path
    board: str
    chip: str
    node: str
    bitrate: str
    version: str
    dbc: str


def all_boards(root: Path = ROOT) -> dict[str, Board]:
    """Every board by its name."""
    boards = {}
    for name, path in board_files(root).items():
        made = settings(path)
        chip = made["OCTET_CHIP"]
        for file in (root / HAL).glob(f"*/{chip}/chip.cmake"):
            made |= settings(file)
        links = f"{made['OCTET_LINKS']} {made.get('OCTET_BODIES', '')}"
        boards[name] = Board(name, chip, tuple(links.split()))
    return boards


def node_max(root: Path = ROOT) -> int:
    """The highest node number in the protocol."""
    found = re.search(r"^node_max = (\d+)", (root / "hal" / "protocol" / "robot.toml").read_text(), re.MULTILINE)
    assert found is not None
    return int(found[1])


def choose_board(name: str, boards: dict[str, Board]) -> Board:
    """The board of that name.

    Raises:
        OctetError: There is no such board.
    """
    if name not in boards:
        raise UsageError(f"no board {name}; there are {', '.join(boards)}")
    return boards[name]


@contextmanager
def built(  # noqa: PLR0913 - what is built, and what is built into it
    board: Board, link: str, node: int, bitrate: int, root: Path = ROOT, *, own: Path | None = None
) -> Iterator[Path]:
    """Builds the image for a board and a link, in a separate folder: the usual images stay as they are.

    Until the context ends, no other process builds one for this board: it might be for another node.

    With a user's behaviour in C, that drives a simulated robot for a minute first, in a process that checks it.

    Raises:
        OctetError: The board has no such link, the behaviour makes a mistake, or the build fails.
    """
    if link not in board.links:
        what = f"no image {link} for {board.name}" if link else f"name an image for {board.name} after it"
        raise UsageError(f"{what}; there are {', '.join(board.links)}")
    if own is not None:
        try_out(own, root)
    folder, image = root / "build" / "flash" / board.name, f"octet-{board.name}-{link}"
    settings = [f"-DOCTET_NODE={node}", f"-DOCTET_CAN_BITRATE={bitrate}"]
    settings += [f"-DOCTET_OWN_BRAIN={own.resolve() if own else ''}"]
    with alone_in(folder):
        done = build_image(board.name, folder, *settings, target=image, root=root)
        if done.returncode != 0:
            raise OctetError(f"{image} cannot be built:\n{complaints(done)}")
        yield folder / f"{image}.elf"


def try_out(own: Path, root: Path = ROOT) -> None:
    """Runs a user's behaviour; what is wrong with it is on standard error.

    Raises:
        OctetError: It is not a behaviour, or makes a mistake.
    """
    with TemporaryDirectory() as out:
        words = ["--profile", os.fspath(own), "--environments", "1", "--limit-s", "60", "--quiet", "--out", out]
        if subprocess.run([root / "tools" / "run", *words], check=False).returncode != 0:
            raise UsageError(f"{own} is not flashed: it has to drive a simulated robot for a minute first")


def identify(path: Path, board: Board) -> Image:
    """Reads the information built into an image.

    Raises:
        OctetError: It cannot be read, is not an Octet image, or is for another board.
    """
    try:
        found = _IDENTITY.search(path.read_bytes())
    except OSError as error:
        raise UsageError(f"{path}: {error.strerror}") from error
    if found is None:
        raise UsageError(f"{path} is not an Octet image")
    image = Image(path, *(part.decode() for part in found.groups()))
    if image.board != board.name:
        raise UsageError(f"{path} is for {image.board}, not for {board.name}")
    return image
