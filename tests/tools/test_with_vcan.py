"""tools/with-vcan with real buses: each test starts one."""

import os
import re
import shutil
import signal
import subprocess
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest

from tests.tools.project import alive, soon

TOOLS = Path(__file__).resolve().parents[2] / "tools"
WITH_VCAN = TOOLS / "with-vcan"
NOBODY = 65534

Finished = subprocess.CompletedProcess[str]


@pytest.fixture(scope="module", autouse=True)
def _a_way_to_a_bus() -> None:
    if subprocess.run([TOOLS / "setup", "vcan"], check=False).returncode != 0:
        pytest.skip("vcan: tools/with-vcan has no way to a bus")


@pytest.fixture(scope="module")
def way() -> str:
    """The way to a bus on this machine."""
    return subprocess.check_output([WITH_VCAN, "--how"], text=True).strip()


@pytest.fixture(scope="module")
def finished(tmp_path_factory: pytest.TempPathFactory) -> Finished:
    """A command that shows what reached it, prints to both outputs, leaves a process behind and exits with 3."""
    script = 'printf "<%s>" "$@" "$PWD" "$OCTET_CANARY"; ip -brief link show vcan0 >&2; sleep 1000 & exit 3'
    command = [str(WITH_VCAN), "bash", "-c", script, "bash", "a b'c", "", '$HOME "*"\n']
    folder = tmp_path_factory.mktemp("a folder")
    environment = {**os.environ, "OCTET_CANARY": "two\nlines"}
    return subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True, check=False)


def test_exit_code_of_the_command_is_returned(finished: Finished) -> None:
    assert finished.returncode == 3


def test_arguments_folder_and_environment_reach_the_command(finished: Finished) -> None:
    assert finished.stdout.startswith('<a b\'c><><$HOME "*"\n></')
    assert re.search(r"/a folder\d><two\nlines>$", finished.stdout)


def test_bus_exists_and_error_output_has_nothing_else(finished: Finished) -> None:
    assert finished.stderr.startswith("vcan0 ")
    assert finished.stderr.count("\n") == 1


def test_output_of_256_kib_is_unchanged() -> None:
    data = "".join(f"{number:015}\n" for number in range(16384))
    script = "for number in range(16384): print(f'{number:015}')"
    assert subprocess.check_output([WITH_VCAN, "python3", "-c", script], text=True) == data


# Sends a frame until candump hears it; once both listen, another one until that is heard.
# On a shared bus, the other's would then be heard, too.
TALK = """
candump -L vcan0 >{me} &
until grep -q '#AA' {me}; do cansend vcan0 {me}#AA; sleep 0.05; done
touch {me}.listens
until [ -e {other}.listens ]; do sleep 0.05; done
until grep -q '#BB' {me}; do cansend vcan0 {me}#BB; sleep 0.05; done
touch {me}.said
until [ -e {other}.said ]; do sleep 0.05; done
"""


def test_simultaneous_calls_have_separate_buses(tmp_path: Path) -> None:
    names = ("101", "102")
    scripts = [TALK.format(me=me, other=other) for me, other in (names, names[::-1])]

    both = [subprocess.Popen([WITH_VCAN, "bash", "-c", script], cwd=tmp_path) for script in scripts]

    assert [process.wait() for process in both] == [0, 0]
    for name in names:
        heard = {line.split()[2] for line in (tmp_path / name).read_text().splitlines()}
        assert heard == {f"{name}#AA", f"{name}#BB"}


def test_with_vcan_ends_the_processes_that_it_started(tmp_path: Path) -> None:
    started = tmp_path / "started"
    process = subprocess.Popen([WITH_VCAN, "bash", "-c", f"touch '{started}'; sleep 1000"])
    assert soon(started.exists)
    family = {process.pid, *descendants(process.pid)}

    process.send_signal(signal.SIGTERM)

    assert process.wait() in (143, -signal.SIGTERM)
    assert soon(lambda: not any(alive(pid) for pid in family))


