"""tools/setup, with stand-ins for what it calls: .venv, builds, Debian's packages, what a stage needs."""

import os
import re
import shlex
import shutil
import signal
import subprocess
import sys
from importlib.metadata import distributions
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest

from tests.tools.project import EXTRAS, INSTALLERS, ROOT, STAND_IN, Tree


@pytest.fixture
def tree(tmp_path: Path) -> Tree:
    return Tree(tmp_path)


def test_first_call_sets_up_and_names_each_step(tree: Tree) -> None:
    done, calls = tree.setup()
    assert done.returncode == 0
    assert {"python3", "python", "cmake", "esbuild", "ninja"} == set(calls)
    assert [line.split()[1] for line in done.stderr.splitlines()] == ["installing", "registering", "building"]


def test_second_call_only_asks_ninja_and_prints_nothing(tree: Tree) -> None:
    tree.setup()
    done, calls = tree.setup()
    assert calls == ["ninja"]
    assert done.stdout + done.stderr == ""


def test_changed_module_of_the_pages_is_bundled_anew(tree: Tree) -> None:
    tree.setup()
    (tree.folder / "host_sim/web/page.ts").write_text("export const page = 1;\n")

    assert tree.setup()[1] == ["esbuild", "ninja"]
    assert tree.setup()[1] == ["ninja"]


def test_stages_that_only_read_sources_need_no_compiler(tree: Tree) -> None:
    for stage in ("lint", "types"):
        done, calls = tree.setup(stage)
        assert done.returncode == 0
        assert "cmake" not in calls


def test_c_stage_builds_its_tests_and_no_image(tree: Tree) -> None:
    done, _ = tree.setup("c")
    assert done.returncode == 0
    assert tree.built() == ["build/host-san"]
    assert (tree.folder / "build/unity/unity.c").exists()


def test_fetched_source_has_the_time_of_its_fetch(tree: Tree) -> None:
    tree.setup("c")
    began = (tree.folder / "build/setup.lock").stat().st_mtime
    assert (tree.folder / "build/unity/unity.c").stat().st_mtime >= began


def test_warnings_are_errors_from_the_first_stage_of_tests_on(tree: Tree) -> None:
    tree.setup("run")
    assert "OCTET_WERROR" not in tree.calls.read_text()
    tree.setup("c")
    assert tree.calls.read_text().count("cmake -DOCTET_WERROR=ON build/host-san") == 1
    assert "cmake" not in tree.setup("c")[1]


def test_compiler_warning_is_shown_and_stops_nothing(tree: Tree) -> None:
    (tree.bin / "ninja").write_text(STAND_IN + 'echo "[1/2] cc x.c"; echo "x.c:1:5: warning: unused"\n')
    done, _ = tree.setup("run")
    assert done.returncode == 0
    assert done.stderr.splitlines()[-1] == "x.c:1:5: warning: unused"


def test_compilation_is_announced_once_for_each_folder(tree: Tree) -> None:
    tree.setup("images")
    (tree.bin / "ninja").write_text(STAND_IN + 'echo "[1/2] Building x.o"; echo "[2/2] Building y.o"\n')

    done, _ = tree.setup("images")

    said = sorted(line for line in done.stderr.splitlines() if "compiling" in line)  # not what the system lacks
    boards = ("blue_pill", "feather_stm32f405", "host", "nucleo_g431rb", "pico")
    assert said == [f"octet: compiling in build/{board}, which takes a while" for board in boards]


def test_changed_toolchain_file_is_configured_anew(tree: Tree) -> None:
    tree.setup("images")
    (tree.folder / "tools/cmake/wasm32.cmake").write_text("# another one")

    tree.setup("images")

    assert sorted(tree.built()) == ["build/blue_pill", "build/feather_stm32f405", "build/nucleo_g431rb", "build/pico"]


def test_failed_build_fails_the_setup_and_lets_the_others_end(tree: Tree) -> None:
    (tree.bin / "cmake").write_text(STAND_IN + '[ "$2" != build/blue_pill ]\n')
    done, _ = tree.setup("images")
    assert done.returncode == 1
    assert {path.parent.name for path in tree.folder.glob("build/*/stamp")} >= {"host", "nucleo_g431rb"}
    assert not (tree.folder / "build/blue_pill/stamp").exists()


