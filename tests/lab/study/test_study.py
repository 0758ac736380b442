"""A study from its file to its table: its rows, and that none is lost or made twice."""

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from host_sim.base.errors import OctetError
from host_sim.base.extra_library import library
from host_sim.cli.main import main
from host_sim.lab.study.folder import StudyFolder
from host_sim.lab.study.trial import run_all, run_trial
from host_sim.lab.workers import cluster as cluster_of
from host_sim.lab.workers import processes
from tests.lab.study.support import trial

ROOT = Path(__file__).resolve().parents[3]
PLAN = 'profiles = ["article", "never"]\nseeds = {seeds}\nenvironments = 1\nlimit_s = {limit_s}\n'


@pytest.fixture
def plan(tmp_path):
    """Writes a study's file and returns its path."""

    def write(seeds: int = 2, limit_s: int = 20, more: str = "") -> Path:
        (tmp_path / "a.toml").write_text(PLAN.format(seeds=seeds, limit_s=limit_s) + more)
        return tmp_path / "a.toml"

    return write


def study(path: Path, *options: str) -> int:
    return main(["study", str(path), "--out", str(path.parent / "out"), "--jobs", "2", *options])


def contents(folder: Path) -> dict[str, bytes]:
    return {str(path.relative_to(folder)): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


def test_study_has_a_row_for_each_run_environment_and_contact(plan, tmp_path, capsys):
    assert study(plan()) == 0

    assert f"wrote     {tmp_path / 'out'} (4 runs)" in capsys.readouterr().out
    tables = StudyFolder(tmp_path / "out").tables()
    runs = tables["runs"]
    assert sorted(zip(runs["condition"], runs["seed"], strict=True)) == [
        ("article", 1), ("article", 2), ("never", 1), ("never", 2),
    ]  # fmt: skip
    assert len(tables["environments"]["seed"]) == 4
    expected = run_trial(trial("never", 2, limit_s=20.0))
    digest = runs["log_sha256"][(runs["condition"] == "never") & (runs["seed"] == 2)]
    assert digest.tolist() == [expected["runs"][0]["log_sha256"]]
    contacts = tables["contacts"]
    ours = (contacts["condition"] == "never") & (contacts["seed"] == 2)
    assert contacts["trials"][ours].tolist() == [it["trials"] for it in expected["contacts"]]
    assert contacts["number"][ours].tolist() == list(range(1, ours.sum() + 1))


def test_pyarrow_reads_the_tables_of_a_study(plan, tmp_path):
    study(plan())

    parquet = library("pyarrow.parquet", "study")
    assert parquet.read_table(tmp_path / "out/environments").num_rows == 4


def test_study_resumes_and_adds_seeds(plan, tmp_path, capsys):
    study(plan(seeds=1))
    before = contents(tmp_path / "out/runs")
    capsys.readouterr()

    assert study(plan(seeds=3)) == 0

    assert "(4 runs, 2 existed already)" in capsys.readouterr().out
    after = contents(tmp_path / "out/runs")
    assert {name: after[name] for name in before} == before
    runs = StudyFolder(tmp_path / "out").tables()["runs"]
    assert len(set(zip(runs["condition"], runs["seed"], strict=True))) == len(runs["seed"]) == 6


@pytest.mark.parametrize("number", [signal.SIGKILL, signal.SIGTERM, signal.SIGINT])
def test_stopped_study_resumes_without_loss_or_repetition(plan, tmp_path, number):
    path = plan(seeds=30, limit_s=60)
    words = ["study", path, "--out", tmp_path / "out", "--jobs", "1", "--chunk", "1"]
    process = subprocess.Popen([sys.executable, "-m", "host_sim", *words], cwd=ROOT, stderr=subprocess.DEVNULL)
    while not list((tmp_path / "out").glob("runs/*.parquet")):
        assert process.poll() is None
        time.sleep(0.01)
    workers_of_it = Path(f"/proc/{process.pid}/task/{process.pid}/children").read_text().split()
    process.send_signal(number)
    assert process.wait() != 0
    while any(Path(f"/proc/{worker}").exists() for worker in workers_of_it):  # they end with the one that began them
        time.sleep(0.01)
    before = StudyFolder(tmp_path / "out").done()

    assert study(path) == 0

    runs = StudyFolder(tmp_path / "out").tables()["runs"]
    assert 0 < len(before) < 60
    assert len(set(zip(runs["condition"], runs["seed"], strict=True))) == len(runs["seed"]) == 60


def test_rows_of_a_part_without_its_runs_do_not_count(plan, tmp_path):
    study(plan())
    for part in (tmp_path / "out/runs").iterdir():
        part.unlink()

    assert not len(StudyFolder(tmp_path / "out").tables()["contacts"]["seed"])
    assert study(plan()) == 0
    assert len(StudyFolder(tmp_path / "out").tables()["environments"]["seed"]) == 4


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"format": 99}, "is of format 99, this Octet's is 1; nothing was changed"),
        ({"code": "another"}, "was made with another version of robot or world; nothing was changed"),
        ({"conditions": {}}, "has other conditions; nothing was changed"),
    ],
)
def test_study_of_another_version_is_refused_and_left_unchanged(plan, tmp_path, capsys, change, said):
    study(plan())
    about = tmp_path / "out/study.json"
    about.write_text(json.dumps({**json.loads(about.read_text()), **change}))
    before = contents(tmp_path / "out")
    capsys.readouterr()

    assert study(plan(seeds=3)) == 2

    assert said in capsys.readouterr().err
    assert contents(tmp_path / "out") == before


