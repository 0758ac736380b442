"""A study's plan: the conditions to compare, the seeds and the goals, read from its TOML file.

Error messages name the line and the possible values.
"""

import itertools
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from host_sim.base.errors import UsageError, meant
from host_sim.base.toml_file import TomlFile, read_toml
from host_sim.lab.study.figures import FIGURES
from host_sim.lab.study.trial import Trial
from host_sim.protocol.generated import NODE_MAX, PARAMETERS
from host_sim.sim.option import options_of
from host_sim.sim.run_config import C_FILE, RunConfig, profile_error
from host_sim.world.body_kinds import IDEAL, body_kind
from host_sim.world.changes import Change
from host_sim.world.names import RANDOM
from host_sim.world.worlds import world_of

PLOTS = ("learning", "survival", "recovery", "score")
"""Names of the plots."""


@dataclass(frozen=True)
class Goal:
    """A goal for a figure.

    Attributes:
        figure: Name of the figure.
        condition: Name of the condition.
        against: Name of the condition to compare with, as a ratio or in percentage points; empty for none.
        at_least: Lowest acceptable value.
        at_most: Highest acceptable value.
    """

    figure: str
    condition: str
    against: str = ""
    at_least: float = -math.inf
    at_most: float = math.inf


@dataclass(frozen=True)
class Plan:
    """A study.

    Attributes:
        title: Title of the study.
        conditions: A run of each condition, all with the same seed; the others are compared with the first one.
        first_seed: The first seed.
        seeds: Number of seeds, the same for each condition.
        chosen_on: First and last of the seeds used to choose anything; empty if there are none.
        goals: The goals for its figures.
        plots: Names of the plots that are drawn for documents, of `PLOTS`.
        is_atlas: Whether each condition is run with every memory, by robots that learn no more.
        judged_on: Of an atlas, first and last of the seeds on which the memories that it names are compared; empty
            for no comparison.
    """

    title: str
    conditions: Sequence[Trial]
    first_seed: int = 1
    seeds: int = 100
    chosen_on: Sequence[int] = ()
    goals: Sequence[Goal] = ()
    plots: Sequence[str] = ()
    is_atlas: bool = False
    judged_on: Sequence[int] = ()

    @property
    def is_fleet(self) -> bool:
        """Whether its robots have worlds of their own: they run without a bus, and leave no rows."""
        return any(it.config.is_fleet for it in self.conditions)

    @property
    def seeds_used(self) -> tuple[int, int]:
        """First and last of its seeds."""
        return self.first_seed, self.first_seed + self.seeds * _seeds_each(self.conditions) - 1

    def trials(self) -> list[Trial]:
        """All runs, ordered so that those with the same environments are adjacent."""
        return [
            replace(it, config=it.config.with_seed(seed))
            for seed in range(self.first_seed, self.first_seed + self.seeds)
            for it in self.conditions
        ]


_SEED_MAX = 2**32 - 1
_KEYS = (
    *("title", "profiles", "robots", "worlds", "bodies", "changes", "own_worlds", "seeds", "first_seed", "chosen_on"),
    *("environments", "limit_s", "settings", "goals", "plots", "memories", "judged_on"),
)
_GOAL_KEYS = ("figure", "condition", "against", "at_least", "at_most")
_PLAIN = "plain"
_NO_CHANGE = "none"
_DONE_ON = {"chosen_on": "was chosen", "judged_on": "is judged"}
_WRONG_KIND = {"judged_on": 'needs memories = "all"'}


def read_plan(path: Path) -> Plan:
    """Reads a plan.

    Raises:
        UsageError: The file cannot be read, or has an error; the message names its line.
    """
    return _Reader(read_toml(path, "a study")).plan()