def test_interrupted_setup_is_repaired(tree: Tree) -> None:
    with tree.offline("requirements/run.lock"):
        assert tree.setup()[0].returncode != 0
    done, calls = tree.setup()
    assert done.returncode == 0
    assert calls.count("cmake") == 1


def test_interrupted_compilation_is_not_reported_as_a_failure(tree: Tree) -> None:
    (tree.bin / "ninja").write_text("#!/bin/sh\necho 'ninja: build stopped'\nkill -INT 0\nexit 130\n")
    done = subprocess.run(
        [tree.folder / "tools/setup"],
        cwd="/",
        env={"PATH": f"{tree.bin}:{os.environ['PATH']}", "CALLS": str(tree.calls)},
        start_new_session=True,
        capture_output=True,
        text=True,
        check=False,
    )

    assert done.returncode in (130, -signal.SIGINT)
    assert done.stderr.splitlines()[-1] == "octet: interrupted while compiling"
    assert "failed" not in done.stderr
    assert "build stopped" not in done.stderr


def test_setup_without_a_network_says_what_to_do_and_leaves_nothing(tree: Tree) -> None:
    with tree.offline("requirements/run.lock"):
        done, _ = tree.setup()

    last = (
        "octet: cannot get the Python packages of requirements/run.lock: "
        "pip says why above, usually that there is no network; run this again when that is fixed"
    )
    assert (done.returncode, done.stderr.splitlines()[-1]) == (1, last)
    assert [path.name for path in tree.folder.glob("build/setup.*")] == ["setup.lock"]


def test_moved_folder_is_repaired_without_a_network(tree: Tree) -> None:
    tree.setup()
    tree.folder = tree.folder.rename(tree.folder.with_name("moved"))
    done, calls = tree.setup()
    assert done.returncode == 0
    assert tree.installed() == []
    assert "cmake" in calls


def test_scripts_of_the_venv_run_after_each_move(tree: Tree) -> None:
    for name in ("there", "a tree again", "there"):
        tree.setup()
        script = tree.folder / ".venv/bin/script"
        script.chmod(0o755)
        subprocess.run([script, "word"], env={**os.environ, "CALLS": str(tree.calls)}, check=True)
        assert tree.calls.read_text().splitlines()[-1] == f"python {script} word"
        tree.folder = tree.folder.rename(tree.folder.with_name(name))


def test_changed_lock_file_is_installed(tree: Tree) -> None:
    tree.setup()
    tree.change("requirements/run.lock")
    tree.setup()
    assert tree.installed() == ["requirements/run.lock"]


def test_working_venv_stays_until_the_new_one_is_complete(tree: Tree) -> None:
    tree.setup()
    (tree.folder / ".venv/old").touch()
    tree.change("requirements/run.lock")
    with tree.offline("requirements/run.lock"):
        assert tree.setup()[0].returncode != 0
    assert (tree.folder / ".venv/old").exists()
    assert tree.setup()[0].returncode == 0
    assert not (tree.folder / ".venv/old").exists()


def test_interrupted_swap_of_the_venv_is_undone(tree: Tree) -> None:
    tree.setup()
    (tree.folder / ".venv").rename(tree.folder / ".venv.old")
    tree.setup()
    assert tree.installed() == []
    assert (tree.folder / ".venv").exists()


def test_stage_installs_only_what_it_needs(tree: Tree) -> None:
    tree.setup("emulator")
    assert tree.installed() == ["requirements/run.lock", "requirements/emulator.lock"]
    assert tree.setup("emulator")[1] == ["ninja"]


@pytest.mark.parametrize("name", ["export", "study"])
def test_extra_libraries_have_their_own_folder_and_are_installed_once(tree: Tree, name: str) -> None:
    tree.setup(name)
    assert tree.installed() == ["requirements/run.lock", f"requirements/{name}.lock"]
    (line,) = [line for line in tree.calls.read_text().splitlines() if line.endswith(f" requirements/{name}.lock")]
    assert f" --target build/{name} " in line
    assert tree.setup(name)[1] == ["ninja"]


def test_cluster_stage_installs_studies_too(tree: Tree) -> None:
    tree.setup("cluster")
    first, *both = tree.installed()
    assert first == "requirements/run.lock"
    assert sorted(both) == ["requirements/cluster.lock", "requirements/study.lock"]


