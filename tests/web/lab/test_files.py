"""Logs, memories and worlds go out of octet.html and come back; they are those of the host."""

import hashlib

from tests.runs.support import ROOT, octet
from tests.web.lab.support import saved, simulated
from tests.web.support import wait_for, wait_for_text


def test_saved_log_is_that_of_tools_run(page, tmp_path):
    assert octet("run", "--bus", "none", "--seed", "1", "--quiet", "--out", tmp_path).returncode == 0

    log = saved(page, "#save-log")

    assert hashlib.sha256(log).hexdigest() == hashlib.sha256((tmp_path / "run.log").read_bytes()).hexdigest()


def test_opened_log_gives_the_same_run(page, tmp_path):
    words = ("--profile", "adaptive", "--environments", "2", "--seed", "9", "--set", "turn_deg=20")
    assert octet("run", "--bus", "none", "--quiet", "--out", tmp_path, *words).returncode == 0
    page.click("#tab-files")

    page.set_input_files("#open", [tmp_path / "run.log", tmp_path / "run.world.json"])

    wait_for_text(page, "#file-news", "byte for byte")
    simulated(page)
    assert saved(page, "#save-log") == (tmp_path / "run.log").read_bytes()


def test_malformed_log_is_reported(page, tmp_path):
    (tmp_path / "run.log").write_text("hello\n")
    page.click("#tab-files")

    page.set_input_files("#open", tmp_path / "run.log")

    wait_for_text(page, "#file-news", "line 1 is not a frame of a log")


def test_failed_save_is_reported(page):
    page.evaluate("void (octet.simulator.ask = () => Promise.reject(new Error('no memory left')))")
    page.click("#tab-files")

    page.click("#save-log")

    wait_for_text(page, "#file-news", "no memory left")


def test_memory_is_saved_and_opened_again(page, tmp_path):
    page.evaluate("octet.go(octet.last)")
    memory = saved(page, "#save-memory")
    (tmp_path / "robot.mem").write_bytes(memory)
    page.click("#tab-files")

    page.set_input_files("#open", tmp_path / "robot.mem")

    wait_for_text(page, "#file-news", "The robot starts with robot.mem.")
    simulated(page)
    page.evaluate("octet.go(0)")
    assert bytes(page.evaluate("octet.scene.state.memory")) == memory


def test_memory_is_saved_with_its_confidence(page, tmp_path):
    page.select_option("#behaviour", "adaptive")
    page.fill("#environments", "1")
    page.click("#new-run button")
    wait_for(page, "octet.lane.data")
    simulated(page)
    page.evaluate("octet.go(octet.last)")
    words = ("--profile", "adaptive", "--environments", "1", "--memory", tmp_path / "host.mem")
    assert octet("run", "--bus", "none", "--quiet", "--out", tmp_path, *words).returncode == 0

    memory = saved(page, "#save-memory")

    assert memory == (tmp_path / "host.mem").read_bytes()
    assert max(memory) > 2


def test_malformed_memory_is_reported_and_not_used(page, tmp_path):
    (tmp_path / "robot.mem").write_bytes(bytes([0, 99, 0, 0, 0, 0, 0, 0]))
    page.click("#tab-files")

    page.set_input_files("#open", tmp_path / "robot.mem")

    wait_for_text(page, "#file-news", "these eight bytes are not a robot's memory")
    assert page.evaluate("octet.lane.experiment.robots[0].memory") is None


def test_world_file_begins_a_run_in_it(page, tmp_path):
    world = ROOT / "docs/worlds/two_walls.toml"
    assert octet("run", "--bus", "none", "--world", world, "--quiet", "--out", tmp_path).returncode == 0
    page.click("#tab-files")

    page.set_input_files("#open", world)

    wait_for_text(page, "#file-news", "A new run in two_walls.toml.")
    assert saved(page, "#save-log") == (tmp_path / "run.log").read_bytes()
    assert page.evaluate("document.querySelector('#worlds input:checked').value") == "two_walls.toml"


def test_opened_log_shows_the_behaviour_at_the_shown_tick(page, tmp_path):
    page.evaluate("octet.go(400)")
    page.select_option("#behaviour", "never")
    simulated(page)
    (tmp_path / "run.log").write_bytes(saved(page, "#save-log"))
    (tmp_path / "run.world.json").write_bytes(saved(page, "#save-world"))
    page.click("#tab-files")

    page.set_input_files("#open", [tmp_path / "run.log", tmp_path / "run.world.json"])

    wait_for_text(page, "#file-news", "byte for byte")
    simulated(page)
    page.evaluate("octet.go(300)")
    wait_for_text(page, "figcaption", "original: article, seed 1")
    page.evaluate("octet.go(500)")
    wait_for_text(page, "figcaption", "original: never, seed 1")


def test_message_about_a_file_follows_the_chosen_language(page, tmp_path):
    (tmp_path / "robot.mem").write_bytes(bytes(8))
    page.click("#tab-files")
    page.set_input_files("#open", tmp_path / "robot.mem")
    wait_for_text(page, "#file-news", "The robot starts with robot.mem.")

    page.select_option("#language", "de")

    assert page.inner_text("#file-news") == "Der Roboter beginnt mit robot.mem."


def test_world_file_opens_though_a_field_was_emptied(page):
    page.fill("#robot-count", "")
    page.click("#tab-files")

    page.set_input_files("#open", ROOT / "docs/worlds/two_walls.toml")

    wait_for_text(page, "#file-news", "A new run in two_walls.toml.")
    assert page.evaluate("octet.lane.experiment.robots.length") == 1
