"""One self-contained page: text, tables and plots in a single file that works offline."""

import base64
import io
import json
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, Self

from ...templates import policy_source, template
from . import palette
from .bundles import bundle

if TYPE_CHECKING:  # who wants the words alone waits for no drawing
    from matplotlib.figure import Figure

PAGE = Path(__file__).with_name("page.html.jinja")
LICENCE = Path(__file__).parent / "web" / "vendor" / "LICENSE-uPlot.txt"

_COLOURS = ("BLUE", "ORANGE", "GREEN", "RED", "SKY", "PURPLE", "BLACK", "GREY")
INKS = {  # colours of drawings and those of ``page.css``
    **{getattr(palette, name).lower(): name.lower() for name in _COLOURS},
    **{"#ffffff": "paper", "#e3e3e3": "line", "#666666": "soft", "#444444": "soft"},
}


@dataclass(frozen=True)
class Plot:
    """A figure with the sentence below it; ``file`` is the stem of its file next to the page.

    One that is ``still`` stands for what scripts show: it is seen where none run. A bitmap may be
    given as the content of its file. ``tiles`` stand next to each other where there is room,
    so many in a row; they fit on a telephone, and their colours are those of the page.
    """

    file: str
    figure: "Figure | bytes"
    caption: str
    bitmap: bool = False  # many long lines are smaller as a picture than as a drawing
    still: bool = False
    tiles: int = 0

    @property
    def name(self) -> str:
        """The name of the file."""
        return f"{self.file}.{'png' if self.bitmap else 'svg'}"

    @cached_property
    def content(self) -> bytes:
        """The content of the file, which is also what the page shows: drawn once."""
        if isinstance(self.figure, bytes):
            return self.figure
        if self.bitmap:
            return picture(self.figure, dpi=110)
        return _drawing(self.figure, self.file).encode()

    @property
    def markup(self) -> Any:
        """The figure as it stands in the page."""
        from markupsafe import Markup

        if not self.bitmap:
            svg = self.content.decode()
            return Markup(themed(svg) if self.tiles else svg)
        data = base64.b64encode(self.content).decode("ascii")
        return Markup('<img alt="{}" src="data:image/png;base64,{}">').format(self.caption, data)


@dataclass(frozen=True)
class Table:
    """Rows of text; ``numbers`` are the columns set to the right.

    ``shades`` are shares 0 .. 1 that colour the cells of each row; None leaves one as it is.
    One that ``stays`` folded is so on paper too.
    ``figures`` are the names of the rows' key figures: scripts show these in other units.
    """

    heads: Sequence[str]
    rows: Sequence[Sequence[str]]
    numbers: Sequence[int] = ()
    title: str = ""
    folded: bool = False
    stays: bool = False
    shades: Sequence[Sequence[float | None]] = ()
    figures: Sequence[str] = ()

    @classmethod
    def of(
        cls, items: Iterable[object], columns: Mapping[str, Callable[[Any], str]], words: int = 1
    ) -> Self:
        """Return a row per item; ``columns``: heads and cells, numbers from ``words`` on."""
        rows = [tuple(cell(item) for cell in columns.values()) for item in items]
        return cls(list(columns), rows, range(words, len(columns)))


@dataclass(frozen=True)
class Section:
    """A chapter of the page; ``widgets`` are the places that scripts fill.

    One that is ``folded`` opens with a click or a link to it, and is on paper only if it is open or
    ``printed``.
    """

    anchor: str
    title: str
    widgets: Sequence[str] = ()
    texts: Sequence[str] = ()
    plots: Sequence[Plot] = ()
    tables: Sequence[Table] = ()
    folded: bool = False
    printed: bool = False

    @property
    def look(self) -> str:
        """The class of a chapter that has nothing to show where no scripts run."""
        without = self.plots or self.tables or (self.texts and not self.widgets)
        return "" if without else "widget"

    @property
    def unprinted(self) -> bool:
        """Whether there is nothing to print: all of it stays folded."""
        there = bool(self.tables) and not (self.plots or self.widgets)
        return there and all(table.folded and table.stays for table in self.tables)


@dataclass(frozen=True)
class Card:
    """A key figure at the top of the page; ``figure``: its name, for other units."""

    name: str
    value: str
    note: str = ""
    figure: str = ""

    @property
    def pieces(self) -> list[str]:
        """The note in pieces that are not broken where they have room; markup is one."""
        return [self.note] if hasattr(self.note, "__html__") else re.split("(?<=[:;]) ", self.note)


@dataclass(frozen=True, kw_only=True)
class Page:
    """Everything the page shows; ``scripts`` are files of ``web/bundle`` that work on ``data``.

    ``first`` is a chapter without a title above the panel: the picture that says most. ``live`` is
    the address of a page next to this one in which the same is tried.
    """

    title: str
    subtitle: str
    summary: Sequence[str] = ()
    warnings: Sequence[str] = ()
    cards: Sequence[Card] = ()
    first: Section | None = None
    live: str = ""
    sections: Sequence[Section]
    footer: str
    scripts: Sequence[str] = ()
    data: Any = None


def render(page: Page) -> str:
    """Return the page as HTML; text is escaped; plots, scripts and their data are inside.

    Its content policy lets these scripts run, and kernels in a worker of theirs, and lets nothing
    be fetched from anywhere.
    """
    from markupsafe import Markup

    names = ("page.css", *(name for name in page.scripts if name.endswith(".css")))
    codes = [bundle(name) for name in ("page.js", *page.scripts) if name.endswith(".js")]
    notice = any("uPlot" in code for code in codes)
    filled: str = template(PAGE).render(
        {**vars(page), "scripts": [Markup(code) for code in codes]},
        policy=" ".join(map(policy_source, codes)),
        styles=[Markup(bundle(name)) for name in names],
        notice=LICENCE.read_text("utf-8") if notice else "",
        json=Markup(json.dumps(page.data, separators=(",", ":")).replace("<", r"\u003c")),
    )
    return filled


def save_plots(page: Page, folder: Path) -> None:
    """Write the plots but tiles into the folder: drawings as SVG, shaded maps as PNG."""
    for section in (*([page.first] if page.first else []), *page.sections):
        for plot in section.plots:
            if not plot.tiles:
                (folder / plot.name).write_bytes(plot.content)


def _drawing(figure: "Figure", prefix: str) -> str:
    """Return SVG whose identifiers begin with ``prefix``: many drawings share one page."""
    from matplotlib import rc_context

    stream = io.StringIO()
    with rc_context({"svg.fonttype": "none", "svg.hashsalt": prefix}):
        figure.savefig(stream, format="svg", metadata={"Date": None, "Creator": None})
    svg = stream.getvalue()
    svg = svg[svg.index("<svg") :]
    svg = re.sub(r"<metadata>.*?</metadata>", "", svg, flags=re.DOTALL)
    return re.sub(r'(\bid="|url\(#|href="#)', rf"\g<1>{prefix}-", svg)


def themed(svg: str) -> str:
    """Return a drawing whose colours are those of the page, light or dark."""
    return re.sub(
        r"#[0-9a-f]{6}\b", lambda m: f"var(--{n})" if (n := INKS.get(m[0])) else m[0], svg
    )


def picture(figure: "Figure", dpi: int = 100) -> bytes:
    """Return a PNG; packing it tighter takes twice the time for a tenth less."""
    stream = io.BytesIO()
    figure.savefig(stream, format="png", dpi=dpi, pil_kwargs={"compress_level": 3})
    return stream.getvalue()
