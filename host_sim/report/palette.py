"""One fixed palette for all pictures: computing the best one for each takes longer than drawing."""

from functools import cache
from itertools import combinations

from PIL import Image, ImageColor

from host_sim.report.drawing import CONE_DARK, CONE_LIT, FLOOR, INK, MARKS, OBSTACLE, PAPER

BEAM, IN_USE, LEARNED = "#d8efe7", "#fdeecb", "#bfe5d8"
_COLOURS = (PAPER, FLOOR, INK, OBSTACLE, CONE_LIT, CONE_DARK, BEAM, IN_USE, LEARNED)


def in_palette(image: Image.Image) -> Image.Image:
    """An image with each of its colours replaced by the nearest one of the palette."""
    return image.quantize(palette=_palette(), dither=Image.Dither.NONE)


@cache
def _palette() -> Image.Image:
    """The drawing colours, with their blends into paper and floor, and halfway into each other."""
    bases = dict.fromkeys(
        ImageColor.getrgb(colour) for colour in (*_COLOURS, *(mark.colour for mark in MARKS.values()))
    )
    blends = [(a, b, 0.5) for a, b in combinations(bases, 2)]
    blends += [(a, ImageColor.getrgb(b), part) for a in bases for b in (PAPER, FLOOR) for part in (0.25, 0.75)]
    mixed = [tuple(round(x + (y - x) * part) for x, y in zip(a, b, strict=True)) for a, b, part in blends]
    palette = Image.new("P", (1, 1))
    palette.putpalette([value for colour in [*bases, *mixed] for value in colour])
    return palette
