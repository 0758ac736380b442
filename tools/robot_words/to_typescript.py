"""The robot's numbers and words in TypeScript: host_sim/web/generated.ts."""

import json

from tools.robot_words.description import Description
from tools.robot_words.to_c import c_name

_HEAD = "/* Made by tools/generate from octet.dbc and robot.toml. */\n"

# The page is small, so it has only those that it uses.
_NUMBERS = (
    *("cell_count", "node_max", "answer_wants_ranges", "plant_radius_mm", "plant_growth_mm"),
    *("page_robots_max", "program_text_max"),
)


def module(robot: Description) -> str:
    """The text of generated.ts: one declaration a line."""
    exports: dict[str, object] = {}
    for name in ("reason", "side", "opcode"):
        exports[name.upper()] = {c_name(word): number for word, number in robot.enums[name].items()}
    exports["AVOIDING"] = list(robot.avoiding.values())
    exports["SIDES"] = list(robot.enums["side"])
    exports["PATTERNS"] = list(robot.patterns)
    exports["FEEL"] = {c_name(name): 1 << bit for bit, name in enumerate(robot.feel)}
    exports["EDITS"] = {name: list(names) for name, names in robot.edits.items()}
    exports["PROFILES"] = list(robot.profiles[:-1])
    exports["PARAMETERS"] = {
        p.name: {"min": p.minimum, "max": p.maximum, "default": p.default, "unit": p.unit, "meaning": p.comment}
        for p in robot.parameters
    }
    exports["KIT_SETTINGS"] = dict(robot.kit_settings)
    exports |= {c_name(name): robot.numbers[name] for name in _NUMBERS}
    exports["FRAMES"] = {message.name: message.frame_id for message in robot.messages}
    exports["ROW"] = list(robot.row)
    exports["COLUMNS"] = dict(robot.columns)
    exports["SENTENCES"] = dict(robot.sentences)
    exports["BODY_SENTENCES"] = {json.dumps(name): words for name, words in robot.body_sentences.items()}
    lines = [f"export const {name} = {_literal(value)};" for name, value in exports.items()]
    return "\n".join([_HEAD, *lines, ""])


def _literal(value: object) -> str:
    """A value as a TypeScript literal, with unquoted keys."""
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{key}: {_literal(inner)}" for key, inner in value.items()) + " }"
    return json.dumps(value)
