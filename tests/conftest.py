"""A skipped test counts as failed, unless `--allow-missing NAME` allows skips for that reason.

A test that cannot run says `pytest.skip("NAME: what is missing")`.

With `--progress FILE`, tools/test can tell at any time what has passed and what is running.

Where a shell or nohup had this run ignore Ctrl-C or a hangup, what a test starts does not ignore them.

Python keeps its compiled files, here and in each process that a test starts, whatever the environment says: otherwise
each of them would compile all libraries again.
"""

import asyncio
import json
import os
import signal
import sys
from collections.abc import Generator, Iterator
from pathlib import Path

import hypothesis
import pytest

hypothesis.settings.register_profile("octet", deadline=None, derandomize=True)  # time and chance are no faults
hypothesis.settings.load_profile("octet")
for _number in (signal.SIGINT, signal.SIGHUP):
    if signal.getsignal(_number) == signal.SIG_IGN:
        signal.signal(_number, lambda *_: None)  # child processes do not inherit handlers
sys.dont_write_bytecode = False
os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # numpy's threads wait for one another where tests take all cores


PLAYWRIGHT_LOOP = pytest.StashKey[asyncio.AbstractEventLoop | None]()


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption("--progress", metavar="FILE", help="append a line of JSON whenever a test begins or ends")
    parser.addoption("--decisions", type=int, default=200_000, help="of each behaviour, held against its oracle")
    parser.addoption("--allow-missing", action="append", default=[], metavar="NAME", help="allow skips due to NAME")


def fail_if_skipped(report: pytest.TestReport | pytest.CollectReport, config: pytest.Config) -> None:
    if not report.skipped:
        return
    # An expected failure that is not run, or that fails, is reported as skipped, too.
    expected = getattr(report, "wasxfail", None)
    reason = report.longrepr[2].removeprefix("Skipped: ") if expected is None else f"xfail: {expected}"
    if reason.split(":")[0] not in config.getoption("allow_missing"):
        report.outcome = "failed"
        report.longrepr = f"skipped, which counts as failed: {reason}"


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport(item: pytest.Item) -> Generator[None, pytest.TestReport, pytest.TestReport]:
    report = yield
    fail_if_skipped(report, item.config)
    return report


@pytest.hookimpl(wrapper=True)
def pytest_make_collect_report(
    collector: pytest.Collector,
) -> Generator[None, pytest.CollectReport, pytest.CollectReport]:
    report = yield
    fail_if_skipped(report, collector.config)
    return report


@pytest.hookimpl(tryfirst=True)
def pytest_runtest_setup(item: pytest.Item) -> None:
    """Once Playwright is at work, its event loop counts as running; a test without a browser may run another."""
    if "browser" not in item.fixturenames:
        item.stash[PLAYWRIGHT_LOOP] = asyncio._get_running_loop()
        asyncio._set_running_loop(None)


@pytest.fixture(autouse=True)
def _playwright_loop(request: pytest.FixtureRequest) -> Iterator[None]:
    """Lets it count again before fixtures of more than one test are torn down: these may be pages."""
    yield
    asyncio._set_running_loop(request.node.stash.get(PLAYWRIGHT_LOOP, asyncio._get_running_loop()))


class Progress:
    """Notes what happens to each test: [event, test, reason]."""

    def __init__(self, path: Path) -> None:
        self.path = path

    def note(self, event: str, test: str, reason: str = "") -> None:
        with self.path.open("a") as file:
            file.write(json.dumps([event, test, reason]) + "\n")

    def pytest_runtest_logstart(self, nodeid: str) -> None:
        self.note("running", nodeid)

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        if report.skipped:
            reason = report.longrepr[2] if isinstance(report.longrepr, tuple) else str(report.longrepr)
            self.note("skipped", report.nodeid, reason.removeprefix("Skipped: "))
        elif report.failed or report.when == "call":
            self.note(report.outcome, report.nodeid)

    def pytest_collectreport(self, report: pytest.CollectReport) -> None:
        if report.failed:
            self.note("failed", report.nodeid)


def pytest_configure(config: pytest.Config) -> None:
    path = config.getoption("progress")
    if path and not hasattr(config, "workerinput"):  # the controller of xdist receives the workers' events
        config.pluginmanager.register(Progress(Path(path)))
