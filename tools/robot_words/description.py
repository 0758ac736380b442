"""The robot's description in `octet.dbc` and `robot.toml`, as input of the generators."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from cantools.database.can import Message


class DescriptionError(ValueError):
    """The two files are inconsistent, or exceed what the robot can hold."""


@dataclass(frozen=True)
class Parameter:
    """A setting of the robot; see `Description.parameters`."""

    name: str
    number: int
    minimum: int
    maximum: int
    default: int
    unit: str
    comment: str


@dataclass(frozen=True)
class Member:
    """A signal of SENSES or DRIVE, as a member of `struct senses` or `struct drive`.

    Attributes:
        name: Name of the member: the signal's name and unit.
        signal: The signal's name.
        is_flag: Whether it is a bit.
        meaning: What it means, with range and unit.
    """

    name: str
    signal: str
    is_flag: bool
    meaning: str


@dataclass(frozen=True)
class Description:
    """The robot's numbers and words.

    Attributes:
        messages: As cantools reads them, by rising identifier.
        enums: Enumerations that firmware and simulator share: the words of each, with their numbers.
        avoiding: The reasons of a robot with something in its way, with their numbers.
        meanings: The meanings of some words, by enumeration.
        parameters: By rising number, from 0 without a gap.
        body_parameters: Parameters of a body on pins, numbered after the robot's.
        profiles: Names by number, from 0 without a gap; the last one, `own`, is for a user's behaviour.
        memory: The kind of memory of each profile, from the enum `memory_kind`.
        patterns: Names by number.
        feel: Names of the proximity sensors, from bit 0 on.
        edits: Kinds of changes to a world, each with the names of its fields.
        senses: The message of a body to its robot at each tick.
        drive: The robot's answer.
        row: Names of the numbers recorded at each tick: senses, drive, and additions of the recorder.
        columns: The numbers of a row that views show, with their indexes.
        sentences: What the robot says, by reason or other name.
        kit_settings: Parameters that a robot with a body of the kit is set to, unless a run says otherwise.
        body_sentences: Texts about faults of a body, by the name of the fault.
        numbers: Numbers by name: those of robot.toml; `cell_count`, the number of bytes of a memory; `tick_span`,
            `action_span` and `odometer_span`, the number of values after which these wrap; and
            `odometer_counts_per_mm`.
        layout_hash: Hash of the messages' layout.
        same_layout: Other hashes that stood for the same layout.
    """

    messages: Sequence[Message]
    enums: Mapping[str, Mapping[str, int]]
    avoiding: Mapping[str, int]
    meanings: Mapping[str, Mapping[str, str]]
    parameters: Sequence[Parameter]
    body_parameters: Sequence[Parameter]
    profiles: Sequence[str]
    memory: Mapping[str, str]
    patterns: Sequence[str]
    feel: Sequence[str]
    edits: Mapping[str, Sequence[str]]
    senses: Sequence[Member]
    drive: Sequence[Member]
    row: Sequence[str]
    columns: Mapping[str, int]
    sentences: Mapping[str, str]
    kit_settings: Mapping[str, int]
    body_sentences: Mapping[str, str]
    numbers: Mapping[str, int]
    layout_hash: int
    same_layout: Sequence[int]
