"""Where a picture is drawn: in a figure of its own, or in a figure or on axes of the caller."""

from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from typing import Any, NamedTuple

from matplotlib.axes import Axes
from matplotlib.figure import Figure, SubFigure
from matplotlib.layout_engine import LayoutEngine

from ...errors import ParameterError, suggestion


class Target(NamedTuple):
    """What the caller gave; neither: a new figure."""

    axes: Axes | None = None
    figure: Figure | None = None  # or a SubFigure, which can all that is done with it here


_NEW = Target()
_TARGET: ContextVar[Target] = ContextVar("target")


@contextmanager
def drawn_on(ax: object, fig: object) -> Iterator[None]:
    """Draw the next picture on axes or in a figure of the caller.

    Raises
    ------
    ParameterError : both are given, or one is not what it should be
    """
    if ax is not None and fig is not None:
        raise ParameterError("plot: ax and fig are given, allowed: one of them")
    if ax is not None and not (isinstance(ax, Axes) and ax.name == "rectilinear"):
        figure = isinstance(ax, Figure | SubFigure)
        hint = "; a figure is given by fig = .." if figure else ""
        raise ParameterError(f"ax = {_named(ax)}, allowed: one Axes of matplotlib, x and y{hint}")
    if fig is not None and not isinstance(fig, Figure | SubFigure):
        hint = "; axes are given by ax = .." if isinstance(fig, Axes) else ""
        raise ParameterError(
            f"fig = {_named(fig)}, allowed: a Figure or SubFigure of matplotlib{hint}"
        )
    asked: Any = (ax, fig)
    token = _TARGET.set(Target(*asked))
    try:
        yield
    finally:
        _TARGET.reset(token)


def _named(given: object) -> str:
    name = getattr(given, "name", "")
    return f"{name} axes" if isinstance(given, Axes) else f"an object of {type(given).__name__}"


def asked_target() -> Target:
    """Return what the caller gave."""
    return _TARGET.get(_NEW)


def axes_for(panels: int, choose: str) -> Axes:
    """Return the caller's axes; ParameterError: the picture has several panels."""
    axes = asked_target().axes
    assert axes is not None
    if panels != 1:
        one = f", or {choose} = .. with one name" if choose else ""
        raise ParameterError(
            f"ax: this picture has {panels} panels, allowed: fig = .., a Figure or SubFigure{one}"
        )
    return axes


def empty_figure() -> Figure | None:
    """Return the caller's figure; None: there is none. ParameterError: something is in it."""
    figure = asked_target().figure
    if figure is not None and (figure.axes or figure.subfigs):
        raise ParameterError(
            f"fig has {len(figure.axes)} axes and {len(figure.subfigs)} subfigures, "
            "allowed: an empty Figure or SubFigure"
        )
    return figure


def size_of(figure: Figure) -> tuple[float, float]:
    """Return width and height [inch]."""
    return figure.bbox.width / figure.dpi, figure.bbox.height / figure.dpi


def lays_out_itself(figure: Figure) -> bool:
    """Return whether the figure arranges panels and texts when it is drawn ("constrained")."""
    engine: LayoutEngine | None = figure.get_layout_engine()
    return engine is not None


def chosen(option: str, given: str | Iterable[str], known: Iterable[str]) -> list[str]:
    """Return the names that an option of ``plot()`` gives, one or several; none: [].

    ParameterError: one is not known.
    """
    known, names = list(known), [given] if isinstance(given, str) else list(given)
    for name in names:
        if name not in known:
            hint = suggestion(name, known, "did you mean {!r}?", f"allowed: {', '.join(known)}")
            raise ParameterError(f"plot: {option} = {name!r} is not here, {hint}")
    return names
