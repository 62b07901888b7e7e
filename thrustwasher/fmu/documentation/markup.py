"""The little of Markdown that the models' own pages use, as HTML."""

import base64
import re
from collections.abc import Iterator
from html import escape
from pathlib import Path

FENCE = "```"
TYPES = {".png": "image/png", ".svg": "image/svg+xml"}


def data_uri(picture: Path) -> str:
    """Return a picture as an address that holds it whole."""
    content = base64.b64encode(picture.read_bytes()).decode("ascii")
    return f"data:{TYPES[picture.suffix]};base64,{content}"


def markup(text: str, folder: Path, *, level: int = 1) -> str:
    """Return headings, paragraphs, bullet lists, ``code``, fenced blocks and pictures as HTML.

    Pictures, each a paragraph of its own, are files in ``folder``. ``level`` is the level of a
    heading with one hash.
    """
    return "\n".join(_block(kind, lines, folder, level) for kind, lines in _blocks(text))


def _blocks(text: str) -> Iterator[tuple[str, list[str]]]:
    """Yield (kind, lines): fenced blocks whole, the rest divided at empty lines."""
    for i, part in enumerate(re.split(rf"^{FENCE}\n?", text, flags=re.MULTILINE)):
        if i % 2:
            yield "code", part.rstrip("\n").split("\n")
            continue
        for block in filter(str.strip, re.split(r"\n\s*\n", part)):
            lines = block.strip("\n").split("\n")
            marks = {"#": "heading", "-": "list", "!": "picture"}
            yield marks.get(lines[0][0], "text"), lines


def _block(kind: str, lines: list[str], folder: Path, level: int) -> str:
    whole = "\n".join(lines)
    if kind == "code":
        return f"<pre>{escape(whole)}</pre>"
    if kind == "heading":
        hashes, _, title = lines[0].partition(" ")
        tag = f"h{len(hashes) + level - 1}"
        return f"<{tag}>{_inline(title)}</{tag}>"
    if kind == "list":
        items = re.split(r"^- ", whole, flags=re.MULTILINE)[1:]
        return "<ul>" + "".join(f"<li>{_inline(item)}</li>" for item in items) + "</ul>"
    picture = re.fullmatch(r"!\[(.*)\]\((.*)\)", " ".join(lines))
    if picture:
        caption, file = escape(picture[1]), data_uri(folder / picture[2])
        return (
            f'<figure><img alt="{caption}" src="{file}"><figcaption>{caption}</figcaption></figure>'
        )
    return f"<p>{_inline(whole)}</p>"


def _inline(text: str) -> str:
    """Return one paragraph with its code spans; line breaks become blanks."""
    return re.sub(r"`([^`]+)`", r"<code>\1</code>", escape(" ".join(text.split())))
