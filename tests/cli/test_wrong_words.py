"""Whatever is typed wrong gets one line that says what to do, and exit code 2; nothing is written."""

import re
from pathlib import Path

import pytest

from tests.runs.support import ROOT, octet

WRONG = {
    "rnu": "did you mean run?",
    "dance": "choose from calibrate, campaign, check, check-wiring, class, compare",
    "--verbose": "see tools/octet --help",
    "run --warp 9": "see tools/octet run --help",
    "run --profle fixed": "did you mean --profile?",
    "run --see 2": "did you mean --seed?",
    "run run": "unrecognized arguments: run; see",
    "run --profile articel": "did you mean article?",
    "run --profile genius": "choose from article, fixed, never",
    "run --seed x": "'x' is not a number from 0 to 4294967295",
    "run --seed 4294967296": "from 0 to 4294967295",
    "run --seed -1": "'-1' is not a number from 0",
    "run --environments 0": "from 1 to 1000",
    "run --limit-s nan": "'nan' is not a number from 0.02",
    "run --robots 0": "from 1 to 100000",
    "run --robots 2 --node 31 --bus none": "the last is 31",
    "run --robots 32 --bus fd": "leave --bus fd out",
    "run --robots 40 --port 8139": "leave --port out",
    "run --robots 40 --robot qemu": "leave --robot out",
    "run --robots 40 --watch": "run it unwatched",
    "run --robots 2 --robot qemu": "leave out --node and --robots",
    "run --node 32": "from 1 to 31",
    "run --owner 0": "from 1 to 255",
    "run --set colour=3": "choose from turn_deg, trial_deg",
    "run --set turn_dg=3": "did you mean turn_deg?",
    "run --set turn_deg": "write --set turn_deg=VALUE, a whole number from 1 to 180 deg",
    "run --set turn_deg=": "a whole number from 1 to 180 deg, not ''",
    "run --set turn_deg=999": "a whole number from 1 to 180 deg, not '999'",
    "run --set": "expected one argument",
    "run --world corridorz": "did you mean corridors?",
    "run --world moon": "or name a file ending in .toml",
    "run --body kitt": "did you mean kit?, or name a file",
    "run --worlds hal": "did you mean hall?",
    "run --physics fats": "did you mean fast?",
    "run --change plnt@20s": "did you mean plant?",
    "run --change explode@20s": "choose from plant, grow",
    "run --fault dorp": "did you mean drop?",
    "run --fault @nowhere": "cannot read nowhere",
    "run --bus socketcan": "INTERFACE:CHANNEL such as socketcan:vcan0",
    "run --bus carrier:pigeon --robot external": "cannot open the bus carrier:pigeon",
    "run --bus carrier:pigeon": "use --robot external",
    "run --bus slcan:/dev/nowhere --robot external": "/dev/nowhere",
    "run --bus fd --robot external": "--bus INTERFACE:CHANNEL",
    "run --robot emulated --board blue_pil": "did you mean blue_pill?",
    "run --board blue_pill": "leave --board out",
    "run --bitrate 9600": "choose from 125000, 250000",
    "run --bitrate fast": "choose from 125000, 250000",
    "run --bitrate 250000": "leave --bitrate out",
    "run --bus socketcan:can0 --bitrate 250000": "leave --bitrate out",
    "run --listen": "add --watch, or leave --listen out",
    "run --port 8139": "leave --port out",
    "run --port 99999": "from 0 to 65535",
    "run --memory=": "the file name is empty",
    "run --out=": "the file name is empty",
    "run --bus none --memory {out}/loop": "loop",
    "watch --terminal --listen": "leave --terminal out",
    "watch --listen 300.1.1.1 --port 0": "choose another with --port or --listen",
    "replay": "required: RUN.LOG; see tools/octet replay --help",
    "replay README.md": "README.md",
    "replay nowhere.log": "there is no file nowhere.log: tools/run writes out/run.log",
    "replay docs": "cannot read docs: it is a folder, not a file",
    "replay README.md --html {out}/a.html": "README.md",
    "replay {log} --html {out}/loop": "is a link to itself",
    "replay {log} --node 9": "has no heartbeat of node 9",
    "picture {log}": "give --gif FILE",
    "picture {log} --gif {out}/a.gif --from 9 --to 5": "--to 5 s is before --from 9 s",
    "picture README.md --png {out}/a.png": "README.md",
    "picture {log} --png {out}/a.xyz": "does not end with .png",
    "picture {log} --gif {out}/a.png": "does not end with .gif",
    "picture {log} --png /nowhere/a.png": "there is no folder /nowhere",
    "export {log}": "give --csv FILE",
    "export {log} --cvs a.csv": "did you mean --csv?",
    "export {log} --csv {out}": "it is a folder",
    "export README.md --csv {out}/a.csv": "README.md",
    "world README.md": "choose from random",
    "world random --png {out}/a.xyz": "does not end with .png",
    "talk --script nobody": "give a file, or one of",
    "talk out/run.log": "did you mean --log out/run.log?",
    "run --compress-log=5": "it takes no value",
    "run --profile {out}/none.c": "none.c begins one",
    "grade 4 {out}/none.c": "there is no such file or folder",
    "campaign --repeat nonsense": "is not a run: write PROFILE LINK PACE",
    "talk --at -3": "'-3' is not a number from 0",
    "talk --log nowhere.log": "tools/run writes out/run.log",
    "campaign --shrink=": "'' is not a run: write PROFILE LINK PACE",
    "calibrate --robot emulated --bus fd": "leave --bus out",
    "calibrate trak --robot emulated": "did you mean track?",
    "check-wiring /nowhere/tty": "cannot open /nowhere/tty: No such file or directory\n",
    "check-wiring README.md": "cannot open README.md: it is not a serial port\n",
    "study nowhere.toml": "there is no file nowhere.toml",
    "compare articel": "did you mean article?",
    "compare docs": "docs",
    "compare article --seeds 0": "from 1 to 100000",
    "campaign --html /nowhere/a.html": "there is no folder /nowhere",
    "campaign --html {out}/a.html --links fdd": "did you mean fd?",
    "page": "required: FILE",
    "page /nowhere/a.html": "there is no folder /nowhere",
    "page {out}": "it is a folder",
    "dbc 99": "--nodes --node is required",
    "check": "--robot-command CMD, or --bus INTERFACE:CHANNEL",
    **dict.fromkeys(
        (
            *("replay {long}", "replay {log} --html {long}", "picture {log} --png {long}"),
            *("talk --script {long}", "page {long}", "run --body {long}", "run --change {long}", "compare {long}"),
            "study studies/learned.toml --docs {long}",
        ),
        "File name too long",
    ),
}


