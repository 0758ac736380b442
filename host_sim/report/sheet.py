"""The layout of the pictures of runs and fleets: rows of images under lines of text."""

from collections.abc import Sequence

from PIL import Image

from host_sim.report.drawing import PAPER, write

WIDTH_PX, MARGIN_PX, GAP_PX = 1608, 36, 24
LINE_PX, TEXT_PX, HEADING_PX = 30, 18, 21


def titled(title: str, image: Image.Image) -> Image.Image:
    """An image under a line of text."""
    sheet = Image.new("RGB", (image.width, image.height + LINE_PX), PAPER)
    sheet.paste(image, (0, LINE_PX))
    write(sheet, (0, LINE_PX * 0.4), title, HEADING_PX, "lm")
    return sheet


def abreast(images: Sequence[Image.Image], gap_px: int) -> Image.Image:
    """Images of one size side by side."""
    step = images[0].width + gap_px
    row = Image.new("RGB", (len(images) * step - gap_px, images[0].height), PAPER)
    for i, image in enumerate(images):
        row.paste(image, (i * step, 0))
    return row


def stacked(rows: Sequence[Image.Image]) -> Image.Image:
    """Rows one below the other on the finished sheet."""
    height = 2 * MARGIN_PX + sum(row.height for row in rows) + (len(rows) - 1) * GAP_PX
    sheet = Image.new("RGB", (WIDTH_PX + 2 * MARGIN_PX, height), PAPER)
    y = MARGIN_PX
    for row in rows:
        sheet.paste(row, (MARGIN_PX, y))
        y += row.height + GAP_PX
    return sheet
