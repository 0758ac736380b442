"""The output folder of a run. It never mixes files of two runs, however a run ends."""

import json
import os
import sys
import time
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from operator import itemgetter
from pathlib import Path
from typing import Any

from host_sim.base.errors import OctetError, PageNotBuiltError
from host_sim.base.extra_library import missing
from host_sim.base.files import read_bytes, write_bytes
from host_sim.base.paths import PAGE_WASM, as_called
from host_sim.base.system import signals_held
from host_sim.base.terminal import linked
from host_sim.cli.own_source import log_words
from host_sim.cli.run_options import FLEET_TABLE, LOGS, RunOptions
from host_sim.client.frame_log import FrameLog
from host_sim.client.robot_client import RobotClient
from host_sim.recording.phrases import news_of
from host_sim.recording.run_recorder import RunRecorder
from host_sim.recording.summary import Summary, summarize
from host_sim.recording.trajectory import Trajectory
from host_sim.recording.world_file import world_path, world_text, write_world
from host_sim.sim.simulation import Simulation
from host_sim.sim.world_record import EpisodeResult

SUMMARY, PICTURE, PAGE = "summary.json", "arena.png", "replay.html"
"""The files in a run's output folder, beside the log and its world file."""

FAULTS = "faults.txt"
"""File in the run's folder: the faults that were injected."""

REFUSED = "refused.log"
"""File in the run's folder: the frames that were refused, each with its reason."""

FLEET_PICTURE = "fleet.png"
"""The files of a fleet in its output folder, beside its table and summary."""

FILES = (SUMMARY, PICTURE, PAGE, FAULTS, REFUSED, FLEET_PICTURE, FLEET_TABLE, *LOGS)
"""All files of a run or a fleet, apart from the world file beside the log."""

_SUMMARY_MAX = 10_000_000


@dataclass
class Outputs:
    """The output files of a run.

    Attributes:
        options: The run's options.
        simulation: Its simulation.
        recorder: Its recording.
        log: Its log.
        episodes: The results of its environments so far.
        cut_short: Whether a person or a signal ended it early.
        over_s: When the last environment of a watched run ended, s on the monotonic clock; 0.0 for other runs.
            Its page may be served for longer.
    """

    options: RunOptions
    simulation: Simulation
    recorder: RunRecorder
    log: FrameLog
    episodes: list[EpisodeResult] = field(default_factory=list)
    cut_short: bool = False
    over_s: float = 0.0
    _began_s: float = field(default_factory=time.monotonic)
    _packed: tuple[tuple[int, str], dict[str, Any]] = ((0, ""), {})

    @property
    def has_begun(self) -> bool:
        """Whether there was a first tick."""
        return any(client.inbox.ticks for client in self.simulation.clients)

    @property
    def has_begun_or_is_first(self) -> bool:
        """Whether to write the files: a run without a tick does not replace an earlier run."""
        return self.has_begun or not any((self.options.out / name).exists() for name in LOGS)

    def write(self) -> Summary:
        """Writes all files, with signals held back. Files of an earlier run are kept in the folder `OUT.1`.

        Raises:
            OctetError: A file cannot be written.
        """
        wall_s = (self.over_s or time.monotonic()) - self._began_s
        if len(self.episodes) < len(self.simulation.record.begun):
            self.episodes.append(self.simulation.leave())
        with signals_held():
            digest = self._replace_log()
            self._write_frames()
            summary = summarize(self.options, self.simulation, self.episodes, digest, wall_s)
            summary.write(self.options.out / SUMMARY)
            self._draw()
        return summary

    def _replace_log(self) -> str:
        """Closes the log and writes its world file. If the log cannot be written, the earlier run stays.

        Returns:
            SHA-256 of the log.

        Raises:
            OctetError: The log could not be written.
        """
        self.log.flush()
        keep_earlier(self.options)
        digest = self.log.close()
        write_world(self.simulation.record, world_path(self.options.log))
        return digest

    def _write_frames(self) -> None:
        """Writes the faults that were injected, and the frames that were refused."""
        if self.options.faults:
            _write_faults(self.options.out / FAULTS, self.simulation.clients)
        _write_refused(self.options.out / REFUSED, self.simulation.clients)

    def _draw(self) -> None:
        # Loaded late, so that runs start sooner.
        if parts := self._parts():
            self._write_page(*parts)
            try:
                from host_sim.report.picture import write_picture

                write_picture(self.options.out / PICTURE, self.recorder.trajectory)
            except ModuleNotFoundError as error:  # drawing libraries are an extra of the wheel
                if self.options.verbose:
                    print(f"left out  {PICTURE}: {missing(error.name or '', 'run')}")

    def _write_page(self, run: dict[str, Any], laboratory: dict[str, Any]) -> None:
        """Writes the page, unless its program was not built, which is no error."""
        from host_sim.report.replay_page import page

        try:
            write_bytes(self.options.out / PAGE, page(run, laboratory).encode())
        except PageNotBuiltError as error:
            if self.options.verbose:
                print(f"left out  {PAGE}: {error}")

    def recording(self) -> str | None:
        """The JSON that the page of a live run fetches: the objects `run` and `parts`; None before the first tick."""
        parts = self._parts()
        return json.dumps(dict(zip(("run", "parts"), parts, strict=True))) if parts else None

    def _parts(self) -> tuple[dict[str, Any], dict[str, Any]] | None:
        """The run so far, and the data to repeat it with; None before its first tick."""
        from host_sim.report.replay_page import run_data

        trajectory, record = self.recorder.trajectory, self.simulation.record
        trajectory.news = news_of(record)
        if not trajectory.ticks:
            return None
        now = trajectory.ticks, record.title
        if self._packed[0] != now:  # packing takes long, and pages have often just fetched it
            self._packed = now, run_data(trajectory, record.title)
        log = log_words(self.options.log, self.options.profile)
        return {**self._packed[1], "log": log}, self._laboratory(trajectory)

    def _laboratory(self, trajectory: Trajectory) -> dict[str, Any]:
        """The data with which the page answers "What if?"."""
        from host_sim.report.laboratory import NO_FIRMWARE, laboratory

        if not PAGE_WASM.exists():
            return NO_FIRMWARE
        clients = self.simulation.clients
        commands = sorted((it for client in clients for it in client.dialogue.commands), key=itemgetter(0))
        record = self.simulation.record
        return laboratory(world_text(record), trajectory, record, commands)