def test_next_call_removes_only_the_folder_of_a_killed_one(tmp_path: Path, way: str) -> None:
    started, goes_on = tmp_path / "started", tmp_path / "goes on"
    wait = f"while [ ! -e '{goes_on}' ]; do sleep 0.05; done; exit 5"
    first = subprocess.Popen([WITH_VCAN, "bash", "-c", wait])
    killed = subprocess.Popen([WITH_VCAN, "bash", "-c", f"touch '{started}'; {wait}"])
    assert soon(started.exists)
    family = [killed.pid, *descendants(killed.pid)]
    left = folders_of(killed.pid)
    assert len(left) == (1 if way == "user-mode-linux" else 0)

    killed.kill()
    killed.wait()
    assert soon(lambda: not any(alive(pid) for pid in family))
    subprocess.run([WITH_VCAN, "true"], check=True)
    goes_on.touch()

    assert first.wait() == 5
    assert not any(folder.exists() for folder in left)


def folders_of(pid: int) -> list[Path]:
    """The folders of tools/with-vcan that a process has open."""
    targets = [os.readlink(link) for link in Path(f"/proc/{pid}/fd").iterdir()]  # noqa: PTH115 - some are no files
    return [Path(target) for target in targets if target.startswith("/tmp/octet-vcan.")]


@pytest.fixture
def as_an_ordinary_user() -> Iterator[tuple[Path, Sequence[str]]]:
    """A folder of an ordinary user, with a copy of tools/with-vcan, and what makes a command run as that user."""
    with TemporaryDirectory() as folder:
        become: list[str] = []
        for name in ("with-vcan", "legacy-fpu"):
            shutil.copy(TOOLS / name, folder)
        if os.geteuid() == 0:
            os.chown(folder, NOBODY, NOBODY)
            become = ["setpriv", f"--reuid={NOBODY}", f"--regid={NOBODY}", "--clear-groups"]
        yield Path(folder), become


def test_ordinary_user_owns_its_files_and_may_set_up_the_bus(as_an_ordinary_user) -> None:
    folder, become = as_an_ordinary_user
    script = "touch file; test -O file && test -O . && ip link set vcan0 down && ip link set vcan0 up"

    done = subprocess.run([*become, "./with-vcan", "bash", "-c", script], cwd=folder, check=False)

    assert done.returncode == 0
    assert (folder / "file").owner() == folder.owner()


# Forbids tracing, as a container's seccomp profile may.
FORBID = """
import ctypes, os, struct, sys
program = [(0x20, 0, 0), (0x15, 1, 101), (0x06, 0, 0x00050001), (0x06, 0, 0x7FFF0000)]
code = ctypes.create_string_buffer(b"".join(struct.pack("=HBBI", it[0], 0, it[1], it[2]) for it in program))
class Program(ctypes.Structure):
    _fields_ = (("length", ctypes.c_ushort), ("filter", ctypes.c_void_p))
libc = ctypes.CDLL(None)
assert libc.prctl(38, 1, 0, 0, 0) == 0
assert libc.prctl(22, 2, ctypes.byref(Program(len(program), ctypes.addressof(code))), 0, 0) == 0
os.execv(sys.argv[1], sys.argv[1:])
"""


def missing(*launcher: str, **environment: str) -> str:
    command = [*launcher, str(WITH_VCAN), "--missing"]
    return subprocess.check_output(command, env={**os.environ, **environment}, text=True)


