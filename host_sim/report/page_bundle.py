"""Pages as single files: a template of `web/` with the files that it refers to inserted.

In the page:
- `<link rel="stylesheet" href="X">` becomes the style sheet;
- `<script type="module" src="X"></script>` becomes a script that runs that module, after all modules that it imports,
  directly or not, each in its own function. An import must be one line, `import { a, b } from "./y.js";`,
  an export the word before a declaration. A module in a folder of `web/` is known by its path from there,
  `folder/y.js`.

Comments on lines of their own, inline types, indentation and empty lines are removed: a third of a page.
"""

import base64
import posixpath
import re
import zlib
from collections.abc import Iterator, Mapping
from functools import cache
from pathlib import Path

from host_sim.base.paths import WEB
from host_sim.talk.languages import as_script, template, with_languages

_STYLE = re.compile(r'<link rel="stylesheet" href="([\w./-]+)">')
_SPACE, _CLOSED = re.compile(r"\s*([{};,])\s*|(?<=\w)(:)\s+"), r"\1\2"
_SCRIPT = re.compile(r'<script type="module" src="([\w./-]+)"></script>')
_NO_SCRIPT = re.compile(r"<noscript>.*?</noscript>", re.DOTALL)
_SIGNS = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz!#$%&()*+-;,=>?@^_`{|}~"
"""The digits of `b85encode`, but for one that would mean something in HTML."""
_UNPACK = """<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<title>Octet</title>
</head>
<body>
NO_SCRIPT
<script type="module">
const signs = "SIGNS";
const text = "DATA";
const view = new DataView(new ArrayBuffer(4 * Math.ceil(text.length / 5)));
for (let i = 0; i < text.length; i += 5) {
  let value = 0;
  for (let j = i; j < i + 5; j += 1) value = 85 * value + (j < text.length ? signs.indexOf(text[j]) : 84);
  view.setUint32((4 * i) / 5, value);
}
if (window.DecompressionStream) {
  const packed = new Blob([view.buffer.slice(0, SIZE)]).stream().pipeThrough(new DecompressionStream("deflate"));
  document.documentElement.innerHTML = await new Response(packed).text();
  const { textContent } = document.querySelector("script[type=module]");
  document.head.append(Object.assign(document.createElement("script"), { type: "module", textContent }));
} else {
  document.body.textContent = "NO_STREAM";
}
</script>
</body>
</html>
"""
"""It writes no new document: after `document.open()`, Chromium captures no pointer."""
_NO_STREAM = "This page needs a newer browser: Chrome or Edge 80, Firefox 113, Safari 16.4."
_IMPORT = re.compile(r'^import (\{[^}]*\}) from "(\.\.?/[\w./-]+)";$', re.MULTILINE)
_COMMENT = re.compile(r"^[ \t]*(?:/\*[^*]*\*+(?:[^/*][^*]*\*+)*/|//[^\n]*)\n", re.MULTILINE)
_NOT_READ = re.compile(r"^\s+|/\*\* @type [^*]*\*/ ?", re.MULTILINE)
_EXPORT = re.compile(r"^export ((?:async )?(?:function\*?|const|let|class) (\w+))", re.MULTILINE)


def page_of(name: str) -> str:
    """A template with its words, its style sheet and its modules inserted."""
    text = _STYLE.sub(
        lambda match: f"<style>\n{_SPACE.sub(_CLOSED, _read(match[1]))}</style>",
        with_languages(_plain(template(name))),
    )
    return _SCRIPT.sub(lambda match: f'<script type="module">\n{bundle(match[1])}</script>', text)


def packed_page(page: str) -> str:
    """A page that unpacks itself: about half as large."""
    data = zlib.compress(page.encode(), 9)
    text = base64.b85encode(data).decode("ascii").replace("<", ",")
    without = {"NO_SCRIPT": "".join(_NO_SCRIPT.findall(page)), "NO_STREAM": _NO_STREAM}
    parts = {"SIGNS": _SIGNS, "SIZE": f"{len(data)}", "DATA": text, **without}
    return re.sub("|".join(parts), lambda match: parts[match[0]], _UNPACK)


def with_data(text: str, element_id: str, data: object) -> str:
    r"""A page whose empty element `<script type="application/json" id="...">` holds data, each `<` as `\u003c`."""
    element = f'<script type="application/json" id="{element_id}"></script>'
    return text.replace(element, element.replace("></", f">{as_script(data)}</"))


def packed(data: bytes | str) -> str:
    """Data, or a text in UTF-8, as base64 of a zlib stream: `inflate` in `core/packed_columns.js` unpacks it."""
    return base64.b64encode(zlib.compress(data.encode() if isinstance(data, str) else data, 9)).decode("ascii")


def bundle(*names: str) -> str:
    """Modules and all that they import, as one script; `</script` is escaped so that it cannot end the element."""
    places = {module: i for i, module in enumerate(modules_of(*names))}
    modules = "".join(_as_function(module, places) for module in places)
    return f"const $ = [];\n{modules}".replace("</script", "<\\/script")


def modules_of(*names: str) -> list[str]:
    """Modules and all that they import, each after its own imports: in a bundle, `$[i]` is the i-th."""
    seen: set[str] = set()
    return [module for name in names for module in _in_order(name, seen)]


def _as_function(name: str, places: Mapping[str, int]) -> str:
    """A module as a function that is called once and returns its exports, which are stored at its index."""
    text = _read(name)
    exported = ", ".join(match[2] for match in _EXPORT.finditer(text))
    body = _IMPORT.sub(lambda match: f"const {match[1]} = $[{places[_place(name, match[2])]}];", text)
    body = _EXPORT.sub(r"\1", body)
    return f"$[{places[name]}] = (() => {{\n{body}\nreturn {{ {exported} }};\n}})();\n"


def _in_order(name: str, seen: set[str]) -> Iterator[str]:
    """A module and the modules that it imports, each after its own imports."""
    if name not in seen:
        seen.add(name)
        for _, needed in _IMPORT.findall(_read(name)):
            yield from _in_order(_place(name, needed), seen)
        yield name


def _place(name: str, needed: str) -> str:
    """The path, relative to `web/`, of a module that another one imports."""
    return posixpath.normpath(posixpath.join(posixpath.dirname(name), needed))


def _read(name: str) -> str:
    return _stripped(WEB / name)


@cache
def _stripped(path: Path) -> str:
    return _plain(path.read_text(encoding="utf-8"))


def _plain(text: str) -> str:
    """A text without what no browser reads."""
    return _NOT_READ.sub("", _COMMENT.sub("", text))
