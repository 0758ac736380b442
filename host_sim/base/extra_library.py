"""Loads libraries that only some commands need."""

import importlib
import os
import shlex
import sys
from collections.abc import Mapping, Sequence
from importlib.util import find_spec
from typing import Any

from host_sim.base.errors import UsageError
from host_sim.base.paths import BUILD, INSTALLED, project
from host_sim.base.toml_file import parse_toml

_MODULES = {"pillow": "PIL", "pyserial": "serial", "python-can": "can"}
"""Module names of the packages whose own is another."""


def missing(name: str, *stages: str) -> str:
    """A one-line message that says how to install a missing library; for a wheel, with all that is missing beside it.

    Args:
        name: Its module name.
        stages: The stages of tools/setup that install it in a checkout. A wheel's extra of that name is preferred.
    """
    module = name.partition(".")[0]
    package = {value: key for key, value in _MODULES.items()}.get(module, module)
    if not INSTALLED:
        return f"this needs {package}, which is not installed: run tools/setup {stages[0]}"
    about = parse_toml(project())["project"]
    extra, wanted = extra_with(package, stages, about["optional-dependencies"])
    absent = [it for it in wanted if not find_spec(_MODULES.get(it, it))] or [package]
    words = " and ".join(filter(None, (", ".join(absent[:-1]), absent[-1])))
    verb = "is" if len(absent) == 1 else "are"
    how = f"{shlex.quote(sys.executable)} -m pip install '{about['name']}{extra}'"
    return f"this needs {words}, which {verb} not installed: run {how}"


def extra_with(package: str, stages: Sequence[str], extras: Mapping[str, list[str]]) -> tuple[str, list[str]]:
    """The extra that installs a package, in brackets, and its packages; both empty if none does.

    >>> extra_with("numpy", ["run"], {"picture": ["pillow"], "fleet": ["numpy", "pillow"], "gym": ["numpy"]})
    ('[fleet]', ['numpy', 'pillow'])
    """
    for name in (*stages, *extras):
        if package in extras.get(name, ()):
            return f"[{name}]", extras[name]
    return "", []


def library(name: str, stage: str) -> Any:
    """Loads a library.

    Args:
        name: Its module name.
        stage: The stage of tools/setup that installs it, into a folder of that name.

    Raises:
        UsageError: It is not installed.
    """
    place = os.fspath(BUILD / stage)
    if place not in sys.path:
        sys.path.append(place)
    try:
        return importlib.import_module(name)
    except ModuleNotFoundError:
        raise UsageError(missing(name, stage)) from None
