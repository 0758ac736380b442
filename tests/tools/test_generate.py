"""tools/generate: the hash depends on the messages' layout only, and inconsistent files are refused."""

import re
import subprocess
import sys
from pathlib import Path

import cantools
import pytest

from host_sim.protocol import generated
from tools.robot_words import to_python, to_types, to_typescript
from tools.robot_words.description import DescriptionError
from tools.robot_words.model import layout_hash, read

ROOT = Path(__file__).resolve().parents[2]
DBC = ROOT / "hal/protocol/octet.dbc"
WORDS = ROOT / "hal/protocol/robot.toml"
TEXT = DBC.read_text()


def hash_of(text: str | bytes, folder: Path) -> int:
    """The hash of a DBC file with this text."""
    path = folder / "changed.dbc"
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    return layout_hash(cantools.database.load_file(path))


def changed(old: str, new: str, text: str = TEXT) -> str:
    assert old in text, old
    return text.replace(old, new)


def dumped(folder: Path) -> str:
    """As the library writes it."""
    del folder
    return cantools.database.load_file(DBC).as_dbc_string()


def converted(folder: Path) -> bytes:
    """As the command line writes it."""
    path = folder / "converted.dbc"
    subprocess.run([Path(sys.executable).parent / "cantools", "convert", DBC, path], check=True)
    return path.read_bytes()


def with_messages_turned_round(folder: Path) -> str:
    """The same messages, the last one first."""
    del folder
    messages = re.findall(r"^BO_ .*?\n\n", TEXT, re.MULTILINE | re.DOTALL)
    return changed("".join(messages), "".join(reversed(messages)))


NEW_PARAMETER = 'EV_ patience_s: 0 [0|9] "s" 1 99 DUMMY_NODE_VECTOR0 Vector__XXX;'

SAME = {
    "a mended comment": lambda _: changed('CM_ SG_ 65 reason "', 'CM_ SG_ 65 reason "In short: '),
    "a new profile": lambda _: changed('2 "never"', '2 "never" 99 "lazy"'),
    "another name of a choice": lambda _: changed('3 "look_around"', '3 "glance"'),
    "another unit": lambda _: changed('"mm/s"', '"km/h"'),
    "another range": lambda _: changed("[0|31]", "[0|30]"),
    "a new parameter": lambda _: changed("\nEV_ turn_deg:", f"\n{NEW_PARAMETER}\nEV_ turn_deg:"),
    "line ends of Windows": lambda _: TEXT.replace("\n", "\r\n").encode(),
    "another order of messages": with_messages_turned_round,
    "saved by another tool": dumped,
    "converted by another tool": converted,
}
OTHER = {
    "a moved signal": (
        'SG_ tick : 12|8@1+ (1,0) [0|255] "tick" SIM\n SG_ reason : 20|4@1+',
        'SG_ tick : 16|8@1+ (1,0) [0|255] "tick" SIM\n SG_ reason : 12|4@1+',
    ),
    "a resized signal": ("SG_ feel : 20|5@1+", "SG_ feel : 20|4@1+"),
    "another sign": ("SG_ left : 24|12@1-", "SG_ left : 24|12@1+"),
    "another byte order": ("SG_ result : 16|8@1+", "SG_ result : 23|8@0+"),
    "another name of a signal": ("SG_ beacon :", "SG_ distance :"),
    "another multiplexer value": ("SG_ freeze m7", "SG_ freeze m6"),
    "another identifier": ("BO_ 1953 CRASH: 8", "BO_ 1889 CRASH: 8"),
    "another length": ("BO_ 1665 MEMORY: 6", "BO_ 1665 MEMORY: 7"),
    "a signal more": (
        "BO_ 1953 CRASH: 8 ROBOT\n",
        'BO_ 1953 CRASH: 8 ROBOT\n SG_ spare : 24|4@1+ (1,0) [0|15] "" SIM\n',
    ),
    "a signal less": (' SG_ action : 57|7@1+ (1,0) [0|127] "" SIM\n', ""),
}


@pytest.mark.parametrize("change", SAME.values(), ids=SAME)
def test_change_that_moves_no_bit_keeps_the_hash(change, tmp_path):
    assert hash_of(change(tmp_path), tmp_path) == generated.LAYOUT_HASH


@pytest.mark.parametrize(("old", "new"), OTHER.values(), ids=OTHER)
def test_change_that_moves_a_bit_changes_the_hash(old, new, tmp_path):
    # A file with a comment or value table of a removed signal could not be read at all.
    bare = re.sub(r"^(CM_|VAL_) .*\n", "", TEXT, flags=re.MULTILINE)
    assert hash_of(bare, tmp_path) == generated.LAYOUT_HASH

    assert hash_of(changed(old, new, bare), tmp_path) != generated.LAYOUT_HASH


def test_parameters_survive_conversion_by_another_tool(tmp_path):
    path = tmp_path / "converted.dbc"
    path.write_bytes(converted(tmp_path))

    assert read(path, WORDS).parameters == read(DBC, WORDS).parameters


