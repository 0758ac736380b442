"""Images that `tools/flash` builds."""

import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
from tools.flashing import FlashError
from tools.flashing.images import all_boards, build, identify, node_max


def test_an_image_is_built_for_a_node_and_a_bit_rate() -> None:
    board = all_boards()["blue_pill"]

    image = identify(build(board, "bxcan", node_max(), 125_000), board)

    assert (image.node, image.bitrate) == (str(node_max()), "125000")


def test_a_node_that_the_protocol_does_not_have_is_refused() -> None:
    with pytest.raises(FlashError, match="cmake --build"):
        build(all_boards()["feather_stm32f405"], "bxcan", node_max() + 1, 500_000)
