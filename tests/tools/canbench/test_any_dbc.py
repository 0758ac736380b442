"""The bench takes any DBC file: judged by cantools' own files, and by frames that cantools encodes and decodes."""

import random
import tarfile
from collections import Counter
from contextlib import closing
from pathlib import Path

import cantools
import pytest

from host_sim.base.errors import UsageError
from host_sim.transport.socket_pair import EXTENDED
from tools.pytest_canbench import devices
from tools.pytest_canbench.bench import Bench, Setup
from tools.pytest_canbench.devices import open_device
from tools.pytest_canbench.messages import Messages

ROOT = Path(__file__).resolve().parents[3]
UNREADABLE = {
    "BU_EV_REL_.dbc",
    "bus_comment_bare.dbc",
    "bus_comment_bare_out.dbc",
    "cp1252.dbc",
    "empty_ns.dbc",
    "environment_variable_data.dbc",
    "environment_variable_multiple_access_nodes.dbc",
    "incorrect-sig_valtype.dbc",
    "incorrect-val.dbc",
    "issue_199.dbc",
    "issue_199_extended.dbc",
    "issue_62.dbc",
}
"""Files that cantools refuses even with `strict=False`, or that have no messages."""

REFUSED = {"AFT1PSI2": 1, "Message1": 1, "CanFd": 2, "TestMessage2": 1}
"""Messages with overlapping signals, with one outside the message, and two with over 8 bytes."""

ECHO = """
#include <stdint.h>
#include <string.h>
struct frame { uint32_t id; uint8_t len; uint8_t data[8]; };
static struct frame queue[16];
static int count;
void receive(const struct frame *frame) { if (count < 16) queue[count++] = *frame; }
int tick(uint32_t now_ms, struct frame frames[16])
{
    int sent = count;
    (void)now_ms;
    memcpy(frames, queue, sizeof queue);
    count = 0;
    return sent;
}
"""
ECHO_PROGRAM = """
import os, socket
bus = socket.socket(fileno=int(os.environ["CAN_CHANNEL"]))
while frame := bus.recv(16):
    bus.send(frame)
"""
HEAD = 'VERSION ""\nBU_: HOST FAN\n'
CYCLIC = 'BA_DEF_ BO_ "GenMsgCycleTime" INT 0 65535;\nBA_DEF_DEF_ "GenMsgCycleTime" 0;\n'


@pytest.fixture(scope="module")
def files(tmp_path_factory):
    folder = tmp_path_factory.mktemp("cantools")
    (package,) = (ROOT / "build" / "unity").glob("cantools-*.tar.gz")
    with tarfile.open(package) as archive:
        for member in archive.getmembers():
            if "/tests/files/dbc/" in member.name and member.isfile():
                (folder / Path(member.name).name).write_bytes(archive.extractfile(member).read())
    return sorted(path for path in folder.iterdir() if path.suffix.lower() == ".dbc")


@pytest.fixture(scope="module")
def echo(tmp_path_factory):
    folder = tmp_path_factory.mktemp("echo")
    (folder / "echo.c").write_text(ECHO)
    (folder / "echo.py").write_text(ECHO_PROGRAM)
    return folder


def a_bench(file, echo, device="echo.c", profile="none", node=""):
    return closing(Bench(Setup(Messages(file, profile), lambda: open_device(device, echo), node=node)))


def written(tmp_path, text):
    (tmp_path / "it.dbc").write_text(HEAD + text)
    return tmp_path / "it.dbc"


def refusal(act):
    """What an action is refused with; empty if it is not."""
    try:
        act()
    except UsageError as error:
        return str(error)
    return ""


def heard_back(file, profile, echo):
    """The messages of a file that an echo returns as they are, and those that are refused by name."""
    heard, refused = Counter(), Counter()
    with a_bench(file, echo, profile=profile) as bench:
        for message in cantools.database.load_file(file, strict=False).messages:
            why = refusal(lambda: bench.send(message.name))  # noqa: B023
            assert not why or why.startswith(f"{message.name} cannot be used: ")
            bench.run(ms=2)
            heard[message.name] += bool(not why and bench.heard[-1].name == message.name)
            refused[message.name] += bool(why)
    return heard, refused


@pytest.mark.parametrize("profile", ["none", "j1850"])
def test_classic_messages_of_cantools_files_are_echoed_or_refused_by_name(files, echo, profile):
    unreadable = {file.name for file in files if file.name in refusal(lambda: Messages(file, profile))}  # noqa: B023
    told = [heard_back(file, profile, echo) for file in files if file.name not in unreadable]
    heard, refused = (sum(some, Counter()) for some in zip(*told, strict=True))

    assert unreadable == UNREADABLE
    assert refused == REFUSED | ({"FOOBAR": 2} if profile == "j1850" else {})  # whose CRC has 12 bits
    assert heard.total() == 418 - refused.total()


