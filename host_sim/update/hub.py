"""One link for the updates of several nodes at once."""

from collections.abc import Callable, Mapping
from concurrent.futures import Future, ThreadPoolExecutor
from queue import Empty, SimpleQueue

from host_sim.base.errors import LinkDownError
from host_sim.base.frame import Frame
from host_sim.protocol.generated import UPDATE_ANSWER_ID
from host_sim.transport.link import Link

_SLICE_S = 0.0005


class Share:
    """One node's share of the link, as a `Link` that sends through an outbox. Another thread may use it."""

    def __init__(self, outbox: "SimpleQueue[Frame]") -> None:
        self.inbox: SimpleQueue[Frame] = SimpleQueue()
        self.ended = False
        self._outbox = outbox

    def send(self, frame: Frame) -> None:
        """As in `Link`."""
        self._outbox.put(frame)

    def receive(self, timeout_s: float) -> Frame | None:
        """As in `Link`."""
        if self.ended:
            raise LinkDownError("the update was interrupted; run the same command again to resume")
        try:
            return self.inbox.get(timeout=timeout_s) if timeout_s > 0 else self.inbox.get_nowait()
        except Empty:
            return None

    def close(self) -> None:
        """As in `Link`: the hub's owner closes it."""


class Hub:
    """Passes frames between a link and updates, each in a thread; the caller alone uses the link, and closes it."""

    def __init__(self, link: Link) -> None:
        self._link = link
        self._outbox: SimpleQueue[Frame] = SimpleQueue()
        self._shares: dict[int, Share] = {}

    def share(self, node: int) -> Share:
        """The link for the update of that node."""
        return self._shares.setdefault(UPDATE_ANSWER_ID + node, Share(self._outbox))

    def run(self, jobs: Mapping[int, Callable[[], None]]) -> dict[int, BaseException | None]:
        """Runs the jobs concurrently.

        Returns:
            The exception raised by each job; None if it succeeded.

        Raises:
            LinkDownError: The link is down.
        """
        with ThreadPoolExecutor(len(jobs)) as pool:
            futures: dict[int, Future[None]] = {name: pool.submit(job) for name, job in jobs.items()}
            try:
                while not all(future.done() for future in futures.values()):
                    self._carry()
            finally:
                for share in self._shares.values():
                    share.ended = True
        return {name: future.exception() for name, future in futures.items()}

    def _carry(self) -> None:
        while not self._outbox.empty():
            self._link.send(self._outbox.get())
        frame = self._link.receive(_SLICE_S)
        if frame is not None and frame.id in self._shares:
            self._shares[frame.id].inbox.put(frame)
