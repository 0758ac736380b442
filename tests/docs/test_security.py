"""The page on security: each protection that it names is shown by a test that exists."""

import re

from tests.docs.test_docs import ROOT

PAGE = (ROOT / "docs/security.md").read_text()
NAMED = re.compile(r"`(tests/[\w/]+\.(?:py|c))::(test_\w+)`")


def test_each_threat_names_a_test_that_exists():
    rows = [
        line for line in PAGE.splitlines() if line.startswith("| ") and not line.startswith(("| threat", "| ---"))
    ]

    assert len(rows) > 15
    for row in rows:
        ((path, name),) = NAMED.findall(row)
        defined = rf"^(def {name}\(|TEST\({name.removeprefix('test_')}\))"
        assert re.search(defined, (ROOT / path).read_text(), re.MULTILINE), row


def test_the_readme_leads_to_the_page():
    assert "docs/security.md" in (ROOT / "README.md").read_text()
