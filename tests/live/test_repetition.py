"""A run that people have meddled with is the same again: for the same orders at the same ticks, and from its log."""

from host_sim.client.commands import stop
from host_sim.live.page_commands import EraseMemory, Freeze, NewSeed, NextEnvironment, WriteCell
from host_sim.recording.phrases import news_of
from host_sim.recording.resimulation import resimulate
from host_sim.recording.world_file import world_path, write_world
from host_sim.report.replay_page import run_data
from host_sim.world.edits import Edit
from tests.live.support import order


def test_equal_orders_at_equal_ticks_give_equal_runs(live):
    def meddle(name: str) -> str:
        run = live(name)
        simulation = run.simulation
        for orders in (
            [Edit("add_bar", a=(1000.0, 200.0), b=(1000.0, 900.0)), WriteCell(2, 1)],
            [Edit("lift")],
            [Edit("put", at=(2000.0, 2700.0), heading=500), Edit("move_food", 0, at=(300.0, 300.0))],
            [NextEnvironment(), Freeze(True)],
            [NewSeed(4)],
        ):
            for _ in range(137):
                simulation.step()
            order(run, *orders)
        stop(simulation.clients[0])
        return simulation.clients[0].log.close()

    assert meddle("once") == meddle("again")


def test_an_environment_that_ended_without_a_tick_began_all_the_same(live, tmp_path):
    run = live("skipped")
    for orders in ([Edit("body", what="odometer:left:150%")], [NewSeed(4), NextEnvironment()], []):
        for _ in range(137):
            run.simulation.step()
        order(run, *orders)
    stop(run.simulation.clients[0])
    run.simulation.clients[0].log.close()
    log = tmp_path / "skipped.log"
    write_world(run.simulation.record, world_path(log))

    run.recorder.trajectory.news = news_of(run.simulation.record)
    assert run_data(resimulate(log).trajectory, "") == run_data(run.recorder.trajectory, "")


def test_the_memory_that_a_robot_reports_with_its_start_is_the_one_it_starts_with(live, tmp_path):
    run = live("fixed", fixed=True)
    for orders in ([WriteCell(3, 2)], [NewSeed(4)], [NewSeed(5, keep=True), WriteCell(2, 2)], []):
        for _ in range(137):
            run.simulation.step()
        order(run, *orders)
    stop(run.simulation.clients[0])
    run.simulation.clients[0].log.close()
    write_world(run.simulation.record, world_path(tmp_path / "fixed.log"))

    again = resimulate(tmp_path / "fixed.log").trajectory

    assert run_data(again, "") == run_data(run.recorder.trajectory, "")


def test_what_a_person_wrote_between_two_ticks_is_the_same_from_the_log(live, tmp_path):
    run = live("changed")
    for orders in (
        [WriteCell(3, 1), WriteCell(3, 2), WriteCell(5, 1)],
        [EraseMemory(), WriteCell(3, 1), Freeze(True)],
        [WriteCell(6, 2), NewSeed(4), WriteCell(2, 1), WriteCell(2, 2)],
        [WriteCell(1, 1), NewSeed(5, keep=True)],
        [WriteCell(4, 1)],
    ):
        for _ in range(137):
            run.simulation.step()
        order(run, *orders)
    stop(run.simulation.clients[0])
    run.simulation.clients[0].log.close()
    log = tmp_path / "changed.log"
    write_world(run.simulation.record, world_path(log))

    again = resimulate(log).trajectory

    assert len(run.recorder.histories[0].lessons) > 8
    assert run_data(again, "") == run_data(run.recorder.trajectory, "")
