"""What the robot does where its proximity sensors do not protect it, before its brain is asked."""

from collections.abc import Callable
from typing import NamedTuple

FRONT_RIGHT, FRONT, FRONT_LEFT = 2, 4, 8
IN_FRONT = FRONT_RIGHT | FRONT | FRONT_LEFT


class Action(NamedTuple):
    """As in the firmware, without reason and rest."""

    forward_mm: int = 0
    turn_deg: int = 0


class Caution:
    """Beside a robot."""

    def __init__(self) -> None:
        self.plan: list[Action] = []
        self.backed_off = self.pressed = False
        self.away_deg: int | None = None  # turned since something was found ahead
        self.beside = self.blind_mm = 0

    def stops(self, bump: bool, forward: bool) -> bool:
        """In each tick: must a step end?"""
        stops = bump and forward and not self.pressed
        self.pressed = self.pressed and bump
        if stops:
            self.plan, self.backed_off = [Action(forward_mm=-20)], False
        return stops

    def next(self, feel: int, bump: bool, blind: bool, ask: Callable[[int], Action]) -> tuple[int, Action]:
        """An action has ended: what is felt in the end, and what comes next."""
        if not blind:
            self.blind_mm = 0
        elif self.beside & ~feel:
            self.away_deg = 0
        feel |= FRONT if self.away_deg is not None else 0
        if self.backed_off:
            self.pressed, self.backed_off = bump, False
        if self.plan and self.plan[0].forward_mm:
            self.away_deg, self.backed_off = 0, True
        if not self.plan and self.blind_mm >= 60 and not feel & IN_FRONT:
            self.plan, self.blind_mm = [Action(turn_deg=-24), Action(turn_deg=24)], 0
        action = self.plan.pop(0) if self.plan else ask(feel)
        self.beside = feel & (FRONT_LEFT if action.turn_deg < 0 else FRONT_RIGHT) if action.turn_deg else 0
        self.blind_mm += max(action.forward_mm, 0)
        if self.away_deg is not None:
            self.away_deg += action.turn_deg
            self.away_deg = None if abs(self.away_deg) >= 40 else self.away_deg
        return feel, action
