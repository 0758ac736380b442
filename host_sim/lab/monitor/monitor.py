"""Watches a bus until told to stop: shows a table on a terminal, else one line per frame."""

import time
from collections.abc import Callable
from functools import cache
from typing import TextIO

import can
from can.typechecking import CanFilter

from host_sim.base.screen import full_screen
from host_sim.lab.monitor.bus_watch import BusWatch
from host_sim.lab.monitor.kernel_queue import dropped
from host_sim.lab.monitor.table import lines_of
from host_sim.protocol.codec import NODE_MAX, Frame, Protocol
from host_sim.protocol.every_node import Heard
from host_sim.protocol.generated import MESSAGES
from host_sim.transport.buses import receive

_WAIT_S = 0.1
_DRAW_S = 0.25
_CHECK_S = 1.0
_LAST_S = 2.0
"""Processor time for the frames that still wait at the end, s; a full bus would never run dry."""


def filter_robots(bus: can.BusABC) -> None:
    """Filters for the identifiers of robots, in the kernel if possible, else in python-can."""
    bands = sorted({Protocol(NODE_MAX).id_of(name) & ~NODE_MAX for name in MESSAGES})
    bus.set_filters([CanFilter(can_id=band, can_mask=0x7FF & ~NODE_MAX, extended=False) for band in bands])


def watch_lines(bus: can.BusABC, watch: BusWatch, out: TextIO, goes_on: Callable[[], bool]) -> None:
    """Writes each frame as a line, and each new problem as a line that begins with !.

    Args:
        bus: The bus.
        watch: Keeps the state of the bus.
        out: Receives the lines, which are flushed whenever the bus is idle.
        goes_on: Called repeatedly. Once it returns false, the frames received until then are still written.

    Raises:
        OctetError: The bus was closed or failed.
    """
    known: set[str] = set()
    start_s = checked_s = time.monotonic()
    while goes_on():
        message = receive(bus, 0.0)
        if message is None:
            out.flush()
            message = receive(bus, _WAIT_S)
        if message is not None:
            _write(message, watch, out, start_s)
        if time.monotonic() - checked_s >= _CHECK_S:
            checked_s = time.monotonic()
            known = _tell_news(bus, watch, out, start_s, known)
    last_s = time.process_time() + _LAST_S
    while time.process_time() < last_s and (message := receive(bus, 0.0)) is not None:
        _write(message, watch, out, start_s)
    _tell_news(bus, watch, out, start_s, known)
    out.flush()


def watch_table(bus: can.BusABC, watch: BusWatch, name: str, out: TextIO, goes_on: Callable[[], bool]) -> None:
    """Draws the state of the bus repeatedly. `name` names the bus; other arguments and errors as in `watch_lines`."""
    start_s = time.monotonic()
    drawn_s = -_DRAW_S
    with full_screen(out) as draw:
        while goes_on():
            message = receive(bus, _WAIT_S)
            now_s = time.monotonic() - start_s
            if message is not None:
                watch.accept(message, now_s)
            if now_s - drawn_s >= _DRAW_S:
                drawn_s = now_s
                watch.dropped = dropped(bus)
                draw(lines_of(watch, name, now_s))


def _write(message: can.Message, watch: BusWatch, out: TextIO, start_s: float) -> None:
    out.write(f"{_line(message, watch.accept(message, time.monotonic() - start_s))}\n")


def _tell_news(bus: can.BusABC, watch: BusWatch, out: TextIO, start_s: float, known: set[str]) -> set[str]:
    """Writes the new problems; returns all current ones."""
    watch.dropped = dropped(bus)
    wrong = watch.wrong(time.monotonic() - start_s)
    out.writelines(f"! {what}\n" for what in wrong if what not in known)
    return set(wrong)


def _line(message: can.Message, heard: Heard | None) -> str:
    stamp = f"{message.timestamp:.6f}"
    data = bytes(message.data).hex().upper()
    if message.is_error_frame:
        return f"{stamp}   -  error frame {data}"
    if heard is None:
        width = 8 if message.is_extended_id else 3
        kind = "R" if message.is_remote_frame else data
        return f"{stamp}   -  {message.arbitration_id:0{width}X}#{kind}"
    frame = Frame(message.arbitration_id, bytes(message.data))
    if heard.signals is None:
        return f"{stamp}  {heard.node:2}  {heard.name} damaged: {frame.id:03X}#{data}"
    return f"{stamp}  {heard.node:2}  {_protocol(heard.node).describe(frame)}"


@cache
def _protocol(node: int) -> Protocol:
    return Protocol(node)
