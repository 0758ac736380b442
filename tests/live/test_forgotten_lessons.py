"""A page is told each lesson once, though the run forgets earlier ones meanwhile."""

import json

from host_sim.client.commands import write_cells
from host_sim.live.feed import PageFeed
from host_sim.live.paced_run import PacedRun
from host_sim.recording.run_recorder import RunRecorder
from host_sim.sim.make import make
from host_sim.sim.run_config import RunConfig


def test_a_page_is_told_each_lesson_once_though_earlier_ones_are_forgotten():
    with make(RunConfig(environments=1)) as simulation:
        run = PacedRun(simulation, RunRecorder.of(simulation, boredom_limit=10), lambda _: None)
        run.begin()
        feed, (history,), (client,) = PageFeed(run), run.recorder.histories, simulation.clients

        def write(cell: int, side: int) -> None:
            write_cells(client, {cell: side})
            history.relearn(simulation.tick, client.memory)

        write(3, 1)
        write(3, 2)
        write(5, 1)
        assert len(json.loads(feed.next())["lessons"]) == 3

        simulation.step()
        history.forget_lessons(simulation.tick)
        write(6, 2)

        assert history.forgotten == 1
        assert [lesson["cell"] for lesson in json.loads(feed.next())["lessons"]] == [6]
