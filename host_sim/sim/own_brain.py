"""A behaviour in a C file of its user: compiled, checked, and linked with the firmware into a cache by content.

`host_sim/program/own/` has its header, and the guard that is linked between it and the robot.
"""

import hashlib
import json
import os
import re
import shutil
import subprocess
import sys
import time
from codecs import BOM_UTF8
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

from host_sim.base.errors import OctetError, UsageError
from host_sim.base.files import write_bytes
from host_sim.base.image_build import alone_in, build_image, complaints
from host_sim.base.paths import BUILD, PACKAGE, ROOT
from host_sim.sim.in_process_link import OwnLink, Relay, read_source
from host_sim.sim.world_record import Source

OWN_HEADERS = PACKAGE / "program" / "own"
"""The folder of octet_brain.h."""

_MADE, _MADE_DEBUG = (BUILD / host / "host_sim" / "program" / "own" for host in ("host", "host-debug"))
_CACHE, _IMAGES = BUILD / "own", BUILD / "own-images"
_CACHED_MAX = 20
_BUSY_S = 3600.0  # a busy machine may take minutes from compiling to the last link
_SIZE_MAX = 200_000
_COMPILE_S = 30.0
_LIBRARY = ["-shared", f"-Wl,--version-script={OWN_HEADERS / 'library.map'}"]
_LINKS = {
    "liboctet.so": (_MADE / "library.o", _LIBRARY),
    "liboctet_fleet.so": (_MADE / "fleet.o", ["-shared", "-Wl,-Bsymbolic", "-lm"]),
    "octet-robot": (_MADE / "process.o", ["-fsanitize=address"]),
    "octet-debug": (_MADE_DEBUG / "debug.o", ["-fsanitize=address"]),
}
_UNKNOWN = "implicit-function-declaration"
_ERRORS = (
    _UNKNOWN,
    "return-type",
    "uninitialized",
    "incompatible-pointer-types",
    "int-conversion",
)
_OPTIONS = [
    *("-std=c99", "-g", "-fPIC", "-fno-omit-frame-pointer", "-fno-common", "-fno-builtin-printf", "-x", "c", "-"),
    *("-fsanitize=undefined,bounds-strict", "-fno-sanitize-recover=all", "-fsanitize-coverage=trace-pc"),
    *("-ftrivial-auto-var-init=pattern", "-Wno-error", *(f"-Werror={name}" for name in _ERRORS)),
    *(f"-I{ROOT}", f"-I{BUILD}/host/generated", f"-I{OWN_HEADERS}", "-include", "octet_brain.h"),
]
_ALLOWED = re.compile(
    r"(random|memory|pattern|listing|used_cells|feel_memory|confidence)_\w+|mem(cpy|set|move|cmp)|note"
    r"|__ubsan_handle_\w+|__sanitizer_cov_trace_pc|__stack_chk_fail|_GLOBAL_OFFSET_TABLE_|own_(begin|next)"
)
_VARIABLE = re.compile(r"\.(bss|data|tbss|tdata)(?!\.rel\.ro)\b.*")
_OWN = re.compile(r"^own: (-?\d+ )(.*)$", re.MULTILINE)
_SANITIZER = re.compile(r"^==\d+==ERROR: AddressSanitizer:? ([\w-]+)", re.MULTILINE)
_KINDS = {
    "SEGV": "a pointer that points nowhere",
    "stack-overflow": "functions that call each other without an end",
    **dict.fromkeys(("stack-buffer-overflow", "stack-buffer-underflow"), "a place beside a variable is used"),
    "stack-use-after-return": "a variable is used after its function has ended",
    "stack-use-after-scope": "a variable is used after its block has ended",
    "global-buffer-overflow": "a place beside a table is used",
}


