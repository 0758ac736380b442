"""The picture of an arena: as an array for videos and notebooks, in a window, or in the terminal."""

import importlib
import shutil
import sys
import time
from typing import Any, TextIO

import numpy as np
from gymnasium import error, logger
from numpy.typing import NDArray

from host_sim.lab.gymnasium_envs.driven_worlds import DrivenWorlds
from host_sim.world.geometry import Pose, SimParams

MODES = ("human", "rgb_array")
FPS = 10
"""Frames a second of videos; a step lasts as long as its action, 1 to 100 ticks of 20 ms."""

_WIDTH_PX = 480
_PAUSE_MAX_S = 2.0  # an action takes no longer
_FEEL = 1
_HOME, _REST_OF_SCREEN, _PLAIN = "\x1b[H", "\x1b[J", "\x1b[0m"

Frame = NDArray[np.uint8]


class View:
    """What an environment shows of its worlds.

    Attributes:
        mode: One of `MODES`, or None.
    """

    def __init__(self, mode: str | None, worlds: DrivenWorlds) -> None:
        """Creates the view.

        Raises:
            gymnasium.error.Error: There is no such mode.
        """
        if mode not in (None, *MODES):
            raise error.Error(f"render_mode is {mode!r}: give {', '.join(map(repr, MODES))} or None")
        self.mode, self._worlds = mode, worlds
        self._window: Window | None = None

    def render(self, world: int = 0) -> Frame | None:
        """The picture of a world, shape (height, width, 3), with mode "rgb_array"; None in other modes."""
        return frame(self._worlds, world) if self.mode == "rgb_array" else None

    def follow(self) -> None:
        """Shows the first world after a step, with mode "human": in a window, or in the terminal if there is none."""
        if self.mode != "human":
            return
        self._window = self._window or Window()
        if self._window.is_open:
            self._window.show(frame(self._worlds, 0), int(self._worlds.ticks[0]) * SimParams.tick_s)
        elif self._window.reason:
            show(frame(self._worlds, 0), sys.stdout)

    def close(self) -> None:
        """Closes the window."""
        if self._window is not None:
            self._window.close()

    def __getstate__(self) -> dict[str, Any]:
        return {**vars(self), "_window": None}  # a copy opens its own


class Window:
    """A window of the desktop, by Python's own tkinter.

    Attributes:
        reason: Why there is no window; empty if there is, or if its user has closed it.
        is_open: Whether it is open.
    """

    def __init__(self) -> None:
        """Opens the window, or says in a warning why it cannot."""
        self.reason, self._shown_s = "", 0.0
        try:
            self._tk = importlib.import_module("tkinter")
            self._root = self._tk.Tk(className="octet")
            self._label = self._tk.Label(self._root)
            self._label.pack()
        except Exception as fault:  # tkinter's own error needs tkinter, which may be what is missing
            self.reason = str(fault)
            logger.warn(f"render_mode 'human' draws in the terminal, because no window can be opened: {fault}")
        self.is_open = not self.reason

    def show(self, picture: Frame, robot_s: float) -> None:
        """Shows a picture as long after the last one as it took the robot; a window that was closed stays closed."""
        time.sleep(max(0.0, min(robot_s - self._shown_s, _PAUSE_MAX_S)))
        self._shown_s = robot_s
        height, width = picture.shape[:2]
        try:
            data = b"P6 %d %d 255 " % (width, height) + picture.tobytes()
            image = self._tk.PhotoImage(master=self._root, data=data)
            self._label.configure(image=image)
            self._label.image = image  # tkinter keeps none itself
            self._root.update()
        except self._tk.TclError:
            self.is_open = False

    def close(self) -> None:
        """Closes the window if it is open."""
        if self.is_open:
            self._root.destroy()
        self.is_open = False


def frame(worlds: DrivenWorlds, world: int) -> Frame:
    """Draws a world; raises gymnasium.error.ResetNeeded if no episode has begun in it."""
    from host_sim.report import drawing  # noqa: PLC0415 - learners that look at nothing need no Pillow
    from host_sim.world.native_world import CONE_BEARINGS_DEG  # noqa: PLC0415

    arena, params = worlds.arenas[world], SimParams()
    if arena is None:
        raise error.ResetNeeded("no episode has begun: call reset")
    plan = drawing.Plan(params.width_mm, params.height_mm, _WIDTH_PX, drawing.FLOOR)
    poses = [Pose(body.x_mm, body.y_mm, body.heading_rad) for body in arena.inside.bodies]
    reach_mm = params.body_radius_mm + params.sensor_reach_mm
    for pose, senses in zip(poses, worlds.senses[world], strict=True):
        for bit, bearing_deg in CONE_BEARINGS_DEG.items():
            drawing.draw_cone(
                plan, pose, bearing_deg, reach_mm, drawing.CONE_LIT if senses[_FEEL] & bit else drawing.CONE_DARK
            )
    for food in arena.inside.food:
        drawing.draw_food(plan, (food.x_mm, food.y_mm), drawing.FOOD_MM, bool(food.eaten))
    drawing.draw_obstacles(plan, arena.layout.bars, params)
    for pose in poses:
        drawing.draw_robot(plan, pose, 2 * params.body_radius_mm, drawing.PAPER)
    picture: Frame = np.array(plan.done(), np.uint8)
    return picture


def show(picture: Frame, out: TextIO) -> None:
    """Draws a picture on a terminal: two pixels a character, one above the other."""
    columns, rows = shutil.get_terminal_size()
    height, width = picture.shape[:2]
    scale = max(width / columns, height / (2 * (rows - 1)))
    across = (np.arange(int(width / scale)) * scale).astype(int)
    down = (np.arange(int(height / scale) // 2 * 2) * scale).astype(int)
    small = picture[np.ix_(down, across)]
    lines = [
        "".join(  # the upper half is the character, the lower its background
            f"\x1b[38;2;{a[0]};{a[1]};{a[2]};48;2;{b[0]};{b[1]};{b[2]}m\u2580"
            for a, b in zip(upper, lower, strict=True)
        )
        for upper, lower in zip(small[::2], small[1::2], strict=True)
    ]
    out.write(_HOME + "".join(f"{line}{_PLAIN}\n" for line in lines) + _REST_OF_SCREEN)
    out.flush()