@pytest.mark.parametrize("device", ["echo.c", "python3 echo.py"])
def test_29_bit_identifiers_are_sent_and_heard(tmp_path, echo, device, monkeypatch):
    monkeypatch.setattr(devices, "START_S", 0.0)
    file = written(
        tmp_path,
        'BO_ 2566844926 EEC1: 8 HOST\n SG_ speed : 24|16@1+ (0.125,0) [0|8031] "rpm" FAN\n'
        'BO_ 254 SHORT: 8 HOST\n SG_ speed : 24|16@1+ (0.125,0) [0|8031] "rpm" FAN\n',
    )
    with a_bench(file, echo, device) as bench:
        bench.send("EEC1", speed=800)
        bench.send("SHORT", speed=1)
        bench.run_until("SHORT.speed", bool, 2000)

        assert bench["EEC1.speed"] == 800
        assert bench["SHORT.speed"] == 1
        assert "18FEF1FE#0000000019000000 EEC1 speed=800" in "\n".join(bench.lines())


def test_device_need_not_flag_an_identifier_over_11_bits(tmp_path):
    file = written(tmp_path, 'BO_ 2566844927 FANX: 1 FAN\n SG_ state : 0|8@1+ (1,0) [0|255] "" HOST\n')
    (tmp_path / "fan.c").write_text(
        ECHO.split("static", maxsplit=1)[0]
        + "void receive(const struct frame *frame) { (void)frame; }\n"
        + "int tick(uint32_t now, struct frame *out) { *out = (struct frame){0x18FEF1FF, 1, {7}}; return !now; }\n"
    )
    with a_bench(file, tmp_path, "fan.c") as bench:
        bench.run(ms=1)

        assert bench["FANX.state"] == 7


MOTOROLA = """BO_ 80 WANTED: 5 HOST
 SG_ crc : 7|{bits}@0+ (1,0) [0|0] "" FAN
 SG_ counter : {counter}|4@0+ (1,0) [0|15] "" FAN
 SG_ duty : 31|8@0+ (1,0) [0|100] "%" FAN
"""


@pytest.mark.parametrize(("profile", "bits", "counter"), [("j1850", 8, 15), ("e2e1", 8, 15), ("e2e5", 16, 23)])
def test_motorola_checksums_and_counters_are_where_cantools_reads_them(tmp_path, profile, bits, counter):
    file = written(tmp_path, MOTOROLA.format(bits=bits, counter=counter))
    messages, judge = Messages(file, profile), cantools.database.load_file(file)

    frames = [messages.frame("WANTED", {"duty": 30}) for _ in range(3)]
    told = [judge.decode_message(80, frame.data) for frame in frames]

    assert [each["counter"] for each in told] == [0, 1, 2]
    assert {each["duty"] for each in told} == {30}
    assert len({each["crc"] for each in told}) == 3
    assert [messages.decode(frame)[1] for frame in frames] == told


def test_forged_motorola_counter_is_the_requested_one(tmp_path):
    file = written(tmp_path, MOTOROLA.format(bits=8, counter=15))
    messages = Messages(file, "j1850")
    for count in range(16):
        forged = messages.forged("WANTED", random.Random(count), count)

        assert cantools.database.load_file(file).decode_message(80, forged.data)["counter"] == count
        assert messages.decode(forged)[1]["counter"] == count


MULTIPLEXED = """BO_ 80 WANTED: 4 HOST
 SG_ kind M : 0|8@1+ (1,0) [0|7] "" FAN
 SG_ duty m3 : 8|8@1+ (1,0) [0|100] "%" FAN
 SG_ crc m3 : 16|8@1+ (1,0) [0|255] "" FAN
 SG_ level m5 : 16|8@1+ (1,0) [0|100] "%" FAN
"""


def test_multiplexer_selects_the_given_signals(tmp_path, echo):
    with a_bench(written(tmp_path, MULTIPLEXED), echo, profile="j1850") as bench:
        bench.send("WANTED")
        bench.send("WANTED", level=7)
        bench.send("WANTED", kind=3, duty=9)
        bench.run(ms=1)

        assert [{**heard.signals, "crc": 0} for heard in bench.heard] == [
            {"kind": 3, "duty": 0, "crc": 0},
            {"kind": 5, "level": 7, "crc": 0},
            {"kind": 3, "duty": 9, "crc": 0},
        ]
        assert bench.heard[0].signals["crc"] != bench.heard[2].signals["crc"]
        with pytest.raises(UsageError, match="WANTED cannot be encoded: its multiplexers do not select level"):
            bench.send("WANTED", kind=3, level=7)
        with pytest.raises(UsageError, match=r"WANTED cannot be encoded: .*multiplexer"):
            bench.send("WANTED", kind=4)


