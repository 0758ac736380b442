"""What `octet.dbc` and `robot.toml` say together, as the generators take it."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from cantools.database.can import Message


class DescriptionError(ValueError):
    """The two files do not fit together, or ask for what the robot cannot hold."""


@dataclass(frozen=True)
class Parameter:
    """A number that the robot is set up with; see `Description.parameters`."""

    name: str
    number: int
    minimum: int
    maximum: int
    default: int
    unit: str
    comment: str


@dataclass(frozen=True)
class Member:
    """What SENSES or DRIVE says, as a member of `struct senses` or `struct drive`.

    Attributes:
        name: The member's name: the signal's with its unit.
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
        enums: The words that firmware and simulator share, each with its number, by what they are of.
        meanings: What a word means, for some.
        parameters: By rising number, from 0 without a gap.
        body_parameters: Those that a body on pins keeps, behind them.
        profiles: Names by number, from 0 without a gap.
        memory: For each profile, what its eight bytes are: one of the enum `memory_kind`.
        patterns: Names by number.
        feel: Names of the proximity sensors, from bit 0 on.
        edits: What is changed in a world, each with the names of its fields.
        senses: What a body tells its robot at each tick.
        drive: What the robot answers.
        row: The names of the numbers that are recorded of each tick: senses, drive, and what recorders add.
        columns: What views show of a row: each with its place there.
        sentences: What the robot says, by reasons and other names.
        kit_settings: Parameters that a robot with a body of the kit is set to, unless a run says otherwise.
        plant: Radius and growth of a plant, mm.
        body_sentences: What has happened to a body, by the names of faults.
        cell_count: Number of bytes of a memory.
        node_max: The last node.
        range_none: A distance where nothing is within reach.
        answer_wants_ranges: The bit of an answer by which a robot asks for distances.
        tick_span: Ticks are numbered below it, and wrap.
        action_span: Actions likewise.
        odometer_span: Odometers count below it, and wrap.
        odometer_counts_per_mm: How finely they count.
        layout_hash: Hash of the messages' layout.
        same_layout: Other hashes that stood for the same layout.
    """

    messages: Sequence[Message]
    enums: Mapping[str, Mapping[str, int]]
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
    plant: Mapping[str, int]
    body_sentences: Mapping[str, str]
    cell_count: int
    node_max: int
    range_none: int
    answer_wants_ranges: int
    tick_span: int
    action_span: int
    odometer_span: int
    odometer_counts_per_mm: int
    layout_hash: int
    same_layout: Sequence[int]
