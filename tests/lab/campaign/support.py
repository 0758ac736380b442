"""What the tests of the campaign share: a run without a fault, and the outcome of one with."""

from host_sim.lab.campaign.cell import LOCKSTEP, Cell, Outcome
from host_sim.lab.campaign.running import run_all

CLEAN = Cell("article", "none", LOCKSTEP, limit_s=3.0)


def leaves_a_trace(event: str, link: str, limit_s: int) -> bool:
    """Whether the log of a run in lockstep in which something happens is another one than without."""
    line = f"article {link} lockstep seed=12 limit={limit_s}"
    return outcome_of(line).digest != outcome_of(f"{line} event={event}@20").digest


def outcome_of(text: str) -> Outcome:
    (outcome,) = run_all([Cell.parse(text)])
    return outcome
