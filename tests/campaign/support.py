"""What the tests of the campaign share: a run without a fault, and the outcome of one with."""

from dataclasses import replace

from host_sim.campaign.cell import LOCKSTEP, Cell
from host_sim.campaign.outcome import Outcome
from host_sim.campaign.running import run_all

CLEAN = Cell("article", "none", LOCKSTEP, limit_s=3.0)


def outcome_of(text: str) -> Outcome:
    cell = Cell.parse(text)
    *_, outcome = run_all([replace(cell, faults=(), changes=(), events=(), fault=""), cell])
    return outcome
