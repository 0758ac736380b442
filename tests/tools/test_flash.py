"""tools/flash with boards, images and probes, and with stand-ins for the programs that it calls."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT))

from host_sim.base.errors import OctetError  # noqa: E402 - found by the line above
from tools.flashing.images import Image, all_boards, built, choose_board, identify  # noqa: E402
from tools.flashing.probes import Probe, choose_probe, find_drive, find_probes, write_to_drive  # noqa: E402
from tools.flashing.programs import CHIP_IDS, Plan, check_chip, explain, make_plan, write  # noqa: E402

BOARDS = all_boards()
STLINK, OTHER = Probe("stlink", "A1"), Probe("cmsis-dap", "B2")


def plug_in(usb: Path, name: str, **attributes: str) -> None:
    (usb / name).mkdir(parents=True)
    for attribute, value in attributes.items():
        (usb / name / attribute).write_text(f"{value}\n")


def image_file(folder: Path, board: str, chip: str) -> Path:
    path = folder / "image.elf"
    identity = f"octet-image board={board} chip={chip} node=2 bitrate=250000 version=1.0-3-gabc dbc=7827"
    path.write_bytes(b"\x7fELF..\0" + identity.encode() + b"\0..")
    return path


def image_for(chip: str) -> Image:
    return Image(Path("octet.elf"), "blue_pill", chip, "1", "500000", "1", "0")


def installed(folder: Path, monkeypatch: pytest.MonkeyPatch, **programs: str) -> None:
    """Puts shell scripts of these names first in PATH."""
    for name, script in programs.items():
        (folder / name).write_text(f"#!/bin/sh\n{script}\n")
        (folder / name).chmod(0o755)
    monkeypatch.setenv("PATH", f"{folder}{os.pathsep}{os.environ['PATH']}")


def flash(*options: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run([ROOT / "tools" / "flash", *options], capture_output=True, text=True, check=False)


def test_boards_have_their_chips_and_links() -> None:
    assert {board.name: (board.chip, *board.links) for board in BOARDS.values()} == {
        "blue_pill": ("stm32f103", "bxcan", "slcan", "pins", "mute", "body"),
        "feather_stm32f405": ("stm32f405", "bxcan", "slcan"),
        "nucleo_g431rb": ("stm32g431", "fdcan", "slcan", "pins", "mute", "body"),
        "olimex_stm32_h405": ("stm32f405", "bxcan", "slcan"),
        "pico": ("rp2040", "slcan", "pins", "check"),
    }


def test_boards_have_a_preset_of_their_name() -> None:
    presets = json.loads((ROOT / "CMakePresets.json").read_text())
    hidden = {preset["name"] for preset in presets["configurePresets"] if preset.get("hidden")}
    for kind in ("configurePresets", "buildPresets"):
        names = {preset["name"] for preset in presets[kind]} - hidden
        assert names == {"host", "host-san", "page", *BOARDS}


def test_chips_of_all_boards_have_an_id() -> None:
    assert {board.chip for board in BOARDS.values()} == CHIP_IDS.keys()


def test_unknown_board_is_refused() -> None:
    with pytest.raises(OctetError, match="no board nosuch; there are blue_pill, feather"):
        choose_board("nosuch", BOARDS)


def test_unknown_link_is_refused() -> None:
    refused = pytest.raises(OctetError, match="no image usb for blue_pill; there are bxcan, slcan")
    with refused, built(BOARDS["blue_pill"], "usb", 1, 500_000):
        pass
    there = "there are fdcan, slcan, pins, mute, body"
    refused = pytest.raises(OctetError, match=f"no image bxcan for nucleo_g431rb; {there}")
    with refused, built(BOARDS["nucleo_g431rb"], "bxcan", 1, 500_000):
        pass


@pytest.mark.parametrize(("configured_s", "stays"), [(1, False), (3, True)])
def test_changed_toolchain_file_is_configured_anew(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, configured_s: int, stays: bool
) -> None:
    folder = tmp_path / "build/flash/blue_pill"
    for path, at_s in ((tmp_path / "tools/cmake/arm.cmake", 2), (folder / "CMakeCache.txt", configured_s)):
        path.parent.mkdir(parents=True)
        path.touch()
        os.utime(path, (at_s, at_s))
    (tmp_path / "cmake").write_text("#!/bin/sh\n")
    (tmp_path / "cmake").chmod(0o755)
    monkeypatch.setenv("PATH", str(tmp_path), prepend=os.pathsep)

    with built(BOARDS["blue_pill"], "bxcan", 1, 500_000, tmp_path):
        assert (folder / "CMakeCache.txt").exists() == stays


def test_image_states_its_identity(tmp_path: Path) -> None:
    image = identify(image_file(tmp_path, "blue_pill", "stm32f103"), BOARDS["blue_pill"])
    assert (image.chip, image.version, image.dbc) == ("stm32f103", "1.0-3-gabc", "7827")
    assert (image.node, image.bitrate) == ("2", "250000")


def test_image_for_another_board_is_refused(tmp_path: Path) -> None:
    with pytest.raises(OctetError, match="is for olimex_stm32_h405, not for blue_pill"):
        identify(image_file(tmp_path, "olimex_stm32_h405", "stm32f405"), BOARDS["blue_pill"])


def test_file_that_is_no_image_is_refused(tmp_path: Path) -> None:
    (tmp_path / "some.elf").write_bytes(b"\x7fELF")
    with pytest.raises(OctetError, match="is not an Octet image"):
        identify(tmp_path / "some.elf", BOARDS["blue_pill"])
    with pytest.raises(OctetError, match="No such file"):
        identify(tmp_path / "none.elf", BOARDS["blue_pill"])


def test_probes_are_found_among_other_devices(tmp_path: Path) -> None:
    plug_in(tmp_path, "1-1", idVendor="0483", idProduct="374b", serial="A1", product="STM32 STLink")
    plug_in(tmp_path, "1-2", idVendor="0d28", idProduct="0204", serial="B2", product="DAPLink CMSIS-DAP")
    plug_in(tmp_path, "1-3", idVendor="1366", idProduct="0101", serial="C3", product="J-Link")
    plug_in(tmp_path, "1-4", idVendor="0483", idProduct="5740", serial="D4", product="Virtual COM Port")
    plug_in(tmp_path, "usb1", idVendor="1d6b")
    assert [str(probe) for probe in find_probes(tmp_path)] == ["stlink:A1", "cmsis-dap:B2", "jlink:C3"]


def test_system_without_usb_has_no_probe(tmp_path: Path) -> None:
    assert find_probes(tmp_path / "none") == []


@pytest.mark.parametrize("wanted", [None, "stlink", "stlink:A1"])
def test_single_probe_is_chosen(wanted: str | None) -> None:
    assert choose_probe(wanted, [STLINK]) == STLINK


@pytest.mark.parametrize(
    ("wanted", "found", "reason"),
    [
        (None, [], "no debug probe is plugged in"),
        ("stlink:Z9", [STLINK], "no probe stlink:Z9 is plugged in"),
        (None, [STLINK, OTHER], "several probes: choose one with --probe: stlink:A1, cmsis-dap:B2"),
        ("magic", [STLINK], "no kind of probe magic"),
        ("serial:/dev/nosuch", [], "no such device: /dev/nosuch"),
        ("serial", [], "PATH is missing"),
    ],
)
def test_impossible_choice_of_a_probe_is_refused(wanted: str | None, found: list[Probe], reason: str) -> None:
    with pytest.raises(OctetError, match=reason):
        choose_probe(wanted, found)


@pytest.mark.parametrize(("probe", "program"), [(STLINK, "openocd"), (Probe("serial", "/dev/null"), "stm32flash")])
def test_probe_determines_the_program(probe: Probe, program: str) -> None:
    assert make_plan(image_for("stm32f103"), probe, has=bool).program == program


def test_pyocd_is_used_where_openocd_is_missing() -> None:
    plan = make_plan(image_for("stm32f405"), STLINK, has=lambda program: program == "pyocd")
    assert plan.write[:6] == ["pyocd", "load", "-u", "A1", "-t", "stm32f405rg"]


def test_missing_program_is_named() -> None:
    with pytest.raises(OctetError, match="stlink needs openocd or pyocd"):
        make_plan(image_for("stm32f405"), STLINK, has=lambda _: False)


def plan_with(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, script: str) -> Plan:
    installed(tmp_path, monkeypatch, openocd=script)
    return make_plan(image_for("stm32f405"), STLINK)


def test_matching_chip_is_accepted(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    check_chip(plan_with(tmp_path, monkeypatch, "echo Info : clock; echo chip=0x10076413"), "stm32f405")


@pytest.mark.parametrize(
    ("script", "said"),
    [
        ("echo chip=0x20036410", r"the chip behind the probe is 0x410, not stm32f405 \(0x413\)"),
        (
            "echo Error: init mode failed >&2; exit 1",
            r"openocd finds no chip \(exit code 1\): the probe does not reach .* \(Error: init mode failed\)",
        ),
    ],
)
def test_wrong_or_silent_chip_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, script: str, said: str
) -> None:
    with pytest.raises(OctetError, match=said):
        check_chip(plan_with(tmp_path, monkeypatch, script), "stm32f405")


REPORTED = {
    "no permission for the probe": "Error: libusb_open() failed with LIBUSB_ERROR_ACCESS\nError: open failed\n",
    "is a clone": "Warn : UNEXPECTED idcode: 0x2ba01477\nError: expected 1 of 1: 0x1ba01477",
    "read-out protected": "Error: stm32x device protected\nError: failed erasing sectors 0 to 2",
    "has no power": "Info : Target voltage: 0.002410\nError: target voltage may be too low for reliable debugging\n"
    "Error: init mode failed (unable to connect to the target)",
    "does not reach a chip": "Error: init mode failed (unable to connect to the target)\n"
    "in procedure 'init'\n** OpenOCD init failed **",
    "permission to open the serial port": "stm32flash 0.7\n\nFailed to open port: /dev/ttyUSB0\n",
    "boot loader does not answer": "Interface serial_posix: 57600 8E1\nFailed to init device, timeout.\n",
    "cannot be opened": "Info : clock speed 1000 kHz\nError: open failed\nin procedure 'init'\n",
}
"""Outputs of openocd and stm32flash that users have reported, each with a part of its explanation."""


@pytest.mark.parametrize("sentence", REPORTED)
def test_known_error_is_explained_with_the_line_that_shows_it(sentence: str) -> None:
    told = explain(REPORTED[sentence])

    assert sentence in told
    assert any(told.endswith(f" ({line})") for line in REPORTED[sentence].splitlines())
    assert [other for other in REPORTED if other in told] == [sentence]


def test_unknown_error_is_reported_by_its_last_line() -> None:
    assert explain("Info : fine\nError: the moon is full\n\n") == "Error: the moon is full"
    assert explain("\n") == "no output"


def test_failed_write_is_reported(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    plan = plan_with(tmp_path, monkeypatch, "echo '** Verify Failed **'; exit 1")
    with pytest.raises(OctetError, match=r"openocd did not write the image \(exit code 1\): \*\* Verify Failed"):
        write(plan)


def test_dry_run_prints_its_steps_and_calls_nothing(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    called = tmp_path / "called"
    installed(tmp_path, monkeypatch, stm32flash=f"touch {called}")
    image = image_file(tmp_path, "blue_pill", "stm32f103")
    options = (f"--image={image}", "--probe=serial:/dev/null", "--dry-run")

    result = flash("blue_pill", "bxcan", *options)

    assert [line.split()[0] for line in result.stdout.splitlines()] == ["image", "robot", "board", "check", "write"]
    assert not called.exists()


def test_flash_writes_nothing_to_another_chip(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    calls = tmp_path / "calls"
    installed(tmp_path, monkeypatch, stm32flash=f"echo $* >>{calls}; echo 'Device ID    : 0x0413 (STM32F40xxx)'")
    image = image_file(tmp_path, "blue_pill", "stm32f103")

    result = flash("blue_pill", "bxcan", f"--image={image}", "--probe=serial:/dev/null")

    assert (result.returncode, len(calls.read_text().splitlines())) == (1, 1), result.stderr
    assert "the chip behind the probe is 0x413, not stm32f103 (0x410)" in result.stderr


def test_dry_run_needs_no_probe(tmp_path: Path) -> None:
    image = image_file(tmp_path, "blue_pill", "stm32f103")

    result = flash("blue_pill", "bxcan", f"--image={image}", "--dry-run", "--probe=jlink")

    assert result.returncode == 0
    assert "openocd -f interface/jlink.cfg" in result.stdout


@pytest.mark.parametrize(("words", "names"), [(["nucleo"], "nucleo_g431rb"), (["blue_pill"], "bxcan, slcan, pins")])
def test_incomplete_board_or_missing_link_is_answered_with_the_choices(words: list[str], names: str) -> None:
    result = flash(*words)

    assert (result.returncode, result.stderr.count("\n")) == (2, 1)
    assert names in result.stderr


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ("nucleo bxcan", "nucleo_g431rb"),
        ("blue_pill fdcan", "there are bxcan"),
        ("blue_pill bxcan --image tools/flash", "is not an Octet image"),
    ],
)
def test_wrong_choice_prints_one_line_and_ends_with_2(words: str, said: str) -> None:
    result = flash(*words.split())
    assert (result.returncode, result.stdout, result.stderr.count("\n")) == (2, "", 1)
    assert said in result.stderr


@pytest.mark.parametrize("option", ["--node=2", "--bitrate=125000", "--profile=mine.c"])
def test_image_built_earlier_refuses_options_of_a_build(option: str) -> None:
    result = flash("blue_pill", "bxcan", "--image=octet.elf", option)

    assert result.returncode == 2
    assert "leave out --node and --bitrate, and --profile" in result.stderr


def drive(
    folder: Path, name: str, about: str = "UF2 Bootloader v3.0\nModel: Raspberry Pi RP2\nBoard-ID: RPI-RP2\n"
) -> Path:
    """A mounted drive; the second line of `about` is what the RP2040's boot ROM says of itself."""
    made = folder / name
    made.mkdir()
    (made / "INFO_UF2.TXT").write_text(about)
    with (folder / "mounts").open("a") as mounts:
        mounts.write(f"/dev/sda1 {str(made).replace(' ', chr(92) + '040')} vfat rw 0 0\n")
    return made


