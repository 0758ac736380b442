"""The page's modules in Node: the very bundle that is in the page, with the very WebAssembly."""

import json
import subprocess
from pathlib import Path
from typing import Any

from host_sim.base.paths import PAGE_WASM
from host_sim.report.page_bundle import bundle, modules_of

RUN_IN_NODE = Path(__file__).with_name("run_in_node.js")


def in_node(folder: Path, module: str, code: str, *files: Path) -> Any:
    """What a piece of JavaScript returns; see `run_in_node.js`.

    Args:
        folder: Where the bundle is written.
        module: The module to bundle, with all that it imports; several with spaces between them.
        code: The body of a function of (modules, page, texts).
        files: Files whose texts the code wants.
    """
    script = folder / f"{Path(module).name}.bundle"
    names = {name: i for i, name in enumerate(modules_of(*module.split()))}
    named = ", ".join(f'"{name}": $[{i}]' for name, i in names.items())
    script.write_text(f"{bundle(*module.split())}const modules = Object.assign($, {{ {named} }});\n")
    done = subprocess.run(
        ["node", RUN_IN_NODE, script, PAGE_WASM, code, *files], capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)
