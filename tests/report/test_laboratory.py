"""What the page of a run has so that its future can be changed, and what it says where it has not."""

import json
from pathlib import Path

import pytest

from host_sim.cli import replay_command
from host_sim.protocol.codec import Frame
from host_sim.recording.log_reader import read_log
from host_sim.report import octet_page as octet_page_module
from host_sim.report.laboratory import NO_FIRMWARE
from host_sim.report.octet_page import class_page, octet_page
from host_sim.report.page_bundle import packed_page
from tests.runs.support import data_in, octet, octet_process, unpacked


@pytest.fixture
def run_of(tmp_path: Path):
    """Makes short runs; returns their logs."""

    def make(*words: str) -> Path:
        options = ("--bus", "none", "--quiet", "--limit-s", "4", "--environments", "1", "--out", tmp_path)
        assert octet("run", *options, *words).returncode == 0
        return tmp_path / "run.log"

    return make


def laboratory_in(page: Path) -> dict:
    """The parts of a page; of their wasm and worker only that they are there."""
    parts = data_in(page.read_text(), "parts")
    return {name: bool(part) if name in ("wasm", "worker") else part for name, part in parts.items()}


def test_page_holds_the_firmware_and_the_recorded_commands(run_of, tmp_path):
    log, page = run_of("--robots", "2", "--set", "turn_deg=20"), tmp_path / "page.html"

    done = octet("replay", log, "--html", page, "--what-if")

    assert (done.returncode, done.stderr) == (0, "")
    held = laboratory_in(page)
    run = held["recorded"]
    assert [held["wasm"], held["worker"]] == [True, True]
    assert run["ticks"] == 200
    assert json.loads(run["world"])["robots"] == 2
    commands = [line.frame for line in read_log(log) if line.frame.id in (0x021, 0x022)]
    told = [Frame(0x021 + robot, bytes.fromhex(digits)) for _, robot, digits in run["commands"]]
    assert told == commands
    assert {tick for tick, *_ in run["commands"]} == {0, 200}


def test_packed_octet_html_is_at_most_260_kb():
    assert len(packed_page(octet_page()).encode()) <= 260_000


def test_class_page_may_reach_its_server_and_is_marked_as_one():
    text = unpacked(class_page())

    assert "default-src 'none'; connect-src 'self'; " in text
    assert '<meta name="octet-class"' in text


def test_page_of_a_run_holds_the_same_as_one_made_of_its_log(tmp_path):
    words = ("--robots", "2", "--limit-s", "4", "--environments", "1", "--set", "turn_deg=20", "--change", "plant@2s")

    done = octet_process("run", "--bus", "none", "--quiet", "--out", tmp_path, *words)

    assert (done.returncode, done.stderr) == (0, "")
    octet_process("replay", tmp_path / "run.log", "--html", tmp_path / "page.html")
    [own, replayed] = [laboratory_in(tmp_path / name) for name in ("replay.html", "page.html")]
    told = [sorted(it["recorded"].pop("commands")) for it in (own, replayed)]
    assert told[0] == told[1]
    assert own == replayed


def test_page_lacks_the_firmware_if_it_was_not_built_for_pages(run_of, tmp_path, monkeypatch):
    monkeypatch.setattr(replay_command, "PAGE_WASM", tmp_path / "missing.wasm")
    log, page = run_of(), tmp_path / "page.html"

    done = octet("replay", log, "--html", page)

    assert (done.returncode, done.stderr) == (0, "")
    assert laboratory_in(page) == laboratory_in(log.with_name("replay.html"))
    assert NO_FIRMWARE.items() <= laboratory_in(page).items()
    assert "wasm" not in laboratory_in(page)


def test_missing_build_for_what_if_is_named(run_of, tmp_path, monkeypatch):
    monkeypatch.setattr(octet_page_module, "PAGE_WASM", tmp_path / "missing.wasm")

    done = octet("replay", run_of(), "--html", tmp_path / "page.html", "--what-if")

    assert done.returncode == 1
    assert done.stderr.endswith("build it with tools/setup page\n")
    assert not (tmp_path / "page.html").exists()


@pytest.mark.parametrize(
    ("words", "why"),
    [(("--robots", "5"), "What if? supports only robots of nodes 1 to 4."), (("--node", "2"), "What if? supports")],
)
def test_replay_says_why_what_if_cannot_repeat_a_run(run_of, tmp_path, words, why):
    log, page = run_of(*words), tmp_path / "page.html"

    done = octet("replay", log, "--html", page, "--what-if", *words[:2] if words[0] == "--node" else ())

    assert done.returncode == 0
    assert done.stderr.startswith(f"octet: {why}")
    assert laboratory_in(page)["why"].startswith(why)


def test_replay_says_that_what_if_needs_the_world_of_the_run(run_of, tmp_path):
    page = tmp_path / "page.html"

    done = octet("replay", run_of(), "--html", page, "--no-world", "--what-if")

    assert done.stderr == "octet: What if? needs the world of the run, which is not known here.\n"
    assert laboratory_in(page)["why"] == "What if? needs the world of the run, which is not known here."


def test_replay_refuses_what_if_without_html(run_of):
    done = octet("replay", run_of(), "--what-if")

    assert (done.returncode, done.stderr) == (2, "octet: --what-if is for a page: name it with --html FILE\n")
