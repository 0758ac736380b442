"""The DBC files for any nodes, loaded by cantools.

The bits that frames take at worst, and the tables made of them.
"""

import random
import re
from collections import Counter
from contextlib import ExitStack
from itertools import chain

import cantools
import pytest
from crccheck.crc import Crc8GsmA

from host_sim.cli.main import main
from host_sim.client.commands import stop
from host_sim.protocol.codec import NODE_MAX, Frame, Protocol
from host_sim.protocol.every_node import hear
from host_sim.protocol.generated import MESSAGES
from host_sim.recording.log_reader import read_log
from host_sim.report.dbc_file import dbc_text
from host_sim.report.protocol_page import frames_a_second, load_tables, worst_bits
from host_sim.sim.run_config import RunConfig
from tests.recording.support import open_simulation, record_run, run_through
from tests.report.bits_sent import bits_sent, crc15

NODES = (1, 2, 3, NODE_MAX)


@pytest.fixture(scope="module")
def dbc():
    return cantools.database.load_string(dbc_text(NODES), "dbc")


@pytest.fixture(scope="module")
def log(tmp_path_factory):
    """Three robots, for two seconds."""
    path = tmp_path_factory.mktemp("run") / "run.log"
    with ExitStack() as stack:
        simulation = open_simulation(stack, path, RunConfig(environments=1, limit_s=2.0, robots=3))
        run_through(simulation)
        for client in simulation.clients:
            stop(client)
    return list(read_log(path))


def test_dbc_file_decodes_a_log_of_several_robots(dbc, log):
    together: dict[str, int] = {}
    expected: dict[str, int] = {}
    for _, frame in log:
        heard = hear(frame)
        together |= dbc.decode_message(frame.id, frame.data, decode_choices=False)
        expected |= {f"N{heard.node}_{heard.name}_{name}": number for name, number in heard.signals.items()}

        assert together == expected

    assert {name.split("_")[0] for name in together} == {"N1", "N2", "N3"}


def test_signal_names_are_unique_and_valid(dbc):
    names = [signal.name for message in dbc.messages for signal in message.signals]

    assert len(names) == len(set(names)) == len(NODES) * sum(len(message.signals) for message in MESSAGES.values())
    assert all(re.fullmatch(r"[A-Za-z_]\w{0,31}", name) for name in names)  # what older tools accept


def test_identifiers_and_senders_are_those_of_the_node(dbc):
    for node in NODES:
        for name, message in MESSAGES.items():
            found = dbc.get_message_by_name(f"N{node}_{name}")
            assert found.frame_id == Protocol(node).id_of(name)
            assert found.senders == ["SIM" if message.sender == "SIM" else f"ROBOT_{node}"]
            receivers = set(chain.from_iterable(signal.receivers for signal in found.signals))
            assert receivers == {f"ROBOT_{node}" if message.sender == "SIM" else "SIM"}


def test_messages_have_cycle_times_send_types_and_start_values(dbc):
    senses, answer, memory = (dbc.get_message_by_name(f"N2_{name}") for name in ("SENSES", "ANSWER", "MEMORY"))

    assert (senses.cycle_time, senses.send_type) == (20, "Cyclic")
    assert (answer.cycle_time or 0, answer.send_type) == (0, "Event")
    assert (memory.cycle_time, memory.send_type) == (1000, "CyclicAndEvent")
    for message in dbc.messages:
        assert all(signal.raw_initial == max(signal.minimum or 0, 0) for signal in message.signals)


def test_attributes_give_crc_and_counter_of_each_frame(dbc, log):
    """The CRC by a library that knows nothing of the robots, and the counter, from nothing but the attributes."""
    counters: dict[int, list[int]] = {}
    for _, frame in log:
        values = {name: it.value for name, it in dbc.get_message_by_frame_id(frame.id).dbc.attributes.items()}
        assert (values["E2EProfile"], values["E2EDataLength"]) == (1, 8 * len(frame.data))
        place = values["E2ECRCOffset"] // 8
        others = frame.data[:place] + frame.data[place + 1 :]
        assert frame.data[place] == Crc8GsmA.calc(values["E2EDataID"].to_bytes(2, "little") + others)
        counter = int.from_bytes(frame.data, "little") >> values["E2ECounterOffset"] & 15
        counters.setdefault(frame.id, []).append(counter)

    senses = counters[Protocol(2).id_of("SENSES")]
    assert senses == [(senses[0] + i) % 15 for i in range(len(senses))]


