"""`tools/octet watch --terminal`: shows a run in a terminal, for example over ssh."""

import asyncio
import contextlib
import curses
import sys

from host_sim.base.errors import UsageError
from host_sim.live.ending_signals import on_ending_signals
from host_sim.live.paced_run import PacedRun
from host_sim.live.page_commands import (
    FULL_SPEED,
    EraseMemory,
    Freeze,
    MoveRobot,
    NextEnvironment,
    OneDecision,
    PageCommand,
    Play,
    Speed,
)
from host_sim.live.text_picture import View, draw_text
from host_sim.recording.phrases import news_of
from host_sim.recording.state import environment_scene, states
from host_sim.recording.summary import environment_line
from host_sim.world.edits import Edit

_EVERY_S = 0.1
_KEYS = """\
q quit   space pause   . one decision   + - speed   n next
e erase the memory   f freeze it   l lift, and put down"""
_SPEEDS = (0.25, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0, 64.0, 256.0, 1000.0)
"""The speeds that + and - step through, as multiples of real time; above the last one, as fast as possible."""


def watch_in_terminal(live: PacedRun) -> None:
    """Plays a whole run on the full screen of the terminal, which is restored at the end.

    Args:
        live: The run, before its first environment. It must not print anything.

    Raises:
        UsageError: Standard input or output is not a terminal, or the terminal cannot position its cursor.
        RobotError: A robot has ended or does not answer.
    """
    if not (sys.stdin.isatty() and sys.stdout.isatty()):
        raise UsageError("--terminal needs a terminal, and this is not one: leave it out, or use ssh -t")
    try:
        curses.setupterm()
    except curses.error as error:
        raise _cannot_draw(str(error)) from None
    if not curses.tigetstr("cup"):
        raise _cannot_draw("it cannot position its cursor")
    live.begin()
    try:
        curses.wrapper(lambda screen: asyncio.run(_show(live, screen)))
    except curses.error as error:
        raise _cannot_draw(str(error)) from None


def _cannot_draw(why: str) -> UsageError:
    return UsageError(f"cannot draw in this terminal ({why}): set TERM to its type, such as xterm")


async def _show(live: PacedRun, screen: "curses.window") -> None:
    """Draws at most ten times a second, whatever the speed of the run."""
    screen.nodelay(True)
    with contextlib.suppress(curses.error):  # some terminals cannot hide it
        curses.curs_set(0)
    with on_ending_signals(asyncio.get_running_loop(), live.close):
        player = asyncio.create_task(live.play())
        while not player.done():
            while (key := screen.getch()) != curses.ERR:
                _press(live, key)
            _draw(live, screen)
            await asyncio.wait({player}, timeout=_EVERY_S)
        await player


def _press(live: PacedRun, key: int) -> None:
    """Carries out the command of a key; robot commands apply to the first robot."""
    state = states(live.simulation, live.recorder.histories)[0]
    node = state["node"]
    put = Edit("put", at=(state["x"], state["y"]), heading=state["heading"])
    commands: dict[int, PageCommand] = {
        ord(" "): Play(not live.playing),
        ord("."): OneDecision(),
        ord("+"): Speed(faster(live.speed)),
        ord("-"): Speed(slower(live.speed)),
        ord("n"): NextEnvironment(),
        ord("e"): EraseMemory(node),
        ord("f"): Freeze(not state["frozen"], node),
        ord("l"): MoveRobot(put if state["lifted"] else Edit("lift"), node),
    }
    if key == ord("q"):
        live.close()
    elif key in commands:
        live.offer(commands[key], lambda _: curses.beep())


def faster(speed: float) -> float:
    """The next higher speed."""
    return FULL_SPEED if speed == FULL_SPEED else next((step for step in _SPEEDS if step > speed), FULL_SPEED)


def slower(speed: float) -> float:
    """The next lower speed; the lowest stays."""
    if speed == FULL_SPEED:
        return _SPEEDS[-1]
    return next((step for step in reversed(_SPEEDS) if step < speed), _SPEEDS[0])


def _draw(live: PacedRun, screen: "curses.window") -> None:
    rows, columns = screen.getmaxyx()
    screen.erase()
    for row, line in enumerate(draw_text(_view(live), columns, rows)):
        # The last character of the last row stays empty: writing it would scroll the screen.
        screen.addnstr(row, 0, line, columns - (row == rows - 1))
    screen.refresh()


def _view(live: PacedRun) -> View:
    simulation, trajectory = live.simulation, live.recorder.trajectory
    begun = simulation.record.begun[-1]
    first = max(begun.first_tick, trajectory.first_tick)
    return View(
        live.params,
        environment_scene(simulation.record.begun, simulation.environments, simulation.arena),
        states(simulation, live.recorder.histories),
        [[(x, y) for x, y, _ in track.trail(first, track.ticks)] for track in trajectory.tracks],
        trajectory.boredom_limit,
        _pace(live),
        _KEYS,
        _news(live, begun.first_tick),
    )


def _news(live: PacedRun, first_tick: int) -> str:
    """The result of the run or environment or, before its end, the last change in it."""
    since = live.episodes[live.started_over :]
    if live.done:
        return f"ALL DONE: {sum(episode.finished for episode in since)} of {len(since)} environments finished"
    if live.ended_at is not None and since:
        return environment_line(len(since), since[-1]).partition(";")[0]
    news = [sentence for tick, sentence in news_of(live.simulation.record) if tick >= first_tick]
    return news[-1] if news else ""


def _pace(live: PacedRun) -> str:
    if live.done:
        return "all done"
    if not live.playing:
        return "paused"
    speed = live.speed if live.speed != FULL_SPEED else live.rate * live.params.tick_s
    return f"{speed:.3g} x real time"
