"""One self-contained page: text, tables and plots in a single file that works offline."""

from __future__ import annotations

import base64
import io
import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from matplotlib import rc_context
from matplotlib.figure import Figure

_TEMPLATE = Path(__file__).with_name("template.html")


@dataclass(frozen=True, kw_only=True)
class Plot:
    """A figure with the sentence below it; ``file`` is the stem of its PNG."""

    file: str
    figure: Figure
    caption: str
    square: bool = False
    bitmap: bool = False  # shaded maps are smaller as pictures than as drawings

    @property
    def markup(self) -> Any:
        """The figure as it stands in the page."""
        from markupsafe import Markup

        return Markup(_picture(self.figure) if self.bitmap else _drawing(self.figure, self.file))


@dataclass(frozen=True, kw_only=True)
class Table:
    """Rows of text; ``numbers`` are the columns set to the right."""

    heads: Sequence[str]
    rows: Sequence[Sequence[str]]
    numbers: Sequence[int] = ()
    title: str = ""
    folded: bool = False


@dataclass(frozen=True, kw_only=True)
class Section:
    """A chapter of the page."""

    anchor: str
    title: str
    texts: Sequence[str] = ()
    plots: Sequence[Plot] = ()
    tables: Sequence[Table] = ()


@dataclass(frozen=True, kw_only=True)
class Card:
    """A key figure at the top of the page."""

    name: str
    value: str


@dataclass(frozen=True, kw_only=True)
class Page:
    """Everything the page shows."""

    title: str
    subtitle: str
    summary: Sequence[str]
    warnings: Sequence[str]
    cards: Sequence[Card]
    sections: Sequence[Section]
    footer: str


def render(page: Page) -> str:
    """Return the page as HTML; text is escaped, plots are inside."""
    from jinja2 import Environment, StrictUndefined

    environment = Environment(
        autoescape=True, undefined=StrictUndefined, trim_blocks=True, lstrip_blocks=True
    )
    template = environment.from_string(_TEMPLATE.read_text("utf-8"))
    return template.render({name: getattr(page, name) for name in page.__dataclass_fields__})


def save_plots(page: Page, folder: Path) -> list[Path]:
    """Write every plot of the page as PNG into the folder."""
    paths = []
    for section in page.sections:
        for plot in section.plots:
            path = folder / f"{plot.file}.png"
            plot.figure.savefig(path, dpi=130)
            paths.append(path)
    return paths


def _drawing(figure: Figure, prefix: str) -> str:
    """Return inline SVG whose identifiers begin with ``prefix``: many drawings share one page."""
    stream = io.StringIO()
    with rc_context({"svg.fonttype": "none", "svg.hashsalt": prefix}):
        figure.savefig(stream, format="svg", metadata={"Date": None, "Creator": None})
    svg = stream.getvalue()
    svg = svg[svg.index("<svg") :]
    svg = re.sub(r"<metadata>.*?</metadata>", "", svg, flags=re.DOTALL)
    return re.sub(r'(\bid="|url\(#|href="#)', rf"\g<1>{prefix}-", svg)


def _picture(figure: Figure) -> str:
    """Return an image element with the PNG inside."""
    stream = io.BytesIO()
    figure.savefig(stream, format="png", dpi=100)
    data = base64.b64encode(stream.getvalue()).decode("ascii")
    return f'<img alt="" src="data:image/png;base64,{data}">'
