"""Those who can be talked to in a page: their scripts as they were read, and the words of their facts."""

from dataclasses import asdict
from typing import Any

from host_sim.talk.conversation import SPEAKERS, script_named, texts_of


def speakers() -> dict[str, Any]:
    """Each speaker by its name: `script`, of `host_sim.talk.script`, and `texts`, of `host_sim.talk.texts`."""
    return {name: {"script": asdict(script_named(name)), "texts": asdict(texts_of(name))} for name in SPEAKERS}
