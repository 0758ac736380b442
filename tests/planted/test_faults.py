"""The table of faults: each can still be planted."""

from tests.planted.__main__ import ROOT, faults


def test_sixty_faults_have_one_place_and_existing_tests_each():
    assert len(faults()) == 60
    assert [fault for fault in faults() if (ROOT / fault.file).read_text().count(fault.old) != 1] == []
    paths = {fault.tests.partition(" ")[0] for fault in faults() if not fault.file.endswith(".c")}
    assert [path for path in paths if not (ROOT / path).is_file()] == []
