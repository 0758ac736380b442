"""`tools/octet page`: writes the robot and its world as one web page."""

import argparse

from host_sim.cli.parsing import Subparsers, add_command, check_outputs, file_path

_EXAMPLE = """\
example:
  tools/octet page octet.html
"""


def add(commands: Subparsers) -> None:
    """Adds the command."""
    parser = add_command(
        commands,
        "page",
        _page,
        summary="write the robot and its world as one web page",
        description="Writes a page that runs the robot's own firmware in its world, without a server or a network.",
        epilog=_EXAMPLE,
        check=lambda arguments: check_outputs("page", None, {"FILE": arguments.file}),
        stages=lambda _: ["page"],
    )
    parser.add_argument("file", type=file_path, metavar="FILE", help="the page to write, such as octet.html")


def _page(arguments: argparse.Namespace) -> int:
    from host_sim.report.octet_page import write_octet_page

    size = write_octet_page(arguments.file)
    print(f"wrote     {arguments.file} ({round(size / 1000)} KB)")
    return 0
