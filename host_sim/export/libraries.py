"""The optional libraries of exports. They stand apart, so that no other command spends time on loading them."""

import importlib
import os
import sys
from pathlib import Path
from typing import Any

from host_sim.errors import UsageError
from host_sim.paths import EXPORT_LIBRARIES


def library(name: str, folder: Path = EXPORT_LIBRARIES) -> Any:
    """A library, loaded.

    Args:
        name: Its module.
        folder: Where the optional libraries are.

    Raises:
        UsageError: It is not installed.
    """
    place = os.fspath(folder)
    if place not in sys.path:
        sys.path.append(place)
    try:
        return importlib.import_module(name)
    except ModuleNotFoundError:
        needed = name.partition(".")[0]
        raise UsageError(f"this format needs {needed}, which is not installed: run tools/setup export") from None
