"""A sample of the noise; ten robot minutes of it are run by name, as its module says."""

import pytest

from tests.runs.endurance.noise import is_whole, run_through_noise


@pytest.mark.faulty
def test_over_a_noisy_line_a_run_in_real_time_goes_on(tmp_path):
    run = run_through_noise(tmp_path / "out", 2.0, chance=0.03)

    assert is_whole(run, 2.0), run.output + run.errors
    assert run.code == 0 or "result unreliable" in run.errors
