"""The page's modules outside a page: bundled by esbuild as the pages are, in Node with the very WebAssembly."""

import json
import subprocess
from pathlib import Path
from typing import Any

from host_sim.base.paths import PAGE_WASM, WEB

RUN_IN_NODE = Path(__file__).with_name("run_in_node.js")


def bundle(*modules: str) -> str:
    """Modules, by their paths in `web/`, as one script that defines `modules`, their exports by their paths."""
    imports = [f'import * as m{i} from "./{module}";\n' for i, module in enumerate(modules)]
    exports = ", ".join(f'"{module}": m{i}' for i, module in enumerate(modules))
    command = ("esbuild", "--bundle", "--format=iife", "--global-name=bundle", "--loader=ts", "--target=es2022")
    entry = f"{''.join(imports)}export const modules = {{ {exports} }};\n"
    done = subprocess.run(command, input=entry, cwd=WEB, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return f"{done.stdout}const {{ modules }} = bundle;\n"


def with_modules(code: str, *modules: str) -> str:
    """A function for a page to evaluate: a function of (modules, asked), with a copy of these modules."""
    return f"(asked) => {{\n{bundle(*modules)}return ({code})(modules, asked);\n}}"


def in_node(folder: Path, module: str, code: str, *files: Path) -> Any:
    """What a piece of JavaScript returns; see `run_in_node.js`.

    Args:
        folder: Where the bundle is written.
        module: The module that the code uses; several with spaces between them.
        code: The body of a function of (modules, page, texts).
        files: Files whose texts the code wants.
    """
    script = folder / "modules.bundle"
    script.write_text(bundle(*module.split()))
    done = subprocess.run(
        ["node", RUN_IN_NODE, script, PAGE_WASM, code, *files], capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)
