"""Pages and XML from templates."""

from pathlib import Path
from typing import Any


def filled(template: Path, **told: Any) -> bytes:
    """Return a template filled in; values are escaped as in XML and HTML."""
    from jinja2 import Environment, StrictUndefined  # late: few commands need it

    environment = Environment(
        autoescape=True, undefined=StrictUndefined, trim_blocks=True, lstrip_blocks=True,
        keep_trailing_newline=True,
    )  # fmt: skip
    return environment.from_string(template.read_text("utf-8")).render(told).encode()
