"""Changes of the world while robots are in it, by a person or a schedule, in whole mm and mrad."""

from dataclasses import dataclass

from host_sim.world.geometry import Bar, Plant, Point, Pose

PLANT_MIN_MM, PLANT_MAX_MM = 20, 500
"""Radius of the smallest and of the largest plant."""


@dataclass(frozen=True)
class AddBar:
    """Adds an obstacle, which gets the next id."""

    bar: Bar


@dataclass(frozen=True)
class MoveBar:
    """Moves an obstacle."""

    id: int
    bar: Bar


@dataclass(frozen=True)
class RemoveBar:
    """Removes an obstacle."""

    id: int


@dataclass(frozen=True)
class MoveFood:
    """Moves a piece of food, eaten or not."""

    id: int
    at: Point


@dataclass(frozen=True)
class Lift:
    """Lifts a robot, counted from 0: its wheels still turn, but it does not move or sense anything."""

    robot: int = 0


@dataclass(frozen=True)
class Put:
    """Puts a lifted robot, counted from 0, down."""

    pose: Pose
    robot: int = 0


@dataclass(frozen=True)
class AddPlant:
    """Puts a plant down, which gets the next id of the plants."""

    plant: Plant


@dataclass(frozen=True)
class MovePlant:
    """Moves a plant."""

    id: int
    at: Point


@dataclass(frozen=True)
class GrowPlant:
    """Gives a plant another radius."""

    id: int
    radius_mm: float


@dataclass(frozen=True)
class RemovePlant:
    """Removes a plant."""

    id: int


@dataclass(frozen=True)
class ChangeBody:
    """Breaks something in the body of a robot, counted from 0, or repairs it.

    `what` is as in `check_fault`; when noise strikes follows from the seed.
    """

    what: str
    robot: int = 0
    seed: int = 0


Edit = (
    AddBar | MoveBar | RemoveBar | MoveFood | Lift | Put | AddPlant | MovePlant | GrowPlant | RemovePlant | ChangeBody
)


class EditError(ValueError):
    """An edit that cannot be made in the world as it is; the message says why."""
