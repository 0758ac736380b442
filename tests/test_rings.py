"""C sources do not call each other in a ring: who reads one of them does not have to read them all at once."""

from collections import defaultdict
from collections.abc import Iterable, Mapping

import pytest

from tests.test_unit_tested import BUILD, FOLDERS, Object, objects_of, sources_of_objects


def calls(objects: Iterable[Object]) -> dict[str, set[str]]:
    """For each source of the product the others that it calls; what several of them define may be any of them."""
    product = [it for it in objects if it.source.startswith(FOLDERS)]
    makers: dict[str, set[str]] = defaultdict(set)
    for it in product:
        for symbol in it.defined:
            makers[symbol].add(it.source)
    called: dict[str, set[str]] = defaultdict(set)
    for it in product:
        for symbol in it.needed:
            if len(makers[symbol]) == 1:
                called[it.source] |= makers[symbol] - {it.source}
    return called


def reached(called: Mapping[str, set[str]], source: str) -> set[str]:
    """All that a source calls, directly or not."""
    found: set[str] = set()
    waiting = [source]
    while waiting:
        new = called.get(waiting.pop(), set()) - found
        found |= new
        waiting += new
    return found


def in_rings(called: Mapping[str, set[str]]) -> set[str]:
    """The sources that call themselves through others."""
    return {source for source in called if source in reached(called, source)}


@pytest.fixture(scope="module")
def objects() -> list[Object]:
    return list(objects_of(BUILD, sources_of_objects(BUILD)).values())


def test_no_source_calls_itself_through_others(objects):
    assert in_rings(calls(objects)) == set()


@pytest.mark.parametrize(
    ("low", "symbol", "ring"),
    [
        ("page_state.c", "page_open", {f"page_{it}.c" for it in ("open", "commands", "frames", "state", "world")}),
        ("layout.c", "layouts_draw", {"layout.c", "layouts.c", "draw_written.c", "written.c"}),
    ],
)
def test_a_call_that_closes_a_ring_is_found(objects, low, symbol, ring):
    planted = next(Object(it.source, set(), {symbol}) for it in objects if it.source.endswith(f"/{low}"))

    found = {source.rpartition("/")[2] for source in in_rings(calls([*objects, planted]))}

    assert found >= ring
