"""The stages of tools/test and tools/prove: each is set up, run and judged on its own."""

import argparse
import fcntl
import json
import os
import re
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Collection, Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple, TextIO

from tools.testing.limits import NO_LIMIT, Ended, Limits, Steps, run_within, side_by_side

RUNNING, PASSED, FAILED, SKIPPED = "running", "passed", "failed", "skipped"

_CTEST_BEGINS = re.compile(r" *Start +\d+: (\S+)")
_CTEST_ENDS = re.compile(r" *\d+/\d+ Test +#\d+: (\S+) \.+ *(Passed)?")


class Count(NamedTuple):
    """Test results.

    Attributes:
        passed: Number that passed.
        failed: Number that failed, or were skipped and not allowed; without those still running.
        allowed: Skipped tests that the caller allowed, with their reasons.
        running: Tests that have begun and not ended.
    """

    passed: int
    failed: int
    allowed: list[str]
    running: list[str]


def count(reports: Iterable[Path], allowed: Collection[str]) -> Count:
    """Counts the tests in some reports, which grow as tests end: so a stopped run is counted, too.

    Args:
        reports: Of pytest, as tests/conftest.py writes them (`--progress FILE.jsonl`), or what ctest printed; a
            missing one has no tests.
        allowed: Words before the colon in the reasons of accepted skips.
    """
    state: dict[str, str] = {}
    reasons: dict[str, str] = {}
    for report in (report for report in reports if report.exists()):
        lines = report.read_text(errors="replace").splitlines()
        for event, test, reason in _pytest(lines) if report.suffix == ".jsonl" else _ctest(lines):
            if state.get(test) != FAILED:
                state[test] = event
                reasons[test] = reason
    skipped = [test for test, said in state.items() if said == SKIPPED]
    fine = [test for test in skipped if reasons[test].split(":")[0] in allowed]
    said = list(state.values())
    return Count(
        passed=said.count(PASSED),
        failed=said.count(FAILED) + len(skipped) - len(fine),
        allowed=[f"{test}: {reasons[test]}" for test in fine],
        running=[test for test, said in state.items() if said == RUNNING],
    )


def _pytest(lines: Iterable[str]) -> Iterable[tuple[str, str, str]]:
    for line in lines:
        try:
            event, test, reason = json.loads(line)
        except ValueError:
            continue  # cut short
        yield event, test, reason


def _ctest(lines: Iterable[str]) -> Iterable[tuple[str, str, str]]:
    for line in lines:
        if begins := _CTEST_BEGINS.match(line):
            yield RUNNING, f"ctest {begins[1]}", ""
        elif ends := _CTEST_ENDS.match(line):
            yield PASSED if ends[2] else FAILED, f"ctest {ends[1]}", ""


ROOT = Path(__file__).resolve().parents[2]
REPORTS = ROOT / "build/reports"
C_BUILD = "host-san"
STALL_MIN = 10.0
NAMED_MAX = 5

Command = Sequence[str]


@dataclass(frozen=True)
class Stage:
    """A stage of tests.

    Attributes:
        name: its name on the command line.
        setup: its stage of tools/setup.
        commands: its commands, which all run even if one fails.
        reports: files that grow as tests begin and end; none if it only checks sources.
    """

    name: str
    setup: str
    commands: Sequence[Command]
    reports: Sequence[Path] = ()


@dataclass(frozen=True)
class Result:
    """The result of a stage.

    Attributes:
        verdict: "ok", "FAILED" or "not run".
        seconds: its duration.
        passed: tests that passed.
        failed: tests that did not; 1 for a stage that failed as a whole.
        missing: skipped tests that the caller allowed, with their reasons.
        why: why it was stopped; empty if it was not.
    """

    verdict: str
    seconds: float = 0.0
    passed: int = 0
    failed: int = 0
    missing: Sequence[str] = ()
    why: str = ""


def run_commands(stage: Stage, limits: Limits, output: TextIO | None) -> Steps[list[Ended]]:
    """Runs a stage's commands within the limits."""
    ended: list[Ended] = []
    for command in stage.commands:
        it = yield from run_within(limits, command, stage.reports, cwd=ROOT, stdout=output, stderr=output)
        ended.append(it)
        if it.why:
            break
    return ended


