"""The plug-in: options, the fixture `can_bench`, the marker `can_faults`, and reports of failures."""

import warnings
from collections.abc import Generator, Iterator
from pathlib import Path

import pytest

from host_sim.base.errors import OctetError, UsageError
from host_sim.transport.rule import Rule, fewer, narrower

from .bench import Bench, Setup
from .devices import open_device
from .messages import Messages

_OPTIONS = {
    "dbc": ("FILE.dbc", "", "the bus, as a DBC file"),
    "device": ("DEVICE", "", "the device: a library (.so), a C file, image:CHIP:FILE.elf, or a command"),
    "node": ("NODE", "", "the device's name in the DBC file; the bench sends the others' cyclic messages"),
    "crc": ("PROFILE", "none", "CRC profile of the messages: e2e1, e2e2, e2e5, j1850 or none"),
    "bus": ("BUS", "fd", "bus of a command: fd (a socket pair), or one such as socketcan:vcan0"),
    "seed": ("N", "1", "seed of the faults"),
}


def pytest_addoption(parser: pytest.Parser) -> None:
    """Adds the options, which pytest's configuration file may also set."""
    group = parser.getgroup("canbench", "a device on a CAN bus")
    for name, (metavar, default, text) in _OPTIONS.items():
        group.addoption(f"--can-{name}", metavar=metavar, help=f"{text} (default: {default or 'none'})")
        parser.addini(f"can_{name}", f"as --can-{name}", default=default)
    group.addoption("--can-shrink", action="store_true", help="find the fewest faults with the same failure")


def pytest_configure(config: pytest.Config) -> None:
    """Adds the marker."""
    config.addinivalue_line("markers", "can_faults(*rules): faults of frames, such as drop@20-/to")


def _option_or_ini(config: pytest.Config, name: str) -> tuple[str, Path]:
    """The value of an option, and the folder that its relative paths start from."""
    value = config.getoption(f"--can-{name}")
    if value is not None:
        return value, config.invocation_params.dir
    return config.getini(f"can_{name}"), config.inipath.parent if config.inipath else config.rootpath


def _setup(request: pytest.FixtureRequest) -> Setup:
    config = request.config
    (dbc, dbc_folder), (device, device_folder) = _option_or_ini(config, "dbc"), _option_or_ini(config, "device")
    for name, value in (("dbc", dbc), ("device", device)):
        if not value:
            raise UsageError(f"can_bench needs --can-{name} {_OPTIONS[name][0]}, {_OPTIONS[name][2]}")
    seed, bus = _option_or_ini(config, "seed")[0], _option_or_ini(config, "bus")[0]
    if not seed.isdecimal():
        raise UsageError(f"--can-seed is a number, not {seed!r}")
    rules = [rule for mark in request.node.iter_markers("can_faults") for rule in mark.args]
    messages = Messages(dbc_folder / dbc, _option_or_ini(config, "crc")[0])
    if odd := messages.odd():
        warnings.warn(pytest.PytestWarning(odd), stacklevel=1)
    return Setup(
        messages, lambda: open_device(device, device_folder, bus), rules, int(seed), _option_or_ini(config, "node")[0]
    )


@pytest.fixture
def can_bench(request: pytest.FixtureRequest) -> Iterator[Bench]:
    """A bench with the device, powered up for this test."""
    try:
        bench = Bench(_setup(request))
    except OctetError as error:
        raise pytest.fail.Exception(str(error), pytrace=False) from None
    yield bench
    bench.close()


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport(
    item: pytest.Item, call: pytest.CallInfo[None]
) -> Generator[None, pytest.TestReport, pytest.TestReport]:
    """Adds the faults and frames on the bus to the report of a failure."""
    report = yield
    bench = getattr(item, "funcargs", {}).get("can_bench")
    if call.when == "call" and report.failed and isinstance(bench, Bench) and call.excinfo is not None:
        seed = bench.setup.seed
        report.sections.append((f"can_bench, seed {seed}", "\n".join(bench.lines())))
        if item.config.getoption("--can-shrink") and bench.faults:
            fewest = _shrunk(item, bench, _place(call.excinfo, item))
            text = " ".join(map(str, fewest))
            report.sections.append(("can_bench, fewest faults", f"{text}\n" + "\n".join(bench.lines())))
    return report


def _place(failure: pytest.ExceptionInfo[BaseException], item: pytest.Item) -> tuple[type, int]:
    """The identity of a failure: its exception type, and its last line in the test's file."""
    return failure.type, [entry.lineno for entry in failure.traceback if entry.path == item.path][-1]


def _shrunk(item: pytest.Item, bench: Bench, place: tuple[type, int]) -> list[Rule]:
    """The fewest faults with which the test fails in the same way; the bench is then as after that failure."""

    def fails(rules: list[Rule]) -> bool | None:
        bench.restart(rules)
        try:
            item.runtest()
        except Exception:
            return _place(pytest.ExceptionInfo.from_current(), item) == place or None
        return None

    rules = bench.faults
    for fewest, _ in fewer(rules, fails):
        rules = fewest
    for i, rule in enumerate(rules):
        before, after = rules[:i], rules[i + 1 :]
        rules = [*before, narrower(rule, lambda each: bool(fails([*before, each, *after]))), *after]  # noqa: B023
    fails(rules)
    return rules
