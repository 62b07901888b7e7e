"""One look for all plots: colours told apart by everyone, units on axes, no global state."""

from collections.abc import Callable, Sequence
from contextlib import nullcontext
from functools import wraps
from io import BytesIO
from pathlib import Path
from typing import Any, TypeVar, cast

import numpy as np
from matplotlib import rc_context, rc_params_from_file
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.transforms import blended_transform_factory

from ...errors import ParameterError
from .target import asked_target, axes_for, empty_figure, lays_out_itself, size_of

_RC = rc_params_from_file(Path(__file__).with_name("house.mplstyle"), use_default_template=False)
LEFT, RIGHT, TOP, BOTTOM = 0.8, 0.2, 0.36, 0.56  # inch around the panels
ACROSS, DOWN = 0.82, 0.86  # inch between panels
SECOND = 0.44  # inch of a second axis at the top: ticks and label
SHOWN_DPI = 80  # of a figure in a notebook
LEAST = 0.5  # inch of a panel
LINE, EDGE = 0.21, 0.08  # inch of a line above or below the panels; kept free at the very edge
F = TypeVar("F", bound=Callable[..., Any])


def styled(function: F) -> F:
    """Run a drawing function in the house style; settings outside stay as they were.

    On axes of the caller it draws in the caller's style.
    """

    @wraps(function)
    def drawing(*args: Any, **more: Any) -> Any:
        with nullcontext() if asked_target().axes is not None else rc_context(_RC):
            return function(*args, **more)

    return cast(F, drawing)


class Picture(Figure):
    """A figure that a notebook shows by itself, without pyplot."""

    def _repr_png_(self) -> bytes:
        stream = BytesIO()
        self.savefig(stream, format="png", dpi=SHOWN_DPI)
        return stream.getvalue()


def new_figure(
    width: float,
    height: float,
    rows: int = 1,
    columns: int = 1,
    *,
    head: int = 0,
    foot: int = 0,
    left: float = LEFT,
    right: float = RIGHT,
    top: float = TOP,
    across: float = ACROSS,
    down: float = DOWN,
    choose: str = "",
    **options: Any,
) -> tuple[Figure, list[Axes]]:
    """Return a figure [inch] and its axes row by row; margins and gaps are fixed lengths.

    A figure or axes of the caller (``target.drawn_on``) are taken in its place, in their size.

    Parameters
    ----------
    head, foot : lines of text that ``heading`` and rows that ``legend_below`` will take
    left, right, top : margins next to and above the panels [inch]
    across, down : between panels [inch]
    choose : option of ``plot()`` that leaves one panel, for axes of the caller
    """
    if asked_target().axes is not None:
        axes = axes_for(rows * columns, choose)
        return axes.get_figure(), [axes]  # type: ignore[return-value]
    given = empty_figure()
    figure = Picture(figsize=(width, height)) if given is None else given
    width, height = size_of(figure)
    bottom = BOTTOM + LINE * foot
    top += LINE * head
    wide = (width - left - right - (columns - 1) * across) / columns
    tall = (height - bottom - top - (rows - 1) * down) / rows
    grid = {
        "left": left / width,
        "right": 1.0 - right / width,
        "wspace": across / wide,
        "bottom": bottom / height,
        "top": 1.0 - top / height,
        "hspace": down / tall,
    }
    if lays_out_itself(figure):
        grid = {}
    elif min(wide, tall) < LEAST:
        short = LEAST - np.minimum((wide, tall), LEAST)
        across_, up = np.array((width, height)) + short * (columns, rows)
        raise ParameterError(
            f"fig = {width:.3g} x {height:.3g} inch, allowed: {across_:.3g} x {up:.3g} inch or "
            f'more for {columns} x {rows} panels, or a figure of layout = "constrained"'
        )
    panels = figure.subplots(rows, columns, squeeze=False, gridspec_kw=grid, **options)
    return figure, list(panels.ravel())


def heading(figure: Figure, text: str, **options: object) -> None:
    """Write lines above all panels; over axes of the caller only where they have no title."""
    axes = asked_target().axes
    if axes is not None:
        if not any(axes.get_title(loc=loc) for loc in ("left", "center", "right")):
            axes.set_title(text)
    elif lays_out_itself(figure):
        figure.suptitle(text, **options)
    else:
        figure.suptitle(text, y=1.0 - EDGE / size_of(figure)[1], va="top", **options)


