"""Frama-C, as the proofs call it."""

import subprocess
from collections.abc import Callable
from pathlib import Path

import pytest

from tests.proof.parts import HERE, INCLUDED, ROOT

# The analyser's headers know no ARM: their limits of types are those of any machine with these sizes.
HEADERS = ("-D__FC_MACHDEP_GCC_X86_32", "-funsigned-char")


@pytest.fixture(scope="session")
def frama_c(tmp_path_factory: pytest.TempPathFactory) -> Callable[..., str]:
    """Calls Frama-C for an ARM; returns what it prints."""
    module = tmp_path_factory.mktemp("frama_c") / "arm_eabi.cmxs"
    (source := module.with_suffix(".ml")).write_text((HERE / "arm_eabi.ml").read_text())
    library = subprocess.run(["frama-c", "-print-lib-path"], capture_output=True, text=True, check=True).stdout
    subprocess.run(["ocamlopt", "-shared", "-I", library, "-o", module, source], check=True)
    machine = ("-load-module", module, "-machdep", "arm_eabi")
    preprocessor = f"-cpp-extra-args={' '.join((*HEADERS, *INCLUDED))}"

    def call(*words: str | Path) -> str:
        command = ("frama-c", *machine, preprocessor, *words)
        return subprocess.run(command, capture_output=True, text=True, check=True, cwd=ROOT).stdout

    return call
