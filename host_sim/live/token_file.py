"""The access token of pages on this machine, which persists so that a page can stay open across runs."""

import contextlib
import os
import re
import secrets
import stat
from pathlib import Path

from host_sim.base.system import NO_LINK, NO_WAIT, is_own

_TOKEN = re.compile(r"[\w-]{22}")
_READ_MAX = 64


def local_token() -> str:
    """The token in the user's file, which only this user can read; a new one where there is none.

    The file is `octet/token` in `$XDG_STATE_HOME`, by default `~/.local/state`. If it cannot be used, the token is
    that of one run.
    """
    token = secrets.token_urlsafe(16)
    with contextlib.suppress(OSError, RuntimeError):  # RuntimeError: this user has no home
        return _stored(_path(), token)
    return token


def _path() -> Path:
    state = os.environ.get("XDG_STATE_HOME", "")
    return (Path(state) if state.startswith("/") else Path.home() / ".local/state") / "octet/token"


def _stored(path: Path, new: str) -> str:
    """Returns the token in a file; writes a new one if the file does not exist.

    Raises:
        OSError: The file cannot be used, or others may read or change it.
    """
    path.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
    with contextlib.suppress(FileExistsError):
        descriptor = os.open(path, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600)
        with os.fdopen(descriptor, "w", encoding="ascii") as file:
            file.write(new)
        return new
    return _read(path)


def _read(path: Path) -> str:
    descriptor = os.open(path, os.O_RDONLY | NO_LINK | NO_WAIT)
    with os.fdopen(descriptor, "rb") as file:
        about = os.fstat(descriptor)
        if not stat.S_ISREG(about.st_mode) or not is_own(about):
            raise PermissionError(f"{path} is not this user's alone")
        text = file.read(_READ_MAX).decode("ascii", "replace")
    if not _TOKEN.fullmatch(text):
        raise OSError(f"{path} holds no token")
    return text
