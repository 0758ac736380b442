"""The cells of a campaign: a fault and a configuration each."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from host_sim.sim.run_config import RunConfig

_SEED = 12

BUS_FAULTS = {
    "a third of the frames is lost": ("drop:30%",),
    "the bus is cut for a while": ("drop@300-340",),
    "frames come twice": ("duplicate:30%",),
    "frames overtake each other": ("reorder:30%:2",),
    "frames are late": ("delay:20%:0-60ms",),
    "bits flip": ("corrupt:20%",),
    "frames end early": ("truncate:20%",),
    "others talk": ("flood:10%:20",),
    "a forged stop": ("forge:stop@300/to",),
    "a forged start": ("forge:start@300/to",),
    "a second robot": ("forge:DRIVE@300-302/to",),
    "a second simulator": ("forge:SENSES@300-310/from",),
    "forged memories": ("forge:20%:MEMORY/from",),
    "forged heartbeats": ("forge:20%:HEARTBEAT/from",),
    "forged drives": ("forge:20%:DRIVE/from",),
    "a forged power-up": ("forge:BOOT@300/from",),
    "all at once": ("drop:10%", "duplicate:5%", "reorder:5%", "delay:5%:0-60ms", "corrupt:5%", "truncate:5%"),
}
"""What befalls the frames, as `--fault` has it."""

BODY_FAULTS = {
    "motors are swapped": "swap-motors@2s",
    "the ring of sensors is mirrored": "mirror@2s",
    "a sensor is stuck on": "stuck-on:front@2s",
    "a sensor is stuck off": "stuck-off:front-left@2s",
    "sensors flicker": "noise:10/1000@2s",
    "a motor is weak": "weak-motor:left:60%@2s",
}
"""What befalls the body, as `--change` has it."""


@dataclass(frozen=True)
class Cell:
    """One run of a campaign.

    Attributes:
        fault: What happens, in words; empty for a run without a fault.
        config: The run.
    """

    fault: str
    config: RunConfig

    @property
    def configuration(self) -> str:
        """Everything but the fault, in words."""
        pace = "real time" if self.config.real_time else "lockstep"
        return f"{self.config.profile}, {pace}, {self.config.bus}"

    @property
    def is_of_body(self) -> bool:
        """Whether the fault befalls the body rather than the frames."""
        return bool(self.config.changes)

    def command(self) -> str:
        """A command that repeats the run."""
        config = self.config
        words = [f"tools/run --environments 1 --limit-s {config.limit_s:g} --seed {config.seed}"]
        words += [f"--profile {config.profile} --bus {config.bus}"]
        words += [f"--fault {rule}" for rule in config.faults] + [f"--change {change}" for change in config.changes]
        return " ".join(words + ["--real-time"] * config.real_time)


def cells(profiles: Sequence[str], links: Sequence[str], paces: Sequence[bool], limit_s: float) -> Iterator[Cell]:
    """The cells of a campaign, those of one configuration after the other; the first of each has no fault.

    Args:
        profiles: Behaviours.
        links: Buses, as `--bus` has them. Within this process, time counts only in lockstep.
        paces: For each pace, whether it is real time.
        limit_s: Robot time of each run, s.
    """
    for profile in profiles:
        for link in links:
            for real_time in paces:
                if real_time and link == "none":
                    continue
                base = RunConfig(_SEED, 1, limit_s=limit_s, profile=profile, bus=link, real_time=real_time)
                yield from _with_each_fault(base)


def _with_each_fault(base: RunConfig) -> Iterator[Cell]:
    yield Cell("", base)
    for name, rules in BUS_FAULTS.items():
        yield Cell(name, replace(base, faults=rules))
    for name, change in BODY_FAULTS.items():
        yield Cell(name, replace(base, changes=(change,)))
