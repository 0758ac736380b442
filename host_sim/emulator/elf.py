"""What is in the `.elf` of an image."""

from pathlib import Path

from elftools.common.exceptions import ELFError
from elftools.elf.elffile import ELFFile

from host_sim.errors import OctetError


def load_segments(path: Path) -> list[tuple[int, bytes]]:
    """What an image puts where: (address, bytes), as a probe writes it.

    Raises:
        OctetError: It is no image for an ARM core.
    """
    try:
        with path.open("rb") as file:
            elf = ELFFile(file)
            if elf["e_machine"] != "EM_ARM":
                raise OctetError(f"{path} is an image for another machine: {elf['e_machine']}")
            loaded = (segment for segment in elf.iter_segments("PT_LOAD") if segment["p_filesz"])
            return [(segment["p_paddr"], segment.data()) for segment in loaded]
    except (OSError, ELFError) as error:
        raise OctetError(f"cannot read the image {path}: {error}") from error