def test_later_stage_adds_to_the_installed_ones(tree: Tree) -> None:
    tree.setup("run")
    tree.setup("emulator")
    assert tree.installed() == ["requirements/emulator.lock"]


def test_new_venv_has_the_stages_of_the_old_one(tree: Tree) -> None:
    tree.setup("emulator")
    tree.change("requirements/run.lock")
    tree.setup("run")
    assert tree.installed() == ["requirements/run.lock", "requirements/emulator.lock"]
    assert tree.setup("emulator")[1] == ["ninja"]


@pytest.mark.parametrize("name", ["emulator", "export"])
def test_interrupted_stage_is_resumed(tree: Tree, name: str) -> None:
    with tree.offline(f"requirements/{name}.lock"):
        assert tree.setup(name)[0].returncode != 0
    assert tree.setup("run")[1] == ["ninja"]
    assert tree.setup(name)[0].returncode == 0
    assert tree.installed() == [f"requirements/{name}.lock"]


def test_unknown_stage_is_answered_with_the_known_ones(tree: Tree) -> None:
    done, calls = tree.setup("run", "tets")
    assert done.returncode == 2
    assert calls == []
    assert all(f"{stage}:" in done.stderr for stage in ("run", "images", "emulator", *EXTRAS, "tests", "vcan"))


@pytest.mark.parametrize("word", ["-h", "--help"])
def test_help_lists_the_stages_and_sets_nothing_up(tree: Tree, word: str) -> None:
    done, calls = tree.setup(word)
    assert (done.returncode, done.stderr, calls) == (0, "", [])
    assert "page:" in done.stdout


def test_packages_option_needs_no_venv_and_no_build(tree: Tree) -> None:
    done, calls = tree.setup("--packages", "c")
    assert (done.returncode, set(calls) - {"python3"}) == (0, set())  # python3 is asked whether it can make a venv
    assert not (tree.folder / ".venv").exists()


@pytest.mark.parametrize("words", [(), ("--packages", "c")])
def test_uninstallable_packages_are_named_with_the_command(tree: Tree, words: tuple[str, ...]) -> None:
    for name in ("bash", "cat", "dirname", "env", "flock", "mkdir", "readlink", "rm"):
        (tree.bin / name).symlink_to(str(shutil.which(name)))
    for name in ("cmake", *INSTALLERS):
        (tree.bin / name).unlink()
    done, _ = tree.setup(*words, path=str(tree.bin))
    assert done.returncode != 0
    assert "apt-get install gcc cmake\n" in done.stderr


def test_killed_installation_of_packages_is_repeated_by_the_next_call(tree: Tree) -> None:
    for name in ("bash", "cat", "dirname", "env", "flock", "mkdir", "mktemp", "readlink", "rm", "sed", "cp"):
        (tree.bin / name).symlink_to(str(shutil.which(name)))
    gcc = tree.bin / "gcc"
    half = f'[[ $* != *install* || -e "{gcc}" ]] || {{ cp "$0" "{gcc}"; kill -9 "$PPID"; }}'
    for name, does in {"sudo": 'exec "$@"', "apt-get": half, "apt-cache": "echo gcc", "dpkg": ""}.items():
        (tree.bin / name).write_text(f"{STAND_IN}{does}\n")
        (tree.bin / name).chmod(0o755)

    ended = [tree.setup("--packages", "c", path=str(tree.bin)) for _ in range(3)]

    assert [done.returncode for done, _ in ended] == [-9, 0, 0]
    assert [calls.count("apt-get") for _, calls in ended] == [2, 2, 0]
    assert [done.stderr for done, _ in ended[1:]] == ["octet: installing gcc with apt-get\n", ""]


def test_incomplete_setup_of_another_user_is_reported_with_its_owner(tree: Tree) -> None:
    with TemporaryDirectory() as place:  # whose path, unlike tmp_path's, is open to others
        folder = Path(shutil.copytree(tree.folder / "tools", Path(place) / "tools")).parent
        shutil.copytree(tree.folder / "requirements", folder / "requirements")
        (folder / "build").mkdir()
        (folder / "build/setup.lock").touch(mode=0o444)
        folder.chmod(0o755)
        nobody = ("setpriv", "--reuid=65534", "--regid=65534", "--clear-groups") if os.geteuid() == 0 else ()
        done = subprocess.run([*nobody, folder / "tools/setup"], capture_output=True, text=True, check=False)

    said = (
        r"octet: cannot write to \S+, which is \w+'s, and something is missing there: "
        r"run this as that user, or in a clone of your own\n"
    )
    assert (done.returncode, done.stdout) == (1, "")
    assert re.fullmatch(said, done.stderr)


