"""The words of the pages and of the robot in each language, one file a language: `host_sim/web/texts/CODE.json`.

The templates of the pages are `host_sim/web/NAME.html`; a comment there names what is inserted from `common/`.
"""

import json
import re
from typing import Any

from host_sim.base.paths import WEB

TEXTS = WEB / "texts"
"""Folder of the languages' files."""

_COMMON = re.compile(r"^ *<!-- (common/\w+\.html) -->\n", re.MULTILINE)
_TEXTS = re.compile(r'(<script type="application/json" id="texts" data-parts="([\w ]+)">)</script>')


def languages() -> dict[str, dict[str, Any]]:
    """The words of each language, by its code: the parts that docs/lessons.md explains."""
    files = sorted(TEXTS.glob("*.json"))
    return {path.stem: json.loads(path.read_text(encoding="utf-8")) for path in files}


def with_languages(page: str) -> str:
    """A page with its words in all languages: those parts that its element `texts` names, and those of `noscript`."""
    known = languages()

    def filled(match: re.Match[str]) -> str:
        parts = ["language", *match[2].split()]
        said = {code: {part: words[part] for part in parts if part in words} for code, words in known.items()}
        return f"{match[1]}{as_script(said)}</script>"

    needed = " ".join(words["page"]["needsScript"] for words in known.values())
    return _TEXTS.sub(filled, page).replace("<noscript></noscript>", f"<noscript>{needed}</noscript>")


def as_script(data: object) -> str:
    r"""Data as the text of a script element, each `<` as `\u003c`. An object is written as its attributes."""
    return json.dumps(data, separators=(",", ":"), ensure_ascii=False, default=vars).replace("<", "\\u003c")


def template(name: str) -> str:
    """A template, complete but for its words."""
    return _COMMON.sub(lambda match: _read(match[1]), _read(name))


def _read(name: str) -> str:
    return (WEB / name).read_text(encoding="utf-8")
