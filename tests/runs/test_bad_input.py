"""Whatever is typed wrong gets one clear line and an exit code, and nothing is overwritten."""

import os
import re
import resource
import shutil
import subprocess
import sys

import pytest

from host_sim.recording.memory_file import memory_lock
from host_sim.sim import access
from tests.runs.support import ROBOT, ROOT, octet, octet_process


def test_option_with_a_fractional_lower_limit_names_it_in_its_error():
    assert "0.1 to 1000" in octet("picture", "x.log", "--gif", "x.gif", "--speed", "0").stderr


OVER_ITS_INPUT = {
    "a picture": ("picture", "--png"),
    "an animation": ("picture", "--gif"),
    "a page": ("replay", "--html"),
    "a table": ("export", "--csv"),
}


@pytest.mark.parametrize(("command", "option"), OVER_ITS_INPUT.values(), ids=OVER_ITS_INPUT.keys())
def test_command_refuses_to_overwrite_its_input_log(run, tmp_path, command, option):
    done = run("--environments", "1", "--bus", "none", "--limit-s", "2")
    (tmp_path / "link").symlink_to(done.out / "run.log")

    refused = octet(command, done.out / "run.log", option, tmp_path / "link")

    assert refused.returncode == 2
    assert (
        refused.stderr == f"octet: {tmp_path / 'link'} is the input of {command}: choose another file with {option}\n"
    )
    assert octet("replay", done.out / "run.log").returncode == 0


@pytest.mark.parametrize("words", [("picture", "--png", "--gif"), ("export", "--csv", "--asc")])
def test_command_refuses_one_file_for_two_outputs(run, tmp_path, words):
    command, first, second = words
    done = run("--environments", "1", "--bus", "none", "--limit-s", "2")

    refused = octet(command, done.out / "run.log", first, tmp_path / "x", second, tmp_path / "x")

    assert refused.returncode == 2
    assert refused.stderr == f"octet: {first} and {second} name the same file: {tmp_path / 'x'}\n"
    assert not (tmp_path / "x").exists()


def test_world_command_refuses_to_overwrite_its_world_file(tmp_path):
    world = tmp_path / "my.toml"
    shutil.copy(ROOT / "docs/worlds/two_walls.toml", world)
    (tmp_path / "link").symlink_to(world)

    refused = octet("world", world, "--png", tmp_path / "link")

    assert refused.stderr == f"octet: {tmp_path / 'link'} is the input of world: choose another file with --png\n"
    assert octet("world", world).returncode == 0


@pytest.mark.parametrize("name", ["run.log", "summary.json", "run.world.json", "fleet.png"])
def test_run_refuses_a_memory_file_named_like_one_of_its_outputs(tmp_path, name):
    done = octet("run", "--bus", "none", "--limit-s", "2", "--out", tmp_path, "--memory", tmp_path / name)

    said = f"octet: the run would overwrite {tmp_path / name}: choose another file with --memory\n"
    assert (done.returncode, done.stderr) == (2, said)
    assert list(tmp_path.iterdir()) == []


def test_memory_path_that_is_no_regular_file_is_refused(tmp_path):
    (tmp_path / "robot.mem").mkdir()

    done = octet(
        "run", "--bus", "none", "--limit-s", "2", "--out", tmp_path / "out", "--memory", tmp_path / "robot.mem"
    )

    assert done.returncode == 2
    assert done.stderr == f"octet: cannot write {tmp_path / 'robot.mem'}: it is not a regular file\n"


def test_memory_file_in_use_by_another_run_is_refused(tmp_path):
    memory, words = tmp_path / "robot.mem", ("run", "--bus", "none", "--limit-s", "2", "--out", tmp_path / "out")

    with memory_lock(memory):
        refused = octet(*words, "--memory", memory)

    assert refused.returncode == 2
    assert refused.stderr.startswith(f"octet: {memory} is in use by another run (process ")
    assert refused.stderr.endswith("; choose another file with --memory\n")
    assert list(tmp_path.iterdir()) == []
    assert octet(*words, "--memory", memory).returncode == 0


BAD_MEMORIES = {
    "cut short": (bytes(7), "7 bytes"),
    "too long": (bytes(9), "9 bytes"),
    "empty": (b"", "0 bytes"),
    "of no action": (bytes([0, 1, 3, 0, 0, 0, 0, 0]), "no behaviour writes 00 01 03"),
    "with something in cell 0": (bytes([1, 0, 0, 0, 0, 0, 0, 0]), "no behaviour writes 01 00"),
}


@pytest.mark.parametrize(("content", "named"), BAD_MEMORIES.values(), ids=BAD_MEMORIES.keys())
def test_invalid_memory_file_is_refused_and_left_unchanged(run, tmp_path, content, named):
    memory = tmp_path / "robot.mem"
    memory.write_bytes(content)

    done = run("--environments", "1", "--bus", "none", "--memory", memory)

    assert done.code == 2
    assert named in done.errors
    assert memory.read_bytes() == content


