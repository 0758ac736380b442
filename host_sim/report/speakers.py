"""Those who can be talked to in a page: their scripts as they were read, and the words of their facts."""

from typing import Any

from host_sim.talk.conversation import SPEAKERS, script_named, texts_of


def speakers() -> dict[str, Any]:
    """Each speaker by its name: `script`, of `host_sim.talk.script`, and `texts`, of `host_sim.talk.texts`."""
    return {name: {"script": script_named(name), "texts": texts_of(name)} for name in SPEAKERS}
