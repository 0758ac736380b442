"""Pages as single files: a template of `web/` with the files that it refers to inserted.

In the page:
- `<link rel="stylesheet" href="X">` becomes the style sheet;
- `<script type="module" src="X"></script>` becomes the program that esbuild has made of its modules.

Comments, indentation and empty lines are removed.
"""

import base64
import re
import zlib

from host_sim.base.errors import PageNotBuiltError
from host_sim.base.paths import PAGE_SCRIPTS, WEB
from host_sim.talk.languages import as_script, with_languages

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
const text = "DATA";
function decoded() {
  const digits = new Uint8Array(128);
  [..."SIGNS"].forEach((sign, i) => (digits[sign.charCodeAt(0)] = i));
  const view = new DataView(new ArrayBuffer(4 * Math.ceil(text.length / 5)));
  for (let i = 0; i < text.length; i += 5) {
    let value = 0;
    for (let j = i; j < i + 5; j += 1) value = 85 * value + (j < text.length ? digits[text.charCodeAt(j)] : 84);
    view.setUint32((4 * i) / 5, value);
  }
  return view.buffer.slice(0, SIZE);
}
if (window.DecompressionStream) {
  const packed = new Blob([decoded()]).stream().pipeThrough(new DecompressionStream("deflate"));
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
"""It does not write a new document: after `document.open()`, Chromium captures no pointer."""
_NO_STREAM = "This page needs a newer browser: Chrome or Edge 80, Firefox 113, Safari 16.4."
_COMMENT = re.compile(r"^[ \t]*(?:/\*[^*]*\*+(?:[^/*][^*]*\*+)*/|//[^\n]*)\n", re.MULTILINE)
_INDENTATION = re.compile(r"^\s+", re.MULTILINE)


def page_of(text: str) -> str:
    """A template, with its words, its style sheet and its program inserted.

    Raises:
        PageNotBuiltError: The program is not built.
    """
    text = _STYLE.sub(
        lambda match: f"<style>\n{_SPACE.sub(_CLOSED, _read(match[1]))}</style>", with_languages(_plain(text))
    )
    return _SCRIPT.sub(lambda match: f'<script type="module">\n{script(match[1])}</script>', text)


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
    """Data, or a text in UTF-8, as base64 of a zlib stream: `inflate` in `core/packed_columns.ts` unpacks it."""
    return base64.b64encode(zlib.compress(data.encode() if isinstance(data, str) else data, 9)).decode("ascii")


def script(name: str) -> str:
    """The program of a page, as esbuild has made it; nothing in it ends the element `script` that it is put into.

    Raises:
        PageNotBuiltError: It is not built.
    """
    try:
        return (PAGE_SCRIPTS / name).read_text(encoding="utf-8").replace("</script", "<\\/script")
    except OSError as error:
        raise PageNotBuiltError(
            f"cannot read {PAGE_SCRIPTS / name}: {error.strerror}; build it with tools/setup"
        ) from None


def _plain(text: str) -> str:
    """A text without comments, indentation and empty lines."""
    return _INDENTATION.sub("", _COMMENT.sub("", text))


def _read(name: str) -> str:
    return _plain((WEB / name).read_text(encoding="utf-8"))
