"""Draws the picture that links to this repository show: `python -m tools.preview .github/preview.png`."""

import sys
from pathlib import Path
from tempfile import TemporaryDirectory

from PIL import Image

from host_sim.api import RunConfig, resimulate, run
from host_sim.report.animation import draw_frame
from host_sim.report.drawing import PAPER, in_palette, write, write_image

SIZE, MARGIN, ARENA_PX = (1280, 640), 40, 700
WORDS = ("A small robot that", "teaches itself to avoid", "obstacles, with eight", "bytes of memory.")


def main(file: Path) -> None:
    """Draws the end of a run beside a sentence about the project."""
    with TemporaryDirectory() as folder:
        log = Path(folder, "run.log")
        run(RunConfig(seed=333, environments=1), log=str(log))
        trajectory = resimulate(log).trajectory
    picture = Image.new("RGB", SIZE, PAPER)
    arena = draw_frame(trajectory, trajectory.ticks - 1, ARENA_PX)
    picture.paste(arena, (SIZE[0] - MARGIN - ARENA_PX, (SIZE[1] - arena.height) // 2))
    write(picture, (MARGIN, 190), "Octet", 96, "lm")
    for number, words in enumerate(WORDS):
        write(picture, (MARGIN, 310 + number * 46), words, 36, "lm")
    write_image(file, in_palette(picture), "PNG", optimize=True)


if __name__ == "__main__":
    main(Path(sys.argv[1]))