def run_stage(stage: Stage, allowed: Collection[str], limits: Limits, output: TextIO | None) -> Steps[Result]:
    """Runs a stage; without an output file, it prints at once."""
    start = time.monotonic()
    if why := limits.passed():
        return Result("FAILED", failed=1, why=f"did not begin: {why}")
    for report in stage.reports:
        report.unlink(missing_ok=True)
    ended = yield from run_commands(stage, limits, output)
    tests = count(stage.reports, allowed)
    counted = tests.passed or tests.allowed or not stage.reports
    fine = counted and not (tests.failed or tests.running) and all(it.well for it in ended)
    why = next((f"stopped: {it.why}{during(tests.running)}" for it in ended if it.why), "")
    return Result(
        verdict="ok" if fine else "FAILED",
        seconds=time.monotonic() - start,
        passed=tests.passed,
        failed=max(tests.failed + len(tests.running), 0 if fine else 1),
        missing=tests.allowed,
        why=why,
    )


def pytest_stage(name: str, tests: Sequence[str], allowed: Collection[str], more: int = 1) -> Stage:
    """A stage of Python tests.

    Args:
        name: of the stage, for tools/setup as well.
        tests: files and folders, or options of pytest that choose.
        allowed: words before the colon in the reasons of accepted skips.
        more: workers beyond one for each core, since tests sometimes wait for processes and browsers.
    """
    workers = os.environ.get("PYTEST_XDIST_AUTO_NUM_WORKERS", f"{len(os.sched_getaffinity(0)) + more}")
    options = ("-n", workers, "--dist=worksteal", "-m", "not vcan")
    report = REPORTS / f"{name}.jsonl"
    return Stage(name, name, [pytest_command(report, (*options, *tests), allowed)], [report])


def pytest_command(report: Path, words: Sequence[str], allowed: Collection[str]) -> Command:
    """The command of pytest with these arguments, and with a report for `count`. Prints what took longest."""
    skips = (f"--allow-missing={name}" for name in allowed)
    slowest = ("--durations=8", "--durations-min=4")
    return (".venv/bin/python", "-m", "pytest", "--quiet", *slowest, f"--progress={report}", *skips, *words)


def ctest_command(folder: str, report: Path, *selection: str) -> Command:
    """The command of ctest for a build, with a report for `count`."""
    options = ("--test-dir", f"build/{folder}", "--output-on-failure", "--no-tests=error")
    kept = 'set -o pipefail; "$@" | tee "$0"'
    return ("bash", "-c", kept, str(report), "ctest", *options, *selection)


def c_stage(*selection: str) -> Stage:
    """The stage of the C tests, with the sanitizers; `selection` are options of ctest."""
    report = REPORTS / "c.log"
    return Stage("c", "c", [ctest_command(C_BUILD, report, *selection)], [report])


RunStage = Callable[[Stage, TextIO | None], Steps[Result]]


def run_lane(waiting: Iterator[Stage], at_once: bool, run: RunStage, results: dict[str, Result]) -> Steps[None]:
    """Runs the next waiting stage until none is left; the output of each is shown at once, or at its end."""
    for stage in waiting:
        if at_once:
            print(f"\n== {stage.name}", flush=True)
            results[stage.name] = yield from run(stage, None)
        else:
            with (REPORTS / f"{stage.name}.txt").open("w+") as output:
                results[stage.name] = yield from run(stage, output)
                output.seek(0)
                print(f"\n== {stage.name}\n{output.read()}", end="", flush=True)


def during(tests: Sequence[str]) -> str:
    """Names tests that were running."""
    more = f" and {len(tests) - NAMED_MAX} more" if len(tests) > NAMED_MAX else ""
    return f" during {', '.join(tests[:NAMED_MAX])}{more}" if tests else ""


def report(results: dict[str, Result], left_out: Sequence[str]) -> None:
    """Prints the summary; its last line has the numbers of tests."""
    print()
    for name, result in results.items():
        print(f"{name:8} {result.verdict:8} {result.seconds:6.1f} s  {result.passed} passed, {result.failed} failed")
        if result.why:
            print(f"{'':8} {result.why}")
        for test in result.missing:
            print(f"{'':8} skipped, as allowed: {test}")
    if left_out:
        print(f"left out: {', '.join(left_out)}")
    print(f"{sum(r.passed for r in results.values())} passed, {sum(r.failed for r in results.values())} failed")