def test_folder_with_other_files_is_refused_and_left_unchanged(plan, tmp_path, capsys):
    (tmp_path / "out").mkdir()
    (tmp_path / "out/thesis.tex").write_text("precious")

    assert study(plan()) == 2

    assert "has something else in it" in capsys.readouterr().err
    assert contents(tmp_path / "out") == {"thesis.tex": b"precious"}


def test_study_stopped_before_it_was_described_resumes(plan, tmp_path):
    (tmp_path / "out/contacts").mkdir(parents=True)

    assert study(plan(seeds=1)) == 0


def test_study_without_worlds_in_its_runs_resumes(plan, tmp_path):
    study(plan(seeds=1))
    parquet = library("pyarrow.parquet", "study")
    for part in (tmp_path / "out/runs").iterdir():
        parquet.write_table(parquet.read_table(part).drop_columns(["world"]), part)

    assert study(plan(seeds=2)) == 0

    assert StudyFolder(tmp_path / "out").tables()["runs"]["world"].tolist() == [None] * 2 + ["random"] * 2


def test_damaged_part_is_reported_in_one_line(plan, tmp_path, capsys):
    study(plan())
    part = next((tmp_path / "out/runs").iterdir())
    part.write_bytes(b"PAR1")

    assert main(["compare", str(tmp_path / "out")]) == 2

    assert capsys.readouterr().err.count("\n") == 1


def die_once(trial):
    """Makes a run as a worker does that dies in its first one."""
    mark = Path(os.environ["OCTET_TEST_MARK"])
    if not mark.exists():
        mark.touch()
        os.kill(os.getpid(), signal.SIGKILL)
    return run_trial(trial)


def test_runs_of_a_dead_worker_are_made_again(tmp_path, monkeypatch):
    monkeypatch.setenv("OCTET_TEST_MARK", str(tmp_path / "mark"))
    trials = [trial("article", seed, limit_s=5) for seed in range(4)]

    every = run_all(die_once, trials, processes(2), chunk=1)
    made = [run["runs"][0]["seed"] for runs in every for run in runs]

    assert sorted(made) == [0, 1, 2, 3]


def die(_trial):
    """A worker that dies in each run."""
    os.kill(os.getpid(), signal.SIGKILL)


def test_study_gives_up_on_workers_that_die_each_time(plan, capsys, monkeypatch):
    monkeypatch.setattr("host_sim.lab.study.trial.run_trial", die)

    assert study(plan(seeds=1)) == 1

    assert "octet: workers die each time, perhaps in the run tools/run --bus none" in capsys.readouterr().err


def of_another_version(make, trials):
    return [make(trial) for trial in trials], "another"


def test_rows_of_a_worker_of_another_version_are_not_taken(plan, tmp_path, capsys, monkeypatch):
    monkeypatch.setattr("host_sim.lab.study.trial._make_chunk", of_another_version)

    assert study(plan(seeds=1)) == 1

    assert "a worker has another version" in capsys.readouterr().err
    assert StudyFolder(tmp_path / "out").done() == set()


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


def test_two_workers_of_a_cluster_make_the_rows_of_a_local_run(cluster, plan, tmp_path):
    cluster.worker()
    cluster.worker()

    for where, how in (("there", ["--cluster", cluster.address, "--chunk", "1"]), ("here", ["--jobs", "1"])):
        assert main(["study", str(plan(seeds=3)), "--out", str(tmp_path / where), *how]) == 0
    there, here = (
        dict(zip(zip(runs["condition"], runs["seed"], strict=True), runs["log_sha256"], strict=True))
        for runs in (StudyFolder(tmp_path / name).tables()["runs"] for name in ("there", "here"))
    )
    assert there == here
    assert len(here) == 6


def test_runs_of_a_dead_cluster_worker_are_made_by_another(cluster):
    first, _ = cluster.worker(), cluster.worker()
    trials = [trial("article", seed, limit_s=60) for seed in range(12)]

    made = []
    for runs in run_all(run_trial, trials, cluster_of(cluster.address), chunk=1):
        if not made:
            os.killpg(first.pid, signal.SIGKILL)
        made += runs

    by_seed = {run["runs"][0]["seed"]: run["runs"] for run in made}
    assert sorted(by_seed) == list(range(12))
    assert run_trial(trials[5])["runs"] == by_seed[5]


def test_lost_scheduler_is_reported(cluster, monkeypatch):
    monkeypatch.setattr("host_sim.lab.workers._CONNECT_S", 1)
    cluster.worker()
    trials = [trial("article", seed, limit_s=60) for seed in range(12)]
    every = run_all(run_trial, trials, cluster_of(cluster.address), chunk=1)

    assert next(every)
    cluster.scheduler.kill()

    with pytest.raises(OctetError, match=r"^the cluster at tcp://.* is gone"):
        list(every)


def test_unreachable_scheduler_is_reported_in_one_line(plan, capsys, monkeypatch):
    monkeypatch.setattr("host_sim.lab.workers._CONNECT_S", 1)

    assert main(["study", str(plan()), "--cluster", "tcp://127.0.0.1:1"]) == 2

    assert capsys.readouterr().err.count("\n") == 1
