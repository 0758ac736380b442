"""Changes of the world and the bodies during a run, in plain sentences."""

from itertools import groupby

from host_sim.protocol.generated import SENTENCES
from host_sim.sim.world_record import Edited, WorldRecord
from host_sim.view.phrases import body_sentence

News = tuple[int, str]
"""The tick before which something changed, and a sentence."""

_SHOWN = ("plant", "move_plant", "grow_plant", "remove_plant", "body")


def news_of(record: WorldRecord) -> list[News]:
    """All changes in order, including scheduled ones that could not happen, but not things moved by hand."""
    told = [(tick, sentence) for (tick, sentence), _ in groupby(_sentences(record))]
    refused = [(refused.tick, f"{refused.what} could not happen: {refused.why}.") for refused in record.refused]
    return sorted([*told, *refused], key=lambda news: news[0])


def _sentences(record: WorldRecord) -> list[News]:
    edits = [edited for edited in record.edits if edited.edit.do in _SHOWN]
    return [(edited.tick, _sentence(edited, edits, record.robots)) for edited in edits]


def _sentence(edited: Edited, edits: list[Edited], robots: int) -> str:
    edit = edited.edit
    if edit.do != "body":
        return SENTENCES[edit.do]
    everyone = sum((tick, it.do, it.what) == (edited.tick, "body", edit.what) for tick, it in edits)
    return ("" if everyone == robots else f"Robot {edit.robot + 1}: ") + body_sentence(edit.what)