def test_pico_is_found_among_other_drives_and_gets_its_image(tmp_path: Path) -> None:
    drive(tmp_path, "other", "Board-ID: SAMD21G18A-Feather-v0\n")
    pico = drive(tmp_path, "RPI RP2")
    uf2 = tmp_path / "octet-pico-slcan.uf2"
    uf2.write_bytes(b"blocks")

    found = find_drive(tmp_path / "mounts")
    write_to_drive(uf2, found)

    assert found == pico
    assert (pico / uf2.name).read_bytes() == b"blocks"


def test_missing_pico_is_reported_with_the_button_to_hold(tmp_path: Path) -> None:
    with pytest.raises(OctetError, match="hold the Pico's BOOTSEL button while you plug in its USB cable"):
        find_drive(tmp_path / "mounts")


def test_several_picos_are_named(tmp_path: Path) -> None:
    drive(tmp_path, "one"), drive(tmp_path, "two")
    with pytest.raises(OctetError, match=r"several Picos .*one, .*two: unplug all but one"):
        find_drive(tmp_path / "mounts")


def test_pico_unplugged_during_the_copy_is_reported(tmp_path: Path) -> None:
    (tmp_path / "some.uf2").touch()
    with pytest.raises(OctetError, match=r"cannot copy .*some.uf2 to .*gone \(No such file or directory\): hold"):
        write_to_drive(tmp_path / "some.uf2", tmp_path / "gone")


