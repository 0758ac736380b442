"""The conversation partners in a page: their parsed scripts, and the texts of their facts."""

from functools import cache
from typing import Any

from host_sim.report.page_bundle import packed, with_data
from host_sim.talk.conversation import SPEAKERS, script_named, texts_of
from host_sim.talk.languages import as_script


def speakers() -> dict[str, Any]:
    """The speakers by name: `script` from `host_sim.talk.script`, and `texts` from `host_sim.talk.texts`."""
    return {name: {"script": script_named(name), "texts": texts_of(name)} for name in SPEAKERS}


def with_speakers(page: str) -> str:
    """Fills the empty element `speakers` of a page with the packed speakers."""
    return with_data(page, "speakers", _packed())


@cache
def _packed() -> str:
    return packed(as_script(speakers()))
