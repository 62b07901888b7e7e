"""The little of Markdown that the models' own pages use, as HTML."""

import re
from collections.abc import Iterator
from html import escape

FENCE = "```"


def markup(text: str, *, level: int = 1) -> str:
    """Return headings, paragraphs, bullet lists, ``code`` and fenced blocks as HTML.

    ``level`` is the level of a heading with one hash.
    """
    return "\n".join(_block(kind, lines, level) for kind, lines in _blocks(text))


def _blocks(text: str) -> Iterator[tuple[str, list[str]]]:
    """Yield (kind, lines): fenced blocks whole, the rest divided at empty lines."""
    for i, part in enumerate(re.split(rf"^{FENCE}\n?", text, flags=re.MULTILINE)):
        if i % 2:
            yield "code", part.rstrip("\n").split("\n")
            continue
        for block in filter(str.strip, re.split(r"\n\s*\n", part)):
            lines = block.strip("\n").split("\n")
            marks = {"#": "heading", "-": "list"}
            yield marks.get(lines[0][0], "text"), lines


def _block(kind: str, lines: list[str], level: int) -> str:
    if kind == "code":
        return f"<pre>{escape(chr(10).join(lines))}</pre>"
    if kind == "heading":
        hashes, _, title = lines[0].partition(" ")
        tag = f"h{len(hashes) + level - 1}"
        return f"<{tag}>{_inline(title)}</{tag}>"
    if kind == "list":
        items = re.split(r"^- ", "\n".join(lines), flags=re.MULTILINE)[1:]
        return "<ul>" + "".join(f"<li>{_inline(item)}</li>" for item in items) + "</ul>"
    return f"<p>{_inline(chr(10).join(lines))}</p>"


def _inline(text: str) -> str:
    """Return one paragraph with its code spans; line breaks become blanks."""
    return re.sub(r"`([^`]+)`", r"<code>\1</code>", escape(" ".join(text.split())))
