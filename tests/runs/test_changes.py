"""Runs in other worlds, and in worlds and bodies that change: recorded, repeated, and refused when they cannot be."""

import pytest

from host_sim.protocol.generated import FEEL
from host_sim.recording.resimulation import resimulate
from host_sim.sim.make import make
from host_sim.sim.run_config import RunConfig
from tests.runs.support import octet

BRIEF = ("--environments", "2", "--limit-s", "8", "--bus", "none", "--seed", "6")
ALL = (
    *("plant@2s", "plant:600,700@2s", "grow@3s", "swap-motors@env2", "mirror@4s", "stuck-on:front@5s"),
    *("stuck-off:left@5.5s", "noise:10/1000@1s", "weak-motor:left:60%@env2+2s", "repair@env2+4s"),
    *("odometer:left:150%@0.5s", "swap-odometers@7s", "swap-odometers@7.5s", "false-beacon:100@env2+5s"),
)


def words(changes) -> list[str]:
    return [word for change in changes for word in ("--change", change)]


@pytest.mark.faulty
def test_run_with_many_changes_is_repeated_from_its_log(run):
    done = run(*BRIEF, *words(ALL))

    again = resimulate(done.out / "run.log")
    assert (done.code, done.errors) == (0, "")
    assert sorted(done.summary["changes"]["happened"]) == sorted(ALL)
    assert "changes   14 happened\n" in done.output
    assert again.trajectory.ticks == 800
    assert octet("replay", done.out / "run.log").returncode == 0


@pytest.mark.faulty
def test_page_made_from_the_log_equals_that_of_the_run(run, tmp_path):
    done = run(*BRIEF, *words(ALL))
    page = tmp_path / "again.html"

    assert octet("replay", done.out / "run.log", "--html", page).returncode == 0
    assert page.read_bytes() == (done.out / "replay.html").read_bytes()


@pytest.mark.faulty
def test_changes_depend_on_seed_and_options_only(run):
    assert run(*BRIEF, *words(ALL)).log == run(*BRIEF[:4], "--bus", "fd", *BRIEF[6:], *words(ALL)).log


@pytest.mark.faulty
@pytest.mark.parametrize("bus", ["none", "fd"])
def test_run_whose_robot_stops_for_its_wheels_is_repeated_from_its_log(run, bus):
    deadened = ("odometer:left:-100%@2s", "odometer:right:-100%@2s", "repair@env2")

    done = run(*BRIEF[:4], "--bus", bus, *BRIEF[6:], *words(deadened))

    assert (done.code, done.errors.count("the robot has stopped")) == (1, 1)
    assert resimulate(done.out / "run.log").trajectory.ticks == 800
    assert octet("replay", done.out / "run.log").returncode == 0


def test_stop_for_a_dead_motor_is_not_reported_as_a_stop_by_somebody_else(run):
    dead = words(["weak-motor:left:0%@2s"])

    done = run("--environments", "1", "--limit-s", "30", "--seed", "12", "--bus", "none", *dead)

    assert (done.code, done.errors.count("the robot has stopped")) == (1, 1)
    assert "somebody else" not in done.errors


def test_noise_changes_the_log_and_noise_of_zero_does_not(run):
    logs = {run(*BRIEF, *words(changes)).log for changes in ([], ["noise:100/1000@0s"], ["noise:0/1000@0s"])}

    assert len(logs) == 2


def test_impossible_change_is_reported_and_counted_and_the_run_goes_on(run):
    done = run(*BRIEF, "--change", "grow@2s", "--change", "plant:3999,2999@env2+99s")

    assert done.code == 0
    assert done.errors == "octet: at 2.00 s grow@2s could not happen: there is no plant in this environment\n"
    assert done.summary["changes"] == {"happened": [], "refused": ["grow@2s"], "missed": ["plant:3999,2999@env2+99s"]}
    assert "changes   1 could not happen, 1 came after the end\n" in done.output
    assert len(done.summary["environments"]) == 2


def test_plant_on_the_robot_is_refused(run):
    done = run(*BRIEF, "--change", "plant:100,100@0s", "--world", "small", "--seed", "1")
    x, y = (round(place) for place in resimulate(done.out / "run.log").trajectory.tracks[0].pose(0)[:2])

    again = run("--world", "small", *BRIEF, "--seed", "1", "--change", f"plant:{x},{y}@0s")

    assert f"plant:{x},{y}@0s could not happen: the robot stands there" in again.errors


