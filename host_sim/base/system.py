"""Functions that differ between operating systems. No other module asks which one it runs on."""

import contextlib
import os
import signal
import stat
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import asyncio

try:
    import fcntl
    import resource
except ModuleNotFoundError:  # Windows
    fcntl = resource = None  # type: ignore[assignment]

ENDING_SIGNALS = tuple(getattr(signal, name) for name in ("SIGINT", "SIGTERM", "SIGHUP") if hasattr(signal, name))
"""The signals that end a run in an orderly way."""

NO_LINK = getattr(os, "O_NOFOLLOW", 0)
"""Flag of `os.open`: refuses a symbolic link."""

NO_WAIT = getattr(os, "O_NONBLOCK", 0)
"""Flag of `os.open`: does not wait for the other end of a pipe."""

HAS_ROBOT_PROCESSES = sys.platform == "linux"
"""Whether the firmware can run as a process of its own, on a socket pair or a CAN interface."""

_HAS_ALARM = hasattr(signal, "setitimer")
_FILES = 512


def lock_at_once(descriptor: int) -> None:
    """Locks an open file or folder until it is closed, without waiting.

    Raises:
        BlockingIOError: Another process has locked it.
        OSError: It cannot be locked.
    """
    if fcntl is not None:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        return
    import msvcrt  # noqa: PLC0415 - only Windows has it

    windows: Any = msvcrt
    try:
        windows.locking(descriptor, windows.LK_NBLCK, 1)
    except PermissionError as error:
        raise BlockingIOError from error


def open_to_lock(folder: Path) -> int:
    """Opens a folder, or a file in it where a folder cannot be opened, so that it can be locked.

    Raises:
        OSError: It cannot be opened.
    """
    if hasattr(os, "O_DIRECTORY"):
        return os.open(folder, os.O_RDONLY | os.O_DIRECTORY)
    return os.open(folder / ".lock", os.O_RDWR | os.O_CREAT)


def sync_folder(folder: Path) -> None:
    """Syncs a directory, where the system lets one do so: only then is a rename in it durable."""
    if hasattr(os, "O_DIRECTORY"):
        descriptor = open_to_lock(folder)
        try:
            os.fsync(descriptor)
        finally:
            os.close(descriptor)


def give_mode(descriptor: int, before: os.stat_result | None) -> None:
    """Gives a new file the mode and the owner of the one that it replaces, or the mode of a new file."""
    if not hasattr(os, "fchmod"):
        return
    os.fchmod(descriptor, 0o666 & ~_umask() if before is None else stat.S_IMODE(before.st_mode))
    if before is not None and os.geteuid() == 0:
        os.fchown(descriptor, before.st_uid, before.st_gid)


def _umask() -> int:
    """The process's umask, which can be read only by setting it."""
    mask = os.umask(0)
    os.umask(mask)
    return mask


def files_max() -> int:
    """Maximum number of open files of this process."""
    return resource.getrlimit(resource.RLIMIT_NOFILE)[0] if resource is not None else _FILES


@contextlib.contextmanager
def signals_held() -> Iterator[None]:
    """Holds back the signals that end a run, where the system can."""
    if not hasattr(signal, "pthread_sigmask"):
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, ENDING_SIGNALS)
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def on_alarm(handler: Any) -> Any:
    """Sets the alarm's handler and returns the old one. Windows has no alarm, and no robot process that can hang."""
    return signal.signal(signal.SIGALRM, handler) if _HAS_ALARM else signal.SIG_IGN


def set_alarm(seconds: float) -> None:
    """Schedules the alarm in some seconds; 0 cancels it."""
    if _HAS_ALARM:
        signal.setitimer(signal.ITIMER_REAL, seconds)


def on_signal(
    loop: "asyncio.AbstractEventLoop", number: int, action: Callable[[], None], at_once: Callable[[], None]
) -> None:
    """Calls one function between two steps of an event loop on a signal, and another one at once."""
    try:
        loop.add_signal_handler(number, action)
    except NotImplementedError:  # Windows
        signal.signal(number, lambda *_: loop.call_soon_threadsafe(action))
        return
    # The loop hears of the signal all the same, as soon as a step ends.
    signal.signal(number, lambda *_: at_once())


def has_screen() -> bool:
    """Whether there is a desktop that a browser can be opened on."""
    return sys.platform in {"darwin", "win32"} or bool(os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY"))
