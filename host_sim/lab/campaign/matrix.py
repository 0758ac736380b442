"""The fault classes of the campaign, and the configurations in which each is injected."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from random import Random

from host_sim.lab.campaign.cell import LOCKSTEP, PACES, PINS_LINK, REAL_TIME, Cell
from host_sim.protocol.generated import MESSAGES, Opcode
from host_sim.protocol.words import SENSORS
from host_sim.sim.access import BOARDS
from host_sim.transport.rule import Event

_LINES, _PROCESSES = ("external", "slcan", "vcan"), ("fd", "external", "slcan", "vcan")
_COMPARED = (LOCKSTEP,)
"""Paces at which runs can be compared tick by tick."""

_RECORD_WRITES = {"feather_stm32f405": 4, "blue_pill": 8, "nucleo_g431rb": 2, PINS_LINK: 8}
"""Number of flash writes that store a memory, by link: of words, half-words or double words."""

_INSTRUCTIONS, _SAVING_INSTRUCTIONS = 20_000, 400
"""Number of Python instructions in a dozen ticks, and in saving a memory."""

_NO_LESSONS = ("fixed", "never")
"""Behaviours that store nothing."""

_AT = 100
"""Tick of an event: two seconds after the start, while the robot is moving."""


@dataclass(frozen=True)
class FaultClass:
    """A class of faults.

    Attributes:
        name: Description.
        faults: Faults of the frames, as for `--fault`.
        changes: Faults of the body, as for `--change`.
        event: Event of the robot, its line or this host; simultaneous ones are separated by blanks. {any} stands
            for any instruction of a dozen ticks, {saving} for one that saves a memory; each run draws another one.
        links: Links on which it is possible; empty for all.
        paces: Paces at which it is a fault.
        harmless: Paces at which it may go unnoticed; in lockstep it must then leave no trace.
        denies: Whether the robot itself must report it, and learn nothing wrong.
        in_lesson: Whether it occurs only when a turn is learned.
        profiles: Behaviours for which it is possible; empty for all.
        least_s: Robot time within which it shows in lockstep, twice that for `searcher`; no run there is shorter.
    """

    name: str
    faults: tuple[str, ...] = ()
    changes: tuple[str, ...] = ()
    event: str = ""
    links: tuple[str, ...] = ()
    paces: tuple[str, ...] = PACES
    harmless: tuple[str, ...] = ()
    denies: bool = False
    in_lesson: bool = False
    profiles: tuple[str, ...] = ()
    least_s: float = 0.0

    def applies_to(self, profile: str, link: str, pace: str) -> bool:
        """Whether it is possible in a configuration."""
        is_there = pace in self.paces and (link in self.links or (not self.links and link != PINS_LINK))
        is_there = is_there and (not self.profiles or profile in self.profiles)
        return is_there and not (self.in_lesson and profile in _NO_LESSONS)

    def cell(self, base: Cell) -> Cell:
        """Adds this fault to a run without faults."""
        dice = Random(f"{self.name} {base}")
        event = self.event.format(any=dice.randint(1, _INSTRUCTIONS), saving=dice.randint(1, _SAVING_INSTRUCTIONS))
        least_s = self.least_s * (2 if base.profile == "searcher" else 1) if base.pace == LOCKSTEP else 0.0
        return replace(
            base,
            limit_s=max(base.limit_s, least_s),
            fault=self.name,
            faults=self.faults,
            changes=tuple(f"{change}@2s" for change in self.changes),
            events=tuple(Event.parse(f"{each}@{_AT}") for each in event.split()),
            harmless=base.pace in self.harmless,
            denies=self.denies,
        )


def _of_body(name: str, *changes: str, denies: bool = False, least_s: float = 10.0) -> FaultClass:
    """A fault of the body. It affects the robot's actions: in lockstep, the run differs from one without it."""
    harmless = () if denies else (REAL_TIME,)
    return FaultClass(name, changes=changes, harmless=harmless, denies=denies, least_s=least_s)


