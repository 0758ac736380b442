"""The sentences of docs/protocol.md that specify a robot, by number, and those that no check covers."""

import re
from collections.abc import Iterator
from functools import cache

from host_sim.lab.check.invariants import rows
from host_sim.protocol.generated import MESSAGES
from host_sim.report.protocol_page import page

NOT_CHECKED = {
    "B2": "a robot at another bit rate is not heard at all",
    "B4": "signals in other places fail nearly every other check",
    "B5": "no robot needs to drive backward; T9 and L3 read the speeds as they are",
    "B6": "T3, T7 and MEMORY choose by these",
    "H2": "H1, H4 and H5 compute it",
    "COMMAND": "T7 and L4 say the same",
    "DRIVE": "T9, L3 and S2 say the same",
    "SENSES": "what others send",
    "RANGES": "what others send",
    "ANSWER": "T7 says the same",
    "EMERGENCY": "P7 says the same",
    "HEARTBEAT": "T11 and S4 say the same",
    "BOOT": "T1 and T3 say the same",
    "FAULTS": "T11 and P6 say the same",
    "CRASH": "a crash would have to be made",
    "HEALTH": "T11 and H1 say the same",
}
"""Reasons why sentences have no check of their own."""

_MARK = re.compile(r"\(([A-Z]\d+)\)")
_SENTENCE = re.compile(r"(?<=\.) (?=[A-Z*`])|(?:^| )\d\. ")
_FIRST, _END = "\n## A conversation\n", "\n## Identifiers\n"


_page = cache(page)


def prose() -> Iterator[str]:
    """Yields the sentences of the page's prose about the conversation on the bus."""
    text = _page()
    for block in text[text.index(_FIRST) : text.index(_END)].split("\n\n"):
        if not block.lstrip().startswith("#"):
            yield from filter(None, _SENTENCE.split(" ".join(block.split())))


@cache
def sentences() -> dict[str, str]:
    """The specification by sentence number, by message name, and by MESSAGE.signal of a robot's messages."""
    said = {}
    for text in prose():
        begin = 0
        for mark in _MARK.finditer(text):
            said[mark[1]] = text[begin : mark.start()].strip(" ,.;:()").removeprefix("and ")
            begin = mark.end()
    comments = re.findall(r"\n## ([A-Z]+)\n\n(.+)\n", _page())
    return {**said, **{name: comment for name, comment in comments if name in MESSAGES}, **rows()}
