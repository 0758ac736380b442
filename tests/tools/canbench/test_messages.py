"""The messages of the pytest plug-in, and their protection."""

from pathlib import Path

import pytest

from host_sim.base.errors import UsageError
from tools.pytest_canbench.messages import Messages
from tools.pytest_canbench.protection import PROFILES

DBC = Path(__file__).resolve().parents[3] / "examples" / "motor" / "motor.dbc"
VECTORS = [  # of another implementation, autosar-e2e
    ("e2e1", bytes(7), [0x123], 0, 0xCC),
    ("e2e2", bytes([1, 0, 0, 0, 0, 0, 0]), list(range(1, 17)), 1, 0x1B),
    ("e2e5", bytes(6), [0x1234], 0, 0xCA1C),
    ("j1850", b"123456789", [], 0, 0x4B),
]


@pytest.mark.parametrize(("profile", "data", "ids", "count", "crc"), VECTORS, ids=[each[0] for each in VECTORS])
def test_crcs_match_those_of_another_implementation(profile, data, ids, count, crc):
    assert PROFILES[profile].crc(data, ids, count) == crc


def test_counters_wrap_around_at_the_span_of_the_profile():
    for profile, span in (("e2e1", 15), ("e2e2", 16), ("none", 16)):
        messages = Messages(DBC, profile)
        counts = [messages.frame("SETPOINT", {}).data[1] & 15 for _ in range(40)]

        assert counts == [n % span for n in range(40)]


def test_frame_is_decoded_as_encoded_and_a_damaged_one_is_refused():
    messages = Messages(DBC, "j1850")
    frame = messages.frame("SETPOINT", {"speed": -1234})

    assert messages.decode(frame)[1]["speed"] == -1234
    for data in (frame.data[:7], bytes([frame.data[0] ^ 1]) + frame.data[1:]):
        with pytest.raises(ValueError, match="damaged"):
            messages.decode(frame._replace(data=data))
    assert messages.decode(frame._replace(id=0x700)) is None


def test_data_ids_are_read_from_the_dbc(tmp_path):
    told = 'BA_DEF_ BO_ "DataID" INT 0 65535;\nBA_DEF_DEF_ "DataID" 0;\nBA_ "DataID" BO_ 256 291;\n'
    (tmp_path / "told.dbc").write_text(DBC.read_text() + told)

    frames = [Messages(file, "e2e1").frame("SETPOINT", {}) for file in (DBC, tmp_path / "told.dbc")]

    assert frames[0].data[0] == 0x5F
    assert frames[1].data[0] == 0xCC


@pytest.mark.parametrize("text", ["", "BO_ nonsense", "\x00\xff", 'VERSION ""\n'])
def test_invalid_dbc_file_is_reported(tmp_path, text):
    (tmp_path / "bad.dbc").write_text(text)

    with pytest.raises(UsageError, match=r"bad\.dbc (is not a DBC file|has no messages)"):
        Messages(tmp_path / "bad.dbc", "none")
    with pytest.raises(UsageError, match=r"cannot read .*: No such file"):
        Messages(tmp_path / "no.dbc", "none")