def _of_odometers() -> Iterator[FaultClass]:
    """Faults of odometers: wheels seem not to follow the command. A count slightly too high cannot be noticed."""
    for side in ("left", "right"):
        yield _of_body(f"the {side} odometer is stuck", f"odometer:{side}:0%", denies=True)
        yield _of_body(f"the {side} odometer counts backward", f"odometer:{side}:-100%", denies=True)
        yield _of_body(f"the {side} odometer slips", f"odometer:{side}:150%")
    yield _of_body("both odometers are stuck", "odometer:left:0%", "odometer:right:0%", denies=True)
    yield _of_body("both odometers count backward", "odometer:left:-100%", "odometer:right:-100%", denies=True)
    yield _of_body("both odometers slip", "odometer:left:150%", "odometer:right:150%")
    yield _of_body(
        "both odometers count three times the way", "odometer:left:300%", "odometer:right:300%", denies=True
    )
    yield _of_body("odometers are swapped", "swap-odometers", denies=True)


def _of_forgery() -> Iterator[FaultClass]:
    """Forged commands and messages. The robot obeys only those with the counter that it expects."""
    for opcode in Opcode:
        name = opcode.name.lower()
        yield FaultClass(f"a forged {name} command", (f"forge:{name}@300/to",))
    for message in MESSAGES.values():
        profiles = ("distance",) if message.name == "RANGES" else ()  # for other behaviours, these are foreign frames
        rule = f"forge:20%:{message.name}/from" if message.sender == "ROBOT" else f"forge:{message.name}@300-310/to"
        yield FaultClass(f"forged {message.name} frames", (rule,), profiles=profiles)


def _of_flash() -> Iterator[FaultClass]:
    """Power failures at each write of a memory, and during an erase."""
    for number in range(1, max(_RECORD_WRITES.values()) + 1):
        name = f"the power goes in write {number} of a memory to flash, twice in a row"
        boards = tuple(board for board, writes in _RECORD_WRITES.items() if number <= writes)
        yield FaultClass(name, event=f"flash-cut:{number}", links=boards, in_lesson=True)
    yield FaultClass("the power goes while flash is erased, twice in a row", event="erase-cut", links=BOARDS)


BUS: tuple[FaultClass, ...] = (
    FaultClass("a third of the frames is lost", ("drop:30%",)),
    FaultClass("the bus is cut for a while", ("drop@300-340",)),
    FaultClass("nothing arrives at the robot any more", ("drop@300-/to",)),
    FaultClass("nothing arrives from the robot any more", ("drop@300-/from",)),
    FaultClass("frames come twice", ("duplicate:30%",)),
    FaultClass("frames overtake each other", ("reorder:30%:2",)),
    FaultClass("frames are late", ("delay:20%:0-60ms",), harmless=_COMPARED),
    FaultClass("bits flip", ("corrupt:20%",)),
    FaultClass("three bits flip in each frame", ("corrupt:20%:3",)),
    FaultClass("frames end early", ("truncate:20%",)),
    FaultClass("others talk", ("flood:10%:20",)),
    FaultClass("a node babbles", ("babble:50%:20",)),
    FaultClass("a second robot", ("forge:DRIVE@300-302/to",)),
    FaultClass("a second simulator", ("forge:SENSES@300-310/from",)),
    *_of_forgery(),
    # A single one may pass for a repeated report. It is never obeyed.
    FaultClass("a forged power-up", ("forge:BOOT@300/from",), harmless=PACES),
    FaultClass(
        "all at once", ("drop:10%", "duplicate:5%", "reorder:5%", "delay:5%:0-60ms", "corrupt:5%", "truncate:5%")
    ),
)
"""Faults of frames in transit, on any link."""

