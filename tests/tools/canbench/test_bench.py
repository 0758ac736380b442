"""The bench of the pytest plug-in: devices, faults."""

import sys
import time
from contextlib import closing
from pathlib import Path

import pytest

from host_sim.base.errors import UsageError
from tools.pytest_canbench import devices
from tools.pytest_canbench.bench import Bench, BenchError, Setup
from tools.pytest_canbench.devices import open_device
from tools.pytest_canbench.messages import Messages

MOTOR = Path(__file__).resolve().parents[3] / "examples" / "motor"
DBC = MOTOR / "motor.dbc"
SPEEDING = """
#include <stdint.h>
struct frame {{ uint32_t id; uint8_t len; uint8_t data[8]; }};
void receive(const struct frame *frame) {{ (void)frame; }}
int tick(uint32_t now_ms, struct frame frames[16]) {{ (void)now_ms; (void)frames; return {}; }}
"""


@pytest.fixture
def open_bench():
    opened = []

    def make(*rules, device="motor.c", folder=MOTOR, crc="e2e1", node="MOTOR", seed=1):
        setup = Setup(Messages(DBC, crc), lambda: open_device(device, folder), rules, seed, node)
        opened.append(Bench(setup))
        return opened[-1]

    yield make
    for bench in opened:
        bench.close()


def test_messages_of_other_nodes_are_sent_at_their_cycle_time(open_bench):
    bench = open_bench()
    bench.run(ms=95)

    assert [at_ms for at_ms, way, _ in bench._frames if way == "to"] == [0, 20, 40, 60, 80]
    bench.silence("SETPOINT")
    bench.run(ms=100)
    assert sum(way == "to" for _, way, _ in bench._frames) == 5


def test_bench_without_a_node_sends_only_named_messages(open_bench):
    bench = open_bench(node="")
    bench.run(ms=50)
    bench.send("SETPOINT", speed=1)

    assert [at_ms for at_ms, way, _ in bench._frames if way == "to"] == [50]


def test_received_signals_have_their_times(open_bench):
    bench = open_bench()
    bench.send_cyclic("SETPOINT", speed=800)
    bench.run(ms=30)

    assert [at_ms for at_ms, _ in bench.history("STATUS.speed")] == [0, 10, 20]
    assert bench["STATUS.speed"] == bench.history("STATUS.speed")[-1][1] > 0


def test_run_until_waits_for_the_wanted_value_up_to_its_limit(open_bench):
    bench = open_bench()
    bench.send_cyclic("SETPOINT", speed=800)

    bench.run_until("STATUS.speed", lambda speed: speed > 0, 1000)
    assert 0 < bench.now_ms < 1000
    with pytest.raises(BenchError, match=r"^within 50 ms STATUS.speed was not as wanted; it was [\d.]+ in"):
        bench.run_until("STATUS.speed", lambda speed: speed < 0, 50)
    with pytest.raises(UsageError, match="STATUS has no signal sped"):
        bench.run_until("STATUS.sped", lambda _: True, 50)


def test_misspelt_name_is_refused_before_any_frame_is_received(open_bench):
    bench = open_bench()

    with pytest.raises(UsageError, match="STATUS has no signal sped; it has"):
        bench["STATUS.sped"]
    with pytest.raises(UsageError, match="has no message STATS; it has"):
        bench.history("STATS.speed")


def test_run_refuses_a_negative_time(open_bench):
    with pytest.raises(UsageError, match="backward: -5 ms"):
        open_bench().run(ms=-5)


def test_same_seed_makes_the_same_faults(open_bench):
    found = []
    for seed in (1, 1, 2):
        bench = open_bench("drop:30%/to", "corrupt:10%/from", seed=seed)
        bench.run(ms=500)
        found.append(([str(rule) for rule in bench.faults], bench.damaged))

    assert found[0] == found[1] != found[2]
    assert found[0][1] > 0


def test_delays_pass_in_simulated_time(open_bench):
    bench = open_bench("delay:35ms/from")
    bench.run(ms=60)

    assert [heard.at_ms for heard in bench.heard] == [35, 45, 55]


def test_device_of_a_new_bench_is_as_at_power_up(open_bench):
    first, second = open_bench(), open_bench()
    first.send_cyclic("SETPOINT", speed=1000)
    first.run(ms=300)
    second.run(ms=300)

    assert first["STATUS.speed"] > 900
    assert second["STATUS.speed"] == 0


def test_forged_frame_is_accepted_as_undamaged(open_bench):
    bench = open_bench("forge:SETPOINT@5-9/to", "forge:STATUS@5-9/from")
    bench.run(ms=400)

    assert bench["STATUS.refused"] == bench.damaged == 0
    assert sum(speed != 0 for _, speed in bench.history("STATUS.speed")) >= 4


ECHO = """
import os, socket
bus = socket.socket(fileno=int(os.environ["CAN_CHANNEL"]))
while frame := bus.recv(16):
    bus.send(bytes([0, 2]) + frame[2:])
"""