class _Reader:
    """Reads one file."""

    def __init__(self, file: TomlFile) -> None:
        self._file, self._content = file, file.content

    def plan(self) -> Plan:
        self._check_keys(self._content, _KEYS, "")
        if "profiles" not in self._content:
            raise self._error('profiles is missing, such as profiles = ["article", "fixed"]', "", "profiles")
        conditions = self._conditions()
        first = self._number("first_seed", 1, 0, _SEED_MAX)
        seeds = self._number("seeds", Plan.seeds, 1, min(100_000, _SEED_MAX + 1 - first))
        last = first + seeds * _seeds_each(conditions) - 1
        return Plan(
            title=self._text_of("title", self._file.path.stem),
            conditions=conditions,
            first_seed=first,
            seeds=seeds,
            chosen_on=self._seeds_apart("chosen_on", first, last),
            plots=self._words("plots", _is_plot) if "plots" in self._content else (),
            goals=[self._goal(i, goal, conditions) for i, goal in enumerate(self._tables("goals"))],
            is_atlas=self._is_atlas(conditions),
            judged_on=self._seeds_apart("judged_on", first, last),
        )

    def _is_atlas(self, conditions: Sequence[Trial]) -> bool:
        for key in ("judged_on",) if "memories" not in self._content else ("goals", "plots"):
            if key in self._content:
                raise self._error(f"{key} {_WRONG_KIND.get(key, 'are not in an atlas')}", "", key)
        if self._content.get("memories", "all") != "all":
            raise self._error('memories are "all"', "", "memories")
        runs = [it.config for it in conditions]
        if "memories" in self._content and any(
            (it.profile, it.environments, it.robots, it.worlds) != ("article", 1, 1, "one") for it in runs
        ):
            what = 'profiles = ["article"], environments = 1 and one robot'
            raise self._error(f"an atlas of all memories has {what}", "", "memories")
        return "memories" in self._content

    def _seeds_apart(self, key: str, first: int, last: int) -> Sequence[int]:
        """The seeds used to choose or to judge something; none of them may be a seed of the study."""
        chosen = self._content.get(key, [])
        numbers = isinstance(chosen, list) and all(isinstance(it, int) and not isinstance(it, bool) for it in chosen)
        if not numbers or len(chosen) not in (0, 2) or chosen != sorted(chosen):
            raise self._error(f"{key} is the first and the last of some seeds, such as [1, 1000]", "", key)
        if chosen and chosen[0] <= last and first <= chosen[1]:
            overlap = f"{first}..{last} are not held out: something {_DONE_ON[key]} on {chosen[0]}..{chosen[1]}"
            raise self._error(f"the study's seeds {overlap}", "", key)
        return tuple(chosen)

    def _conditions(self) -> list[Trial]:
        profiles = self._words("profiles", profile_error)
        settings = self._settings() or {_PLAIN: {}}
        worlds = self._words("worlds", _is_world, [RANDOM])
        bodies = self._words("bodies", _is_body, [IDEAL])
        changes = self._words("changes", _is_change, [_NO_CHANGE])
        robots = self._content.get("robots", [1])
        for count in robots if isinstance(robots, list) and robots else [None]:
            self._check_number(count, "robots", 1, NODE_MAX)
        own_worlds = self._content.get("own_worlds", False)
        if not isinstance(own_worlds, bool):
            raise self._error(f"own_worlds is true or false, not {own_worlds!r}", "", "own_worlds")
        every = itertools.product(profiles, settings, worlds, bodies, changes, robots)
        several = [len(values) > 1 for values in (profiles, settings, worlds, bodies, changes, robots)]
        return [
            Trial(
                RunConfig(
                    environments=self._option("environments"),
                    limit_s=float(self._option("limit_s")),
                    profile=profile,
                    fast=profile.endswith(C_FILE),
                    settings=settings[setting],
                    world=world,
                    body=body,
                    changes=() if change == _NO_CHANGE else (change,),
                    robots=count,
                    worlds="own" if own_worlds else "one",
                ),
                _name([profile, setting, world, body, change, f"{count} robots"], several),
            )
            for profile, setting, world, body, change, count in every
        ]

    def _settings(self) -> dict[str, dict[str, int]]:
        tables = self._content.get("settings", {})
        if not isinstance(tables, dict) or not all(isinstance(table, dict) for table in tables.values()):
            raise self._error("settings is a table for each setting, such as [settings.careful]", "", "settings")
        for name, table in tables.items():
            self._check_keys(table, PARAMETERS, f"settings.{name}")
            for key, value in table.items():
                self._check_number(value, key, PARAMETERS[key].minimum, PARAMETERS[key].maximum, f"settings.{name}")
        return tables

    def _goal(self, index: int, goal: dict[str, Any], conditions: Sequence[Trial]) -> Goal:
        def fail(message: str, key: str) -> UsageError:
            return self._error(message, "goals", key, index)

        names = [it.condition for it in conditions]
        self._check_keys(goal, _GOAL_KEYS, "goals", index)
        for key, words in (("figure", FIGURES), ("condition", names)):
            if not isinstance(goal.get(key), str) or goal[key] not in words:
                raise fail(f"{key} = {goal.get(key)!r}: {meant(goal.get(key), words)}", key)
        if goal.get("against", names[0]) not in names:
            raise fail(f"against = {goal['against']!r}: {meant(goal['against'], names)}", "against")
        bounds = {key: goal[key] for key in ("at_least", "at_most") if key in goal}
        for key, value in bounds.items():
            if not isinstance(value, int | float) or isinstance(value, bool):
                raise fail(f"{key} is a number, not {value!r}", key)
        if not bounds:
            raise fail("a goal has at_least, at_most or both", "")
        return Goal(goal["figure"], goal["condition"], goal.get("against", ""), **bounds)

    def _tables(self, key: str) -> list[dict[str, Any]]:
        tables = self._content.get(key, [])
        if not isinstance(tables, list) or not all(isinstance(table, dict) for table in tables):
            raise self._error(f"{key} are tables, each under a line [[{key}]]", "", key)
        return tables

    def _words(self, key: str, check: Callable[[str], str], default: Sequence[str] = ()) -> list[str]:
        """A list of distinct words; each must pass a check that returns the error in it."""
        words = self._content.get(key, list(default))
        if not isinstance(words, list) or not words or not all(isinstance(word, str) for word in words):
            raise self._error(f'{key} is a list of words, such as {key} = ["{(*default, "article")[0]}"]', "", key)
        for word in words:
            if wrong := check(word):
                raise self._error(f"{key}: {wrong}", "", key)
        if len(set(words)) < len(words):
            raise self._error(f"{key} has the same value twice", "", key)
        return words

    def _number(self, key: str, default: float, low: float, high: float) -> Any:
        value = self._content.get(key, default)
        self._check_number(value, key, low, high, whole=isinstance(default, int))
        return value

    def _option(self, name: str) -> Any:
        """An option of a run."""
        it, row = options_of(RunConfig)[name]
        assert row.limits is not None
        return self._number(name, it.default, *row.limits)

    def _check_number(  # noqa: PLR0913 - which number, and what it may be
        self, value: Any, key: str, low: float, high: float, table: str = "", *, whole: bool = True
    ) -> None:
        kinds = int if whole else (int, float)
        if not isinstance(value, kinds) or isinstance(value, bool) or not low <= value <= high:
            what = "a whole number" if whole else "a number"
            raise self._error(f"{key} is {what} from {low:g} to {high:.10g}, not {value!r}", table, key)

    def _text_of(self, key: str, default: str) -> str:
        value = self._content.get(key, default)
        if not isinstance(value, str) or "\n" in value:
            raise self._error(f"{key} is a line of text, not {value!r}", "", key)
        return value

    def _check_keys(
        self, table: Mapping[str, Any], keys: Sequence[str] | dict[str, Any], name: str, i: int = 0
    ) -> None:
        for key in table:
            if key not in keys:
                raise self._error(f"unknown key {key!r}; {meant(key, keys)}", name, key, i)

    def _error(self, message: str, table: str, key: str, index: int = 0) -> UsageError:
        return self._file.error(message, key, table=table, index=index)


def _is_plot(word: str) -> str:
    return "" if word in PLOTS else f"there is no {word!r}; {meant(word, PLOTS)}"


def _is_change(word: str) -> str:
    return "" if word == _NO_CHANGE else _mistake(Change.parse, word)


def _is_world(word: str) -> str:
    return _mistake(world_of, word)


def _is_body(word: str) -> str:
    return _mistake(body_kind, word)


def _mistake(read: Callable[[str], object], word: str) -> str:
    """A reader's error message for a word; empty if there is none."""
    try:
        read(word)
    except UsageError as error:
        return str(error)
    return ""


def _seeds_each(conditions: Sequence[Trial]) -> int:
    """Number of seeds that a run uses: one for each robot of a fleet in which each has its own world, else one."""
    return max(it.config.robots if it.config.is_fleet else 1 for it in conditions)


def _name(parts: Sequence[str], several: Sequence[bool]) -> str:
    """The name that distinguishes a condition; its behaviour if there is only one."""
    return " ".join(part for part, varies in zip(parts, several, strict=True) if varies) or parts[0]
