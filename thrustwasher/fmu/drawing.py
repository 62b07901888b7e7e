"""Lines in a frame as SVG, without a drawing package: small, and the same bytes everywhere."""

import math
from collections.abc import Sequence
from html import escape
from typing import NamedTuple

WIDTH, HEIGHT = 560, 330
LEFT, RIGHT, TOP, BOTTOM = 64, 546, 30, 280  # the frame
COLOURS = ("#1f4e79", "#c05a1c", "#3b7d4f")
DASHES = ("none", "7 4", "2 3")  # told apart in grey too
TICKS = 6  # at most, per axis
STEPS = (1.0, 2.0, 2.5, 5.0, 10.0)


class Line(NamedTuple):
    """A named line through points."""

    name: str
    x: Sequence[float]
    y: Sequence[float]


def drawing(title: str, x_label: str, y_label: str, lines: Sequence[Line]) -> str:
    """Return an SVG element; ``title`` is what a reader without eyes for it is told."""
    xs = ticks([v for line in lines for v in line.x])
    ys = ticks([v for line in lines for v in line.y])
    parts = [
        f'<svg viewBox="0 0 {WIDTH} {HEIGHT}" width="{WIDTH}" role="img" '
        f'aria-label="{escape(title)}" font-family="system-ui,sans-serif" font-size="12">',
        f'<rect x="{LEFT}" y="{TOP}" width="{RIGHT - LEFT}" height="{BOTTOM - TOP}" '
        'fill="none" stroke="#8894a0"/>',
        *(_tick(v, x=_place(v, xs, LEFT, RIGHT)) for v in xs),
        *(_tick(v, y=_place(v, ys, BOTTOM, TOP)) for v in ys),
        _text((LEFT + RIGHT) / 2, HEIGHT - 12, x_label),
        _text(16, (TOP + BOTTOM) / 2, y_label, turn=True),
    ]
    for i, line in enumerate(lines):
        parts += _line(i, line, xs, ys, LEFT + i * (RIGHT - LEFT) / len(COLOURS))
    return "\n".join([*parts, "</svg>"])


def ticks(values: Sequence[float]) -> list[float]:
    """Return round numbers that enclose the values, evenly spaced; with 0 where it is near."""
    low, high = min(values), max(values)
    low, high = (0.0, high) if 0.0 < low < 0.5 * high else (low, high)
    width = (high - low) or abs(high) or 1.0
    decade = 10.0 ** math.floor(math.log10(width / TICKS))
    step = next(s * decade for s in STEPS if width / (s * decade) <= TICKS)
    first, last = math.floor(low / step + 1e-9), math.ceil(high / step - 1e-9)
    return [n * step for n in range(first, max(last, first + 1) + 1)]


def _place(value: float, marks: Sequence[float], start: float, end: float) -> float:
    share = (value - marks[0]) / (marks[-1] - marks[0])
    return start + share * (end - start)


def _tick(value: float, *, x: float | None = None, y: float | None = None) -> str:
    shown = f"{value:.6g}"
    if x is not None:
        mark = f'<path d="M{x:.1f} {BOTTOM}V{TOP}" stroke="#e3e8ec"/>'
        return mark + _text(x, BOTTOM + 16, shown)
    assert y is not None
    mark = f'<path d="M{LEFT} {y:.1f}H{RIGHT}" stroke="#e3e8ec"/>'
    return mark + f'<text x="{LEFT - 6}" y="{y + 4:.1f}" text-anchor="end">{shown}</text>'


def _text(x: float, y: float, words: str, *, turn: bool = False) -> str:
    turned = f' transform="rotate(-90 {x:.1f} {y:.1f})"' if turn else ""
    return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="middle"{turned}>{escape(words)}</text>'


def _line(i: int, line: Line, xs: Sequence[float], ys: Sequence[float], legend: float) -> list[str]:
    points = " ".join(
        f"{_place(x, xs, LEFT, RIGHT):.1f},{_place(y, ys, BOTTOM, TOP):.1f}"
        for x, y in zip(line.x, line.y, strict=True)
    )
    look = f'fill="none" stroke="{COLOURS[i]}" stroke-width="2" stroke-dasharray="{DASHES[i]}"'
    return [
        f'<polyline {look} points="{points}"/>',
        f'<path d="M{legend:.0f} {TOP - 14}h30" {look}/>',
        f'<text x="{legend + 36:.0f}" y="{TOP - 10}">{escape(line.name)}</text>',
    ]
