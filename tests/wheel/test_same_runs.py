"""Runs of the wheel and of the page's WebAssembly are those of the checkout, by the hashes of their logs."""

import os
import re
import subprocess
import sys
from pathlib import Path
from zipfile import ZipFile

from host_sim.client.frame_log import digest_of
from tests.web.sim.page_runs import experiment, run_in_page

ROOT = Path(__file__).resolve().parents[2]
SEEDS, LIMIT_S = (1, 2, 3), 20
PROGRAM = f"""
from host_sim.cli.main import main
for seed in {SEEDS}:
    main(["run", "--bus", "none", "--environments", "2", "--limit-s", "{LIMIT_S}", "--json", "--seed", str(seed)])
"""


def digests(site: Path, cwd: Path) -> list[str]:
    """Those of the runs of the packages in a folder."""
    variables = {**os.environ, "PYTHONPATH": str(site)}
    said = subprocess.check_output([sys.executable, "-c", PROGRAM], cwd=cwd, env=variables, text=True)
    return re.findall(r'"log_sha256": "(\w+)"', said)


def test_the_wheel_gives_the_bytes_of_the_checkout(wheel: Path, tmp_path: Path):
    site = tmp_path / "site"
    with ZipFile(wheel) as files:
        files.extractall(site)

    ours = digests(ROOT, tmp_path)

    assert digests(site, tmp_path) == ours
    assert len(set(ours)) == len(SEEDS)


def test_the_page_gives_the_bytes_of_the_checkout(tmp_path: Path):
    runs = run_in_page(tmp_path, *(experiment("article", seed, limit_ticks=LIMIT_S * 50) for seed in SEEDS))

    assert [digest_of(run["log"].encode("latin1")) for run in runs] == digests(ROOT, tmp_path)