UNFIT = {
    "a parameter without a description": ('0 "turn_deg"', '0 "turn_deg" 99 "patience_s"', "EV_ lines"),
    "a description of no parameter": ('0 "turn_deg" ', "", "EV_ lines"),
    "a parameter with another number": ('"deg" 45 1 DUMMY', '"deg" 45 99 DUMMY', "EV_ lines"),
    "a default out of its range": ('[1|180] "deg" 45 1', '[1|180] "deg" 200 1', "trial_deg"),
    "a range that no byte holds": ('[1|250] "mm" 12', '[1|256] "mm" 12', "step_mm"),
    "a parameter without a comment": ('CM_ EV_ reach_mm "Food nearer than this is eaten.";', "", "reach_mm"),
    "two lists of profiles": ('VAL_ 1697 profile 0 "article"', 'VAL_ 1697 profile 0 "paper"', "profile"),
    "profiles with a gap": ('2 "never"', '98 "never"', "not 0, 1, 2"),
    "two lists of opcodes": ('VAL_ 321 opcode 1 "stop"', 'VAL_ 321 opcode 1 "halt"', "opcode"),
    "a cell too few": ("SG_ cell_7 m1", "SG_ cell_8 m1", "there are 8 patterns"),
    "a signal that is no whole number": (
        "SG_ beacon : 27|13@1+ (1,0)",
        "SG_ beacon : 27|13@1+ (0.5,0)",
        "SENSES.beacon",
    ),
    "odometers in another unit": ('"0.1 mm"', '"inch"', "inch"),
    "identifiers too close": ("BO_ 1953 CRASH", "BO_ 1930 CRASH", "31 nodes"),
}


@pytest.mark.parametrize(("old", "new", "words"), UNFIT.values(), ids=UNFIT)
def test_contradictory_dbc_is_refused(old, new, words, tmp_path):
    path = tmp_path / "unfit.dbc"
    text = changed(old, new)
    path.write_text(
        re.sub(r"^(CM_ (BO_|SG_)|VAL_) (1953|1665) .*\n", "", text, flags=re.MULTILINE)
        if "CRASH" in old or "cell" in old
        else text
    )

    with pytest.raises(DescriptionError, match=re.escape(words)):
        read(path, WORDS)


UNFIT_WORDS = {
    "a pattern without a name": ('"101" = "front-left and front-right"\n', "", "[patterns]"),
    "two patterns of one name": ('"010" = "front"', '"010" = "front-right"', "[patterns]"),
    "a sensor too few": ('["right", "front-right"', '["front-right"', "feel names 4"),
    "a profile without a kind of memory": ('never = "sides"\n', "", "[memory] is of"),
    "a kind of memory that no profile has": ('five = "all_sensors"', 'five = "sides"', "[memory] has"),
    "a kind of memory that is not explained": ('five = "all_sensors"', 'five = "colours"', "[memory] has"),
    "a reason that does not exist": ('avoiding = ["remembered"', 'avoiding = ["forgotten"', "forgotten"),
    "a column that no row has": ('"lifted", "feel"', '"lifted", "glow"', "columns has glow"),
    "a reason that nothing is said of": (
        'silence = "I hear',
        'quiet = "I hear',
        "[sentences] says nothing of silence",
    ),
    "the meaning of no reason": ('trial = "blocked', 'tried = "blocked', "[reason] explains tried"),
}


@pytest.mark.parametrize(("old", "new", "words"), UNFIT_WORDS.values(), ids=UNFIT_WORDS)
def test_words_that_do_not_fit_the_dbc_are_refused(old, new, words, tmp_path):
    path = tmp_path / "robot.toml"
    path.write_text(changed(old, new, WORDS.read_text()))

    with pytest.raises(DescriptionError, match=re.escape(words)):
        read(DBC, path)


def test_refusal_prints_one_line_and_leaves_no_file(tmp_path):
    (tmp_path / "octet.dbc").write_text(changed('2 "never"', '98 "never"'))
    command = [sys.executable, ROOT / "tools/generate", "--dbc", tmp_path / "octet.dbc", "--c", tmp_path / "words.h"]

    done = subprocess.run(command, capture_output=True, text=True, check=False)

    assert (done.returncode, done.stdout) == (1, "")
    assert done.stderr.count("\n") == 1
    assert not (tmp_path / "words.h").exists()


def test_generated_files_are_up_to_date():
    robot = read(DBC, WORDS)

    assert (ROOT / "host_sim/protocol/generated.py").read_text() == to_python.module(robot)
    assert (ROOT / "host_sim/web/generated.ts").read_text() == to_typescript.module(robot)
    assert (ROOT / "host_sim/web/generated_types.ts").read_text() == to_types.module()


def test_types_of_the_page_match_the_python_types():
    lines = to_types.module().splitlines()

    for line in (
        *("beacon: number", "trial: Trial | null", "bars: number[][]", "plants?: number[][]"),
        *("bar_length_mm: [number, number]", "food_bands_mm: [number, number][]"),
    ):
        assert f"  {line};" in lines


def test_exports_to_typescript_take_one_line_each():
    lines = to_typescript.module(read(DBC, WORDS)).splitlines()

    assert all(line.startswith(("export const ", "/*")) or line == "" for line in lines)
    assert "export const SIDE = { NOTHING: 0, LEFT: 1, RIGHT: 2 };" in lines
