"""What becomes of changes that a run of octet.html cannot make."""

from tests.web.sim.page_runs import page_file
from tests.web.support import wait_for, wait_for_text

READY = "window.octet?.scene?.state && octet.last > 0"
CHANGES = """
octet.lane.change({ do: "remove_bar", id: 98, tick: 5 });
octet.lane.change({ do: "move_food", id: 0, at: [5000, 0], tick: 5 });
octet.lane.change({ do: "freeze", robot: 0, on: 1, tick: 6 });
octet.simulate(octet.lane);
"""


def test_of_several_changes_only_those_that_cannot_be_made_are_taken_back(open_page, tmp_path):
    page = open_page(page_file(tmp_path).as_uri(), ready=READY)

    page.evaluate(f"() => {{ {CHANGES} }}")

    wait_for_text(page, "#note", "there is no such number; that is outside of the arena")
    wait_for(page, "octet.simulator.running === undefined && octet.simulator.queued.size === 0")
    assert page.evaluate("octet.lane.experiment.changes.map((change) => change.do)") == ["freeze"]
