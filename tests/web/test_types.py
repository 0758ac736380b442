"""The pages' modules pass the TypeScript compiler, and their types are those of what the server sends."""

import json
import re
import shutil
import subprocess
from pathlib import Path

from host_sim.base.paths import WEB
from tests.web.support import run_in

TYPES = WEB / "types.ts"
TEXT = TYPES.read_text() + (WEB / "generated_types.ts").read_text()
FAULTS = {
    "a type error": ("TS2322", "export const tick: number = 'one';\n"),
    "an unused variable": ("TS6133", "const unused = 1;\n"),
    "an unused parameter": ("TS6133", "export function f(unused: number) {}\n"),
    "a parameter without a type": ("TS7006", "export function f(x) {\n  return x;\n}\n"),
    "a misspelt property": (
        "TS2551",
        'import type { State } from "./generated_types.js";\nexport const f = (state: State) => state.beakon;\n',
    ),
    "a type that does not exist": (
        "TS2724",
        'import type { Stat } from "./generated_types.js";\nexport const f = (state: Stat) => state;\n',
    ),
    "a path without a result": ("TS7030", "export function f(x: number) {\n  if (x) return 1;\n}\n"),
    "a case that falls through": (
        "TS7029",
        "export function f(x: number) {\n  switch (x) {\n    case 1:\n      x += 1;\n"
        "    default:\n      return x;\n  }\n}\n",
    ),
}


def check(folder: Path) -> subprocess.CompletedProcess[str]:
    return subprocess.run(["tsc", "-p", "."], cwd=folder, capture_output=True, text=True, check=False)


def test_modules_pass_the_type_checker():
    done = check(WEB)

    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")


def test_type_checker_finds_every_planted_fault(tmp_path):
    for part in (TYPES, WEB / "generated_types.ts", WEB / "tsconfig.json", WEB / "browser.d.ts"):
        shutil.copy(part, tmp_path)
    for name, (_, text) in FAULTS.items():
        (tmp_path / f"{name}.ts").write_text(text)

    done = check(tmp_path)

    assert done.returncode != 0
    found = re.findall(r"^(.+)\.ts\(\d+,\d+\): error (\w+):", done.stdout, re.MULTILINE)
    assert sorted(found) == sorted((name, code) for name, (code, _) in FAULTS.items())


def test_modules_suppress_no_finding():
    said = re.compile(r"@ts-(?:ignore|nocheck|expect-error)|\bas any\b|\w: any(?:[,)]| =)|\bany\[\]")

    assert [path.name for path in WEB.rglob("*.ts") if said.search(path.read_text())] == []


def interfaces(text: str) -> dict[str, dict[str, str]]:
    """For each interface of a module its properties and their types; optional ones end with a question mark."""
    found = re.findall(r"^(?:export )?interface (\w+) \{\n(.*?)^\}", text, re.DOTALL | re.MULTILINE)
    return {name: dict(re.findall(r"^  (\w+\??): (.+);$", body, re.MULTILINE)) for name, body in found}


def test_type_of_a_recorded_run_matches_its_page(recorded):
    run, found = run_in(recorded), interfaces(TEXT)

    assert {*run, "shown"} == {name.removesuffix("?") for name in found["Run"]}  # few name the tick to open at
    assert set(run["robots"][0]) == set(found["RobotRun"])


def test_type_of_a_message_matches_what_a_live_run_sends(watch, open_page):
    page = open_page(watch().url)
    first, later = page.evaluate(
        """() => new Promise((resolve) => {
          const seen = [];
          const socket = new WebSocket(`ws://${location.host}/live${location.search}`);
          socket.onmessage = ({ data }) => {
            seen.push(data);
            if (seen.length === 2) resolve(seen);
          };
        })"""
    )
    found = interfaces(TEXT)
    optional = {name.removesuffix("?") for name in found["Message"] if name.endswith("?")}

    assert set(json.loads(later)) == set(found["Message"]) - {f"{name}?" for name in optional}
    assert set(json.loads(first)) | {"notes", "answers"} == {name.removesuffix("?") for name in found["Message"]}
    for part, name in (
        ("play", "Play"),
        ("health", "Health"),
        ("measures", "Measures"),
        ("environment", "EnvironmentScene"),
    ):
        assert set(json.loads(first)[part]) == {key for key in found[name] if not key.endswith("?")}
