"""Makes the files that the wheels of all systems share, in build/wheel: `python -m tools.wheelhouse.shared`.

They are the pages' programs and WebAssembly, and the flash images that tools/setup has built; the declarations of C
functions, as Python modules; and shell completions and man pages, generated from the command line's parsers.
"""

import os
import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import shtab

from host_sim.base import c_interface, paths
from host_sim.cli.parsing import Parser
from host_sim.sim.access import BOARDS

MADE = paths.BUILD / "wheel"
TREE = MADE / "tree" / "build"
SHELLS = {
    "bash": "bash-completion/completions/octet",
    "fish": "fish/vendor_completions.d/octet.fish",
    "zsh": "zsh/site-functions/_octet",
}
"""Where each shell looks for a completion, in share/ of a prefix."""


def copy_page_and_images() -> None:
    """Copies the files for pages and boards, and strips the images of their debugging information."""
    shutil.copytree(
        paths.PAGE_SCRIPTS, TREE / paths.PAGE_SCRIPTS.relative_to(paths.BUILD), ignore=lambda *_: ["stamp"]
    )
    page = TREE / paths.PAGE_WASM.relative_to(paths.BUILD)
    page.parent.mkdir(parents=True)
    shutil.copyfile(paths.PAGE_WASM, page)
    for image in sorted(it for board in BOARDS for it in paths.BUILD.glob(f"{board}/octet-*.elf")):
        stripped = TREE / image.relative_to(paths.BUILD)
        stripped.parent.mkdir(exist_ok=True)
        subprocess.run(["arm-none-eabi-strip", "--strip-debug", "-o", stripped, image], check=True)


def read_interfaces() -> None:
    """Lets each module that uses C read its declarations, which are then stored as Python modules."""
    c_interface.FOLDER = TREE / "cffi"
    from host_sim.emulator.c_models import c_models  # noqa: PLC0415
    from host_sim.emulator.core import unicorn_calls  # noqa: PLC0415
    from host_sim.lab.gymnasium_envs import driven_worlds  # noqa: PLC0415
    from host_sim.sim import native_fleet, native_loop  # noqa: PLC0415
    from host_sim.sim.in_process_link import InProcessLink  # noqa: PLC0415 - some read them when they are imported
    from host_sim.world.world_library import world_library  # noqa: PLC0415

    InProcessLink().close()
    for load in (
        c_models,
        unicorn_calls,
        driven_worlds.loaded,
        native_fleet.loaded,
        native_loop.loaded,
        world_library,
    ):
        load()


def subparsers(parser: Parser) -> Iterator[tuple[str, str, Parser]]:
    """The name, the summary and the parser of each subcommand."""
    actions: list[Any] = parser._subparsers._group_actions if parser._subparsers else []
    for action in actions:
        for name, it in (action.choices or {}).items():
            yield name, it.summary, it


def write_man_page(folder: Path, name: str, summary: str, parser: Parser) -> None:
    """Lets help2man write a man page, from a program that prints the help text."""
    with TemporaryDirectory() as temporary:
        program = Path(temporary, name)
        program.with_suffix(".txt").write_text(parser.format_help(), encoding="utf-8")
        program.write_text(f"#!/bin/sh\ncat '{program}.txt'\n", encoding="utf-8")
        program.chmod(0o755)
        how = ("--no-info", f"--version-string={paths.version()}", f"--name={summary}", f"--output={folder / name}.1")
        subprocess.run(["help2man", *how, program], check=True)


def write_texts() -> None:
    """Writes completions and man pages for the installed command."""
    paths.INSTALLED = True
    os.environ["COLUMNS"] = "100"
    from host_sim.cli.main import parser_of  # noqa: PLC0415 - names in it depend on the line above

    parser = parser_of([])
    subcommands: Any = parser._subparsers
    for action in subcommands._group_actions:  # shtab leaves out what the plain list of argparse does
        action.help = "command"
        entries = ((name, (), it.summary) for name, it in action.choices.items())
        action._choices_actions = [action._ChoicesPseudoAction(*entry) for entry in entries]
    for shell, place in SHELLS.items():
        completion = MADE / "share" / place
        completion.parent.mkdir(parents=True)
        completion.write_text(shtab.complete(parser, shell), encoding="utf-8")
    pages = MADE / "share" / "man" / "man1"
    pages.mkdir(parents=True)
    write_man_page(pages, "octet", "a robot that learns with eight bytes of memory", parser)
    for name, summary, it in subparsers(parser):
        write_man_page(pages, f"octet-{name}", summary, it)


def main() -> int:
    """Makes all of them from scratch."""
    shutil.rmtree(MADE, ignore_errors=True)
    copy_page_and_images()
    read_interfaces()
    write_texts()
    return 0


if __name__ == "__main__":
    sys.exit(main())