@pytest.mark.parametrize(("changed", "code"), [("", 0), ("firmware/robot.c", 1)])
def test_setup_of_another_user_can_be_used_while_it_is_complete(tree: Tree, changed: str, code: int) -> None:
    with TemporaryDirectory() as place:  # whose path is open to others
        tree.folder = Path(shutil.move(tree.folder, Path(place) / "a tree"))
        tree.setup()
        if changed:
            (tree.folder / changed).parent.mkdir()
            (tree.folder / changed).touch()
            later_s = (tree.folder / "build/host/compiled").stat().st_mtime + 1
            os.utime(tree.folder / changed, (later_s, later_s))
        for path in (Path(place), tree.folder, *tree.folder.rglob("*")):
            path.chmod(0o555 if path.is_dir() or path.parent.name in {"bin", "tools"} else 0o444)
        nobody = ("setpriv", "--reuid=65534", "--regid=65534", "--clear-groups") if os.geteuid() == 0 else ()
        environment = {"PATH": "/usr/bin:/bin", "CALLS": "/dev/null"}
        command = [*nobody, tree.folder / "tools/setup"]
        done = subprocess.run(command, capture_output=True, text=True, env=environment, check=False)
        for path in (Path(place), tree.folder, *tree.folder.rglob("*")):
            path.chmod(0o755)

    assert (done.returncode, done.stdout) == (code, "")
    assert ("something is missing there" in done.stderr) == bool(changed)


def test_settings_of_pip_that_install_elsewhere_are_ignored(tree: Tree) -> None:
    stand_in = tree.bin / "python3"
    stand_in.write_text(stand_in.read_text() + '[[ "$*" != *install* ]] || env >"$CALLS.env"\n')
    tree.environment = {"PIP_USER": "1", "PIP_TARGET": "/elsewhere", "PIP_CONSTRAINT": "/none", "PIP_CACHE_DIR": "/c"}

    done, _ = tree.setup()

    seen = Path(f"{tree.calls}.env").read_text().splitlines()
    assert done.returncode == 0
    assert sorted(line for line in seen if line.startswith("PIP_")) == [
        "PIP_CACHE_DIR=/c",
        "PIP_CONFIG_FILE=/dev/null",
    ]


def test_tree_registered_under_an_earlier_name_has_one_distribution_again(tree: Tree) -> None:
    tree.setup()
    shutil.rmtree(tree.folder / ".venv/lib")
    packages = tree.folder / ".venv/lib/python3.11/site-packages"
    for name in ("octet-1.0", "octet_robot-0.9", "octet_other-1.0"):
        (packages / f"{name}.dist-info").mkdir(parents=True)
    tree.change("pyproject.toml")

    done, _ = tree.setup()

    (version,) = re.findall(r'^version = "(.+)"$', (ROOT / "pyproject.toml").read_text(), re.MULTILINE)
    assert done.returncode == 0
    assert {path.name for path in packages.glob("*.dist-info")} == {
        f"octet_robot-{version}.dist-info",
        "octet_other-1.0.dist-info",
    }
    (ours,) = distributions(name="octet-robot", path=[os.fspath(packages)])
    assert ours.version == version
    assert ours.entry_points["octet"].group == "can.interface"


def test_python_finds_a_folder_with_umlauts_in_the_c_locale(tmp_path: Path) -> None:
    folder = tmp_path / "\u00fcml\u00e4ut"
    folder.mkdir()
    (folder / "octet_here.py").touch()
    (tmp_path / "site").mkdir()
    lines = (ROOT / "tools/setup").read_text().splitlines()
    written = next(line for line in lines if "sys.path.append" in line).strip().removesuffix(" \\")
    script = f"{written.replace('.venv/bin/python', sys.executable)} {shlex.quote(str(folder))} >site/octet.pth"
    subprocess.run(["bash", "-c", script], cwd=tmp_path, check=True)
    code = f"import site; site.addsitedir({os.fspath(tmp_path / 'site')!r}); import octet_here"

    environment = {**os.environ, "LC_ALL": "C"}
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, env=environment, check=False)

    assert (done.returncode, done.stderr) == (0, "")
