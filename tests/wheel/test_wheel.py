"""The wheel for this system does all that a checkout does, from a folder that it does not write to."""

import json
import os
import re
import shlex
import shutil
import signal
import subprocess
import sys
import sysconfig
from collections.abc import Callable
from pathlib import Path
from urllib.request import HTTPCookieProcessor, build_opener
from zipfile import ZipFile

import pytest

from host_sim.cli.main import parser_of
from host_sim.client.frame_log import digest_of
from tests.runs.support import octet_process, unpacked
from tests.web.sim.page_runs import experiment, run_in_page

ROOT = Path(__file__).resolve().parents[2]
PLAN = """\
profiles = ["article", "never"]
seeds = 2
environments = 1
limit_s = 5
"""
RUN = "run --environments 1 --limit-s 20 --quiet"
USES = {
    "calibrate": "calibrate --robot emulated",
    "campaign": "campaign --repeat 'article none lockstep seed=12 limit=8 fault=drop:30%'",
    "class": "class --port 0",
    "check": f"check --robot-command 'python3 {ROOT}/examples/robot/robot.py'",
    "compare": "compare article never --seeds 2 --environments 1",
    "dbc": "dbc --nodes 1-8",
    "export": "export out/run.log --csv run.csv --mf4 run.mf4 --parquet run.parquet",
    "page": "page octet.html",
    "picture": "picture out/run.log --png run.png",
    "replay": "replay out/run.log --html run.html --what-if",
    "run": "run --environments 1 --limit-s 5 --robot emulated --quiet --out emulated",
    "study": "study plan.toml",
    "talk": "talk",
    "tune": "tune --only turn_deg --environments 1 --limit-s 5 --trials 8 --seeds 3 --held-out 2",
    "watch": "watch --port 0 --environments 1 --limit-s 5",
    "world": "world corridors --png corridors.png",
}
"""A use of each command; those that serve have a test of their own."""
SERVING = ("class", "watch")


NOT_NEEDED = (
    "aiohttp PIL numpy unicorn gymnasium pettingzoo pyarrow matplotlib distributed asammdf ifaddr segno pymunk cmaes"
)
"""Libraries that only some commands load."""


def commands() -> set[str]:
    groups = parser_of([])._subparsers._group_actions
    return {name for action in groups for name in action.choices}


IN_A_CHECKOUT = {"debug", "grade", "new"}
"""The commands that need the sources."""


def test_uses_cover_each_command():
    assert commands() == set(USES) | IN_A_CHECKOUT | {"check-wiring"}


def test_behaviour_in_c_needs_a_checkout(octet, tmp_path):
    done = octet("new", "mine.c")

    assert (done.returncode, (tmp_path / "mine.c").exists()) == (1, False)
    assert "need a checkout of Octet with gcc" in done.stderr


def test_check_wiring_names_a_missing_port(octet):
    done = octet("check-wiring", "nowhere")

    assert (done.returncode, done.stderr) == (2, "octet: cannot open nowhere: No such file or directory\n")


def test_debug_needs_a_checkout(octet):
    octet(*RUN.split())

    done = octet("debug", "out/run.log")

    assert done.returncode == 1
    assert "octet-debug is not built: this wheel was built without it" in done.stderr


@pytest.mark.parametrize("name", sorted({*USES} - {*SERVING}))
def test_command_of_the_wheel_succeeds_and_names_no_tool_of_a_checkout(name, octet, tmp_path):
    (tmp_path / "plan.toml").write_text(PLAN)
    assert "tools/" not in octet(*RUN.split()[:-1]).stdout

    done = octet(*shlex.split(USES[name]), input="")

    assert done.returncode == 0, done.stderr
    assert "tools/octet" not in done.stdout + done.stderr or name == "protocol"


def test_run_of_the_wheel_has_the_log_digest_of_the_checkout(octet, tmp_path):
    octet(*RUN.split(), "--out", "here")
    octet_process(*RUN.split(), "--out", tmp_path / "there").check_returncode()

    one, other = (json.loads((tmp_path / it / "summary.json").read_text()) for it in ("here", "there"))

    assert one["log_sha256"] == other["log_sha256"]


@pytest.mark.parametrize("name", SERVING)
def test_command_of_the_wheel_serves_its_page(name, environment, tmp_path):
    command, browser = [environment / "bin/octet", *USES[name].split()], build_opener(HTTPCookieProcessor())
    with subprocess.Popen(command, cwd=tmp_path, stdout=subprocess.PIPE, text=True) as watched:
        address = next(found[0] for line in watched.stdout if (found := re.search(r"http://\S+", line)))
        page = browser.open(address, timeout=20).read().decode()
        watched.send_signal(signal.SIGINT)
        watched.wait(30)

    assert 'id="arena' in unpacked(page)


