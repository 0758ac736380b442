"""What a robot does and why, in its own words. The pages use the same sentences."""

from host_sim.protocol.generated import PATTERNS, SIDES, Reason, Side
from host_sim.view.history import Lesson, Trial
from host_sim.view.state import State

_WANDERING = "Nothing in my way: I drive on and look about for food."
_AVOIDING = ("I do not believe my front sensor: I look aside.", "I have touched something: I back off.")


def sentence(state: State) -> str:
    """A robot's state in one sentence."""
    if state["lifted"]:
        return "Someone has picked me up: my wheels turn in the air."
    side = SIDES[Side.LEFT if state["left"] < state["right"] else Side.RIGHT]
    blocked = f"{PATTERNS[state['pattern']].capitalize()} blocked"
    turns = state["repeat_count"] or "Many"
    return {
        Reason.STOP: "I am standing still.",
        Reason.WANDER: _WANDERING,
        Reason.TOWARD_FOOD: _toward_food(state["beacon"]),
        Reason.LOOK_AROUND: _WANDERING,
        Reason.REMEMBERED: f"{blocked}: I remember that turning {side} helped.",
        Reason.TRIAL: f"{blocked}: I do not know what helps yet, so I try turning {side}.",
        Reason.BOREDOM: f"{turns} turns in a row, and still blocked. I am bored: about face!",
        Reason.EAT: "Food! I eat it.",
        Reason.SILENCE: "I hear nothing from my body: my wheels rest.",
        Reason.AVOID: _AVOIDING[state["left"] == state["right"]],
    }[Reason(state["reason"])]


def verdict(trial: Trial | None) -> str:
    """How a trial went, in one or two sentences; empty if there was none, or if it still goes on."""
    if trial is None or trial["helped"] is None:
        return ""
    what = f"Last try: {PATTERNS[trial['cell']]} blocked, I turned {SIDES[trial['side']]}."
    if not trial["helped"]:
        return f"{what} It did not help, so I forgot it."
    return f"{what} It helped{', but my learning was frozen.' if trial['frozen'] else ', so I remembered it!'}"


def _toward_food(beacon_mm: int) -> str:
    return f"I see food {beacon_mm / 1000:.2f} m ahead: I drive toward it." if beacon_mm else _WANDERING


def body_sentence(what: str) -> str:
    """What has happened to a body, a fault of `host_sim.world.body_faults`, in one sentence."""
    name, _, details = what.partition(":")
    if name == "weak-motor":
        side, _, share = details.partition(":")
        return f"The {side} motor turns at {share} of its speed."
    if name == "odometer":
        side, _, share = details.partition(":")
        return f"The {side} odometer counts {share} of its wheel's way."
    return {
        "swap-motors": "The plugs of the motors were swapped.",
        "swap-odometers": "The plugs of the odometers were swapped.",
        "false-beacon": f"The beacon shows food {details} mm ahead where there is none.",
        "mirror": "The ring of sensors was mounted the other way round.",
        "stuck-on": f"The {details} sensor is stuck: it always sees something.",
        "stuck-off": f"The {details} sensor is dead: it never sees anything.",
        "noise": f"Each sensor is wrong in {details.replace('/', ' of ')} ticks.",
        "repair": "The body was repaired.",
    }[name]


def lesson_sentence(lesson: Lesson) -> str:
    """A change of a cell in one sentence."""
    name = PATTERNS[lesson["cell"]]
    if not lesson["side"]:
        return f"{'Erased by hand' if lesson['by_hand'] else 'Forgotten'}: {name}."
    how = "Told" if lesson["by_hand"] else "Learned"
    return f"{how}: {name} blocked, turn {SIDES[lesson['side']]}."
