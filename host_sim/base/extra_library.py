"""Loads libraries that only some commands need."""

import importlib
import os
import sys
from typing import Any

from host_sim.base.errors import UsageError
from host_sim.base.paths import BUILD, INSTALLED


def missing(name: str, stage: str) -> str:
    """A one-line message that says how to install a missing library.

    Args:
        name: Its module name.
        stage: The stage of tools/setup that installs it in a checkout.
    """
    needed = name.partition(".")[0]
    needed = {"PIL": "pillow"}.get(needed, needed)
    # Names the library itself: a registry may have another project called octet.
    how = f"python -m pip install {needed}" if INSTALLED else f"tools/setup {stage}"
    return f"this needs {needed}, which is not installed: run {how}"


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
