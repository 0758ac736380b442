"""A study on a Dask cluster: a scheduler and two workers as processes of their own."""

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from host_sim.base.errors import OctetError
from host_sim.cli.main import main
from host_sim.lab.study import workers
from host_sim.lab.study.folder import StudyFolder
from host_sim.lab.study.trial import run_trial
from host_sim.lab.workers import cluster as cluster_of
from tests.lab.study.support import trial

ROOT = Path(__file__).resolve().parents[3]
NO_PAGE = ("--no-dashboard",)


class Cluster:
    """A scheduler, and workers that can be killed."""

    def __init__(self, folder: Path) -> None:
        self._folder, self._processes = folder, []
        self.scheduler = self.start("scheduler", "--port", "0")
        self.address = self._line(self.scheduler, "Scheduler at:")

    def start(self, role: str, *words: str) -> subprocess.Popen:
        command = [sys.executable, "-m", "dask", role, *words, "--host", "127.0.0.1", *NO_PAGE]
        found = {**os.environ, "PYTHONPATH": os.pathsep.join(map(str, (ROOT, ROOT / "build/cluster")))}
        process = subprocess.Popen(command, env=found, stderr=subprocess.PIPE, text=True, start_new_session=True)
        self._processes.append(process)
        return process

    def worker(self) -> subprocess.Popen:
        alone = ("--nworkers", "1", "--nthreads", "1", "--no-nanny")
        process = self.start("worker", self.address, *alone, "--local-directory", str(self._folder))
        self._line(process, "Registered to:")
        return process

    def stop(self) -> None:
        for process in reversed(self._processes):
            process.kill()
            process.communicate()

    def _line(self, process: subprocess.Popen, words: str) -> str:
        """The address in the line with these words, which Dask writes when it is ready."""
        for line in process.stderr:
            if words in line:
                return line.split()[-1]
        raise AssertionError(f"{process.args} ended with {process.wait()}")


@pytest.fixture
def cluster(tmp_path):
    cluster = Cluster(tmp_path)
    yield cluster
    cluster.stop()


@pytest.fixture
def plan(tmp_path) -> Path:
    text = 'profiles = ["article", "never"]\nseeds = 3\nenvironments = 1\nlimit_s = 20\n'
    (tmp_path / "a.toml").write_text(text)
    return tmp_path / "a.toml"


def test_two_workers_of_a_cluster_make_the_rows_that_are_made_here(cluster, plan, tmp_path):
    cluster.worker()
    cluster.worker()

    words = ["study", str(plan), "--out", str(tmp_path / "there"), "--cluster", cluster.address, "--chunk", "1"]
    assert main(words) == 0

    assert main(["study", str(plan), "--out", str(tmp_path / "here"), "--jobs", "1"]) == 0
    there, here = (
        dict(zip(zip(runs["condition"], runs["seed"], strict=True), runs["log_sha256"], strict=True))
        for runs in (StudyFolder(tmp_path / name).tables()["runs"] for name in ("there", "here"))
    )
    assert there == here
    assert len(here) == 6


def test_the_runs_of_a_worker_that_dies_are_made_by_another(cluster):
    first, _ = cluster.worker(), cluster.worker()
    trials = [trial("article", seed, limit_s=60) for seed in range(12)]

    made = []
    for runs in workers.run_all(workers.run_chunk, trials, cluster_of(cluster.address), chunk=1):
        if not made:
            os.killpg(first.pid, signal.SIGKILL)
        made += runs

    assert sorted(run.trial.config.seed for run in made) == list(range(12))
    assert run_trial(trials[5]).log_sha256 in {run.log_sha256 for run in made}


def test_a_scheduler_that_goes_away_is_said(cluster, monkeypatch):
    monkeypatch.setattr("host_sim.lab.workers._CONNECT_S", 1)
    cluster.worker()
    trials = [trial("article", seed, limit_s=60) for seed in range(12)]
    every = workers.run_all(workers.run_chunk, trials, cluster_of(cluster.address), chunk=1)

    assert next(every)
    cluster.scheduler.kill()

    with pytest.raises(OctetError, match=r"^the cluster at tcp://.* is gone"):
        list(every)


def test_where_no_scheduler_answers_it_is_one_line(plan, capsys, monkeypatch):
    monkeypatch.setattr("host_sim.lab.workers._CONNECT_S", 1)

    assert main(["study", str(plan), "--cluster", "tcp://127.0.0.1:1"]) == 2

    assert capsys.readouterr().err.count("\n") == 1
