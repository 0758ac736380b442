"""Options that are tried: what the table options.toml says of each, and a command's outcome with and without one."""

import argparse
import asyncio
import os
import re
import shlex
import socket
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from functools import cache
from pathlib import Path
from typing import Any, TextIO
from unittest import mock

from host_sim.base.toml_file import parse_toml
from host_sim.cli.main import parser_of
from host_sim.lab import workers
from host_sim.live.browser import announce
from host_sim.live.paced_run import PacedRun
from host_sim.live.page_commands import FULL_SPEED
from host_sim.live.server import LiveServer
from tests.runs.support import ROOT, octet, octet_process

_UNTIL_BROKEN = workers._run_until_broken
TABLE: dict[str, Any] = parse_toml(Path(__file__).with_name("options.toml").read_text())
COMMON = {"watch": "run"}
"""A command whose other options are those of another one."""
LAB = ("compare", "study", "tune")
AS_PROCESSES = ("picture", "talk")
"""Commands that need a standard input, or draw what `octet` leaves out."""
PLAN = 'profiles = ["article", "never"]\nseeds = 2\nenvironments = 1\nlimit_s = 5\n'


def parsers() -> dict[str, argparse.ArgumentParser]:
    """The parser of each command."""
    return {
        name: each for action in parser_of([])._subparsers._group_actions for name, each in action.choices.items()
    }


def options(parser: argparse.ArgumentParser) -> set[str]:
    """The options of a command, without `--help`."""
    return {action.option_strings[-1] for action in parser._actions if action.option_strings} - {"--help"}


def rows(command: str) -> dict[str, Any]:
    """What the table says of each option of a command."""
    of_other = TABLE[COMMON[command]] if command in COMMON else {}
    given = {**of_other, **TABLE[command]}
    return {name: given[name] for name in options(parsers()[command]) if name in given}


def tried(*commands: str) -> list[tuple[str, str]]:
    """The options of these commands that a command line tries."""
    return [
        (command, name) for command in commands for name, row in sorted(rows(command).items()) if type(row) is list
    ]


def _watch_at_once(live: PacedRun, server: LiveServer, out: TextIO) -> None:
    """Plays a watched run, without a page that begins it and without a pause."""
    announce(server.listener, out, waits=False)
    live.stays, live.waits, live.speed = False, False, FULL_SPEED
    live.begin()
    asyncio.run(live.play())


def _noted_pool(count: int, **how: Any) -> ProcessPoolExecutor:
    Path("workers").write_text(f"{count}")
    return ProcessPoolExecutor(count, **how)


def _noted_chunks(work: Any, left: list[Any], of: Any) -> Iterator[Any]:
    Path("chunks").write_text(f"{len(left[0])}")
    return _UNTIL_BROKEN(work, left, of)


class Trial:
    """Calls a command with and without an option, each in a folder of its own."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        (folder / "plan.toml").write_text(PLAN)
        (folder / "robot.mem").write_bytes(bytes((0, 1, 0, 0, 2, 0, 2, 0)))
        words = "run --bus none --environments 1 --limit-s 3 --robots 2 --out"
        octet(*words.split(), folder / "run")
        with socket.create_server(("127.0.0.1", 0)) as free:
            port = free.getsockname()[1]
        names = {
            "run": folder / "run",
            "studied": folder / "studied",
            "plan": folder / "plan.toml",
            "memory": folder / "robot.mem",
        }
        self._names = {**names, "root": ROOT, "port": port}
        self._with = cache(self._outcome)

    def check(self, command: str, name: str) -> None:
        """Checks that the option's pattern is in its file with the option alone, or that the file is another one."""
        words, option, file, pattern = rows(command)[name]
        line = words[1:] if words.startswith("=") else f"{TABLE[command]['words']} {words}"
        before, after = self._with(f"{command} {line}"), self._with(f"{command} {line} {option}")
        if not pattern:
            assert after[file] != before[file]
            return
        assert re.search(self.named(pattern), after.get(file, ""), re.MULTILINE), after
        assert not re.search(self.named(pattern), before.get(file, ""), re.MULTILINE)

    def named(self, text: str) -> str:
        """A text of the table, with the names of files in it."""
        return re.sub(r"\{(\w+)\}", lambda it: str(self._names[it[1]]), text)

    def _outcome(self, line: str) -> dict[str, str]:
        here = self._folder / f"call{len(list(self._folder.glob('call*')))}"
        here.mkdir()
        before = Path.cwd()
        os.chdir(here)
        try:
            with (
                mock.patch("host_sim.live.browser.watch_run", _watch_at_once),
                mock.patch.object(workers, "ProcessPoolExecutor", _noted_pool),
                mock.patch("concurrent.futures.ProcessPoolExecutor", _noted_pool),
                mock.patch.object(workers, "_run_until_broken", _noted_chunks),
            ):
                words = shlex.split(self.named(line))
                is_own = words[0] in AS_PROCESSES
                done = octet_process(*words, input="WHAT DO YOU KNOW\n") if is_own else octet(*words)
        finally:
            os.chdir(before)
        files = {path.relative_to(here).as_posix(): path for path in here.rglob("*") if path.is_file()}
        told = {"out": done.stdout, "err": done.stderr, "code": str(done.returncode)}
        return {**{name: path.read_text("latin-1") for name, path in files.items()}, **told}