@dataclass(frozen=True)
class OwnBrain:
    """A behaviour that compiles.

    Attributes:
        name: The name of its file, for people.
        text: Its source.
        folder: The folder of what was built from it.
    """

    name: str
    text: bytes
    folder: Path

    @property
    def source(self) -> Source:
        """Its source, as recorded in the world file."""
        return Source(Path(self.name).name, self.text)

    @property
    def command(self) -> list[Path]:
        """The robot as a process, as in `Program`."""
        return [self.process]

    def robot(self, node: int = 1, memory: Sequence[int] = (0,) * 8, relay: Relay | None = None) -> OwnLink:
        """The robot in this process; raises as `OwnLink`."""
        return OwnLink(self, node, memory, relay)

    @property
    def library(self) -> Path:
        """The robot as a library, as `in_process_link.LIBRARY`."""
        return self._linked("liboctet.so", "fast")

    @property
    def fleet(self) -> Path:
        """Robots in their worlds, as `native_fleet.LIBRARY`."""
        return self._linked("liboctet_fleet.so", "fast")

    @property
    def debugger(self) -> Path:
        """The robot of a log, as `debugger.OCTET_DEBUG`."""
        return self._linked("octet-debug", "checked")

    @property
    def process(self) -> Path:
        """The robot as a process that notices what C does not define, as `robot_process.PROGRAM`."""
        return self._linked("octet-robot", "checked")

    def image(self, board: str, link: str) -> Path:
        """The flash image of a board with it, built in a folder for all such images of the board.

        Raises:
            OctetError: It cannot be built.
        """
        folder, source = _IMAGES / board, _IMAGES / f"{board}.c"
        with alone_in(folder):
            text = _with_lines(self.path, self.text)
            if not source.exists() or source.read_bytes() != text:
                write_bytes(source, text)
            done = build_image(board, folder, f"-DOCTET_OWN_BRAIN={source}", target=f"octet-{board}-{link}")
            if done.returncode:
                told = self.named(complaints(done))
                raise OctetError(f"the image of {board} with {self.name} cannot be built:\n{told}")
            made = folder / f"octet-{board}-{link}.elf"
            kept = self.folder / made.name
            for suffix in (".elf", ".bin"):
                shutil.copyfile(made.with_suffix(suffix), kept.with_suffix(suffix))
        return kept

    def mistake(self, printed: str) -> str:
        """The mistake that its process has printed in the form of `guard.h`; empty if there is none."""
        found = _OWN.search(printed)
        if found is None:
            return ""
        kind = _SANITIZER.search(printed)
        if not kind:
            return self.named(found[0].removeprefix("own: "))
        place = re.search(rf"^ +#\d+ .*{re.escape(self.path)}:(\d+)", printed, re.MULTILINE)
        what = _KINDS.get(kind[1], f"the address sanitizer says {kind[1]}")
        return f"{found[1]}{self.name}{f':{place[1]}' if place else ''}: {what}{found[2]}"

    def named(self, told: str) -> str:
        """A text with the name of the file as its user wrote it."""
        return told.replace(self.path, self.name)

    @property
    def path(self) -> str:
        """The absolute path of its file, as the compiler knows it."""
        return os.path.abspath(self.name)  # noqa: PTH100 - links stay links

    def _linked(self, name: str, guard: str) -> Path:
        made = self.folder / name
        if not made.exists():
            part = self.folder / f"{name}.{os.getpid()}"
            self.link(part, name, guard, self.folder / f"{guard}.o")
            part.replace(made)
        return made

    def link(self, made: Path, name: str, guard: str, *objects: Path) -> None:
        """Links objects that have own_begin and own_next with a guard, `fast` or `checked`, and the rest of a robot.

        Args:
            made: The output file.
            name: What it is: a key of `_LINKS`.
            guard: The guard.
            objects: The objects.
        """
        rest, options = _LINKS[name]
        if not rest.exists():
            stage = "debug" if _MADE_DEBUG in rest.parents else "run"
            raise OctetError(f"{rest} is not built: run tools/setup {stage}")
        wrap = ["-Wl,--wrap=own_begin", "-Wl,--wrap=own_next"]
        parts = [*objects, *_tools()[guard].split(";"), rest]
        _compiler([*wrap, "-o", os.fspath(made), *map(os.fspath, parts), *options], self.name)


def own_brain(source: Path) -> OwnBrain:
    """Compiles the behaviour in a file, unless that was done before. The compiler's warnings go to stderr.

    Raises:
        UsageError: The file cannot be read or compiled, is no behaviour, or uses what a robot does not have.
        OctetError: Something that must be built or installed is missing.
    """
    if not source.exists():
        raise UsageError(f"there is no file {source}: tools/octet new {source} begins one")
    return compiled(read_source(source, _SIZE_MAX), os.fspath(source))


def own_copy(source: Source) -> OwnBrain:
    """As `own_brain`, for a recorded source, which is written to a file where a debugger finds it."""
    folder = _CACHE / f"source-{source.sha256[:24]}"
    folder.mkdir(parents=True, exist_ok=True)
    write_bytes(folder / source.name, source.text)
    return own_brain(folder / source.name)


def compiled(text: bytes, name: str) -> OwnBrain:
    """As `own_brain`, for a source and the name of its file."""
    brain = OwnBrain(name, text, _CACHE / _key(text, name))
    if (brain.folder / "checked.o").exists():
        os.utime(brain.folder)
        return brain
    part = _CACHE / f"{brain.folder.name}.{os.getpid()}"
    part.mkdir(parents=True, exist_ok=True)
    try:
        warnings = _compile(brain, part)
        _check_symbols(name, part / "fast.o")
        if not brain.folder.exists():
            part.rename(brain.folder)
    finally:
        shutil.rmtree(part, ignore_errors=True)
    if warnings:
        sys.stderr.write(f"{warnings}\n")
    _prune()
    return brain


