"""Animations and stills of a recorded run."""

import re
from pathlib import Path

import pytest
from PIL import Image, ImageChops

from host_sim.cli.main import main
from host_sim.recording.phrases import lesson_sentence, sentence
from host_sim.recording.state_types import State
from host_sim.recording.trajectory import Trajectory
from host_sim.report.animation import Clip, draw_frame, write_gif
from host_sim.report.drawing import CONE_LIT
from tests.runs.support import octet_process

README_BYTES_MAX = 1_500_000
IMAGES = Path(__file__).resolve().parents[2] / "docs/images"


def durations_ms(path: Path) -> list[int]:
    with Image.open(path) as image:
        return [image.seek(i) or image.info["duration"] for i in range(image.n_frames)]


def colours(trajectory: Trajectory, tick: int) -> set[tuple[int, ...]]:
    frame = draw_frame(trajectory, tick, 640)
    arena = frame.crop((0, 26, frame.width, 26 + 465))
    return {colour for _, colour in arena.getcolors(1 << 24)}


def test_clip_lasts_as_long_as_its_part_of_the_run_and_its_holds(short, tmp_path):
    held = [event for event in short.trajectory.events() if 2.0 <= event.tick * 0.02 <= 8.6 and event.tick]

    write_gif(tmp_path / "clip.gif", short.trajectory, Clip(2.0, 8.6))

    shown = durations_ms(tmp_path / "clip.gif")
    assert sum(duration > 1000 for duration in shown) == len({event.tick for event in held})
    assert 6.6 < sum(shown) / 1000 < 6.6 + 1.2 * len(held)


def test_clip_at_double_speed_is_half_as_long(short, tmp_path):
    for speed in (1.0, 2.0):
        write_gif(tmp_path / f"{speed:g}.gif", short.trajectory, Clip(0.0, 8.0, speed))

    slow, fast = (sum(durations_ms(tmp_path / f"{speed}.gif")) for speed in (1, 2))
    assert fast == pytest.approx(slow / 2, rel=0.1)


def test_equal_clips_are_equal_bytes(short, tmp_path):
    for name in "ab":
        write_gif(tmp_path / name, short.trajectory, Clip(2.0, 5.0, width_px=400))

    assert (tmp_path / "a").read_bytes() == (tmp_path / "b").read_bytes()


def test_cone_is_lit_only_when_its_sensor_detects_something(short):
    lit = tuple(bytes.fromhex(CONE_LIT[1:]))
    feel = short.trajectory.tracks[0].column("feel")

    assert lit in colours(short.trajectory, feel.index(max(feel)))
    assert lit not in colours(short.trajectory, feel.index(0))


def test_frame_has_the_requested_width(short):
    assert draw_frame(short.trajectory, 10, 480).width == 480


def state(**fields: object) -> State:
    rest = {
        "lifted": 0,
        "left": 251,
        "right": -251,
        "beacon": 0,
        "pattern": 0,
        "repeat_count": 0,
        "reason": 0,
        "trial": None,
        "by_hand": [0] * 8,
    }
    return State(**{**rest, **fields})


@pytest.mark.parametrize(
    ("fields", "words"),
    [
        ({"reason": 1}, "Nothing in my way: I drive on and look around for food."),
        ({"reason": 2, "beacon": 430}, "I see food 0.43 m ahead: I drive toward it."),
        ({"reason": 4, "pattern": 4}, "Front-left blocked: I remember that turning right helped."),
        ({"reason": 4, "pattern": 4, "by_hand": [1] * 8}, "Front-left blocked: I was told to turn right."),
        ({"reason": 5, "pattern": 7}, "All three blocked: I do not know what helps yet, so I try turning right."),
        ({"reason": 6, "repeat_count": 10}, "10 turns in a row, and still blocked. I am bored: about face!"),
        ({"reason": 7}, "Food! I eat it."),
        ({"reason": 4, "lifted": 1}, "Someone has picked me up: my wheels turn in the air."),
    ],
)
def test_sentence_tells_reason_pattern_and_side(fields, words):
    assert sentence(state(**fields)) == words


@pytest.mark.parametrize(
    ("side", "by_hand", "words"),
    [
        (1, 0, "Learned: front blocked, turn left."),
        (2, 1, "Told: front blocked, turn right."),
        (0, 1, "Erased by hand: front."),
    ],
)
def test_lesson_sentence_tells_learned_told_or_erased(side, by_hand, words):
    assert lesson_sentence({"node": 1, "tick": 0, "cell": 2, "side": side, "by_hand": by_hand}) == words


def test_picture_command_redraws_the_picture_that_a_run_leaves(tmp_path):
    words = ["--seed", "2", "--environments", "2", "--bus", "none", "--quiet", "--out", str(tmp_path)]
    assert main(["run", *words]) == 0

    assert main(["picture", str(tmp_path / "run.log"), "--png", str(tmp_path / "again.png")]) == 0

    with Image.open(tmp_path / "arena.png") as left, Image.open(tmp_path / "again.png") as again:
        assert left.size == again.size
        greys = left.convert("L").tobytes(), again.convert("L").tobytes()
        assert sum(a != b for a, b in zip(*greys, strict=True)) < 0.001 * left.width * left.height


@pytest.mark.parametrize(
    ("words", "named"),
    [
        ([], "--gif FILE"),
        (["--gif", "x.gif", "--from", "9999"], "nothing between these times: the run is 10.00 s long"),
        (["--gif", "x.gif", "--from", "5", "--to", "4"], "--to 4 s is before --from 5 s"),
        (["--gif", "x.gif", "--width", "100000"], "320 to 1280"),
        (["--gif", "x.gif", "--speed", "0"], "'0'"),
    ],
)
def test_wrong_clip_options_are_refused_in_one_line(short, capsys, words, named):
    assert main(["picture", str(short.log), *words]) == 2
    message = capsys.readouterr().err
    assert re.fullmatch(r"octet: .*\n", message)
    assert named in message


def test_clip_with_too_many_frames_is_refused(kept, tmp_path, capsys):
    assert main(["picture", str(kept.log), "--gif", str(tmp_path / "x.gif")]) == 2
    assert "more than 600: use --from" in capsys.readouterr().err


def test_readme_picture_is_that_of_the_command(tmp_path):
    assert octet_process("run", "--bus", "none", "--quiet", "--environments", "3", "--out", tmp_path).returncode == 0

    with Image.open(tmp_path / "arena.png") as new, Image.open(IMAGES / "arena.png") as old:
        assert ImageChops.difference(new.convert("RGB"), old.convert("RGB")).getbbox() is None


def test_readme_images_are_small_and_intact():
    assert (IMAGES / "octet.gif").stat().st_size < README_BYTES_MAX
    assert 8 <= sum(durations_ms(IMAGES / "octet.gif")) / 1000 <= 13
    with Image.open(IMAGES / "arena.png") as still:
        still.verify()
