"""A log as a table: columns of Arrow, a frame of pandas."""

from host_sim.api import RunConfig, log_table, run


def test_a_log_is_a_table_of_arrow_and_of_pandas(tmp_path):
    log = tmp_path / "run.log"
    done = run(RunConfig(seed=3, environments=2, limit_s=20), log=log)

    table = log_table(log)
    frames = table.to_pandas()

    assert table.column_names[:3] == ["time_s", "node", "message"]
    assert len(frames) == len(log.read_text().splitlines())
    assert frames["SENSES.feel"].dropna().tolist() == done.ticks()["feel"].tolist()
