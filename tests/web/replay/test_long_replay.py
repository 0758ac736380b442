"""The page of a run of which only the last part is retained shows what the robot knew and used all the same."""

import json

from host_sim.recording import run_recorder as run_recorder_module
from host_sim.recording.run_recorder import RunRecorder
from host_sim.report.replay_page import run_data
from host_sim.sim.make import make
from host_sim.sim.run_config import RunConfig
from tests.web.sim.node import in_node

STATES = """
const data = await modules["core/run_data.js"].RunData.from(JSON.parse(texts[0]));
const states = [];
for (let tick = data.first; tick <= data.last; tick += 7) states.push(...data.statesAt(tick));
return states;
"""


def test_the_states_of_the_retained_ticks_are_those_of_the_run(tmp_path, monkeypatch):
    monkeypatch.setattr(run_recorder_module, "TICKS_MAX", 1000)
    with make(RunConfig(seed=5, environments=30, limit_s=4.0)) as simulation:
        trajectory = RunRecorder.of(simulation, boredom_limit=10).trajectory
        for _ in simulation.run():
            pass
    file = tmp_path / "run.json"
    file.write_text(json.dumps(run_data(trajectory, "a long run")))

    states = in_node(tmp_path, "core/run_data.js", STATES, file)

    assert sum(cell.uses for cell in trajectory.tracks[0].cells[:8]) > 0
    assert states == [trajectory.at(tick) for tick in range(trajectory.first_tick, trajectory.ticks, 7)]
