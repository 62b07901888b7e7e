"""Texts, pages and XML from templates."""

import base64
import hashlib
from functools import cache
from pathlib import Path
from typing import Any


def filled(path: Path, **told: Any) -> bytes:
    """Return a template filled in; values are escaped as in XML and HTML, but for Markdown."""
    return bytes(template(path).render(told), "utf-8")


@cache
def template(path: Path) -> Any:
    """Return a template, read once."""
    return environment(escape=".md" not in path.suffixes).from_string(path.read_text("utf-8"))


def environment(*, escape: bool) -> Any:
    """Return what reads templates; a name that it was not told is an error."""
    from jinja2 import Environment, StrictUndefined  # late: few commands need it

    return Environment(
        autoescape=escape, undefined=StrictUndefined, trim_blocks=True, lstrip_blocks=True,
        keep_trailing_newline=True,
    )  # fmt: skip


def policy_source(text: str) -> str:
    """Return how a page's content policy names a script or style that it lets in."""
    return f"'sha256-{base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()}'"
