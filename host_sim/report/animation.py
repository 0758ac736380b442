"""An animated GIF of a run: the arena with the robot's senses, the reason for its action, and its memory."""

from dataclasses import dataclass
from pathlib import Path

from PIL import Image, ImageFont

from host_sim.base.errors import UsageError
from host_sim.base.terminal import SOON_S, counted
from host_sim.protocol.generated import CELL_COUNT, SIDES, Reason
from host_sim.recording.phrases import lesson_sentence, sentence
from host_sim.recording.state_types import Lesson, State
from host_sim.recording.trajectory import RobotTrack, Trajectory, at
from host_sim.report.drawing import (
    BEAM,
    CONE_DARK,
    CONE_LIT,
    FLOOR,
    IN_USE,
    LEARNED,
    PAPER,
    Plan,
    draw_cell,
    draw_cone,
    draw_robot,
    draw_scene,
    draw_trail,
    in_palette,
    write,
    write_image,
)
from host_sim.world.geometry import Pose, SimParams, ahead_of
from host_sim.world.native_world import CONE_BEARINGS_DEG

FRAMES_MAX = 600
"""Maximum number of frames of a clip."""

_FRAME_MS = 80
_HOLD_MS = 1000
_TRAIL_S = 12.0
_MARGIN_PX, _LINE_PX, _TEXT_PX = 10, 26, 15
_CLOCK_PX = 70
_TURNING = (Reason.REMEMBERED, Reason.TRIAL)


@dataclass(frozen=True)
class Clip:
    """The part of a run to show, and how.

    Attributes:
        from_s: Start, s of robot time.
        to_s: End, s of robot time; None for the end of the run.
        speed: Speed as a multiple of real time. Each event is held for one second divided by it.
        width_px: Width of the animation.
    """

    from_s: float = 0.0
    to_s: float | None = None
    speed: float = 1.0
    width_px: int = 640


def write_gif(path: Path, trajectory: Trajectory, clip: Clip) -> None:
    """Writes an animated GIF that loops for ever; equal clips give equal bytes.

    Raises:
        UsageError: The run has nothing between the two times, or more than `FRAMES_MAX` frames.
        OctetError: The file cannot be written.
    """
    ticks = _frame_ticks(trajectory, clip)
    holds = _holds(trajectory, clip)
    durations = [_FRAME_MS + holds.get(tick, 0) for tick in ticks]
    shown = counted(ticks, len(ticks), f"drawing {path}", after_s=SOON_S)
    frames = (in_palette(draw_frame(trajectory, tick, clip.width_px)) for tick in shown)
    write_image(path, next(frames), "GIF", save_all=True, append_images=frames, duration=durations, loop=0)


