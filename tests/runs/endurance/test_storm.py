"""A sample of the storm; the whole is run by name, as its module says."""

from tests.runs.endurance.storm import storm_at_robot, storm_at_simulator


def test_whatever_a_robot_hears_it_says_only_what_it_may():
    said = storm_at_robot(20_000, seed=1)

    assert said["ANSWER"] > 0


def test_whatever_a_simulator_hears_is_counted_and_ends_in_order():
    outcomes = storm_at_simulator(20_000, seed=1)

    assert sum(outcomes.values()) == 40
    assert outcomes.keys() <= {"went on", "SessionLostError"}
