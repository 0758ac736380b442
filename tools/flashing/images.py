"""Boards, and the images that are built for them."""

import re
import shutil
import subprocess
from dataclasses import dataclass
from pathlib import Path

from host_sim.emulator.board_pins import STM32, settings
from tools.flashing import ChoiceError, FlashError

ROOT = Path(__file__).resolve().parents[2]
_IDENTITY = re.compile(rb"octet-image board=(\S+) chip=(\S+) node=(\d+) bitrate=(\d+) version=(\S+) dbc=(\w+)\0")


@dataclass(frozen=True)
class Board:
    """A board that we build for.

    Attributes:
        name: Name of the board, of its file in hal/stm32/boards, and of its CMake preset.
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
    for path in sorted((root / STM32 / "boards").glob("*.cmake")):
        chip = settings(path)["OCTET_CHIP"]
        made = settings(root / STM32 / chip / "chip.cmake")
        links = f"{made['OCTET_LINKS']} {made.get('OCTET_BODIES', '')}"
        boards[path.stem] = Board(path.stem, chip, tuple(links.split()))
    return boards


def node_max(root: Path = ROOT) -> int:
    """The highest node number in the protocol."""
    found = re.search(r"^node_max = (\d+)", (root / "hal" / "protocol" / "robot.toml").read_text(), re.MULTILINE)
    assert found is not None
    return int(found[1])


def choose_board(name: str, boards: dict[str, Board]) -> Board:
    """The board of that name.

    Raises:
        FlashError: There is no such board.
    """
    if name not in boards:
        raise ChoiceError(f"no board {name}; there are {', '.join(boards)}")
    return boards[name]


def build(board: Board, link: str, node: int, bitrate: int, root: Path = ROOT) -> Path:
    """Builds the image for a board and a link, in a separate folder: the usual images stay as they are.

    Raises:
        FlashError: The board has no such link, or the build fails.
    """
    if link not in board.links:
        raise ChoiceError(f"no link {link} on {board.name}; there are {', '.join(board.links)}")
    folder = root / "build" / "flash" / board.name
    cache = folder / "CMakeCache.txt"
    newest_s = max((path.stat().st_mtime for path in (root / "tools/cmake").glob("*.cmake")), default=0.0)
    if cache.exists() and cache.stat().st_mtime < newest_s:
        shutil.rmtree(folder)  # CMake takes nothing new from a toolchain into a folder that it has configured
    settings = [f"-DOCTET_NODE={node}", f"-DOCTET_CAN_BITRATE={bitrate}"]
    for command in (["--preset", board.name, "-B", str(folder), *settings], ["--build", str(folder)]):
        done = subprocess.run(["cmake", *command], cwd=root, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise FlashError(f"cmake {' '.join(command)} failed; run it to see why")
    return folder / f"octet-{board.name}-{link}.elf"


def identify(path: Path, board: Board) -> Image:
    """Reads the information built into an image.

    Raises:
        FlashError: It cannot be read, is not an Octet image, or is for another board.
    """
    try:
        found = _IDENTITY.search(path.read_bytes())
    except OSError as error:
        raise ChoiceError(f"{path}: {error.strerror}") from error
    if found is None:
        raise ChoiceError(f"{path} is not an Octet image")
    image = Image(path, *(part.decode() for part in found.groups()))
    if image.board != board.name:
        raise ChoiceError(f"{path} is for {image.board}, not for {board.name}")
    return image
