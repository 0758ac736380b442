"""A picture of one environment as it is before a run: obstacles, food, and the robots at their starts."""

from io import BytesIO
from pathlib import Path

from host_sim.base.atomic_file import write_bytes
from host_sim.report.drawing import FLOOR, FOOD_MM, PAPER, Plan, draw_food, draw_obstacles, draw_robot
from host_sim.world.layouts import Layout
from host_sim.world.params import SimParams


def write_world_picture(path: Path, layout: Layout, params: SimParams, width_px: int) -> None:
    """Writes an environment as PNG; equal environments give equal bytes.

    Raises:
        OctetError: The file cannot be written.
    """
    plan = Plan(params.width_mm, params.height_mm, width_px, FLOOR)
    draw_obstacles(plan, layout.bars, params)
    for at in layout.food:
        draw_food(plan, at, FOOD_MM, eaten=False)
    for start in layout.starts:
        draw_robot(plan, start, 2 * params.body_radius_mm, PAPER)
    content = BytesIO()
    plan.done().quantize().save(content, "PNG", optimize=True)
    write_bytes(path, content.getvalue())
