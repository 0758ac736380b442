"""The parts that are proved and fuzzed: each has a harness NAME.c here, and these sources."""

from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
HERE = Path(__file__).parent
GENERATED = ROOT / "build/host-vcan/generated"
INCLUDED = (
    *(f"-I{folder}" for folder in (ROOT, GENERATED)),
    "-DOCTET_VERSION_MAJOR=1",
    "-DOCTET_VERSION_MINOR=0",
)

_CORE = sorted({*(ROOT / "firmware").rglob("*.c")} - {ROOT / "firmware/main.c"})

_CRC32 = ROOT / "hal/flash_store/crc32.c"

_STORE = [ROOT / "hal/flash_store/flash_store.c", _CRC32]

_ANY_FLASH = HERE / "any/flash.c"

ROBOT = [HERE / "any/robot.c", *_CORE]
"""The core, with a robot in any state."""


PARTS = {
    "core": ROBOT,
    "config": _CORE,
    "wire": [*sorted((ROOT / "hal/protocol").glob("*.c")), _CRC32, *_CORE, GENERATED / "octet.c"],
    "slcan": [ROOT / "hal/link/slcan.c"],
    "store": [*_STORE, _ANY_FLASH],
}

_EXCHANGE = [*PARTS["wire"], HERE / "any/command.c", ROOT / "hal/library/exchange.c"]

_PROGRAM = [
    source
    for source in sorted((ROOT / "host_sim/program/native").glob("*.c"))
    if source.name not in {"brain.c", "programmed.c", "program_main.c", "trace.c"}
]

FUZZED = {
    **PARTS,
    "program": [*_PROGRAM, *_CORE, ROOT / "host_sim/world/native/trig.c"],
    "flash": _STORE,
    "commands": _EXCHANGE,
    "session": _EXCHANGE,
}
"""What holds from one input to the next is too much for the analyser: that is fuzzed only."""