@pytest.mark.parametrize("name", ["summary.json", "arena.png", "run.log"])
def test_folder_in_place_of_an_output_file_is_named(tmp_path, name):
    (tmp_path / name / "mine").mkdir(parents=True)

    done = octet("run", "--bus", "none", "--environments", "1", "--limit-s", "1", "--out", tmp_path)

    assert done.returncode == 1
    assert re.fullmatch(f"octet: cannot (replace|write) {re.escape(str(tmp_path / name))}: .*\n", done.stderr)
    assert (tmp_path / name / "mine").is_dir()


def test_output_folder_that_is_a_file_is_refused(tmp_path):
    in_the_way = tmp_path / "out"
    in_the_way.write_text("mine")

    done = octet("run", "--bus", "none", "--out", in_the_way)

    assert done.returncode == 2
    assert "choose another with --out" in done.stderr
    assert in_the_way.read_text() == "mine"


def no_large_files() -> None:
    """No file may be larger than 100 kB: as good as a disk with no more room."""
    resource.setrlimit(resource.RLIMIT_FSIZE, (100_000, 100_000))


def test_full_disk_is_reported_and_the_old_log_stays(tmp_path):
    (tmp_path / "run.log").write_text("old")

    done = octet_process("run", "--bus", "none", "--environments", "1", "--out", tmp_path, preexec_fn=no_large_files)

    assert done.returncode == 1
    assert re.fullmatch(r"octet: cannot write .*run\.log\.part: File too large\n", done.stderr)
    assert (tmp_path / "run.log").read_text() == "old"


def test_text_may_begin_with_a_byte_order_mark(run, tmp_path):
    def marked(name: str, text: str):
        (tmp_path / name).write_text(text, encoding="utf-8-sig")
        return tmp_path / name

    rules = f"@{marked('rules', 'drop@5/to')}"
    world = marked("w.toml", (ROOT / "docs/worlds/two_walls.toml").read_text())
    changes = marked("changes", "plant@1s\n")

    done = run("--environments", "1", "--bus", "none", "--limit-s", "2", "--fault", rules, "--change", changes)

    assert done.code == 0, done.errors
    assert octet("replay", marked("marked.log", done.log.decode())).returncode == 0
    assert octet("world", world).stderr == ""


def test_auto_bus_is_fd_when_the_with_vcan_script_is_missing(tmp_path, monkeypatch):
    monkeypatch.setattr(access, "_WITH_VCAN", tmp_path / "with-vcan")
    monkeypatch.delenv("OCTET_VCAN_CHOSEN", raising=False)

    assert access.choose_bus("auto", "spawn") == "fd"


def test_robot_with_another_message_layout_is_refused(tmp_path):
    """A simulator of its own, in whose octet.dbc two signals have changed places, with the robot that is here."""
    shutil.copytree(ROOT / "host_sim", tmp_path / "host_sim")
    dbc, python = tmp_path / "hal/protocol/octet.dbc", tmp_path / "host_sim/protocol/generated.py"
    dbc.parent.mkdir(parents=True)
    text = (ROOT / "hal/protocol/octet.dbc").read_text()
    dbc.write_text(text.replace("bump : 25|", "bump : 26|").replace("look : 26|", "look : 25|"))
    subprocess.run([sys.executable, ROOT / "tools/generate", "--dbc", dbc, "--python", python], check=True)
    shutil.copy(ROOT / "hal/protocol/robot.toml", dbc.parent)
    (tmp_path / "build").symlink_to(ROOT / "build")

    done = octet_process("run", "--bus", "fd", "--out", tmp_path / "out", cwd=tmp_path)

    assert done.returncode == 1
    assert "another octet.dbc" in done.stderr
    assert done.stderr.count("\n") == 1
    assert not (tmp_path / "out/run.log").exists()


ROBOT_WRONG = {
    "nothing": ([], 2),
    "a node out of range": (["--node", "0", "fd:0"], 2),
    "two links": (["fd:0", "fd:1"], 2),
    "an unknown option": (["--warp", "fd:0"], 2),
    "an unknown kind of link": (["pigeon:1"], 2),
    "an fd that is not open": (["fd:999"], 1),
    "an interface that does not exist": (["socketcan:nowhere0"], 1),
    "a tty that does not exist": (["slcan:/dev/nowhere"], 1),
}


@pytest.mark.parametrize(("words", "code"), ROBOT_WRONG.values(), ids=ROBOT_WRONG.keys())
def test_robot_program_reports_arguments_that_it_cannot_use(words, code):
    done = subprocess.run([os.fspath(ROBOT), *words], capture_output=True, text=True, check=False)

    assert done.returncode == code
    assert done.stderr
