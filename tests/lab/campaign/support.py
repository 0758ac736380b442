"""What the tests of the campaign share: a run without a fault, and the outcome of any."""

from host_sim.lab.campaign.cell import LOCKSTEP, Cell, Outcome
from host_sim.lab.campaign.running import run_one

CLEAN = Cell("article", "none", LOCKSTEP, limit_s=3.0)


def outcome_of(text: str) -> Outcome:
    return run_one(Cell.parse(text))
