"""Two emulated boards on one emulated bus: a body on pins, and the brain that drives it."""

from host_sim.base.paths import image_path
from host_sim.emulator.board import EmulatedBoard, start_board
from host_sim.emulator.can import CanFrame
from host_sim.emulator.chips import CHIPS
from host_sim.emulator.robot_on_pins import RobotOnPins
from host_sim.protocol.codec import Protocol
from host_sim.protocol.generated import Reason
from host_sim.transport.link import Frame
from host_sim.world.arena import Arena
from host_sim.world.body_kinds import body_kind
from host_sim.world.geometry import SimParams
from host_sim.world.layouts import generate

_SLICE_S = 0.0005
"""Maximum delay of a frame to the other board: twice its time on the wire."""


def kit_arena() -> Arena:
    """A world to be driven in by a body of the kit."""
    kind = body_kind("kit")
    params = kind.reach(SimParams())
    made = Arena(generate(2, 1, params), params, kind=kind)
    made.begin(2)
    return made


class TwoBoards:
    """The two boards, from power-up.

    Attributes:
        brain: The board with the image of a robot on a CAN bus.
        body: The board with the image of a body.
        robot: The parts wired to the body's pins.
        heard: All frames on the bus, each with its time, s.
        cut: Whether the wire between the boards is cut.
    """

    def __init__(self, brain: str = "feather_stm32f405", body: str = "blue_pill") -> None:
        """Flashes both boards.

        Raises:
            OctetError: An image is not built.
            BoardError: An image did something that the hardware does not allow.
        """
        self.brain = start_board(brain)
        self.body = EmulatedBoard(CHIPS[body], image_path(body, "body"))
        assert self.body.hardware.robot is not None  # only such chips have this image
        self.robot: RobotOnPins = self.body.hardware.robot
        self.heard: list[tuple[float, Frame]] = []
        self.cut = False
        self._protocol = Protocol()
        self._now_s, self._tick, self._eats = 0.0, 0, False

    def pass_time(self, span_s: float) -> None:
        """Lets time pass on both boards."""
        for _ in range(round(span_s / _SLICE_S)):
            self._now_s += _SLICE_S
            for sender, other in ((self.body, self.brain), (self.brain, self.body)):
                for frame in sender.pass_time(_SLICE_S):
                    self.heard.append((self._now_s, frame))
                    self._eats = self._eats or self._is_meal(frame)
                    if not self.cut:
                        other.put(CanFrame(frame.id, frame.data))

    def live(self, arena: Arena, ticks: int) -> None:
        """Lets the body move in an arena."""
        body = arena.body
        for _ in range(ticks):
            self._eats = False
            self.robot.feel(body, body.sense(self._tick), self._tick)
            self.pass_time(arena.params.tick_s)
            if self._eats:
                body.eat()
            body.move(0.0, 0.0)
            self._tick += 1

    def press(self, span_s: float = 0.2) -> None:
        """Presses and releases the body's button."""
        for pressed in (True, False):
            self.robot.set_button(pressed)
            self.pass_time(span_s)

    def _is_meal(self, frame: Frame) -> bool:
        decoded = self._protocol.decode_drive(frame) if frame.id == self._protocol.id_of("DRIVE") else None
        return decoded is not None and decoded.reason == Reason.EAT
