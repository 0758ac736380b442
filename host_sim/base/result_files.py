"""Check results as JSON and as JUnit XML, for build servers."""

import json
import re
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple
from xml.etree import ElementTree as ET

from host_sim.base.files import write_bytes

_NOT_IN_XML = re.compile("[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")


_ELEMENTS = {"failed": ("failure", "failures"), "error": ("error", "errors"), "skipped": ("skipped", "skipped")}
"""JUnit's element for a result, and the attribute that counts them; a check that passed has none."""


class Case(NamedTuple):
    """One check.

    Attributes:
        name: Name of the check.
        result: `passed`, `failed`, `error` if it could not be checked, or `skipped`.
        text: Details, such as why it failed.
        seconds: Duration, s; 0 if unknown.
    """

    name: str
    result: str
    text: str = ""
    seconds: float = 0.0


def write_results(suite: str, cases: Sequence[Case], json_path: Path | None, junit_path: Path | None) -> None:
    """Writes the requested files.

    Args:
        suite: Name of the tested object.
        cases: The checks.
        json_path: A list of objects with the fields of `Case`; None for no such file.
        junit_path: A `testsuite`; None for no such file.

    Raises:
        OctetError: A file cannot be written.
    """
    if json_path is not None:
        write_bytes(json_path, (json.dumps([case._asdict() for case in cases], indent=1) + "\n").encode())
    if junit_path is not None:
        write_bytes(junit_path, _junit(suite, cases))


def _junit(suite: str, cases: Sequence[Case]) -> bytes:
    results = [case.result for case in cases]
    counts = {many: results.count(result) for result, (_, many) in _ELEMENTS.items()}
    numbers = {"tests": len(cases), **counts}
    top = ET.Element("testsuite", {"name": suite, **{name: str(number) for name, number in numbers.items()}})
    for case in cases:
        element = ET.SubElement(top, "testcase", classname=suite, name=_text(case.name), time=f"{case.seconds:.3f}")
        if case.result in _ELEMENTS:
            one, lines = _ELEMENTS[case.result][0], _text(case.text)
            ET.SubElement(element, one, message=lines.partition("\n")[0]).text = lines
    return ET.tostring(top, encoding="unicode", xml_declaration=True).encode()


def _text(text: str) -> str:
    return _NOT_IN_XML.sub("?", text)
