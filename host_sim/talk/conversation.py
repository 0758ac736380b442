"""A conversation with a robot about a run, with ELIZA, or by any script; answers are marked with their source."""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

from host_sim.base.errors import OctetError, UsageError
from host_sim.base.files import read_text
from host_sim.recording.memory_file import load_memory
from host_sim.recording.trajectory import Trajectory
from host_sim.talk.eliza import Eliza, Facts, Known
from host_sim.talk.facts import FACTS, Rests, RobotFacts
from host_sim.talk.log_index import LogIndex, index_log
from host_sim.talk.script import Script, read_script
from host_sim.talk.texts import POINT, Texts, read_texts
from host_sim.world.memory_kinds import sides_of

SCRIPTS = Path(__file__).with_name("scripts")
"""Folder of the built-in scripts, `NAME.script`, and the texts of their facts, `NAME.toml`."""

SPEAKERS = ("robot", "robot-de", "eliza", "eliza-de")
"""Names of the built-in scripts, in the order in which pages offer them."""

_SIZE_MAX = 1_000_000
_LINES_SHOWN = 3

NO_FACTS: Facts = dict.fromkeys((name.upper() for name in FACTS), lambda _: None)
"""The facts when nothing is known."""


class Said(NamedTuple):
    """An answer.

    Attributes:
        mark: Source of its facts: `log` or `memory`; `words` if it has none.
        text: Text of the answer.
        rests: The evidence for its facts: ticks, cells and pieces of food.
    """

    mark: str
    text: str
    rests: Rests


class Conversation:
    """Answers a person sentence by sentence.

    Attributes:
        script: The script that it follows.
    """

    def __init__(self, script: Script, facts: Facts, texts: Texts, mark: str = "log") -> None:
        """Starts a conversation.

        Args:
            script: The script.
            facts: The facts that it may ask for.
            texts: The language of questions and answers.
            mark: The mark of answers with facts.
        """
        self.script, self._texts, self._mark = script, texts, mark
        self._eliza = Eliza(script, facts)

    def ask_about(self, facts: Facts) -> None:
        """Uses these facts for all further answers."""
        self._eliza.facts = facts

    def answer(self, sentence: str) -> Said:
        """Answers a sentence; if the script loops for ever, the answer says so."""
        try:
            said, evidence = self._eliza.answer(self._texts.heard(sentence))
        except OctetError as error:
            return Said("words", str(error), Rests([], [], []))
        rests = Rests(*(sorted({it for known in evidence for it in known[part]}) for part in range(3)))
        return Said(self._mark if evidence else "words", said.replace(POINT, self._texts.words.point), rests)


class Source(NamedTuple):
    """The source of facts.

    Attributes:
        path: The log or the memory file.
        log: Index of the log; None for a memory file.
    """

    path: Path
    log: LogIndex | None

    def line_of(self, said: Said) -> str:
        """An answer in one line: `[log] ANSWER (FILE:LINES)`, `[memory] ANSWER (FILE)` or `[words] ANSWER`."""
        if said.mark == "words":
            return f"[words] {said.text}"
        if self.log is None:
            return f"[{said.mark}] {said.text} ({self.path})"
        lines = self.log.lines_of(said.rests.ticks)
        more = f" and {len(lines) - _LINES_SHOWN} more" if len(lines) > _LINES_SHOWN else ""
        return f"[{said.mark}] {said.text} ({self.path}:{','.join(map(str, lines[-_LINES_SHOWN:]))}{more})"


def about_nothing(script: str) -> Conversation:
    """Starts a conversation without facts.

    Raises:
        UsageError: As for `script_named`.
    """
    return Conversation(script_named(script), NO_FACTS, texts_of(script))


def about_run(
    script: str, trajectory: Trajectory, log: Path, node: int, at_s: float | None = None
) -> tuple[Conversation, Source]:
    """Starts a conversation about a run.

    Args:
        script: As for `script_named`.
        trajectory: The run.
        log: Path of its log.
        node: The robot's node number.
        at_s: Robot time to talk about, s; by default, the end of the run.

    Raises:
        UsageError: The time is not in the log, or as for `script_named`.
    """
    tick_s, last = trajectory.params.tick_s, trajectory.ticks - 1
    tick = last if at_s is None else round(at_s / tick_s)
    if not trajectory.first_tick <= tick <= last:
        first_s, last_s = trajectory.first_tick * tick_s, last * tick_s
        raise UsageError(f"{log} does not contain {at_s:g} s: choose a time from {first_s:.2f} to {last_s:.2f} s")
    index, texts = index_log(log, node), texts_of(script)
    facts = RobotFacts(trajectory, index, tick, texts)
    return Conversation(script_named(script), facts.by_name(), texts), Source(log, index)


def about_memory(script: str, path: Path) -> tuple[Conversation, Source]:
    """Starts a conversation with a robot of which only the memory is known.

    Raises:
        UsageError: The file is not a memory file, or as for `script_named`.
    """
    memory, texts = load_memory(path), texts_of(script)
    if memory is None:
        raise UsageError(f"there is no file {path}")
    cells = {cell: texts.of_cell(cell, side) for cell, side in enumerate(sides_of(memory)) if cell and side}

    def learned(_: Sequence[str]) -> Known:
        told = "; ".join(texts.say("learned", **it) for it in cells.values()) or texts.say("learned_none")
        return Known(told.upper(), Rests([], [*cells], []))

    def cell(words: Sequence[str]) -> Known | None:
        asked = texts.cell_in(words)
        told = texts.say("learned" if asked in cells else "cell_none", **cells.get(asked, texts.of_cell(asked, 0)))
        return Known(told.upper(), Rests([], [asked], [])) if asked else None

    facts = {**NO_FACTS, "LEARNED": learned, "CELL": cell}
    return Conversation(script_named(script), facts, texts, "memory"), Source(path, None)


def script_named(name: str) -> Script:
    """Reads a built-in script, or a script file.

    Raises:
        UsageError: The script cannot be read or has an error; the message names the line.
    """
    try:
        return read_script(read_text(_path_of(name), _SIZE_MAX), name, NO_FACTS)
    except FileNotFoundError:
        raise UsageError(f"there is no script {name}: give a file, or one of {', '.join(SPEAKERS)}") from None
    except UnicodeDecodeError as error:
        wrong = f"byte {error.start} is {error.object[error.start]:#04x}"
        raise UsageError(f"{name} is not text in UTF-8: {wrong}") from None


def texts_of(script: str) -> Texts:
    """The texts in the language of a built-in script; English texts for any other."""
    path = _path_of(script).with_suffix(".toml")
    if path.parent == SCRIPTS and path.exists():
        return read_texts(path)
    return replace(read_texts(SCRIPTS / "robot.toml"), joined=None)


def _path_of(name: str) -> Path:
    own = SCRIPTS / f"{name}.script"
    return own if own.parent == SCRIPTS and own.exists() else Path(name)