def legend_below(
    figure: Figure, handles: Sequence[Any], names: Sequence[str], columns: int
) -> None:
    """Put one legend below all panels; on axes of the caller inside of them."""
    axes = asked_target().axes
    if axes is not None:
        axes.legend(handles, names)
        return
    loc: Any = "outside lower center" if lays_out_itself(figure) else "lower center"
    figure.legend(handles, names, loc=loc, ncols=columns, borderaxespad=0.3)


def legend_at_right(axes: Axes) -> None:
    """Put a legend to the right of a panel; on axes of the caller inside of them."""
    if asked_target().axes is not None:
        axes.legend()
    else:
        axes.legend(loc="upper left", bbox_to_anchor=(1.01, 1.0), borderaxespad=0.0)


def time_figure(height: float, rows: int, choose: str = "") -> tuple[Figure, list[Axes]]:
    """Return panels over one time axis; all such figures have it at the same place of the page.

    A figure or axes of the caller (``target.drawn_on``) are taken in its place, in their size.
    """
    if asked_target().axes is not None:
        axes = axes_for(rows, choose)
        axes.set_xlabel("time [s]")
        return axes.get_figure(), [axes]  # type: ignore[return-value]
    given = empty_figure()
    figure = Picture(figsize=(10.4, height)) if given is None else given
    height, itself = size_of(figure)[1], lays_out_itself(figure)
    ends = {"left": 0.085, "right": 0.735, "hspace": 0.22}
    ends |= {"top": 1.0 - 0.32 / height, "bottom": 0.5 / height}
    grid = {} if itself else ends
    panels = list(figure.subplots(rows, 1, sharex=True, squeeze=False, gridspec_kw=grid).ravel())
    panels[-1].set_xlabel("time [s]")
    if itself:
        return figure, panels
    for axis in panels:
        place = blended_transform_factory(figure.transSubfigure, axis.transAxes)
        axis.yaxis.set_label_coords(0.025, 0.5, transform=place)
    tall = height * panels[-1].get_position().height
    panels[-1].xaxis.set_label_coords(0.5, -0.26 / tall)
    return figure, panels


def label(axes: Axes, title: str, across: str, up: str, *, above: float = 0.0) -> None:
    """Set title and axis labels; a label carries its unit in brackets, "" leaves it as it is.

    ``above`` [inch] is what an axis at the top takes between panel and title.
    """
    axes.set_title(title, pad=6.0 + 72.0 * above)
    axes.set_ylabel(up)
    if across:
        axes.set_xlabel(across)


def note_at_right(axes: Axes, words: str, height: float, **options: Any) -> None:
    """Write small words at the right end of a level."""
    shift, place = options.pop("shift", (-2, 2)), options.pop("place", 1.0)
    look = {"ha": "right", "fontsize": 8, **options}
    axes.annotate(
        words,
        (place, height),
        shift,
        xycoords=axes.get_yaxis_transform(),
        textcoords="offset points",
        **look,
    )


def second_scale(axes: Axes, factor: float, words: str) -> Any:
    """Add an axis at the top whose numbers are ``factor`` times those below; return it."""
    functions: Any = (lambda below: below * factor, lambda above: above / factor)
    scale = axes.secondary_xaxis("top", functions=functions)
    scale.set_xlabel(words)
    return scale


TICKS = ((1.0,), (1.0, 3.0), (1.0, 2.0, 5.0), tuple(map(float, range(1, 10))))


def decade_ticks(axes: Axes, enough: int = 3) -> None:
    """Label a logarithmic axis of values sparsely: 1, 3, 10, and more only where few fit."""
    low, high = sorted(axes.get_ylim())
    decades = [10.0**n for n in range(int(np.floor(np.log10(low))), int(np.ceil(np.log10(high))))]
    for steps in TICKS:
        ticks = [d * s for d in [*decades, 10.0 * decades[-1]] for s in steps]
        inside = [tick for tick in ticks if low <= tick <= high]
        if len(inside) >= enough:
            break
    axes.set_yticks(inside)
    axes.yaxis.set_major_formatter("{x:g}")
    axes.minorticks_off()