def test_dbc_file_of_one_node_equals_its_part_of_many(dbc):
    alone = cantools.database.load_string(dbc_text([3]), "dbc")

    assert [contents(it) for it in alone.messages] == [contents(it) for it in dbc.messages if it.name[:3] == "N3_"]


def contents(message) -> dict[str, object]:
    """What a message says, but for its start values and attributes."""
    fields = ("start", "length", "byte_order", "is_signed", "minimum", "maximum", "unit", "choices", "comment")
    multiplexing = ("is_multiplexer", "multiplexer_ids", "multiplexer_signal")
    return {
        "identifier": message.frame_id,
        "length": message.length,
        "comment": message.comment,
        "senders": message.senders,
        "cycle": message.cycle_time or 0,
        "signals": {
            signal.name: [
                getattr(signal, field) for field in (*fields, *multiplexing, "receivers", "scale", "offset")
            ]
            for signal in message.signals
        },
    }


@pytest.mark.parametrize(
    ("words", "nodes"),
    [("--nodes 1-3", "123"), ("--nodes 3,1-2", "123"), ("--node 2", "2"), ("--nodes 2", "2")],
)
def test_dbc_command_takes_nodes_and_ranges_of_nodes(capsys, words, nodes):
    assert main(["dbc", *words.split()]) == 0

    assert capsys.readouterr().out == dbc_text(map(int, nodes))


@pytest.mark.parametrize("words", ["0-1", "2-1", f"1-{NODE_MAX + 1}", "1,", "one", ""])
def test_dbc_command_refuses_nodes_that_do_not_exist(capsys, words):
    assert main(["dbc", "--nodes", words]) == 2

    assert re.fullmatch(r"octet: argument --nodes: .*\n", capsys.readouterr().err)


UNASKED = ("COMMAND", "ANSWER", "CRASH", "RANGES", "EMERGENCY", "BOOT")
"""What a run without faults sends at its start, or never."""


def test_crc15_has_the_check_value_of_can():
    assert crc15("".join(f"{byte:08b}" for byte in b"123456789")) == 0x059E  # the check value of CRC-15/CAN


def test_frames_take_at_most_the_bits_of_the_worst_case():
    source = random.Random(1)
    for length in range(9):
        frames = [Frame(source.randrange(0x800), source.randbytes(length)) for _ in range(300)]
        frames.append(Frame(0x078, b"\x3c\x3c" * (length // 2)))
        assert max(len(bits_sent(frame)) for frame in frames) <= worst_bits(length)
    assert worst_bits(8) == 135
    assert worst_bits(0) == 55


def test_log_has_the_frame_rates_of_the_table(tmp_path):
    log = list(read_log(record_run(tmp_path, seed=4, limit_s=30.0).log))
    seconds = (log[-1].time_us - log[0].time_us) / 1e6
    frames = Counter(hear(it.frame).name for it in log)

    for name, message in MESSAGES.items():
        if name not in UNASKED and frames_a_second(message):
            # The reports of the first stop, and a memory for each lesson, come on top.
            assert -3 <= frames[name] - seconds * frames_a_second(message) <= 30
    assert set(frames) - set(UNASKED) == set(MESSAGES) - set(UNASKED)


def test_load_table_gives_a_message_at_its_worst():
    (line,) = re.findall(r"^\| DRIVE .*$", load_tables(), re.MULTILINE)

    worst = worst_bits(8) * 50
    figures = [float(number) for number in re.findall(r"\d+(?:\.\d+)?", line)]
    assert figures == [8, worst_bits(8), 50, worst / 1000]