def test_only_invalid_messages_of_a_file_are_refused(tmp_path, echo):
    file = written(
        tmp_path,
        'BO_ 80 WANTED: 4 HOST\n SG_ all_bits : 16|16@1+ (1,0) [0|65535] "" FAN\n'
        ' SG_ bit0 : 16|1@1+ (1,0) [0|1] "" FAN\n'
        'BO_ 81 LONG: 12 HOST\n SG_ far : 80|8@1+ (1,0) [0|255] "" FAN\n'
        'BO_ 82 GOOD: 1 HOST\n SG_ duty : 0|8@1+ (1,0) [0|100] "" FAN\n'
        'BO_ 83 FAN_STATE: 1 FAN\n SG_ duty : 0|8@1+ (1,0) [0|100] "" HOST\n'
        + CYCLIC
        + 'BA_ "GenMsgCycleTime" BO_ 80 5;\n'
        'BA_ "GenMsgCycleTime" BO_ 81 5;\nBA_ "GenMsgCycleTime" BO_ 82 5;\n',
    )
    with a_bench(file, echo, node="FAN") as bench:
        bench.run(ms=1)

        assert [heard.name for heard in bench.heard] == ["GOOD"]
        for name, why in (
            ("WANTED", "The signals .*bit0.* are overlapping"),
            ("LONG", "it has 12 bytes, .* classic CAN"),
        ):
            for use in (lambda: bench.send(name), lambda: bench[f"{name}.far"]):  # noqa: B023
                with pytest.raises(UsageError, match=f"{name} cannot be used: {why}"):
                    use()
        assert "WANTED: " in bench.setup.messages.odd()
        assert "LONG: " in bench.setup.messages.odd()


@pytest.mark.parametrize(
    ("signal", "attributes", "value"),
    [
        ("(1,20) [20|275]", "", 20),
        ("(1,-300) [-300|-50]", "", -50),
        ("(0.5,0) [3|100]", "", 3),
        ("(1,20) [20|275]", 'BA_DEF_ SG_ "GenSigStartValue" INT 0 255;\nBA_ "GenSigStartValue" SG_ 82 temp 5;\n', 25),
    ],
)
def test_cyclic_message_starts_with_an_allowed_value_where_0_is_none(tmp_path, echo, signal, attributes, value):
    file = written(
        tmp_path,
        f'BO_ 82 TEMP: 2 HOST\n SG_ temp : 0|8@1+ {signal} "C" FAN\nBO_ 81 FAN_STATE: 2 FAN\n'
        + CYCLIC
        + 'BA_ "GenMsgCycleTime" BO_ 82 100;\n'
        + attributes,
    )
    with a_bench(file, echo, node="FAN") as bench:
        bench.run(ms=1)

        assert bench["TEMP.temp"] == value


def test_hexadecimal_data_id_is_read_and_a_non_number_is_refused(tmp_path):
    text = 'BO_ 80 WANTED: 4 HOST\n SG_ crc : 0|8@1+ (1,0) [0|255] "" FAN\nBA_DEF_ BO_ "DataID" STRING ;\n'
    frames = []
    for told in ("0x1A2", "418", "none of it"):
        messages = Messages(written(tmp_path, f'{text}BA_ "DataID" BO_ 80 "{told}";\n'), "e2e1")
        if told == "none of it":
            with pytest.raises(UsageError, match="WANTED cannot be used: its DataID is not a number: none of it"):
                messages.check("WANTED", {})
        else:
            frames.append(messages.frame("WANTED", {}))

    assert frames[0] == frames[1]
    assert frames[0].data[0] != 0


def test_value_may_be_given_by_its_name_in_the_file(tmp_path, echo):
    file = written(
        tmp_path, 'BO_ 80 WANTED: 1 HOST\n SG_ mode : 0|8@1+ (1,0) [0|3] "" FAN\nVAL_ 80 mode 2 "FAST" 1 "SLOW";\n'
    )
    with a_bench(file, echo) as bench:
        bench.send("WANTED", mode="FAST")
        bench.run(ms=1)

        assert bench["WANTED.mode"] == 2
        for value, why in (("QUICK", "mode has no value 'QUICK'; it has FAST, SLOW"), (float("nan"), ""), (999, "")):
            with pytest.raises(UsageError, match=f"WANTED cannot be encoded: {why}"):
                bench.send("WANTED", mode=value)


def test_second_message_of_an_identifier_is_refused(tmp_path):
    messages = Messages(
        written(tmp_path, "BO_ 80 FIRST: 1 HOST\nBO_ 80 SECOND: 1 HOST\nBO_ 2147483728 THIRD: 1 HOST\n"), "none"
    )

    assert messages.refused == {"SECOND": "its identifier is that of FIRST"}
    assert messages.frame("THIRD", {}).id == 80 | EXTENDED
