"""A conversation with a robot about a run, with ELIZA, or by any script; it marks what is known."""

import re
from collections.abc import Sequence
from pathlib import Path

from host_sim.base.errors import OctetError, UsageError
from host_sim.base.regular_file import read_text
from host_sim.protocol.generated import PATTERNS, SIDES
from host_sim.protocol.memory_kinds import sides_of
from host_sim.recording.memory_file import load_memory
from host_sim.recording.trajectory import Trajectory
from host_sim.talk.eliza import Eliza, Facts, Known
from host_sim.talk.facts import FACTS, POINT, RobotFacts, cell_in
from host_sim.talk.log_index import LogIndex, index_log
from host_sim.talk.script import read_script

SCRIPTS = Path(__file__).with_name("scripts")
"""Our own scripts; a file `NAME.script` is known as NAME."""

_SIZE_MAX = 1_000_000
_LINES_SHOWN = 3
_DECIMAL = re.compile(r"(?<=\d)[.,](?=\d)")


class Conversation:
    """Answers sentence by sentence.

    Attributes:
        greeting: What to say first.
    """

    def __init__(self, script: str, facts: Facts, source: str = "", index: LogIndex | None = None) -> None:
        """Begins a conversation.

        Args:
            script: The name of one of our own scripts, or that of a file.
            facts: The facts that it may ask for.
            source: The file that they come from.
            index: The lines of the log that they come from; None if that is not a log.

        Raises:
            UsageError: The script cannot be read, or is wrong; the message has the line.
        """
        read = read_script(_text_of(script), script, facts)
        self.greeting = read.greeting
        self._eliza, self._source, self._index = Eliza(read, facts), source, index

    def answer(self, sentence: str) -> str:
        """The answer to a sentence, in one line, marked by what it rests on.

        Returns:
            `[log] ANSWER (FILE LINES)`, `[memory] ANSWER (FILE)` or `[words] ANSWER`; if the script loops for ever, a
            line that says so.
        """
        try:
            said, evidence = self._eliza.answer(_DECIMAL.sub(POINT, sentence))
        except OctetError as error:
            return f"[words] {error}"
        said = said.replace(POINT, ".")
        if not evidence:
            return f"[words] {said}"
        if self._index is None:
            return f"[memory] {said} ({self._source})"
        lines = self._index.lines_of(sorted({tick for ticks in evidence for tick in ticks}))
        more = f" and {len(lines) - _LINES_SHOWN} more" if len(lines) > _LINES_SHOWN else ""
        return f"[log] {said} ({self._source}:{','.join(map(str, lines[-_LINES_SHOWN:]))}{more})"


def about_run(script: str, trajectory: Trajectory, log: Path, node: int, at_s: float | None = None) -> Conversation:
    """A conversation about a run.

    Args:
        script: As for `Conversation`.
        trajectory: The run.
        log: Its log.
        node: The robot's node number.
        at_s: The robot time that is asked about, s; by default, the end of the run.

    Raises:
        UsageError: That time is not in the log, or as `Conversation` does.
    """
    tick_s, last = trajectory.params.tick_s, trajectory.ticks - 1
    tick = last if at_s is None else round(at_s / tick_s)
    if not trajectory.first_tick <= tick <= last:
        first_s, last_s = trajectory.first_tick * tick_s, last * tick_s
        raise UsageError(f"{log} has no {at_s:g} s: it can be asked about {first_s:.2f} to {last_s:.2f} s")
    index = index_log(log, node, round(tick_s * 1e6))
    return Conversation(script, RobotFacts(trajectory, index, tick).by_name(), str(log), index)


def about_memory(script: str, path: Path) -> Conversation:
    """A conversation with a robot of which only the memory is known.

    Raises:
        UsageError: It is no memory file, or as `Conversation` does.
    """
    memory = load_memory(path)
    if memory is None:
        raise UsageError(f"there is no {path}")
    cells = {cell: SIDES[side] for cell, side in enumerate(sides_of(memory)) if cell and side}

    def learned(_: Sequence[str]) -> Known:
        told = [f"{PATTERNS[cell]} blocked, turn {side}" for cell, side in cells.items()]
        return Known(("; ".join(told) or "nothing yet").upper(), tuple(cells))

    def cell(words: Sequence[str]) -> Known | None:
        asked = cell_in(words)
        if not asked:
            return None
        what = f"I turn {cells[asked]}" if asked in cells else "I do not know yet what helps"
        return Known(f"{PATTERNS[asked]} blocked: {what}".upper(), (asked,))

    nothing: Facts = dict.fromkeys((name.upper() for name in FACTS), lambda _: None)
    return Conversation(script, {**nothing, "LEARNED": learned, "CELL": cell}, str(path))


def _text_of(script: str) -> str:
    own = SCRIPTS / f"{script}.script"
    path = own if own.parent == SCRIPTS and own.exists() else Path(script)
    try:
        return read_text(path, _SIZE_MAX)
    except FileNotFoundError:
        names = ", ".join(sorted(it.stem for it in SCRIPTS.glob("*.script")))
        raise UsageError(f"there is no script {script}: give a file, or one of {names}") from None
    except UnicodeDecodeError as error:
        raise UsageError(
            f"{script} is not text in UTF-8: byte {error.start} is {error.object[error.start]:#04x}"
        ) from None
