"""Builds the distribution, which includes the modules of host_sim that the plug-in needs, in its own package."""

import re
from pathlib import Path

from setuptools import setup
from setuptools.command.build_py import build_py

HERE = Path(__file__).resolve().parent
HOST_SIM = HERE.parents[1] / "host_sim"
TAKEN = (
    *("base/errors", "base/files", "base/system"),
    *(f"transport/{name}" for name in ("bus_link", "bus_process", "faulty_link", "link")),
    *("transport/rule", "transport/socket_pair", "transport/socket_pair_bus"),
)


class BuildPy(build_py):
    """The build_py of setuptools, with the TAKEN modules."""

    def run(self) -> None:
        """As in `build_py`."""
        super().run()
        top = Path(self.build_lib) / "pytest_canbench"
        for name in TAKEN:
            file = top / f"{name}.py"
            file.parent.mkdir(exist_ok=True)
            (file.parent / "__init__.py").touch()
            file.write_text((HOST_SIM / f"{name}.py").read_text())
        for file in top.rglob("*.py"):
            file.write_text(re.sub(r"\bhost_sim(?=\.(base|transport))", "pytest_canbench", file.read_text()))
        (top / "setup.py").unlink()


setup(cmdclass={"build_py": BuildPy})