def _key(text: bytes, name: str) -> str:
    rest = [rest for rest, _ in _LINKS.values() if rest.exists()]
    rest += [Path(it) for guard in ("fast", "checked") for it in _tools()[guard].split(";")]
    stamps = [(it.stat().st_mtime_ns, it.stat().st_size) for it in rest]
    others = f"{os.path.abspath(name)} {stamps} {_OPTIONS}"  # noqa: PTH100 - links stay links
    return hashlib.sha256(others.encode(errors="surrogateescape") + b"\0" + text).hexdigest()[:24]


def _compile(brain: OwnBrain, folder: Path) -> str:
    """Compiles the source from standard input, so that it cannot include files beside it."""
    name, path = brain.name, brain.path
    source = _with_lines(path, brain.text)
    warnings = _tools()["warnings"].split(";")
    told = _compiler([*warnings, *_OPTIONS, "-O2", "-c", "-o", os.fspath(folder / "fast.o")], name, source, path)
    quiet = ["-w", "-O0", "-fsanitize=address", "-c", "-o", os.fspath(folder / "checked.o")]
    _compiler([*_OPTIONS, *quiet], name, source, path)
    return told


def _with_lines(path: str, text: bytes) -> bytes:
    """A source with a `#line` that names its file; without a byte order mark, which gcc takes only first."""
    quoted = path.replace("\\", "\\\\").replace('"', '\\"').replace("\n", "?")
    return f'#line 1 "{quoted}"\n'.encode(errors="surrogateescape") + text.removeprefix(BOM_UTF8)


def _compiler(arguments: Sequence[str], name: str, source: bytes = b"", path: str = "") -> str:
    """Calls the compiler, and returns its messages.

    Raises:
        UsageError: It refuses the source; the error has its messages.
    """
    tool = _tools()["compiler"]
    locale = {**os.environ, "LC_ALL": "C"}
    try:
        done = subprocess.run(
            [tool, *arguments],
            input=source,
            cwd=_CACHE,
            env=locale,
            capture_output=True,
            timeout=_COMPILE_S,
            check=False,
        )
    except OSError as error:
        raise UsageError(f"cannot start the compiler {tool}: {error.strerror}; run tools/setup") from None
    except subprocess.TimeoutExpired:
        raise UsageError(f"{name} takes the compiler longer than {_COMPILE_S:g} s") from None
    told = (done.stderr + done.stdout).decode(errors="replace").replace(path or "\0", name).rstrip()
    if done.returncode:
        hint = "\na robot has only the functions that octet_brain.h names" if _UNKNOWN in told else ""
        raise UsageError(f"{name} cannot be compiled:\n{told}{hint}")
    return told


def _check_symbols(name: str, made: Path) -> None:
    """Refuses functions that a robot does not have, and variables that several robots would share."""
    command = ["nm", "-l", "-f", "sysv", os.fspath(made)]
    table = subprocess.run(command, capture_output=True, text=True, errors="replace", check=True).stdout
    rows = [[word.strip() for word in line.split("|")] for line in table.splitlines() if line.count("|") == _COLUMNS]
    functions = {row[0] for row in rows if row[2] == "T"}
    for function in ("own_begin", "own_next"):
        if function not in functions:
            raise UsageError(f"{name} has no function {function}: octet_brain.h says what it does")
    for symbol, _, kind, _, _, _, section in rows:
        where, _, line = section.partition("\t")
        at = f"{name}:{line.rpartition(':')[2]}" if line else name
        if symbol == "main":
            raise UsageError(f"{at}: a robot has a main already, which calls own_begin and own_next: remove this one")
        if kind == "U" and not _ALLOWED.fullmatch(symbol):
            raise UsageError(f"{at}: a robot has no {symbol}: octet_brain.h names all that it has")
        if kind in "bBdDC" and _VARIABLE.fullmatch(where):
            variable = symbol.partition(".")[0]
            raise UsageError(
                f"{at}: the variable {variable} is not part of *brain, so that all robots would share it: "
                "use brain->own[0..7]"
            )


_COLUMNS = 6


@cache
def _tools() -> Any:
    """The compiler, its warnings, and the guards, as CMake knows them."""
    try:
        return json.loads((_MADE / "own.json").read_text())
    except OSError:
        raise OctetError("behaviours in C files need a checkout of Octet with gcc: run tools/setup there") from None


def _prune() -> None:
    """Drops the least recently used entries, except those of the last hour: another run may be about to link them."""
    used = {it: it.stat().st_mtime for it in _CACHE.iterdir() if it.is_dir()}
    for folder in sorted(used, key=lambda it: used[it])[:-_CACHED_MAX]:
        if used[folder] <= time.time() - _BUSY_S:
            shutil.rmtree(folder, ignore_errors=True)
