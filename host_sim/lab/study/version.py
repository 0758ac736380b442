"""The version of a study: the layout of its rows, and the sources that determine their contents."""

import hashlib
from functools import cache

from host_sim.base.paths import BUILD, ROOT

FORMAT = 1
"""Version number of the layout of a study's folder and tables."""

_FOLDERS = ("firmware", "hal", *(f"host_sim/{name}" for name in ("client", "protocol", "sim", "world")))
_FILES = tuple(f"host_sim/lab/study/{name}.py" for name in ("atlas", "contacts", "trial"))
_KINDS = (".c", ".h", ".dbc", ".toml", ".py")


@cache
def code_version() -> str:
    """A digest of the sources of robot and world, in hexadecimal: runs from other sources may differ."""
    stored = BUILD / "code_version"  # in a wheel, which has no sources
    if stored.exists():
        return stored.read_text(encoding="ascii")
    digest = hashlib.sha256()
    folders = (path for name in _FOLDERS for path in (ROOT / name).rglob("*") if path.suffix in _KINDS)
    for path in sorted([*folders, *(ROOT / name for name in _FILES)]):
        digest.update(path.relative_to(ROOT).as_posix().encode() + b"\0" + path.read_bytes())
    return digest.hexdigest()[:16]