@pytest.mark.parametrize("word", ["-h", "--help"])
def test_help_says_what_with_vcan_is_for(word: str) -> None:
    done = subprocess.run([WITH_VCAN, word], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout.startswith("tools/with-vcan COMMAND...: runs a command where the CAN bus vcan0 exists.")


def test_forbidden_tracing_is_named() -> None:
    assert "ptrace" in missing(sys.executable, "-c", FORBID)
    assert "ptrace" not in missing()


def test_missing_command_is_named_with_its_package() -> None:
    hidden = {
        "BASH_FUNC_command%%": '() { [ "$*" != "-v ip" ] && builtin command "$@"; }'
    }  # asked instead of bash's own
    assert missing(**hidden) == "the command ip (Debian's package iproute2)\n"


def changed(folder: Path, old: str, new: str) -> Path:
    """A copy of tools/with-vcan with a text replaced."""
    text = WITH_VCAN.read_text()
    assert text.count(old) == 1
    for name in ("with-vcan", "legacy-fpu"):
        shutil.copy(TOOLS / name, folder)
    (folder / "with-vcan").write_text(text.replace(old, new))
    return folder / "with-vcan"


def test_failure_inside_user_mode_linux_is_named(tmp_path: Path, way: str) -> None:
    broken = changed(tmp_path, "net/can/can-raw", "net/can/nosuch")

    done = subprocess.run([broken, "true"], capture_output=True, text=True, check=False)

    inside = way == "user-mode-linux"
    assert done.returncode == int(inside)
    assert ("in User-Mode Linux this failed: insmod" in done.stderr) == inside
    assert "panic" not in done.stderr.lower()


def test_user_mode_linux_has_io_uring_disabled(way: str) -> None:
    """io_uring would corrupt the memory of User-Mode Linux."""
    look = "cat /proc/sys/kernel/io_uring_disabled || echo 2"
    disabled = subprocess.check_output([WITH_VCAN, "bash", "-c", look], text=True, stderr=subprocess.DEVNULL)

    assert way != "user-mode-linux" or disabled == "2\n"


def test_kernel_failure_after_the_command_keeps_its_exit_code(tmp_path: Path, way: str) -> None:
    broken = changed(tmp_path, "  wait %1 %2\n", "  echo c >/proc/sysrq-trigger\n")

    done = subprocess.run([broken, "bash", "-c", "exit 3"], capture_output=True, text=True, check=False)

    inside = way == "user-mode-linux"
    assert done.returncode == 3
    assert ("octet: the command had ended when User-Mode Linux stopped" in done.stderr) == inside


def test_result_of_a_damaged_kernel_does_not_count(tmp_path: Path, way: str) -> None:
    broken = changed(tmp_path, "  wait %1 %2\n", "  wait %1 %2\n  echo '<1>BUG: canary' >/dev/kmsg\n")

    done = subprocess.run([broken, "true"], capture_output=True, text=True, check=False)

    inside = way == "user-mode-linux"
    assert done.returncode == int(inside)
    assert ("BUG: canary" in done.stderr and "does not count" in done.stderr) == inside


# In place of User-Mode Linux: ends at once, but for a process that has stopped and holds the outputs open.
LEAVES_ONE = """#!/usr/bin/env python3
import os, pathlib, signal, sys
(box,) = (word.partition("=")[2] for word in sys.argv if word.startswith("uml_dir="))
os.setsid()
left = os.fork()
if left == 0:
    os.kill(os.getpid(), signal.SIGSTOP)
os.waitpid(left, os.WUNTRACED)
pathlib.Path("{noted}").write_text(str(left))
if "{code}":
    pathlib.Path(box, "code").write_text("{code}")
else:
    signal.pause()
"""


@pytest.mark.parametrize("code", ["4", ""], ids=["ended", "killed"])
def test_processes_left_by_the_kernel_end_with_the_call(tmp_path: Path, code: str) -> None:
    with_vcan = changed(tmp_path, "way=$(how)\nif", "way=user-mode-linux\nif")
    noted, fake = tmp_path / "noted", tmp_path / "linux.uml"
    fake.write_text(LEAVES_ONE.format(noted=noted, code=code))
    fake.chmod(0o755)
    environment = {**os.environ, "PATH": f"{tmp_path}:{os.environ['PATH']}"}
    process = subprocess.Popen([with_vcan, "sleep", "1" if code else "1000"], env=environment)
    assert soon(lambda: noted.exists() and noted.read_text() != "")

    if not code:
        process.kill()

    assert process.wait(60) == (int(code) if code else -signal.SIGKILL)
    assert soon(lambda: not alive(int(noted.read_text())))


def descendants(pid: int) -> list[int]:
    try:
        children = [int(child) for child in Path(f"/proc/{pid}/task/{pid}/children").read_text().split()]
    except FileNotFoundError:
        return []  # it has ended meanwhile
    return children + [pid for child in children for pid in descendants(child)]


def test_quick_way_is_empty_if_the_way_starts_another_kernel(way: str) -> None:
    quick = subprocess.check_output([WITH_VCAN, "--quick-way"], text=True).strip()

    assert quick == (way if way in ("present", "namespace") else "")
