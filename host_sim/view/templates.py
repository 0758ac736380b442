"""The templates of the pages: `host_sim/web/NAME.html`, where a comment names what is inserted from `common/`."""

import re

from host_sim.base.paths import WEB

_COMMON = re.compile(r"^ *<!-- (common/\w+\.html) -->\n", re.MULTILINE)


def template(name: str) -> str:
    """A template, whole but for its words."""
    return _COMMON.sub(lambda match: _read(match[1]), _read(name))


def _read(name: str) -> str:
    return (WEB / name).read_text(encoding="utf-8")