def test_api_has_the_name_of_the_project(environment, tmp_path):
    program = "import octet_robot as it; print(len(it.run(it.RunConfig(environments=1, limit_s=1)).log_sha256))"

    done = subprocess.check_output([environment / "bin/python", "-c", program], cwd=tmp_path, text=True)

    assert done == "64\n"


@pytest.fixture
def bare(environment, tmp_path) -> Callable[..., subprocess.CompletedProcess[str]]:
    """Runs the command of the wheel without the libraries of its extras."""
    (tmp_path / "plan.toml").write_text(PLAN)
    loads = "import sys; sys.modules.update(dict.fromkeys(sys.argv.pop(1).split()))"
    program = f"{loads}; from host_sim.__main__ import main; sys.exit(main())"

    def call(*words: str) -> subprocess.CompletedProcess[str]:
        command = [environment / "bin/python", "-c", program, NOT_NEEDED, *words]
        return subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)

    return call


def install(environment: Path, extra: str) -> str:
    return f"not installed: run {environment}/bin/python -m pip install 'octet-robot[{extra}]'\n"


def test_run_needs_no_extra(bare, environment):
    ran = bare(*RUN.split()[:-1])

    assert (ran.returncode, ran.stderr) == (0, "")
    assert f"left out  arena.png: this needs pillow, which is {install(environment, 'picture')}" in ran.stdout
    assert bare("page", "octet.html").returncode == 0
    assert bare("world", "corridors").returncode == 0


@pytest.mark.parametrize(
    ("words", "packages", "extra"),
    [
        ("run --robots 40 --quiet", "numpy and pillow", "fleet"),
        ("run --physics pymunk --quiet", "pymunk", "pymunk"),
        ("run --robot emulated --quiet", "unicorn", "emulator"),
        ("watch", "aiohttp, ifaddr, pillow and segno", "watch"),
        ("class", "aiohttp, ifaddr, pillow and segno", "watch"),
        ("compare article never --seeds 2 --environments 1", "numpy and pillow", "fleet"),
        ("study plan.toml", "cmaes, matplotlib, numpy and pyarrow", "study"),
        ("export out/run.log --parquet run.parquet", "asammdf, numpy and pyarrow", "export"),
    ],
)
def test_refusal_names_all_missing_packages_and_one_extra(words, packages, extra, bare, environment):
    bare(*RUN.split())

    refused = bare(*words.split())

    assert refused.returncode in {1, 2}
    verb = "are" if " and " in packages else "is"
    assert refused.stderr == f"octet: this needs {packages}, which {verb} {install(environment, extra)}"


def test_commands_write_nothing_beside_the_program(environment, octet):
    before = {path: path.stat().st_mtime_ns for path in environment.rglob("*") if path.suffix != ".pyc"}

    octet(*RUN.split())
    octet("page", "octet.html")

    after = {path: path.stat().st_mtime_ns for path in environment.rglob("*") if path.suffix != ".pyc"}
    folders = {path for path in {*before, *after} if path.name == "__pycache__" or path.is_dir()}
    assert {**after, **dict.fromkeys(folders)} == {**before, **dict.fromkeys(folders)}


def test_unwritable_home_stops_no_run(octet):
    nowhere = {**os.environ, "HOME": "/dev/null", "XDG_STATE_HOME": "/dev/null"}

    assert octet(*RUN.split(), env=nowhere).stderr == ""


def test_different_versions_work_side_by_side(wheel, tmp_path):
    def version(name: str) -> str:
        variables = {
            **os.environ,
            "PYTHONPATH": os.pathsep.join((str(tmp_path / name), sysconfig.get_path("purelib"))),
        }
        command = [sys.executable, "-m", "host_sim", "--version"]
        return subprocess.check_output(command, cwd=tmp_path, env=variables, text=True)

    for name in ("new", "old"):
        shutil.unpack_archive(wheel, tmp_path / name, "zip")
    about = tmp_path / "old/host_sim/tree/pyproject.toml"
    about.write_text(about.read_text().replace('version = "1.0"', 'version = "0.9"'))

    assert "1.0" in version("new")
    assert "0.9" in version("old")


def test_pip_refuses_a_wheel_for_another_system(wheel, tmp_path):
    other = shutil.copy(wheel, tmp_path / "octet_robot-1.0-py3-none-win_amd64.whl")
    command = [sys.executable, "-m", "pip", "install", "--no-index", "--no-deps", "--target", tmp_path / "in", other]

    done = subprocess.run(command, capture_output=True, text=True, check=False)

    assert done.returncode == 1
    assert "is not a supported wheel on this platform" in done.stderr


def test_commands_of_the_python_page_write_what_it_says(wheel, tmp_path):
    page = (ROOT / "docs/python.md").read_text()
    (block,) = re.findall(r"^```sh from-a-wheel\n(.*?)^```$", page, re.DOTALL | re.MULTILINE)
    shutil.copy(wheel, tmp_path)
    libraries = sysconfig.get_path("purelib")
    alone = {
        **os.environ,
        "PIP_NO_DEPS": "1",
        "PIP_NO_INDEX": "1",
        "PIP_IGNORE_INSTALLED": "1",
        "PYTHONPATH": libraries,
    }

    subprocess.run(["bash", "-ec", block], cwd=tmp_path, env=alone, check=True)

    assert (tmp_path / "out/replay.html").exists()
    assert (tmp_path / "octet.html").exists()