def _write_faults(path: Path, clients: Sequence[RobotClient]) -> None:
    """Writes the injected faults, as rules for single frames."""
    from host_sim.transport.faulty_link import FaultyLink

    links = [client.connection.link for client in clients]
    schedules = [link.schedule for link in links if isinstance(link, FaultyLink)]
    if schedules:
        rules = [str(rule) for schedule in schedules for rule in schedule.struck]
        more = sum(schedule.count for schedule in schedules) - len(rules)
        left_out = [f"# and {more} more, not recorded"] if more else []
        write_bytes(path, "".join(f"{rule}\n" for rule in [*rules, *left_out]).encode())


def _write_refused(path: Path, clients: Sequence[RobotClient]) -> None:
    """Writes the refused frames, if there are any, in order of time."""
    lines = sorted(line for client in clients for line in client.refused.lines)
    more = sum(client.refused.unlisted for client in clients)
    left_out = [f"# and {more} more, not recorded"] if more else []
    if lines:
        write_bytes(path, "".join(f"{line}\n" for line in [*lines, *left_out]).encode())


def keep_earlier(options: RunOptions) -> None:
    """Moves the files of an earlier run to the folder `OUT.1`, and says so.

    Raises:
        OctetError: One cannot be moved.
    """
    out = options.out
    earlier = [*(out / name for name in FILES), world_path(options.log)]
    if any(map(Path.exists, earlier)):
        replaced, kept = f"replaced  the run in {out}{_seed_of(out / SUMMARY)}", _beside(out)
        for path in earlier:
            _keep(path)
        if options.verbose:
            there = any((kept / path.name).exists() for path in earlier)
            print(replaced + f", which is in {kept.name} now" * there)


def print_result(options: RunOptions, summary: Summary, files: Sequence[Path]) -> None:
    """Prints the result of a run in the requested format, and the list of files."""
    if options.json:
        sys.stdout.write(summary.to_json())
    elif options.verbose:
        there = [path for path in files if path.exists()]
        wrote = f"wrote     {', '.join(map(linked, there))}"
        print("\n".join(filter(None, (summary.text, wrote, _next(options, there), summary.ending))))


def _next(options: RunOptions, there: Sequence[Path]) -> str:
    """Suggested next commands for a run other than a fleet's."""
    if options.log not in there:
        return ""
    log = "" if options.log == RunOptions.out / LOGS[0] else f" --log {options.log}"
    page = f"open {PAGE} in a browser; " if options.out / PAGE in there else ""
    then = f"next      {page}ask the robot: tools/octet talk{log}; change things while it runs: tools/octet watch"
    return as_called(then)


def _seed_of(summary: Path) -> str:
    """The seed in a summary, for a message; empty if there is none."""
    try:
        return f" (seed {json.loads(read_bytes(summary, _SUMMARY_MAX))['seed']})"
    except (OctetError, OSError, ValueError, LookupError, TypeError):
        return ""


def _beside(out: Path) -> Path:
    """The folder for the earlier contents of a run's folder."""
    folder = Path(os.path.realpath(out))
    return folder.with_name(f"{folder.name}.1")


def _keep(path: Path) -> None:
    """Moves a file of an earlier run to the folder beside, or removes it if that fails."""
    kept = _beside(path.parent)
    try:
        with suppress(OSError):
            kept.mkdir(exist_ok=True)
            (kept / path.name).unlink(missing_ok=True)
            if path.is_file():  # a folder in its place is refused below
                path.replace(kept / path.name)
        path.unlink(missing_ok=True)
    except OSError as error:
        raise OctetError(f"cannot replace {path}: {error.strerror}") from error
