"""The mutants of a C text."""

import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT))

from tools.verify.mutants.schemata import mutants_of, schemata  # noqa: E402 - found by the line above
from tools.verify.mutants.sites import sites_of  # noqa: E402
from tools.verify.mutants.syntax import functions  # noqa: E402

STANDARD = ["-std=c99"]
TEXT = "int f(int x);\nint f(int x)\n{\n    return x < 3;\n}\n"


def mutants(folder: Path, text: str, first: int = 1):
    """The mutants of a text, numbered from `first`, and the text with all of them in it."""
    path = folder / "a.c"
    path.write_text(text)
    sites = sites_of(text, functions(path, STANDARD))
    return mutants_of("firmware/a.c", text, sites, first), schemata(text, sites, first)
