"""`python -m host_sim.lab.bench.first_tick FOLDER [MODULE...]`: runs to its first block of ticks, in this process.

Prints the processor time since the start of the process, in ms, and which of the modules are loaded by then.
"""

import os
import runpy
import sys
import time
from typing import NoReturn

from host_sim.client.frame_log import FrameLog


def _stop_after_first_block(modules: list[str]) -> None:
    def stop(_log: FrameLog, _text: bytes) -> NoReturn:
        print(round(1000 * time.process_time()), *(name for name in modules if name in sys.modules), flush=True)
        os._exit(0)

    # This is called when the ticks of a block are done.
    FrameLog.add_block = stop  # type: ignore[method-assign, assignment]


if __name__ == "__main__":
    _stop_after_first_block(sys.argv[2:])
    sys.argv[1:] = ["run", "--bus", "none", "--environments", "1", "--quiet", "--out", sys.argv[1]]
    runpy.run_module("host_sim", run_name="__main__", alter_sys=True)
