"""tools/with-vcan, for real: a bus is started for each."""

import os
import signal
import subprocess
from pathlib import Path

import pytest

from tests.tools.processes import alive, soon

TOOLS = Path(__file__).resolve().parents[2] / "tools"
WITH_VCAN = TOOLS / "with-vcan"

Finished = subprocess.CompletedProcess[str]


@pytest.fixture(scope="module", autouse=True)
def _a_way_to_a_bus() -> None:
    if subprocess.run([TOOLS / "setup", "vcan"], check=False).returncode != 0:
        pytest.skip("vcan: tools/with-vcan has no way to a bus")


@pytest.fixture(scope="module")
def finished(tmp_path_factory: pytest.TempPathFactory) -> Finished:
    """A command that shows what reached it, prints to both outputs, leaves a process behind and exits with 3."""
    script = 'printf "<%s>" "$@" "$PWD" "$OCTET_CANARY"; ip -brief link show vcan0 >&2; sleep 1000 & exit 3'
    command = [str(WITH_VCAN), "bash", "-c", script, "bash", "a b'c", "", '$HOME "*"\n']
    folder = tmp_path_factory.mktemp("a folder")
    environment = {**os.environ, "OCTET_CANARY": "two\nlines"}
    return subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True, check=False)


def test_the_exit_code_comes_through(finished: Finished) -> None:
    assert finished.returncode == 3


def test_arguments_folder_and_environment_come_through(finished: Finished) -> None:
    assert finished.stdout.startswith('<a b\'c><><$HOME "*"\n></')
    assert finished.stdout.endswith("/a folder0><two\nlines>")


def test_the_bus_is_there_and_nothing_else_is_in_the_error_output(finished: Finished) -> None:
    assert finished.stderr.startswith("vcan0 ")
    assert finished.stderr.count("\n") == 1


def test_a_megabyte_comes_through_unharmed() -> None:
    data = "".join(f"{number:015}\n" for number in range(65536))
    script = "for number in range(65536): print(f'{number:015}')"
    assert subprocess.check_output([WITH_VCAN, "python3", "-c", script], text=True) == data


def test_two_at_once_do_not_hear_each_other() -> None:
    script = "(sleep 0.5; cansend vcan0 {frame}) & candump -n 2 -T 2000 vcan0"
    both = [
        subprocess.Popen([WITH_VCAN, "bash", "-c", script.format(frame=frame)], stdout=subprocess.PIPE, text=True)
        for frame in ("101#", "102#")
    ]
    heard = [process.communicate(timeout=60)[0].split() for process in both]
    assert heard == [["vcan0", "101", "[0]"], ["vcan0", "102", "[0]"]]


def test_what_it_started_ends_with_it(tmp_path: Path) -> None:
    started = tmp_path / "started"
    process = subprocess.Popen([WITH_VCAN, "bash", "-c", f"touch '{started}'; sleep 1000"])
    assert soon(started.exists)
    family = {process.pid, *descendants(process.pid)}

    process.send_signal(signal.SIGTERM)

    assert process.wait(timeout=10) in (143, -signal.SIGTERM)
    assert soon(lambda: not any(alive(pid) for pid in family))


def descendants(pid: int) -> list[int]:
    children = [int(child) for child in Path(f"/proc/{pid}/task/{pid}/children").read_text().split()]
    return children + [pid for child in children for pid in descendants(child)]
