"""The browser is led to the page without its secret in the list of processes."""

import stat
from pathlib import Path
from urllib.parse import unquote, urlsplit

from host_sim.live.browser import open_browser

URL = "http://127.0.0.1:8000/?token=abc&x=1"


def test_browser_gets_the_token_by_a_private_file_removed_afterwards(monkeypatch):
    opened: list[Path] = []

    def browse(address: str) -> bool:
        opened.append(Path(unquote(urlsplit(address).path)))
        assert (urlsplit(address).scheme, "abc" in address) == ("file", False)
        assert stat.S_IMODE(opened[0].stat().st_mode) == 0o600
        assert 'content="0; url=http://127.0.0.1:8000/?token=abc&amp;x=1"' in opened[0].read_text()
        return True

    monkeypatch.setattr("webbrowser.open", browse)
    with open_browser(URL):
        assert opened[0].exists()

    assert not opened[0].exists()
