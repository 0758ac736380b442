"""A robot behind a serial line on which many of the bytes are damaged, in real time or in lockstep.

`.venv/bin/python -m tests.runs.endurance.noise 600` prints the figures of 600 s of robot time with 5 % of the bytes
damaged; with `--lockstep`, how many times as fast as real time it was. The exit code is 1 if the run did not go on to
its end, or something wrong was learned. A sample is among the tests.
"""

import argparse
import sys
from contextlib import closing
from pathlib import Path
from tempfile import TemporaryDirectory

from host_sim.transport.cable import Cable
from tests.runs.support import Run, is_right, octet_process, robot_at

CHANCE = 0.05
TICKS_PER_S = 50


def run_through_noise(out: Path, limit_s: float, chance: float = CHANCE, *, lockstep: bool = False) -> Run:
    """A run in one environment, which ends early only if all the food is eaten."""
    with closing(Cable()) as cable, robot_at(f"slcan:{cable.ends[0]}"):
        cable.noise = chance
        words = ["--environments", "1", "--limit-s", f"{limit_s:g}", "--memory", out / "robot.mem"]
        words += [] if lockstep else ["--real-time"]
        bus = ("--bus", f"slcan:{cable.ends[1]}", "--robot", "external")
        out.mkdir()
        done = octet_process("run", "--out", out, *words, *bus)
    return Run(done.returncode, done.stdout, done.stderr, out)


def is_whole(run: Run, limit_s: float) -> bool:
    """Whether the run went on to its end, its counters say what the line was like, and its memory is right."""
    if not (run.out / "summary.json").exists():
        return False
    (environment,), (robot,) = run.summary["environments"], run.summary["robots"]
    ended = environment["finished"] or environment["ticks"] == round(limit_s * TICKS_PER_S)
    frames, damaged = robot["frames"], robot["faults"]["damaged"]
    counted = frames["lost"] + frames["repeated"] > 0 and frames["refused"] > 0 and damaged > 0
    saved = (run.out / f"robot.mem{'.doubtful' * (run.code == 1)}").read_bytes() == bytes(run.memory)
    return ended and counted and saved and is_right(run.memory)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("seconds", type=float)
    parser.add_argument("--lockstep", action="store_true")
    arguments = parser.parse_args()
    limit_s = arguments.seconds
    with TemporaryDirectory() as folder:
        run = run_through_noise(Path(folder) / "out", limit_s, lockstep=arguments.lockstep)
        sys.stdout.write(run.output + run.errors)
        good = is_whole(run, limit_s)
    sys.stdout.write(f"noise     {CHANCE:.0%} of the bytes for {limit_s:g} s: {'went on' if good else 'FAILED'}\n")
    return int(not good)


if __name__ == "__main__":
    sys.exit(main())
