"""`tools/octet page`: writes the robot and its world as one web page."""

import argparse

from host_sim.base.paths import image_path
from host_sim.cli.parsing import Subparsers, add_command, check_outputs, file_path

_EXAMPLES = """\
examples:
  tools/octet page octet.html
  tools/octet page --pico octet.html     a page that also runs the flash image of a Pico, and compares both
"""


def add(commands: Subparsers) -> None:
    """Adds the command."""
    parser = add_command(
        commands,
        "page",
        _page,
        summary="write the robot and its world as one web page",
        description="Writes a page that runs the robot's own firmware in its world, without a server or a network.",
        epilog=_EXAMPLES,
        check=lambda arguments: check_outputs("page", None, {"FILE": arguments.file}),
        stages=lambda arguments: ["page", "pico"] if arguments.pico else ["page"],
    )
    parser.add_argument("file", type=file_path, metavar="FILE", help="the page to write, such as octet.html")
    parser.add_argument(
        "--pico", action="store_true", help="add an emulated Raspberry Pi Pico, whose frames it compares"
    )


def _page(arguments: argparse.Namespace) -> int:
    from host_sim.report.octet_page import write_octet_page

    image = image_path("pico", "slcan").with_suffix(".bin").read_bytes() if arguments.pico else None
    size = write_octet_page(arguments.file, image)
    print(f"wrote     {arguments.file} ({round(size / 1000)} KB)")
    return 0
