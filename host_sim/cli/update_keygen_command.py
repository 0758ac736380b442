"""`tools/octet update` and `tools/octet keygen`: new firmware over the bus, and the key for signing it."""

import argparse
import sys
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from host_sim.backends.images import BOARDS
from host_sim.base.errors import UsageError
from host_sim.cli.parsing import Subparsers, add_command, number
from host_sim.cli.run_options import add_option

if TYPE_CHECKING:
    from rich.progress import Progress

    from host_sim.update.hub import Share
    from host_sim.update.image import SlotImage
    from host_sim.update.keys import Ed25519PrivateKey
    from host_sim.update.status import Status
    from host_sim.update.updater import Updater

    Images = dict[int, SlotImage] | None

_LAST_NODE = 31
_BITRATES = (125_000, 250_000, 500_000, 1_000_000)
_EXAMPLES = """\
examples:
  tools/octet update blue_pill --bus socketcan:can0                   sign the built image and send it to node 1
  tools/octet update out/robot.octet --bus socketcan:can0 --node 1-3  send a signed image to three robots
  tools/octet update blue_pill --key my.pem --save out/robot.octet    only sign it
  tools/octet update --bus socketcan:can0 --node 1 --set-node 7       give robot 1 the number 7
docs/update.md describes the process, and what happens if power is lost.
"""
_KEY_EXAMPLES = """\
example: tools/octet keygen my.pem
Keep that file: boards with its public key accept only images signed with it.
"""


def add(commands: Subparsers) -> None:
    """Adds the command."""
    parser = add_command(
        commands,
        "update",
        _update,
        summary="update the firmware of robots over the bus",
        description="Sends firmware over the bus to the inactive slot of robots, starts it, and reports what runs.\n"
        "Needs the boot loader on the board, and robots that nobody is driving.\n"
        "Several robots are updated at once. Run the same command again to resume an interrupted update.\n"
        "Exit code 2 if a robot did not take the update; it keeps its old firmware.",
        epilog=_EXAMPLES,
        check=_check,
        stages=lambda arguments: ["images" if arguments.image in BOARDS else "update"],
    )
    add_ = parser.add_argument
    add_(
        "image",
        nargs="?",
        metavar="IMAGE",
        help="signed image from --save; or a board, such as blue_pill, to sign its built image",
    )
    add_("--bus", metavar="BUS", help="any bus of python-can: INTERFACE:CHANNEL, such as socketcan:can0")
    add_("--node", type=_nodes, default=[1], metavar="N[-M]", help="node numbers of the robots, 1..31 (default: 1)")
    add_(
        "--key",
        type=Path,
        metavar="PEM",
        help="private key, from tools/octet keygen (default: the development key)",
    )
    add_("--save", type=Path, metavar="FILE", help="write the signed image to a file")
    add_(
        "--version",
        type=number(0, 2**32 - 1),
        metavar="N",
        help="version of an image that is signed here (default: the current time)",
    )
    add_("--set-node", type=number(0, _LAST_NODE), metavar="N", help="set the robot's node number; 0: as built")
    add_(
        "--set-bitrate",
        type=int,
        choices=(0, *_BITRATES),
        metavar="BIT/S",
        help="set the robot's bit rate: 125000, 250000, 500000, 1000000, or 0: as built",
    )
    add_("--allow-older", action="store_true", help="let the boards accept an older version")
    add_option(parser, "bitrate")
    keygen = add_command(
        commands,
        "keygen",
        _keygen,
        summary="make a key for signing firmware",
        description="Makes an Ed25519 key, writes it to a file that only you can read, and prints the public key,\n"
        "which is built into the boot loader.",
        epilog=_KEY_EXAMPLES,
        stages=lambda _: ["update"],
    )
    keygen.add_argument("key", type=Path, metavar="PEM", help="file to write; it must not exist yet")


def _nodes(text: str) -> list[int]:
    first, _, last = text.partition("-")
    try:
        nodes = list(range(int(first), int(last or first) + 1))
    except ValueError:
        nodes = []
    if not nodes or nodes[0] < 1 or nodes[-1] > _LAST_NODE:
        raise argparse.ArgumentTypeError(f"{text!r} is no node number 1..{_LAST_NODE}, and no range such as 1-4")
    return nodes


def _keygen(arguments: argparse.Namespace) -> int:
    from host_sim.update.keys import make_key, public_bytes

    key = make_key(arguments.key)
    print(f"key: {arguments.key}; keep it")
    print(f"for the boot loader: -DOCTET_SIGNER={public_bytes(key).hex()}")
    return 0


def _check(arguments: argparse.Namespace) -> None:
    changes = arguments.set_node is not None or arguments.set_bitrate is not None
    if arguments.bus is None and arguments.save is None:
        raise UsageError("nowhere to put the image: give --bus BUS or --save FILE")
    if arguments.image is None and (arguments.save is not None or not changes):
        raise UsageError("IMAGE is missing: give a file from --save, or a board such as blue_pill")
    if arguments.set_node is not None and len(arguments.node) > 1:
        raise UsageError("--set-node is for one robot: give its current number with --node")


