"""Texts, pages and XML from templates."""

import base64
import hashlib
from functools import cache
from pathlib import Path
from typing import Any


def filled(path: Path, **told: object) -> bytes:
    """Return a template filled in; values are escaped as in XML and HTML, but for Markdown."""
    return bytes(template(path).render(told), "utf-8")


@cache
def template(path: Path) -> Any:
    """Return a template, read once; a name that it is not given is an error."""
    from jinja2 import Environment, StrictUndefined  # late: few commands need it

    reader = Environment(
        autoescape=".md" not in path.suffixes,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
    )
    return reader.from_string(path.read_text("utf-8"))


def policy_source(text: str) -> str:
    """Return how a page's content policy names a script or style that it lets in."""
    return f"'sha256-{base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()}'"