def test_pico_without_a_drive_ends_with_one_line(tmp_path: Path) -> None:
    image = image_file(tmp_path, "pico", "rp2040")
    image.with_suffix(".uf2").touch()

    dry = flash("pico", "slcan", f"--image={image}", "--dry-run")
    result = flash("pico", "slcan", f"--image={image}")

    assert [line.split()[0] for line in dry.stdout.splitlines()] == ["image", "robot", "board", "copy"]
    assert (result.returncode, result.stdout, result.stderr.count("\n")) == (1, "", 1)


def test_pico_takes_a_probe_but_no_serial_port() -> None:
    image = image_for("rp2040")
    assert "target/rp2040.cfg" in make_plan(image, Probe("cmsis-dap", ""), has=bool).write
    with pytest.raises(OctetError, match="no boot loader on a serial port"):
        make_plan(image, Probe("serial", "/dev/null"), has=bool)


def test_faulty_behaviour_is_not_flashed(tmp_path: Path) -> None:
    text = (ROOT / "host_sim/program/own/mine.c").read_text()
    (tmp_path / "mine.c").write_text(text.replace("brain->awaits = NOTHING;", "brain->own[pattern + 8] = 1;"))

    done = flash("blue_pill", "bxcan", "--dry-run", "--profile", str(tmp_path / "mine.c"))

    assert done.returncode == 2
    assert "index 8 is outside of 'uint8_t [8]', at tick 0" in done.stderr
    assert done.stderr.endswith("it has to drive a simulated robot for a minute first\n")
