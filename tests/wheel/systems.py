"""`python -m tests.wheel.systems`: runs of each wheel, held to those of this checkout by their `log_sha256`.

    tools/wheels && .venv/bin/python -m tests.wheel.systems

A wheel that no Python here can run is inspected, and named so. The page's WebAssembly runs in Node.
"""

import argparse
import os
import re
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path
from tempfile import TemporaryDirectory
from zipfile import ZipFile

import lief

from host_sim.client.frame_log import digest_of
from tests.web.sim.page_runs import experiment, run_in_page
from tools.wheelhouse.pythons import OTHERS, ROOT, install, run_python

HERE = "manylinux_2_26_x86_64"
"""The system of these tests."""

LIMIT_S = 20
PROGRAM = f"""
import sys
from host_sim.cli.main import main
for seed in sys.argv[1:]:
    main(["run", "--bus", "none", "--environments", "2", "--limit-s", "{LIMIT_S}", "--json", "--seed", seed])
"""
_DIGEST = re.compile(r'"log_sha256": "(\w+)"')


def of_process(seeds: Sequence[str], command: Sequence[str | Path], site: Path, cwd: Path) -> list[str]:
    """The digests of the runs of a Python of this system, with the packages of a folder."""
    variables = {**os.environ, "PYTHONPATH": str(site)}
    words = [*command, "-c", PROGRAM, *seeds]
    return _DIGEST.findall(subprocess.check_output(words, cwd=cwd, env=variables, text=True))


def of_wheel(name: str, wheel: Path, seeds: Sequence[str], cwd: Path) -> list[str]:
    """The digests of the runs of a wheel, on its system."""
    if name == HERE:
        with ZipFile(wheel) as files:
            files.extractall(cwd / "site")
        return of_process(seeds, [sys.executable], cwd / "site", cwd)
    install(name, wheel)
    done = run_python(name, "-c", PROGRAM, *seeds, cwd=cwd)
    found = _DIGEST.findall(done.stdout)
    assert len(found) == len(seeds), done.stderr[-2000:]
    return found


def of_page(seeds: Sequence[str], cwd: Path) -> list[str]:
    """The digests of the runs of the page's WebAssembly."""
    wanted = [experiment("article", int(seed), limit_ticks=LIMIT_S * 50) for seed in seeds]
    return [digest_of(run["log"].encode("latin1")) for run in run_in_page(cwd, *wanted)]


def inspected(wheel: Path) -> str:
    """What the world's library in a wheel says of itself."""
    lief.logging.disable()
    with ZipFile(wheel) as files:
        (name,) = (it for it in files.namelist() if it.endswith("liboctet_world.so"))
        library = lief.parse(list(files.read(name)))
    if isinstance(library, lief.MachO.Binary):
        wants = ", ".join(it.name for it in library.libraries if it.command.name == "LOAD_DYLIB")
        return f"Mach-O {library.header.cpu_type.name}, wants {wants}"
    assert isinstance(library, lief.ELF.Binary)
    return f"ELF {library.header.machine_type.name}, wants {', '.join(map(str, library.libraries))}"


def rows(wheels: Path, seeds: Sequence[str]) -> list[str]:
    """The lines of the table: for each system, how many runs have the digests of this checkout."""
    lines = []
    with TemporaryDirectory() as temporary:
        here = of_process(seeds, [sys.executable], ROOT, Path(temporary))

        def tell(name: str, digests: Sequence[str]) -> None:
            equal = sum(one == other for one, other in zip(here, digests, strict=True))
            lines.append(f"{name:24}  {equal} of {len(seeds)} equal")

        for wheel in sorted(wheels.glob("octet-*.whl")):
            name = wheel.stem.rpartition("-")[2]
            folder = Path(temporary, name)
            folder.mkdir()
            if name in OTHERS or name == HERE:
                tell(name, of_wheel(name, wheel, seeds, folder))
            else:
                lines.append(f"{name:24}  built, not run: {inspected(wheel)}")
        tell("wasm", of_page(seeds, Path(temporary)))
    return lines


def main() -> int:
    """Returns 0 if all that could be run is equal, else 1."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seeds", type=int, default=20, metavar="N", help="seeds 1 to N (default: %(default)s)")
    parser.add_argument("--wheels", type=Path, default=ROOT / "build/wheelhouse", metavar="DIR", help="the wheels")
    options = parser.parse_args()
    seeds = [str(seed) for seed in range(1, options.seeds + 1)]
    lines = rows(options.wheels, seeds)
    sys.stdout.writelines(f"{line}\n" for line in lines)
    ran = [line for line in lines if "not run" not in line]
    return int(not all(f" {options.seeds} of " in line for line in ran))


if __name__ == "__main__":
    sys.exit(main())