@pytest.fixture(scope="module")
def log(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The log of a short run."""
    out = tmp_path_factory.mktemp("short")
    assert octet("run", "--bus", "none", "--environments", "1", "--limit-s", "1", "--out", out).returncode == 0
    return out / "run.log"


@pytest.mark.parametrize("words", WRONG)
def test_wrong_command_line_says_what_to_do_and_writes_nothing(log, tmp_path, monkeypatch, words):
    monkeypatch.chdir(ROOT)
    before = log.read_bytes()
    (tmp_path / "loop").symlink_to("loop")
    out = ["--out", tmp_path] if words.startswith(("run ", "watch ")) and "--out" not in words else []

    done = octet(*words.format(out=tmp_path, log=log, long="x" * 300).split(), *out)

    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.startswith("octet: ")
    assert done.stderr.count("\n") == 1
    assert WRONG[words] in done.stderr
    assert [path.name for path in tmp_path.iterdir()] == ["loop"]
    assert log.read_bytes() == before


@pytest.mark.parametrize("words", [(), ("--help",)])
def test_octet_without_a_command_lists_all_commands_run_first(words):
    done = octet(*words)

    listed = [line.split()[0] for line in done.stdout.splitlines() if line.startswith("  ") and "-" not in line[:4]]
    rooms = (ROOT / "host_sim").glob("**/*_command.py")
    named = {name for file in rooms for name in file.stem.split("_")[:-1]}
    assert done.returncode == 0
    assert listed[:4] == ["run", "watch", "page", "talk"]
    assert {name.replace("-", "") for name in listed} == named


@pytest.mark.parametrize("command", ["run", "watch"])
def test_help_of_run_shows_the_most_used_options(command):
    text = octet(command, "--help").stdout

    options = re.findall(r"\n  (?:-h, )?--([\w-]+)", text)
    assert options[:4] == ["help", "help-all", "environments", "seed"]
    assert len(options) in (15, 16)
    assert "\nexamples:\n" in text
    assert len(text.splitlines()) <= 65


@pytest.mark.parametrize("command", ["run", "watch"])
def test_help_all_of_run_shows_all_options_and_parameters(command):
    text = octet(command, "--help-all").stdout

    options = set(re.findall(r"\n  (?:-h, )?--([\w-]+)", text))
    assert options > set(re.findall(r"\n  (?:-h, )?--([\w-]+)", octet(command, "--help").stdout))
    assert {"bitrate", "late-max", "compress-log"} <= options
    assert "\nparameters for --set:\n" in text


def test_version_option_prints_the_version_of_the_project():
    done = octet("--version")

    assert (done.returncode, done.stdout) == (0, "Octet 1.0\n")
    assert 'version = "1.0"' in (ROOT / "pyproject.toml").read_text()
