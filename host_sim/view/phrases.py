"""What a robot does and why, in its own words. The pages use the same sentences, those of robot.toml."""

from host_sim.protocol.generated import BODY_SENTENCES, PATTERNS, SENTENCES, SIDES, Reason, Side
from host_sim.view.state_types import Lesson, State, Trial


def sentence(state: State) -> str:
    """A robot's state in one sentence."""
    side: int = Side.LEFT if state["left"] < state["right"] else Side.RIGHT
    if state["reason"] == Reason.TRIAL and state["trial"]:
        side = state["trial"]["side"]  # it also stands still while it tries
    return SENTENCES[_name(state)].format(
        Pattern=PATTERNS[state["pattern"]].capitalize(),
        side=SIDES[side],
        turns=state["repeat_count"] or "Many",
        beacon=f"{state['beacon'] / 1000:.2f}",
    )


def _name(state: State) -> str:
    reason = Reason(state["reason"])
    if state["lifted"]:
        return "lifted"
    if reason == Reason.TOWARD_FOOD and not state["beacon"]:
        return "wander"
    return "look_aside" if reason == Reason.AVOID and state["left"] != state["right"] else reason.name.lower()


def verdict(trial: Trial | None) -> str:
    """How a trial went, in two sentences; empty if there was none, or if it still goes on."""
    if trial is None or trial["helped"] is None:
        return ""
    helped = "helped_frozen" if trial["frozen"] else "helped"
    return _of_cell(helped if trial["helped"] else "useless", trial["cell"], trial["side"])


def body_sentence(what: str) -> str:
    """What has happened to a body, a fault of `host_sim.world.body_faults`, in one sentence."""
    name, *details = what.replace("/", " of ").split(":")
    return BODY_SENTENCES[name].format(*details)


def lesson_sentence(lesson: Lesson) -> str:
    """A change of a cell in one sentence."""
    names = ("forgotten", "erased", "learned", "told")
    return _of_cell(names[2 * bool(lesson["side"]) + lesson["by_hand"]], lesson["cell"], lesson["side"])


def _of_cell(name: str, cell: int, side: int) -> str:
    return SENTENCES[name].format(pattern=PATTERNS[cell], side=SIDES[side])
