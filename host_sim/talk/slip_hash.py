"""The hash function of SLIP, with which ELIZA of 1966 chose how to remember a sentence."""

_CHARACTERS = 6
_BITS = 36
_ROWS = (
    (0o00, "0123456789"),
    (0o13, "='"),
    (0o20, "+ABCDEFGHI"),
    (0o33, ".)"),
    (0o40, "-JKLMNOPQR"),
    (0o53, "$*"),
    (0o60, " /STUVWXYZ"),
    (0o73, ",("),
)
_CODES = {character: first + i for first, row in _ROWS for i, character in enumerate(row)}


def slip_hash(word: str, bits: int) -> int:
    """The hash of a word, from its last machine word of six characters on an IBM 7094.

    Args:
        word: The word; a character that the machine did not have is taken by its low six bits.
        bits: Number of bits of the result, 0..15.

    >>> slip_hash("ALWAYS", 7), slip_hash("HERE", 2)
    (14, 3)
    """
    last = word[(len(word) - 1) // _CHARACTERS * _CHARACTERS :]
    cell = 0
    for character in last.ljust(_CHARACTERS):
        cell = cell << _CHARACTERS | _CODES.get(character, ord(character) & 0o77)
    cell &= (1 << _BITS - 1) - 1
    return cell * cell >> _BITS - 1 - bits // 2 & (1 << bits) - 1