def test_program_serves_as_a_device(open_bench, tmp_path, monkeypatch):
    monkeypatch.setattr(devices, "START_S", 0.0)
    (tmp_path / "echo.py").write_text(ECHO)
    bench = open_bench(device=f"{sys.executable} echo.py", folder=tmp_path, crc="none", node="")
    bench.send("SETPOINT", speed=7)
    for _ in range(200):
        bench.run(ms=50)
        if bench.heard:
            break

    assert bench["STATUS.speed"] == 7


def test_program_device_keeps_real_time_after_a_delay(tmp_path, monkeypatch):
    monkeypatch.setattr(devices, "START_S", 0.0)
    (tmp_path / "echo.py").write_text(ECHO)
    with closing(open_device(f"{sys.executable} echo.py", tmp_path)) as device:
        device.tick(0)
        time.sleep(0.3)
        before_s = time.monotonic()
        device.tick(1)
        device.tick(51)

        assert time.monotonic() - before_s > 0.04


def wrong(text, message):
    return pytest.param(text, message, id=message)


@pytest.mark.parametrize(
    ("device", "message"),
    [
        wrong("no-such.so", "cannot load .*no-such.so: No such file or directory"),
        wrong("no-such.c", "cannot compile .*no-such.c"),
        wrong("motor.dbc.so", "cannot load .*motor.dbc.so"),
        wrong("no-such-program", "cannot start 'no-such-program': No such file"),
        wrong("image:z80:no.elf", "no emulated chip 'z80'; there are"),
        wrong("image:blue_pill:no.elf", "there is no image .*no.elf"),
    ],
)
def test_invalid_device_is_reported(open_bench, device, message):
    with pytest.raises(UsageError, match=message):
        open_bench(device=device)


def test_library_without_the_required_functions_is_reported(open_bench, tmp_path):
    (tmp_path / "other.c").write_text("int tick(void) { return 0; }\n")

    with pytest.raises(UsageError, match="does not have both of receive and tick"):
        open_bench(device="other.c", folder=tmp_path)


@pytest.mark.parametrize("count", [17, -1])
def test_invalid_result_of_a_tick_is_reported(open_bench, tmp_path, count):
    (tmp_path / "mad.c").write_text(SPEEDING.format(count))
    bench = open_bench(device="mad.c", folder=tmp_path)

    with pytest.raises(BenchError, match=f"after 0 ms: tick has returned {count}"):
        bench.run(ms=5)


def test_program_that_ends_at_once_is_reported(open_bench):
    with pytest.raises(UsageError, match=r"the device .* ended with exit code 3 and printed no bus"):
        open_bench(device="sh -c 'echo no bus; exit 3'")


def test_program_that_ends_later_is_reported(open_bench, monkeypatch):
    monkeypatch.setattr(devices, "START_S", 0.0)
    bench = open_bench(device="sh -c 'sleep 0.3; exit 3'")

    with pytest.raises(BenchError, match=r"after \d+ ms: .*ended with exit code 3 and printed nothing"):
        bench.run(ms=60_000)


def test_device_that_never_answers_is_reported(open_bench, tmp_path):
    (tmp_path / "mute.c").write_text(SPEEDING.format(0))
    bench = open_bench(device="mute.c", folder=tmp_path)
    bench.run(ms=100)

    with pytest.raises(BenchError, match=r"in 100 ms the device has sent no STATUS\.speed; it has sent nothing"):
        bench["STATUS.speed"]


def test_name_missing_from_the_dbc_is_reported(open_bench):
    bench = open_bench()
    bench.run(ms=20)

    for act, message in (
        (lambda: bench.send("SETPIONT"), "has no message SETPIONT; it has SETPOINT, STATUS"),
        (lambda: bench.send("SETPOINT", spede=1), "SETPOINT has no signal spede; it has crc, counter, speed"),
        (lambda: bench.send_cyclic("SETPOINT", speed=99999), "SETPOINT cannot be encoded: Expected signal .speed. "),
        (lambda: bench["STATUS.spede"], "STATUS has no signal spede"),
        (lambda: open_bench(node="MOTRO"), "has no message that MOTRO sends; senders are HOST, MOTOR"),
        (lambda: open_bench(crc="crc32"), "no CRC profile 'crc32'; there are e2e1"),
        (lambda: open_bench("fall@3"), "there is no fault 'fall'"),
        (lambda: open_bench("forge:SETPIONT"), "has no message SETPIONT"),
        (lambda: open_bench(crc="e2e5").send("SETPOINT"), "SETPOINT cannot be used: crc is no place for a CRC of 16"),
    ):
        with pytest.raises(UsageError, match=message):
            act()


@pytest.mark.vcan
def test_program_serves_as_a_device_on_vcan():
    heater = MOTOR.parent / "heater"
    command = f"{sys.executable} heater.py"
    messages = Messages(heater / "heater.dbc", "none")
    setup = Setup(messages, lambda: open_device(command, heater, "socketcan:vcan0"), node="HEATER")
    with closing(Bench(setup)) as bench:
        bench.run(ms=100)

        assert bench["HEATER_STATE.power"] == 0