BODY: tuple[FaultClass, ...] = (
    *(_of_body(f"the {sensor} sensor is stuck on", f"stuck-on:{sensor}") for sensor in SENSORS),
    *(_of_body(f"the {sensor} sensor is stuck off", f"stuck-off:{sensor}", least_s=30.0) for sensor in SENSORS),
    _of_body("sensors flicker", "noise:10/1000"),
    _of_body("the ring of sensors is mirrored", "mirror"),
    _of_body("motors are swapped", "swap-motors"),
    _of_body("the left motor is weak", "weak-motor:left:60%"),
    _of_body("the right motor is weak", "weak-motor:right:60%"),
    _of_body("the left motor is dead", "weak-motor:left:0%", denies=True),
    _of_body("the right motor is dead", "weak-motor:right:0%", denies=True),
    _of_body("both motors are dead", "weak-motor:left:0%", "weak-motor:right:0%", denies=True),
    *_of_odometers(),
    _of_body("the wheels follow late", "lag:60ms"),
    _of_body("the wheels follow too late", "lag:300ms", denies=True, least_s=30.0),
    _of_body("the gears have slack", "slack:3deg", least_s=20.0),
    _of_body("the wheels slip", "slip:5%"),
    _of_body("senses come a tick late", "latency:1"),
    _of_body("the walls are dark", "dark-wall"),
    _of_body("the battery is weak", "weak-battery"),
    _of_body("the beacon shows food where there is none", "false-beacon:700"),
    _of_body("the beacon shows food to eat where there is none", "false-beacon:100"),
)
"""Faults of the body, on any link."""

ROBOT: tuple[FaultClass, ...] = (
    FaultClass("the robot's process is killed", event="kill", links=_PROCESSES),
    FaultClass("the robot's process crashes", event="crash", links=_PROCESSES),
    FaultClass("the robot hangs for 0.3 s", event="hang:300", links=(*_PROCESSES, *BOARDS), harmless=_COMPARED),
    FaultClass("the robot hangs for 1.5 s", event="hang:1500", links=(*_PROCESSES, *BOARDS), harmless=_COMPARED),
    FaultClass("the robot restarts", event="reset", links=(*_LINES, *BOARDS)),
    FaultClass("the robot loses its power for a moment", event="power", links=BOARDS),
    FaultClass("the core stands still until its watchdog bites", event="watchdog", links=BOARDS),
    FaultClass("the core jumps to nowhere", event="crash", links=BOARDS),
    FaultClass("the stack has left the memory", event="stack", links=BOARDS),
    *_of_flash(),
    FaultClass("the robot's clock is 2 % fast", event="fast-clock:2", links=BOARDS, harmless=PACES),
    FaultClass("the robot's clock is 2 % slow", event="slow-clock:2", links=BOARDS, harmless=PACES),
)
"""Faults of the robot."""

LINE: tuple[FaultClass, ...] = (
    FaultClass("the controller goes bus-off", event="bus-off:400", links=BOARDS),
    FaultClass("no node acknowledges: error-passive", event="no-ack:400", links=BOARDS),
    FaultClass("a node has the wrong bit rate", event="wrong-rate:400", links=BOARDS),
    FaultClass("a node fills the bus for 0.2 s", event="babble:200", links=BOARDS, harmless=_COMPARED),
    FaultClass("the bus goes down and up", event="bus-down:500", links=("vcan",)),
    FaultClass("the adapter is unplugged and plugged in", event="unplug:500", links=("slcan",)),
    FaultClass("a hundredth of the bytes is damaged", event="noise:1", links=("slcan",)),
)
"""Faults of the line below the frames, and of the CAN controller."""

