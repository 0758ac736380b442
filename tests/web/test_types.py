"""The pages' modules pass the TypeScript compiler, and their types are those of what the server sends."""

import json
import re
import shutil
import subprocess
from pathlib import Path

from host_sim.base.paths import WEB
from tests.web.support import run_in

TYPES = WEB / "types.js"
TEXT = TYPES.read_text() + (WEB / "generated_types.js").read_text()
FAULTS = {
    "a type error": ("TS2322", "/** @type {number} */\nexport const tick = 'one';\n"),
    "an unused variable": ("TS6133", "const unused = 1;\n"),
    "an unused parameter": ("TS6133", "export function f(/** @type {number} */ unused) {}\n"),
    "a parameter without a type": ("TS7006", "export function f(x) {\n  return x;\n}\n"),
    "a misspelt property": (
        "TS2551",
        '/** @param {import("./types.js").State} state */\nexport function f(state) {\n  return state.beakon;\n}\n',
    ),
    "a type that does not exist": (
        "TS2694",
        '/** @param {import("./types.js").Stat} state */\nexport function f(state) {\n  return state;\n}\n',
    ),
    "a path without a result": ("TS7030", "export function f(/** @type {number} */ x) {\n  if (x) return 1;\n}\n"),
    "a case that falls through": (
        "TS7029",
        "export function f(/** @type {number} */ x) {\n  switch (x) {\n    case 1:\n      x += 1;\n"
        "    default:\n      return x;\n  }\n}\n",
    ),
}


def check(folder: Path) -> subprocess.CompletedProcess[str]:
    return subprocess.run(["tsc", "-p", "."], cwd=folder, capture_output=True, text=True, check=False)


def test_every_module_passes_the_type_checker():
    done = check(WEB)

    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")


def test_the_type_checker_finds_every_planted_fault(tmp_path):
    for part in (TYPES, WEB / "generated_types.js", WEB / "tsconfig.json", WEB / "browser.d.ts"):
        shutil.copy(part, tmp_path)
    for name, (_, text) in FAULTS.items():
        (tmp_path / f"{name}.js").write_text(f"// @ts-check\n{text}")

    done = check(tmp_path)

    assert done.returncode != 0
    found = re.findall(r"^(.+)\.js\(\d+,\d+\): error (\w+):", done.stdout, re.MULTILINE)
    assert sorted(found) == sorted((name, code) for name, (code, _) in FAULTS.items())


def test_every_module_asks_for_the_check():
    unchecked = {path.name for path in WEB.rglob("*.js") if not path.read_text().startswith("// @ts-check\n")}

    assert unchecked <= {"generated.js"}


def test_no_module_suppresses_a_finding():
    said = re.compile(r"@ts-(?:ignore|nocheck|expect-error)|@type \{(?:any|\*)\}|@param \{(?:any|\*|Object)\}")

    assert [path.name for path in WEB.rglob("*.js") if said.search(path.read_text())] == []


def test_every_type_begins_its_line():
    """The compiler takes a tag behind a text for a part of the text, and the type is any."""
    behind_text = re.compile(r"(?:/\*\*|\n *\*) [^@\n]*[^@\n`]@(?:type|param|returns)\b")

    assert behind_text.search("/** The last one. @type {number} */")
    assert [path.name for path in WEB.rglob("*.js") if behind_text.search(path.read_text())] == []


def typedefs(text: str) -> dict[str, dict[str, str]]:
    """For each object type of a module its properties and their types; optional ones end with a question mark."""
    found = {}
    for block in re.findall(r"/\*\*.*?\*/", text, re.DOTALL):
        if match := re.search(r"@typedef \{Object\} (\w+)", block):
            properties = re.findall(r"@property \{(.+)\} (\[?\w+\]?)", block)
            found[match[1]] = {re.sub(r"\[(\w+)\]", r"\1?", name): kind for kind, name in properties}
    return found


def test_the_typedef_of_a_recorded_run_is_what_its_page_holds(recorded):
    run, found = run_in(recorded), typedefs(TEXT)

    assert {*run, "shown"} == {name.removesuffix("?") for name in found["Run"]}  # few name the tick to open at
    assert set(run["robots"][0]) == set(found["RobotRun"])


def test_the_typedef_of_a_message_is_what_a_live_run_sends(watch, open_page):
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
    found = typedefs(TEXT)
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
