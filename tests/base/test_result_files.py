"""Results as files that build servers read."""

import json
import xml.etree.ElementTree as ET

from host_sim.base.result_files import Case, write_results

CASES = [Case("drives", "passed", seconds=1.5), Case("a<b", "failed", "it \x1bdoes\nnot"), Case("c", "skipped")]


def test_junit_has_a_case_for_each_and_whatever_the_text_can_be_read(tmp_path):
    write_results("robot", CASES, None, tmp_path / "robot.xml")

    suite = ET.parse(tmp_path / "robot.xml").getroot()
    assert {name: suite.get(name) for name in ("name", "tests", "failures", "skipped")} == {
        "name": "robot",
        "tests": "3",
        "failures": "1",
        "skipped": "1",
    }
    assert [case.get("name") for case in suite] == ["drives", "a<b", "c"]
    assert suite[0].get("time") == "1.500"
    assert (suite[1][0].tag, suite[1][0].get("message"), suite[1][0].text) == ("failure", "it ?does", "it ?does\nnot")
    assert suite[2][0].tag == "skipped"


def test_json_has_the_same(tmp_path):
    write_results("robot", CASES, tmp_path / "robot.json", None)

    assert [Case(**case) for case in json.loads((tmp_path / "robot.json").read_text())] == CASES