def test_wheel_is_small_and_has_man_pages_and_completions(wheel, environment):
    assert wheel.stat().st_size < 1_800_000
    page = (environment / "share/man/man1/octet-run.1").read_text()
    assert "tools/" not in page.replace("host_sim/tree/tools", "")
    script = environment / "share/bash-completion/completions/octet"
    subprocess.run(["bash", "-n", script], check=True)
    assert "--environments" in script.read_text()


SEEDS, LIMIT_S = (1, 2, 3), 20
PROGRAM = f"""
from host_sim.cli.main import main
for seed in {SEEDS}:
    main(["run", "--bus", "none", "--environments", "2", "--limit-s", "{LIMIT_S}", "--json", "--seed", str(seed)])
"""


def digests(site: Path, cwd: Path) -> list[str]:
    """Those of the runs of the packages in a folder."""
    variables = {**os.environ, "PYTHONPATH": str(site)}
    said = subprocess.check_output([sys.executable, "-c", PROGRAM], cwd=cwd, env=variables, text=True)
    return re.findall(r'"log_sha256": "(\w+)"', said)


def test_runs_of_the_wheel_have_the_log_digests_of_the_checkout(wheel: Path, tmp_path: Path):
    site = tmp_path / "site"
    with ZipFile(wheel) as files:
        files.extractall(site)

    ours = digests(ROOT, tmp_path)

    assert digests(site, tmp_path) == ours
    assert len(set(ours)) == len(SEEDS)


def test_runs_of_the_page_have_the_log_digests_of_the_checkout(tmp_path: Path):
    runs = run_in_page(tmp_path, *(experiment("article", seed, limit_ticks=LIMIT_S * 50) for seed in SEEDS))

    assert [digest_of(run["log"].encode("latin1")) for run in runs] == digests(ROOT, tmp_path)


COMMANDS = """
import json
from host_sim.cli.main import parser_of

parser = parser_of([])
found = {}
for name, it in {"": parser, **parser._subparsers._group_actions[0].choices}.items():
    shown = [action for action in it._actions if action.help != "==SUPPRESS=="]
    found[name] = [flag for action in shown for flag in action.option_strings]
print(json.dumps(found))
"""
COMPLETIONS = {
    "bash": "bash-completion/completions/octet",
    "fish": "fish/vendor_completions.d/octet.fish",
    "zsh": "zsh/site-functions/_octet",
}


@pytest.fixture(scope="module")
def options_of_commands(environment) -> dict[str, list[str]]:
    """The options of each command, by its name; those of `octet` itself have none."""
    done = subprocess.run([environment / "bin/python", "-c", COMMANDS], capture_output=True, text=True, check=True)
    return json.loads(done.stdout)


def options_of_page(page: str) -> set[str]:
    """The options that a man page explains."""
    plain = page.replace("\\-", "-")
    heads = re.findall(r"^\.TP\n(\\fB-.*)$", plain, re.MULTILINE)
    return {flag for head in heads for flag in re.findall(r"\\fB(--?[\w-]+)\\fR", head)}


def missing_from(script: str, shell: str, options_of_commands: dict[str, list[str]]) -> set[str]:
    """The commands and long options that a completion does not know."""
    words = set(re.findall(r"[\w-]+", script))
    flags = {flag for options in options_of_commands.values() for flag in options if flag.startswith("--")}
    wanted = {flag[2:] if shell == "fish" else flag for flag in flags} | {*options_of_commands} - {""}
    return wanted - words


def test_man_pages_explain_the_options_of_each_command_and_no_other(environment: Path, options_of_commands):
    pages = {path.stem: path.read_text() for path in (environment / "share/man/man1").glob("octet*.1")}

    assert len(options_of_commands) > 15
    assert {name: options_of_page(page) for name, page in pages.items()} == {
        f"octet-{name}".rstrip("-"): set(options) for name, options in options_of_commands.items()
    }


def test_option_in_an_example_of_a_man_page_is_not_explained():
    page = ".TP\n\\fB\\-h\\fR, \\fB\\-\\-help\\fR\nshow it\n.TP\noctet run \\fB\\-\\-robots\\fR 3\nthree robots\n"

    assert options_of_page(page) == {"-h", "--help"}


@pytest.mark.parametrize("shell", COMPLETIONS)
def test_completions_know_each_command_and_each_option(environment: Path, options_of_commands, shell):
    script = (environment / "share" / COMPLETIONS[shell]).read_text()

    assert missing_from(script, shell, options_of_commands) == set()
    assert missing_from(script, shell, {"x": ["--no-such-option"]}) != set()