def draw_frame(trajectory: Trajectory, tick: int, width_px: int) -> Image.Image:
    """Draws one tick: at the top the reason, then the arena, then the memory."""
    state, inner_px = trajectory.at(tick), width_px - 2 * _MARGIN_PX
    lesson = next((lesson for lesson in trajectory.tracks[0].lessons if lesson["tick"] == tick), None)
    arena = _draw_arena(trajectory, tick, inner_px)
    cells = _draw_memory(state, lesson, trajectory.params, inner_px // CELL_COUNT)
    frame = Image.new("RGB", (width_px, 2 * _MARGIN_PX + _LINE_PX + arena.height + cells.height), PAPER)
    frame.paste(arena, (_MARGIN_PX, _LINE_PX))
    frame.paste(cells, ((width_px - cells.width) // 2, _LINE_PX + arena.height + _MARGIN_PX))
    news = next((words for at, words in reversed(trajectory.news) if at == tick), None)
    words = news or (lesson_sentence(lesson) if lesson else sentence(state))
    write(frame, (_MARGIN_PX, _LINE_PX / 2), words, _fitting_px(words, inner_px - _CLOCK_PX), "lm")
    clock = f"{tick * trajectory.params.tick_s:.1f} s"
    write(frame, (width_px - _MARGIN_PX, _LINE_PX / 2), clock, _TEXT_PX, "rm")
    return frame


def _fitting_px(words: str, room_px: int) -> int:
    """The font size at which a line fits."""
    return min(_TEXT_PX, int(_TEXT_PX * room_px / ImageFont.load_default(_TEXT_PX).getlength(words)))


def _frame_ticks(trajectory: Trajectory, clip: Clip) -> list[int]:
    """The ticks to show: evenly spaced ones, and those with an event."""
    tick_s = trajectory.params.tick_s
    first = max(round(clip.from_s / tick_s), trajectory.first_tick)
    end = trajectory.ticks if clip.to_s is None else min(round(clip.to_s / tick_s) + 1, trajectory.ticks)
    step = max(1, round(_FRAME_MS / 1000 * clip.speed / tick_s))
    ticks = sorted({*range(first, end, step), *(tick for tick in _holds(trajectory, clip) if first <= tick < end)})
    if not ticks:
        raise UsageError(f"there is nothing between these times: the run is {trajectory.ticks * tick_s:.2f} s long")
    if len(ticks) > FRAMES_MAX:
        raise UsageError(f"{len(ticks)} frames are more than {FRAMES_MAX}: use --from, --to or --speed")
    return ticks


def _holds(trajectory: Trajectory, clip: Clip) -> dict[int, int]:
    """How long to hold each tick with an event, ms, by tick."""
    return {tick: round(_HOLD_MS / clip.speed) for tick, kind in trajectory.events() if kind != "environment"}


def _draw_arena(trajectory: Trajectory, tick: int, width_px: int) -> Image.Image:
    params, scene = trajectory.params, at(trajectory.scenes, tick)
    states = [trajectory.at(tick, robot) for robot in range(len(trajectory.tracks))]
    plan = Plan(params.width_mm, params.height_mm, width_px, FLOOR)
    for state in states:
        if state["beacon"]:
            plan.line([_pose(state)[:2], ahead_of(_pose(state), state["beacon"])], params.beam_width_mm, BEAM)
    for track in trajectory.tracks:
        _draw_trail(plan, trajectory, track, tick)
    for state in states:
        _draw_cones(plan, state, params)
    draw_scene(plan, scene, states[0]["eaten"], params)
    for state in states:
        draw_robot(plan, _pose(state), 2 * params.body_radius_mm, PAPER)
    return plan.done()


def _pose(state: State) -> Pose:
    return Pose(state["x"], state["y"], state["heading"] / 1000)


def _draw_cones(plan: Plan, state: State, params: SimParams) -> None:
    reach_mm = params.body_radius_mm + params.sensor_reach_mm
    for bit, bearing_deg in CONE_BEARINGS_DEG.items():
        draw_cone(plan, _pose(state), bearing_deg, reach_mm, CONE_LIT if state["feel"] & bit else CONE_DARK)


def _draw_trail(plan: Plan, trajectory: Trajectory, track: RobotTrack, tick: int) -> None:
    """Draws the last `_TRAIL_S` of a robot's path, within this environment."""
    begun = at(trajectory.scenes, tick)["first_tick"]
    first = max(tick - round(_TRAIL_S / trajectory.params.tick_s), begun, track.first_tick)
    trail = track.trail(first, tick + 1)
    draw_trail(plan, trail[0][:2], trail)


def _draw_memory(state: State, lesson: Lesson | None, params: SimParams, width_px: int) -> Image.Image:
    """The cells with their content. The cell just learned, else the one in use or on trial, is highlighted."""
    row = Image.new("RGB", (CELL_COUNT * width_px, width_px), PAPER)
    in_use = state["pattern"] if state["reason"] in _TURNING else None
    lit, lit_colour = (lesson["cell"], LEARNED) if lesson else (in_use, IN_USE)
    for pattern, side in enumerate(state["memory"]):
        colour = lit_colour if pattern == lit else PAPER
        cell = Image.new("RGB", (width_px, width_px), colour)
        drawing = draw_cell(pattern, side, params, width_px, colour)
        cell.paste(drawing)
        if side:
            middle = width_px / 2, (drawing.height + width_px) / 2
            write(cell, middle, SIDES[side], min(_TEXT_PX, width_px // 5), "mm")
        row.paste(cell, (pattern * width_px, 0))
    return row
