"""Runs work in other processes, on all cores of this machine or on a cluster. Work of dead workers is repeated."""

import ctypes
import signal
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, CancelledError, Executor, ProcessPoolExecutor, wait
from contextlib import suppress
from typing import Any, NamedTuple, TypeVar

from host_sim.base.errors import OctetError, UsageError
from host_sim.base.extra_library import library

_CHUNK_MAX = 16
_CHUNKS_A_PROCESS = 8
_CLUSTER_CHUNK = 100
_CONNECT_S = 10
_CHECK_S = 1.0
_RETRIES = 3
_BREAKS_MAX = 3
_PR_SET_PDEATHSIG = 1

Item = TypeVar("Item")
Done = TypeVar("Done")


class Workers(NamedTuple):
    """The processes that do the work.

    Attributes:
        open: Creates an executor.
        chunk: Returns the number of items to hand over at once, given the total number.
        check: Raises OctetError if the workers are unreachable.
    """

    open: Callable[[], Executor]
    chunk: Callable[[int], int] = lambda _: 1
    check: Callable[[], None] = lambda: None


def processes(count: int) -> Workers:
    """Creates workers on this machine."""
    return Workers(
        open=lambda: ProcessPoolExecutor(count, initializer=_begin),
        chunk=lambda items: max(1, min(_CHUNK_MAX, items // (count * _CHUNKS_A_PROCESS))),
    )


def cluster(address: str) -> Workers:
    """The workers of a Dask cluster, by the address of its scheduler.

    Raises:
        UsageError: Dask is not installed, or the scheduler does not answer.
    """
    distributed, dask = library("distributed", "cluster"), library("dask", "cluster")
    dask.config.set({"distributed.comm.timeouts.connect": f"{_CONNECT_S}s"})
    try:
        client = distributed.Client(address, timeout=_CONNECT_S)
    except (OSError, ValueError) as error:
        raise UsageError(f"no Dask scheduler answers at {address}: {str(error).splitlines()[0]}") from None

    def check() -> None:
        if client.status in ("closing", "closed"):
            raise OctetError(f"the cluster at {address} is gone; run the same command again to resume")

    return Workers(open=lambda: _Cluster(client), chunk=lambda _: _CLUSTER_CHUNK, check=check)


class _Cluster(Executor):
    """Dask's executor, with its errors converted to those of other executors."""

    def __init__(self, client: Any) -> None:
        self._executor = client.get_executor(retries=_RETRIES, pure=False)

    def submit(self, call: Any, /, *arguments: Any, **named: Any) -> Any:
        try:
            return self._executor.submit(call, *arguments, **named)
        except Exception as error:
            raise BrokenExecutor from error

    def shutdown(self, wait: bool = True, *, cancel_futures: bool = False) -> None:
        with suppress(Exception):  # a lost cluster cannot be notified
            self._executor.shutdown(wait=wait and not cancel_futures)


def run_all(
    work: Callable[[Sequence[Item]], Done], items: Sequence[Item], workers: Workers, chunk: int = 0
) -> Iterator[Done]:
    """Runs work items, in any order.

    Args:
        work: Processes some items.
        items: The items; `str` of each describes it.
        workers: The workers.
        chunk: Number of items to hand over at once; 0 leaves it to the workers.

    Yields:
        The results of some items, as soon as they are done.

    Raises:
        OctetError: Workers die repeatedly.
    """
    size = chunk or workers.chunk(len(items))
    left = [items[i : i + size] for i in range(0, len(items), size)]
    breaks = 0
    while left:
        count = len(left)
        yield from _run_until_broken(work, left, workers)
        breaks = 0 if len(left) < count else breaks + 1
        if breaks == _BREAKS_MAX:
            raise OctetError(f"workers die each time, perhaps in the run {left[0][0]}; finished runs are kept")


def _run_until_broken(
    work: Callable[[Sequence[Item]], Done], left: list[Sequence[Item]], workers: Workers
) -> Iterator[Done]:
    """Processes the remaining items, removing them from the list, until all are done or a worker has died."""
    workers.check()
    executor = workers.open()
    try:
        futures = {executor.submit(work, items): items for items in left}
        while futures:
            workers.check()
            for future in wait(futures, _CHECK_S, FIRST_COMPLETED).done:
                done = future.result()
                left.remove(futures.pop(future))
                yield done
    except (BrokenExecutor, CancelledError):
        pass
    finally:
        executor.shutdown(cancel_futures=True)


def _begin() -> None:
    """Prepares a pool process: it ignores Ctrl-C, SIGTERM ends it silently, and it ends with its parent."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    ctypes.CDLL(None).prctl(_PR_SET_PDEATHSIG, signal.SIGKILL)
