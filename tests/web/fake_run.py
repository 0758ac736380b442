"""Runs of many robots that nobody computed: what a page is sent, and what it sends back."""

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from playwright.sync_api import Page, Route, WebSocketRoute

from host_sim.base.paths import PAGE_SCRIPTS, WEB
from host_sim.recording.state import measures
from host_sim.recording.state_types import EnvironmentScene, Measures, State
from host_sim.report.octet_page import live_page
from host_sim.report.replay_page import pack, page
from host_sim.world.geometry import SimParams

HOME = "http://octet.test/"
MEASURES: Measures = measures(SimParams(), 10)
ENVIRONMENT = EnvironmentScene(
    number=1,
    of=5,
    seed=7,
    first_tick=0,
    start_tick=0,
    bars=[[0, 2600, 500, 3400, 700]],
    food=[[500, 2500], [2000, 2600], [3500, 2500]],
)
COLUMNS = [
    *("x", "y", "heading", "lifted", "feel", "bump", "beacon"),
    *("left", "right", "reason", "repeat_count", "action", "pattern", "frozen"),
]
PAUSED = {"playing": False, "speed": 1, "done": False, "rate": 50, "stays": True, "ended": None}
TICKS = 200
PAGE = live_page()
TYPES = {".js": "text/javascript", ".css": "text/css", "": "text/html"}


def robot_state(node: int, x: float, y: float, **fields: Any) -> State:
    """The state of a robot that wanders, but for some fields."""
    numbers = dict.fromkeys([name for name in State.__annotations__ if name != "trial"], 0)
    lists = {"eaten": [0] * 3, "memory": [0] * 8, "uses": [0] * 8, "learned": [-1] * 8, "by_hand": [0] * 8}
    return State(
        **{**numbers, **lists, "reason": 1, "trial": None, "node": node, "x": x, "y": y, "tick": 9, **fields}
    )


@dataclass
class FakeRun:
    """Stands in for a live run: `serve` a page, then `send` states; `commands` is what the page asks for.

    Attributes:
        states: The state of each robot.
    """

    states: list[State]
    commands: list[dict[str, Any]] = field(default_factory=list)
    _socket: WebSocketRoute | None = None

    def serve(self, page: Page) -> None:
        page.route(f"{HOME}**", self._answer)
        page.route_web_socket(f"{HOME.replace('http', 'ws')}live**", self._connect)

    def send(self, **fields: Any) -> None:
        """Sends the states, and with them what else a message can have."""
        assert self._socket is not None
        self._socket.send(json.dumps(self._message(**fields)))

    def _answer(self, route: Route) -> None:
        name = route.request.url.removeprefix(HOME)
        text = ((PAGE_SCRIPTS if name.endswith(".js") else WEB) / name).read_text() if name else PAGE
        route.fulfill(body=text, content_type=TYPES[Path(name).suffix])

    def _connect(self, socket: WebSocketRoute) -> None:
        self._socket = socket
        socket.on_message(lambda text: self.commands.append(json.loads(text)))
        self.send(measures=MEASURES, environment=ENVIRONMENT)

    def _message(self, **fields: Any) -> dict[str, Any]:
        return {
            "states": self.states,
            "trails": [[state["x"], state["y"], state["reason"]] for state in self.states],
            "lessons": [],
            "events": [[] for _ in self.states],
            "play": PAUSED,
            "health": {"sent": 0, "lost": 0, "refused": 0, "late": 0, "orders_refused": 0},
            "pins": [],
            **fields,
        }


def write_replay(path: Path, robots: Sequence[Mapping[str, Any]], **others: int) -> Path:
    """Writes the page of a recorded run in which each robot drives 2 mm a tick to the right, with other fields."""
    run = {
        "version": 3,
        "title": "a run of many",
        "measures": MEASURES,
        "first_tick": 0,
        "ticks": TICKS,
        "scenes": [[0, ENVIRONMENT]],
        "eaten": [[0, [0, 0, 0]]],
        "robots": [_recorded(**robot) for robot in robots],
        **others,
    }
    path.write_text(page(run))
    return path


def _recorded(node: int, y: int, cell: int, learned_at: int) -> dict[str, Any]:
    """A robot that learns to turn left in one cell."""
    columns = np.zeros((len(COLUMNS), TICKS), np.int64)
    columns[COLUMNS.index("x")] = 10 * (500 + 2 * np.arange(TICKS))
    columns[COLUMNS.index("y")] = 10 * y
    columns[COLUMNS.index("reason")] = 1
    learned = [int(i == cell) for i in range(8)]
    return {
        "node": node,
        "memory": [[0, [0] * 8], [learned_at, learned]],
        "trials": [[0, None]],
        "lessons": [{"node": node, "tick": learned_at, "cell": cell, "side": 1, "by_hand": 0}],
        "cells": [*([0, i, 0, -1, 0] for i in range(8)), [learned_at, cell, 0, learned_at, 0]],
        "events": [[0, "environment"], [learned_at, "lesson"]],
        "columns": COLUMNS,
        "data": pack(columns),
    }
