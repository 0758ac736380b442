"""What the robot does and why, in its own words; those of web/words.js."""

from host_sim.view.history import Lesson
from host_sim.view.state import State

PATTERNS = (
    "nothing",
    "front-right",
    "front",
    "front and front-right",
    "front-left",
    "front-left and front-right",
    "front-left and front",
    "all three",
)
"""Names of the eight patterns of the front sensors."""

SIDES = ("nothing", "left", "right")
"""What a cell holds."""

_WANDERING = "Nothing in my way: I drive on and look about for food."


def sentence(state: State) -> str:
    """What a tick shows, in one sentence."""
    if state["lifted"]:
        return "Someone has picked me up: my wheels turn in the air."
    side = SIDES[1 if state["left"] < state["right"] else 2]
    blocked = f"{PATTERNS[state['pattern']].capitalize()} blocked"
    return (
        "I am standing still.",
        _WANDERING,
        f"I see food {state['beacon'] / 1000:.2f} m ahead: I drive toward it." if state["beacon"] else _WANDERING,
        _WANDERING,
        f"{blocked}: I remember that turning {side} helped.",
        f"{blocked}: I do not know what helps yet, so I try turning {side}.",
        f"{state['repeat_count']} turns in a row, and still blocked. I am bored: about face!",
        "Food! I eat it.",
    )[state["reason"]]


def lesson_sentence(lesson: Lesson) -> str:
    """What a cell has changed to, in one sentence."""
    name = PATTERNS[lesson["cell"]]
    how = "Written by hand" if lesson["by_hand"] else "Learned"
    return f"{how}: {name} blocked, turn {SIDES[lesson['side']]}." if lesson["side"] else f"Erased by hand: {name}."