@pytest.mark.parametrize(
    ("change", "why"),
    [
        ("plnat@5s", "'plnat@5s' is not a change: did you mean plant?"),
        ("swap-motors@env6", "swap-motors is scheduled for environment 6, but the run has 2"),
        ("swap-motors@5s/2", "swap-motors is scheduled for robot 2, but the run has 1"),
    ],
)
def test_invalid_change_is_refused_before_the_run_begins(run, change, why):
    done = run(*BRIEF, "--change", change)

    assert (done.code, done.errors) == (2, f"octet: {why}\n")
    assert not (done.out / "run.log").exists()


def test_mistake_in_a_schedule_is_reported_with_its_line(run, tmp_path):
    schedule = tmp_path / "day.txt"
    schedule.write_text("# a day\nplant@5s\nnoise@6s\n")

    done = run(*BRIEF, "--change", schedule)

    assert done.code == 2
    assert done.errors == (
        f"octet: {schedule}:3: 'noise@6s' is not a change: write noise:N/TICKS, such as noise:10/1000\n"
    )


SHORT = ("--environments", "1", "--limit-s", "5", "--bus", "none")


@pytest.mark.parametrize("world", ["corridors", "small"])
def test_run_in_another_world_is_repeated_from_its_log(run, world):
    done = run("--world", world, "--environments", "2", "--limit-s", "5", "--bus", "none")

    result = resimulate(done.out / "run.log")
    assert done.summary["world"] == world
    assert result.title == f"seed 1, {world}"
    assert result.trajectory.ticks == sum(environment["ticks"] for environment in done.summary["environments"])


def test_run_in_a_custom_world_is_repeated_after_its_file_is_deleted(run, tmp_path):
    own = tmp_path / "own.toml"
    own.write_text("size = [1000, 1000]\nstart = [200, 500, 0]\nfood = [[800, 500]]")
    done = run("--world", own, *SHORT)
    own.unlink()

    assert resimulate(done.out / "run.log").trajectory.params.width_mm == 1000
    assert done.summary["environments"][0]["finished"]


def test_default_world_of_a_run_is_random(run):
    assert run(*SHORT).log == run("--world", "random", *SHORT).log


def test_mistake_in_a_world_file_is_refused_before_anything_is_written(run, tmp_path):
    own = tmp_path / "own.toml"
    own.write_text("# two mistakes\nfoot = []")
    done = run("--world", own, *SHORT)

    assert (done.code, done.output) == (2, "")
    assert done.errors == f"octet: {own}:2: there is no 'foot': did you mean 'food'?\n"
    assert not done.out.exists()


def test_more_robots_than_a_world_has_room_for_are_refused(tmp_path):
    own = tmp_path / "own.toml"
    own.write_text("size = [600, 600]\nfood = [[300, 300]]")

    done = octet("run", "--world", own, "--robots", "9", "--out", tmp_path / "out", *SHORT)

    assert done.returncode == 2
    assert "9 robots are too many for seed 1" in done.stderr


SEEDS, ENVIRONMENTS = 12, 3
CAREFUL = {"filter": 1, "distrust": 32}


def test_careful_robot_with_a_stuck_front_sensor_rarely_touches_anything():
    # Given a front sensor that always shows something, and robots that stop believing it
    touched = 0
    for seed in range(1, SEEDS + 1):
        config = RunConfig(seed, ENVIRONMENTS, profile="adaptive", settings=CAREFUL, changes=("stuck-on:front@env1",))
        with make(config) as simulation:
            # When they have been through their environments
            touched += sum(episode.robots[0].collisions > 0 for episode in simulation.run())
    # Then they touched something in less than 5 % of them; without a look aside it was in 18 %
    assert touched < 0.05 * SEEDS * ENVIRONMENTS


@pytest.mark.parametrize(("how", "left_out", "said"), [("on", 0, True), ("off", 0, True), ("on", 1, False)])
def test_run_reports_when_every_sensor_is_stuck(run, how, left_out, said):
    sensors = [name.lower().replace("_", "-") for name in FEEL][left_out:]
    words = [word for sensor in sensors for word in ("--change", f"stuck-{how}:{sensor}@1s")]

    done = run("--environments", "1", "--limit-s", "2", "--bus", "none", *words)

    assert (", every sensor stuck" in done.output) == said
    assert done.summary["environments"][0]["robots"][0]["stuck_sensors"] == len(sensors)
