"""A user's behaviour in flash images. The judges are the host's run of it, and QEMU."""

import json
import re
import subprocess
from contextlib import closing
from pathlib import Path

import pytest

from host_sim.base import image_build
from host_sim.base.errors import OctetError, RefusedError
from host_sim.base.paths import PACKAGE, ROOT
from host_sim.base.system import lock_at_once
from host_sim.client.commands import handshake, start
from host_sim.client.connection import Connection
from host_sim.client.frame_log import NoLog
from host_sim.client.robot_client import RobotClient
from host_sim.client.session import Session
from host_sim.emulator.board import start_board
from host_sim.protocol.codec import Protocol
from host_sim.protocol.generated import OWN_PROFILE
from host_sim.sim import own_brain
from tests.runs.support import octet_process

TEMPLATE = (PACKAGE / "program/own/mine.c").read_text()
ROBOTS = {"emulated": ("--robot", "emulated", "--board", "blue_pill"), "qemu": ("--robot", "qemu")}
SHORT = ("--environments", "1", "--limit-s", "12", "--quiet")


@pytest.fixture
def mine(tmp_path):
    text = TEMPLATE.replace("set[STEP_MM]", "set[STEP_MM] / 2")  # no built-in behaviour does that
    (tmp_path / "mine.c").write_text(
        f"{text}/* {tmp_path} */\n".replace("    brain->rep", '    note("x", 1);\n    brain->rep')
    )
    return tmp_path / "mine.c"


def drives(log: Path) -> list[str]:
    """Each DRIVE once: QEMU, which keeps no time, may be asked again."""
    frames = (line.split()[2] for line in log.read_text().splitlines())
    return list(dict.fromkeys(frame for frame in frames if frame.startswith("041#")))


def memory(folder: Path) -> list[int]:
    return json.loads((folder / "summary.json").read_text())["robots"][0]["memory"]


@pytest.mark.parametrize("robot", ROBOTS)
def test_image_with_a_custom_behaviour_equals_the_host(robot, mine, tmp_path):
    for out, words in (("host", ("--bus", "none")), ("image", ROBOTS[robot])):
        done = octet_process("run", "--profile", mine, *SHORT, *words, "--out", tmp_path / out)
        assert done.returncode == 0, done.stderr

    ours, theirs = drives(tmp_path / "image/run.log"), drives(tmp_path / "host/run.log")
    assert len(ours) >= 600
    assert ours == theirs
    assert memory(tmp_path / "image") == memory(tmp_path / "host")


def test_impossible_image_is_refused_before_it_is_built(mine, tmp_path):
    mine.write_text(TEMPLATE.replace("return true;", "return malloc(1) != 0;"))

    done = octet_process("run", "--profile", mine, *ROBOTS["qemu"], *SHORT, "--out", tmp_path)

    assert done.returncode == 2
    assert "mine.c:9:" in done.stderr


def test_lasting_build_lock_of_another_process_is_reported(mine, tmp_path, monkeypatch):
    monkeypatch.setattr(own_brain, "_IMAGES", tmp_path / "images")
    monkeypatch.setattr(image_build, "_OTHER_S", 0.3)
    brain = own_brain.own_brain(mine)
    (tmp_path / "images/pico").mkdir(parents=True)
    with (tmp_path / "images/pico.lock").open("w") as lock:
        lock_at_once(lock.fileno())
        with pytest.raises(OctetError, match="another octet still builds an image of pico"):
            brain.image("pico", "slcan")


FLASH = (ROOT / "tools/flash", "blue_pill", "bxcan", "--dry-run", "--probe", "stlink")


def flashed(*options: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run([*FLASH, *options], capture_output=True, text=True, check=False)


def starts_own() -> None:
    """Starts the profile `own` on an emulated board with the image that tools/flash has built."""
    elf = ROOT / "build/flash/blue_pill/octet-blue_pill-bxcan.elf"
    board = start_board("blue_pill", image=lambda *_: elf)
    with closing(board), closing(NoLog()) as log:
        client = RobotClient(Connection(board, "none", board.status, deadline_s=30.0), Protocol(1), log)
        handshake(client, 30.0)
        start(client, Session(1, OWN_PROFILE))


def test_flash_builds_images_with_and_without_a_custom_behaviour(mine):
    done = flashed("--profile", str(mine))
    assert done.returncode == 0, done.stderr
    assert "image  " in done.stdout
    starts_own()

    assert flashed().returncode == 0
    with pytest.raises(RefusedError):
        starts_own()


def test_flash_names_what_keeps_an_image_from_being_built(mine):
    table = "static const unsigned char table[100000] = {1};\n"
    mine.write_text(
        TEMPLATE.replace("bool own_begin", f"{table}bool own_begin").replace(
            "return true;", "return table[brain->own[0]] != 0;"
        )
    )

    done = flashed("--profile", str(mine))

    assert done.returncode == 1
    told = done.stderr.partition("tools/flash: octet-blue_pill-bxcan cannot be built:\n")[2]
    assert "overflowed by" in told
    assert re.findall(r"^(?:\[|FAILED|env ).*", told, re.MULTILINE) == []


def test_builds_at_once_each_make_the_image_asked_for():
    nodes = ("2", "3", "4")
    running = [subprocess.Popen([*FLASH, "--node", node], stdout=subprocess.PIPE, text=True) for node in nodes]

    told = [process.communicate()[0] for process in running]

    assert [f"robot  node {node}," in it for node, it in zip(nodes, told, strict=True)] == [True] * 3
