"""ISO-TP over a link, for udsoncan, without threads: the time of an emulated board passes as it is waited for."""

import logging
import time
from collections.abc import Callable

from host_sim.base.errors import OctetError
from host_sim.base.frame import Frame
from host_sim.protocol.generated import UPDATE_ANSWER_ID, UPDATE_REQUEST_ID
from host_sim.transport.link import Link

try:
    import isotp
    from udsoncan.connections import BaseConnection
    from udsoncan.exceptions import TimeoutException
except ImportError as error:
    raise OctetError("udsoncan or can-isotp is not installed: run tools/setup images") from error

_SLICE_S = 0.002
_OTHERS_S = 0.05
_PADDING = [0xCC] * 6
_PARAMS = {"tx_padding": 0xCC, "stmin": 0, "blocksize": 0}


class IsoTpConnection(BaseConnection):
    """A connection to the boot loader of one node, or to an image that one started.

    Attributes:
        now: The time by which it waits, s: that of an emulated board, or this computer's.
    """

    def __init__(self, link: Link, node: int) -> None:
        """Creates a connection to a node over an open link, which the caller closes."""
        super().__init__(f"node {node}")
        self.logger.setLevel(logging.CRITICAL)  # failures are reported by the caller
        logging.getLogger(isotp.TransportLayerLogic.LOGGER_NAME).setLevel(logging.CRITICAL)
        self._link = link
        self.now: Callable[[], float] = getattr(link, "now", time.monotonic)
        self._request_id, self._answer_id = UPDATE_REQUEST_ID + node, UPDATE_ANSWER_ID + node
        address = isotp.Address(isotp.AddressingMode.Normal_11bits, txid=self._request_id, rxid=self._answer_id)
        self._layer = isotp.TransportLayerLogic(self._receive, self._send, address, lambda _error: None, _PARAMS)

    def open(self) -> "IsoTpConnection":
        """As in udsoncan."""
        return self

    def close(self) -> None:
        """As in udsoncan."""

    def is_open(self) -> bool:
        """As in udsoncan."""
        return True

    def empty_rxqueue(self) -> None:
        """As in udsoncan: discards answers to earlier requests."""
        self._layer.process(0.0)
        self._layer.clear_rx_queue()
        self._layer.stop_receiving()

    def specific_send(self, payload: bytes, timeout: float | None = None) -> None:  # noqa: ARG002 - udsoncan's
        """As in udsoncan; aborts a message in progress."""
        self._layer.stop_sending()
        self._layer.clear_tx_queue()
        self._layer.send(payload)

    def specific_wait_frame(self, timeout: float | None = None) -> bytes | None:
        """As in udsoncan."""
        deadline = self.now() + (timeout or 0.0)
        while True:
            self._layer.process(_SLICE_S)
            answer = self._layer.recv()
            if answer is not None:
                return bytes(answer)
            if self.now() > deadline:
                raise TimeoutException(f"no answer within {timeout} s")  # type: ignore[no-untyped-call]

    def answers(self, service: int, timeout_s: float) -> int:
        """Number of boards that answer to a service that none has: each refuses it by the service's number."""
        self.empty_rxqueue()
        self._link.send(Frame(self._request_id, bytes([1, service, *_PADDING])))
        count = 0
        deadline = self.now() + timeout_s
        while self.now() < deadline:
            frame = self._link.receive(_SLICE_S)
            if frame is not None and frame.id == self._answer_id and frame.data[1:3] == bytes([0x7F, service]):
                count += 1
                deadline = min(deadline, self.now() + _OTHERS_S)
        return count

    def _send(self, message: "isotp.CanMessage") -> None:
        self._link.send(Frame(message.arbitration_id, bytes(message.data)))

    def _receive(self, timeout_s: float) -> "isotp.CanMessage | None":
        frame = None if self._layer.available() else self._link.receive(timeout_s)  # the message is complete
        if frame is None or frame.id != self._answer_id:
            return None
        return isotp.CanMessage(arbitration_id=frame.id, data=frame.data)