def set_up(stages: Sequence[Stage]) -> list[Stage]:
    """Sets up what stages need; returns those that can run."""

    def is_set_up(*these: Stage) -> bool:
        return subprocess.run((ROOT / "tools/setup", *(it.setup for it in these)), check=False).returncode == 0

    return list(stages) if is_set_up(*stages) else [stage for stage in stages if is_set_up(stage)]


def parse(parser: argparse.ArgumentParser, names: Sequence[str]) -> argparse.Namespace:
    """Parses the command line, adding the arguments that tools/test and tools/prove share."""
    add = parser.add_argument
    add("stages", nargs="*", metavar="STAGE", help=f"run only these: {', '.join(names)}")
    missing = "accept that this stage cannot run, or skipped tests whose reason begins with NAME:"
    add("--allow-missing", action="append", default=[], metavar="NAME", help=missing)
    add("--time-limit", type=float, default=NO_LIMIT, metavar="MINUTES", help="total time limit (default: none)")
    stall = "stop a stage after this time without progress (default: %(default)g)"
    add("--stall-limit", type=float, default=STALL_MIN, metavar="MINUTES", help=stall)
    add("--repeat", type=int, default=1, metavar="N", help="run everything N times, and print how many runs passed")
    add("--beside", type=int, default=0, metavar="N", help="run N busy loops meanwhile, as on a busy machine")
    arguments = parser.parse_args()
    unknown = set(arguments.stages) - set(names)
    if unknown:
        parser.error(f"no such stage: {', '.join(sorted(unknown))}; there are {', '.join(names)}")
    if arguments.repeat < 1 or arguments.beside < 0:
        parser.error("--repeat must be 1 or more, and --beside 0 or more")
    be_alone(parser)
    return arguments


def be_alone(parser: argparse.ArgumentParser) -> None:
    """Ends the command if it or its sibling runs in this checkout: both would write the same reports."""
    REPORTS.mkdir(parents=True, exist_ok=True)
    lock = os.open(REPORTS / "lock", os.O_CREAT | os.O_RDWR)  # open until the end
    try:
        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        parser.error("tools/test or tools/prove is running in this checkout")


@contextmanager
def busy(count: int) -> Iterator[Sequence[subprocess.Popen[bytes]]]:
    """Busy loops in `count` processes, which end with this one even if it is killed."""
    loop = "import os\nparent = os.getppid()\nwhile os.getppid() == parent: pass"
    loops = [subprocess.Popen((sys.executable, "-c", loop)) for _ in range(count)]
    try:
        yield loops
    finally:
        for each in loops:
            each.kill()
            each.wait()


def run_repeatedly(stages: Sequence[Stage], arguments: argparse.Namespace) -> int:
    """As `run_stages`, with the repetitions and busy loops that the command line asks for.

    Returns:
        0 if every run passed, else 1.
    """
    with busy(arguments.beside):
        codes = [run_stages(stages, arguments) for _ in range(arguments.repeat)]
    failed = [str(number) for number, code in enumerate(codes, 1) if code != 0]
    if arguments.repeat > 1:
        which = f"; failed: {', '.join(failed)}" if failed else ""
        print(f"{len(codes) - len(failed)} of {len(codes)} runs passed{which}")
    return 1 if failed else 0


def run_stages(stages: Sequence[Stage], arguments: argparse.Namespace) -> int:
    """Sets up the stages that the command line names, or all, and runs them in this order, two at a time.

    Returns:
        0 if everything asked for ran and passed, else 1.
    """
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(1))  # running commands are stopped on the way out
    limits = Limits(arguments.time_limit, arguments.stall_limit, begun=time.monotonic())
    chosen = [stage for stage in stages if not arguments.stages or stage.name in arguments.stages]
    results = {it.name: Result("not run", failed=int(it.name not in arguments.allow_missing)) for it in chosen}
    ready = set_up(chosen)

    def run(stage: Stage, output: TextIO | None) -> Steps[Result]:
        return run_stage(stage, arguments.allow_missing, limits, output)

    waiting = iter(ready)  # shared: while one lane's last test leaves cores idle, the other uses them
    side_by_side(run_lane(waiting, True, run, results), run_lane(waiting, False, run, results))
    report(results, [stage.name for stage in stages if stage.name not in results])
    allowed = {name for name in arguments.allow_missing if name in results and results[name].verdict == "not run"}
    return 0 if all(result.verdict == "ok" for name, result in results.items() if name not in allowed) else 1