HOST: tuple[FaultClass, ...] = (
    FaultClass("the simulator is killed at any instruction", event="kill-simulator:{any}"),
    FaultClass(
        "the simulator is killed while it saves a memory", event="kill-saving:{saving}", in_lesson=True, least_s=15.0
    ),
    FaultClass("the simulator is stopped for 0.5 s", event="hold-up:500", links=_PROCESSES, harmless=_COMPARED),
    FaultClass("the disk is full", event="disk-full"),
    FaultClass("the disk fills up in the middle of the log", event="disk-full:10000"),
    FaultClass("the folder becomes read-only", event="read-only"),
    FaultClass("the folder is removed", event="folder-gone"),
    FaultClass("the log is removed while it is written", event="log-gone"),
    # The next lesson, or the end of the run, writes it again.
    FaultClass("the memory file is removed", event="memory-gone", harmless=PACES),
    FaultClass("the wall clock is set ahead by an hour", event="clock-ahead:3600", harmless=PACES),
    FaultClass("the wall clock is set back by an hour", event="clock-back:3600", harmless=PACES),
    FaultClass(
        "the wall clock is set back while the robot hangs",
        event="hang:300 clock-back:3600",
        links=_PROCESSES,
        harmless=_COMPARED,
    ),
)
"""Faults of the simulator's host."""


def _on_pins(name: str, event: str, *, denies: bool = False, harmless: tuple[str, ...] = ()) -> FaultClass:
    return FaultClass(name, event=event, links=(PINS_LINK,), paces=_COMPARED, denies=denies, harmless=harmless)


def _of_pins() -> Iterator[FaultClass]:
    for number, sensor in enumerate(SENSORS):
        yield _on_pins(f"the wire of the {sensor} sensor is broken", f"sensor-off:{number}")
    for number, side in enumerate(("left", "right")):
        yield _on_pins(f"a channel of the {side} encoder is lost", f"encoder-off:{number}", denies=True)
        yield _on_pins(f"the {side} encoder counts against its motor", f"encoder-back:{number}", denies=True)
        yield _on_pins(f"the {side} motor is stalled", f"motor-stall:{number}", denies=True)
        yield _on_pins(f"the wire of the {side} motor is off", f"motor-off:{number}", denies=True)
    yield _on_pins("the motors' plugs are swapped", "motors-swapped", denies=True)
    yield _on_pins("the bridge reports a fault", "bridge-fault", denies=True)
    yield _on_pins("the converter is stuck", "adc-stuck")
    yield _on_pins("the button's contacts bounce", "bounce:400", harmless=_COMPARED)


PINS = tuple(_of_pins())
"""Faults at the pins of a stand-alone robot."""

CLASSES = (*BUS, *BODY, *ROBOT, *LINE, *HOST, *PINS)
"""All fault classes of the campaign."""


def groups(
    profiles: Sequence[str],
    links: Sequence[str],
    paces: Sequence[str],
    limits_s: Callable[[str], float],
    classes: Sequence[FaultClass] = CLASSES,
) -> Iterator[list[Cell]]:
    """The cells of a campaign, grouped by configuration; the first of each group has no fault.

    Args:
        profiles: Behaviours.
        links: Links to the robot. Within this process, only lockstep is possible.
        paces: Some of `PACES`.
        limits_s: Robot time of each run at a pace, s.
        classes: The faults.
    """
    for profile in profiles:
        for link in links:
            for pace in paces:
                if (link, pace) != ("none", REAL_TIME):
                    base = Cell(profile, link, pace, limit_s=limits_s(pace))
                    yield [base, *(each.cell(base) for each in classes if each.applies_to(profile, link, pace))]


def recognised(cell: Cell) -> Cell:
    """Completes a cell with the properties of its fault, if that is one of the campaign's."""
    base = replace(cell, faults=(), changes=(), events=())
    known = (replace(each.cell(base), limit_s=cell.limit_s) for each in CLASSES if cell.pace in each.paces)
    return next((each for each in known if str(each) == str(cell)), cell)


def default_limit_s(pace: str) -> float:
    """Robot time of a run, s: long enough for some lessons, in real time short enough to wait for."""
    return 60.0 if pace == LOCKSTEP else 10.0
