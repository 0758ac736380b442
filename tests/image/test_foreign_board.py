"""A board outside the tree."""

import re
import subprocess
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
LINES = re.compile(r"^(cmake .*)$", re.MULTILINE)


def test_a_board_in_a_folder_of_ones_own_is_built(tmp_path):
    boards, made = tmp_path / "my boards", tmp_path / "made"
    boards.mkdir()
    text = (ROOT / "hal/stm32/boards/blue_pill.cmake").read_text()
    (boards / "mine.cmake").write_text(text.replace("OCTET_LED PC13", "OCTET_LED PC14"))
    page = (ROOT / "docs/porting.md").read_text()
    (configure,) = (line for line in LINES.findall(page) if "OCTET_BOARD_DIR" in line)
    words = configure.replace("build/mine", str(made)).split()
    words = [word.replace("my_boards", str(boards)) for word in words]

    subprocess.run(words, cwd=ROOT, check=True, capture_output=True)
    subprocess.run(["cmake", "--build", made, "--target", "octet-mine-slcan"], check=True, capture_output=True)

    assert "BOARD_LED = 0x2E" in (made / "generated/mine/board_pins.h").read_text()
    assert b"board=mine chip=stm32f103" in (made / "octet-mine-slcan.bin").read_bytes()
