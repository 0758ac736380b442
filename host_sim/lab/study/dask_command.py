"""`tools/octet dask`: a scheduler or a worker for `tools/octet study --dask`."""

import argparse
import os
import sys
from importlib.util import find_spec

from host_sim.base.extra_library import library
from host_sim.base.paths import BUILD, ROOT
from host_sim.cli.parsing import Subparsers, add_command

_EXAMPLES = """\
examples:
  tools/octet dask scheduler                                     for this machine only; prints its address
  tools/octet dask scheduler --host 0.0.0.0                      for other machines, too
  tools/octet dask worker tcp://host:8786                        on each machine that should work
  tools/octet study studies/learned.toml --dask tcp://host:8786  anywhere

Anyone who can reach the scheduler can run any program on the workers: use it only on a private network.
"""
_HERE_PAGE = ["--dashboard-address", "127.0.0.1:8787"]


def add(commands: Subparsers) -> None:
    """Adds the command."""
    parser = add_command(
        commands,
        "dask",
        _dask,
        summary="start the scheduler or a worker of a cluster for studies",
        description="Starts Dask's own scheduler or worker, with Octet and its libraries importable.",
        epilog=_EXAMPLES,
        check=_help,
        stages=lambda _: ["cluster"],
    )
    parser.add_argument("role", choices=("scheduler", "worker"), help="what to start")
    told = "Dask's own options; --help lists them once Dask is installed"
    parser.add_argument("words", nargs=argparse.REMAINDER, metavar="...", help=told)


def _help(arguments: argparse.Namespace) -> None:
    """Prints a help text without installing Dask if it is missing."""
    has_dask = (BUILD / "cluster").exists() or find_spec("distributed") is not None
    if not has_dask and {"-h", "--help"} & {*arguments.words}:
        arguments.parser.print_help()
        raise SystemExit(0)


def _here_only(role: str, words: list[str]) -> list[str]:
    """Arguments for Dask that restrict the scheduler to this machine; by default it listens on all interfaces."""
    told = {word.partition("=")[0] for word in words}
    if role != "scheduler" or told & {"--host", "--interface"}:
        return words
    return ["--host", "127.0.0.1", *([] if "--dashboard-address" in told else _HERE_PAGE), *words]


def _dask(arguments: argparse.Namespace) -> int:
    library("distributed", "cluster")
    places = os.pathsep.join(map(str, (ROOT, BUILD / "cluster")))  # also for the processes that Dask starts
    module = f"distributed.cli.dask_{arguments.role}"
    words = [sys.executable, "-m", module, *_here_only(arguments.role, arguments.words)]
    os.execve(sys.executable, words, {**os.environ, "PYTHONPATH": places})
