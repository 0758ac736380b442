"""Conducts a run from its start to its output files."""

import os
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path

from host_sim.backends.programmed_robot import check_program
from host_sim.base.errors import DoubtfulError, OctetError, UsageError
from host_sim.cli.interruption import stop_soon
from host_sim.cli.outputs import FILES, PAGE, PICTURE, SUMMARY, Outputs, tell
from host_sim.cli.run_options import LOGS, RunOptions
from host_sim.cli.run_through import each, open_listener, run_through
from host_sim.client.commands import stop
from host_sim.client.frame_log import FrameLog
from host_sim.client.robot_client import RobotClient
from host_sim.protocol.generated import CELL_COUNT
from host_sim.recording.memory_file import MemorySaver, check_writable, load_memory, memory_path
from host_sim.recording.memory_lock import memory_lock
from host_sim.recording.run_folder import run_folder
from host_sim.recording.run_recorder import RunRecorder
from host_sim.recording.summary import Summary
from host_sim.recording.world_file import world_path
from host_sim.sim.make import Memory, make
from host_sim.sim.simulation import Simulation
from host_sim.world.body_kinds import body_kind
from host_sim.world.worlds import world_of

_NOTHING = (0,) * CELL_COUNT


def conduct(options: RunOptions) -> Summary:
    """Conducts a run and writes log, world file, summary, picture and page to its folder, however the run ends.

    Raises:
        UsageError: The options are invalid; nothing was changed.
        OctetError: The run could not continue; what was recorded up to there was written.
    """
    world_of(options.world)  # errors in it, or in the next ones, are found before anything is started
    body_kind(options.body)
    check_program(options.program)
    with _memories(options) as loaded, run_folder(options.out):
        _announce(options, loaded)
        with ExitStack() as stack:
            listener = open_listener(stack, options)
            log = FrameLog(options.log)
            stack.callback(log.drop)
            memories = _first_memories(options, loaded)
            simulation = stack.enter_context(
                make(options, log, memories, lambda client: _print_robot(options, client))
            )
            recorder = RunRecorder.of(simulation, options.boredom_limit)
            _save_memories(stack, simulation, options, loaded)
            outputs = Outputs(options, simulation, recorder, log)
            try:
                run_through(outputs, listener)
                _stop(outputs)
                _tell_of_programs(options, simulation)
            except BaseException as end:
                _write_what_there_is(outputs, end)
                raise
            summary = outputs.write()
    tell(options, summary, (*(options.out / name for name in (PAGE, PICTURE, SUMMARY)), options.log))
    _check_trust(summary)
    return summary


def _tell_of_programs(options: RunOptions, simulation: Simulation) -> None:
    for client in simulation.clients if options.program and options.talks else ():
        with suppress(OctetError):  # the robot has ended, which was reported
            _, stopped, told = client.connection.status().partition("the program: ")
            print(f"program   {options.program}: {told if stopped else 'runs'}")


def _stop(outputs: Outputs) -> None:
    if outputs.cut_short:
        stop_soon(outputs.simulation.clients)
        return
    for client in outputs.simulation.clients:
        stop(client)


@contextmanager
def _memories(options: RunOptions) -> Iterator[list[Memory | None]]:
    """Loads the memory files and locks them until the run has ended."""
    paths = _memory_paths(options)
    with ExitStack() as locks:
        for path in paths:
            _check_no_output(path, options)
            check_writable(path)
            locks.enter_context(memory_lock(path))
        yield [load_memory(path) for path in paths]


def _check_no_output(memory: Path, options: RunOptions) -> None:
    """Refuses a memory file that the run would overwrite."""
    outputs = [options.out / name for name in FILES] + [world_path(options.log)]
    # Not Path.resolve: that fails for a link to itself.
    if os.path.realpath(memory) in map(os.path.realpath, outputs):
        raise UsageError(f"the run would overwrite {memory}: choose another file with --memory")


def _announce(options: RunOptions, loaded: Sequence[Memory | None]) -> None:
    """Says which memories begin empty."""
    if not options.talks:
        return
    for path, memory in zip(_memory_paths(options), loaded, strict=True):
        if memory is None:
            print(f"memory    {path} does not exist yet: the robot begins with an empty memory")


def _write_what_there_is(outputs: Outputs, end: BaseException) -> None:
    """Writes the data of an interrupted run; errors here are suppressed in favour of the original one."""
    with suppress(OctetError):
        if isinstance(end, KeyboardInterrupt):
            stop_soon(outputs.simulation.clients)
    if not outputs.has_begun and any((outputs.options.out / name).exists() for name in LOGS):
        return  # a run without a tick replaces no other
    with suppress(OctetError):
        outputs.write()
        if isinstance(end, KeyboardInterrupt):
            end.args = ("the log so far was written",)  # `main` tells it


def _check_trust(summary: Summary) -> None:
    if incidents := summary.content["incidents"]:
        first, *more = incidents
        others = f" (and {len(more)} more in {SUMMARY})" if more else ""
        raise DoubtfulError(f"result unreliable: {first}{others}")


def _print_robot(options: RunOptions, client: RobotClient) -> None:
    if options.talks:
        bus = client.connection.bus
        brain = f"program {options.program}" if options.program else f"profile {options.profile}"
        print(f"robot     node {client.node} on {bus}, {brain}, seed {options.seed}")


def _first_memories(options: RunOptions, loaded: Sequence[Memory | None]) -> list[Memory | None]:
    """Each robot's memory at its start, from its file.

    If the file does not exist yet, a robot started here begins with an empty memory, and an external one is erased.
    """
    missing = _NOTHING if options.robot == "external" else None
    return [memory or missing for memory in loaded]


def _save_memories(
    stack: ExitStack, simulation: Simulation, options: RunOptions, loaded: Sequence[Memory | None]
) -> None:
    """Saves each memory as soon as it has changed, and again at the end of the run, however it ends."""
    savers = [
        MemorySaver(path, memory, lambda line: print(f"octet: {line}", file=sys.stderr))
        for path, memory in zip(_memory_paths(options), loaded, strict=True)
    ]
    if not savers:
        return

    def save(how: Callable[..., None]) -> None:
        for saver, client in zip(savers, simulation.clients, strict=True):
            how(saver, client.memory, doubtful=bool(client.incidents))

    stack.callback(save, MemorySaver.finish)
    simulation.watch = each(simulation.watch, lambda _: save(MemorySaver.save))


def _memory_paths(options: RunOptions) -> list[Path]:
    memory = options.memory
    return [] if memory is None else [memory_path(memory, node, options.robots) for node in options.nodes]