def _update(arguments: argparse.Namespace) -> int:
    from host_sim.update.keys import development_key, load_key

    key = load_key(arguments.key) if arguments.key else development_key()
    images = _images(arguments, key) if arguments.image is not None else None
    if arguments.key is None:
        print("octet: using the development key, which is public", file=sys.stderr)
    if arguments.save is not None and images is not None:
        _save(arguments.save, images)
    return _update_all(arguments, images, key) if arguments.bus is not None else 0


def _images(arguments: argparse.Namespace, key: "Ed25519PrivateKey") -> "dict[int, SlotImage]":
    from host_sim.update.image import LAYOUTS, built_images, read_file, version_now

    if arguments.image not in LAYOUTS:
        return read_file(Path(arguments.image))
    version = version_now() if arguments.version is None else arguments.version
    return {image.slot: image for image in built_images(arguments.image, LAYOUTS[arguments.image].link, version, key)}


def _save(path: Path, images: "dict[int, SlotImage]") -> None:
    from host_sim.base.atomic_file import write_bytes

    write_bytes(path, b"".join(image.data for image in images.values()))
    print(f"saved: {path}, version {images[0].version}, for {images[0].board}")


class _Task(NamedTuple):
    """The operations on each node."""

    arguments: argparse.Namespace
    images: "Images"
    key: "Ed25519PrivateKey"
    progress: "Progress"


def _update_all(
    arguments: argparse.Namespace, images: "dict[int, SlotImage] | None", key: "Ed25519PrivateKey"
) -> int:
    from rich.console import Console
    from rich.progress import Progress

    from host_sim.base.errors import OctetError
    from host_sim.protocol.generated import UPDATE_ANSWER_ID
    from host_sim.transport.buses import open_bus_link
    from host_sim.transport.line_stats import LineStats
    from host_sim.update.hub import Hub

    stats = LineStats()
    answer_ids = [UPDATE_ANSWER_ID + node for node in arguments.node]
    link = open_bus_link(arguments.bus, answer_ids, stats, arguments.bitrate)
    hub = Hub(link)
    try:
        with Progress(console=Console(stderr=True), transient=True, disable=not sys.stderr.isatty()) as progress:
            task = _Task(arguments, images, key, progress)
            failures = hub.run({node: partial(_update_one, hub.share(node), node, task) for node in arguments.node})
    finally:
        link.close()
    for node, error in failures.items():
        if error is not None:
            full = "; the bus takes no frames: it is full, or nobody else is on it" if stats.unsent else ""
            said = str(error) if isinstance(error, OctetError) else f"node {node}: {error}".splitlines()[0]
            print(f"octet: {said}{full}", file=sys.stderr)
    return 2 if any(failures.values()) else 0


def _update_one(link: "Share", node: int, task: _Task) -> None:
    """Updates one node; runs in a thread of its own."""
    from host_sim.update.keys import is_development
    from host_sim.update.updater import Updater, check_images

    updater = Updater(link, node, task.key)
    updater.enter()
    before = updater.status()
    if task.images is not None:
        check_images(task.images, updater.board())
        image = task.images[before.free]
        kept = before.versions[before.slot] if before.installed >> before.slot & 1 else None
        stays = "it has no image" if kept is None else f"version {kept} stays in slot {'AB'[before.slot]}"
        print(f"node {node}: {stays}; version {image.version} goes to slot {'AB'[image.slot]}", flush=True)
    if is_development(before.signer):
        print(
            f"octet: node {node} accepts images signed with the public development key: anybody can update it",
            file=sys.stderr,
        )
    updater.unlock()
    if task.images is not None:
        _install(updater, image, before, task)
    _set_up(updater, task.arguments)


def _install(updater: "Updater", image: "SlotImage", before: "Status", task: _Task) -> None:
    if task.arguments.allow_older:
        updater.lower_floor(min(before.floor, image.version))
    bar = task.progress.add_task(f"node {updater.node}", total=len(image.data))
    updater.install(image, lambda count: task.progress.update(bar, completed=count))
    updater.restart()
    version = updater.confirmed(image.version)
    print(f"node {updater.node}: version {version} runs", flush=True)


def _set_up(updater: "Updater", arguments: argparse.Namespace) -> None:
    """Sets node number and bit rate last, since they take effect at the board's next start."""
    if arguments.set_node is None and arguments.set_bitrate is None:
        return
    updater.enter()
    updater.unlock()
    if arguments.set_node is not None:
        updater.set_node(arguments.set_node)
    if arguments.set_bitrate is not None:
        updater.set_bitrate(arguments.set_bitrate)
    updater.restart()
    said = [f"number {arguments.set_node}"] if arguments.set_node is not None else []
    said += [f"{arguments.set_bitrate} bit/s"] if arguments.set_bitrate is not None else []
    print(f"node {updater.node}: has {' and '.join(said)} from now on", flush=True)
