"""Runs the checks, each on a robot just powered up, and judges each sentence."""

from collections.abc import Collection, Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass

from host_sim.base.errors import RobotError
from host_sim.lab.check import conversation, session, silence  # noqa: F401 - each notes its checks
from host_sim.lab.check.invariants import breaches
from host_sim.lab.check.registry import CHECKS
from host_sim.lab.check.robots import Robots
from host_sim.lab.check.sentences import NOT_CHECKED, sentences
from host_sim.lab.check.talk import BrokenError, Said, Talk

_FRAMES = 12


@dataclass(frozen=True)
class Verdict:
    """The verdict on a sentence.

    Attributes:
        number: Number of the sentence, or the name of a message or a signal.
        text: The sentence.
        state: `holds`, `fails`, or `not checked`.
        why: The fault, or the reason why it is not checked.
        frames: The last frames before the fault, for people.
    """

    number: str
    text: str
    state: str
    why: str = ""
    frames: tuple[str, ...] = ()


@dataclass
class _Course:
    """The result of one check."""

    number: str
    why: str
    talk: Talk | None


def check_robot(robots: Robots, missing: Collection[str] = (), jobs: int = 1, tries: int = 1) -> list[Verdict]:
    """Judges each sentence.

    Args:
        robots: Provides a robot for each check.
        missing: Checks that are not possible with this robot.
        jobs: Maximum number of robots at once.
        tries: Attempts per check before it counts as failed, since a busy machine may cause delays.

    Raises:
        UsageError: There is no robot, or it does not answer at all.
    """
    with robots():
        pass  # any reason for not answering is reported at once
    possible = [number for number in CHECKS if number not in missing]
    possible.sort(key=lambda number: CHECKS[number].__module__ != silence.__name__)  # slowest checks first
    with ThreadPoolExecutor(jobs) as pool:
        courses = pool.map(lambda number: _run(number, robots, tries), possible)
        return list(_judge({course.number: course for course in courses}, missing))


def _run(number: str, robots: Robots, tries: int) -> _Course:
    course = _run_once(number, robots)
    is_broken = course.why or (course.talk is not None and any(breaches(course.talk.said)))
    return _run(number, robots, tries - 1) if is_broken and tries > 1 else course


def _run_once(number: str, robots: Robots) -> _Course:
    course = _Course(number, "", None)
    try:
        with robots() as course.talk:
            CHECKS[number](course.talk)
    except (BrokenError, RobotError) as error:
        course.why = str(error)
    return course


def _judge(courses: dict[str, _Course], missing: Collection[str]) -> Iterator[Verdict]:
    broken: dict[str, tuple[str, tuple[str, ...]]] = {}
    heard: set[str] = set()
    for course in courses.values():
        talk = course.talk
        said = talk.said if talk is not None else []
        heard |= {each.name for each in said if each.by_robot}
        if course.why:
            broken[course.number] = (course.why, tuple(talk.lines(_FRAMES)) if talk is not None else ())
        for breach in breaches(said):
            assert talk is not None
            broken.setdefault(breach.number, (breach.why, tuple(_until(talk, breach.said))))
    for number, text in sentences().items():
        message = number.partition(".")[0]
        if number in broken:
            yield Verdict(number, text, "fails", *broken[number])
        elif number in NOT_CHECKED or number in missing:
            reason = NOT_CHECKED.get(number, "it needs a robot that can be started and stopped: use --robot-command")
            yield Verdict(number, text, "not checked", reason)
        elif "." in number and message not in heard:
            yield Verdict(number, text, "not checked", f"no {message} came")
        else:
            yield Verdict(number, text, "holds")


def _until(talk: Talk, said: Said) -> Iterator[str]:
    index = next(i for i, each in enumerate(talk.said) if each is said)
    return Talk(talk.link, talk.clock, talk.protocol, said=talk.said[: index + 1]).lines(_FRAMES // 3)
