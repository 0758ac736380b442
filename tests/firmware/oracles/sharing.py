"""What robots learn from each other, in Python: the oracle of SHARE."""

from collections.abc import Sequence

from host_sim.protocol.generated import MEMORY_KINDS, MemoryKind

LEFT, RIGHT = 1, 2
_CONFIDENT = (5, 6, 9, 10, 13, 14)
_NOT_LEARNING = ("fixed", "never")


def side_of(cell: int) -> int:
    """The turn that a cell votes for, with confidence or without; 0 for none."""
    if cell in (LEFT, RIGHT):
        return cell
    return cell % 4 if cell in _CONFIDENT else 0


def taught(profile: str, memory: Sequence[int], unlearned: int, others: Sequence[Sequence[int]]) -> list[int]:
    """A robot's memory after a second in which it has heard those of some others.

    Args:
        profile: Its profile.
        memory: Its eight bytes before.
        unlearned: Bit p for each cell p that its boredom has emptied.
        others: The others' eight cells each, of whatever kind.
    """
    kind = MEMORY_KINDS[profile]
    if profile in _NOT_LEARNING or kind == MemoryKind.ALL_SENSORS:
        return list(memory)
    confidence = 4 if kind == MemoryKind.CONFIDENCE else 0
    after = list(memory)
    for pattern in range(1, 8):
        votes = [side_of(other[pattern]) for other in others]
        if memory[pattern] == 0 and not unlearned >> pattern & 1 and votes.count(LEFT) != votes.count(RIGHT):
            after[pattern] = confidence + (LEFT if votes.count(LEFT) > votes.count(RIGHT) else RIGHT)
    return after
