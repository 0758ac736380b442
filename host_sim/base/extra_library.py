"""Loads libraries that only some commands need."""

import importlib
import os
import sys
from pathlib import Path
from typing import Any

from host_sim.base.errors import UsageError
from host_sim.base.paths import BUILD


def library(name: str, stage: str, build: Path = BUILD) -> Any:
    """A library, loaded.

    Args:
        name: Its module.
        stage: The stage of tools/setup that installs it, into a folder of that name.
        build: Where that folder is.

    Raises:
        UsageError: It is not installed.
    """
    place = os.fspath(build / stage)
    if place not in sys.path:
        sys.path.append(place)
    try:
        return importlib.import_module(name)
    except ModuleNotFoundError:
        needed = name.partition(".")[0]
        raise UsageError(f"this needs {needed}, which is not installed: run tools/setup {stage}") from None
