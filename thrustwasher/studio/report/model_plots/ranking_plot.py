"""What one percent more of each parameter changes, largest first."""

from collections.abc import Mapping

from matplotlib.figure import Figure

from ....units import display_unit, pretty_unit
from ..palette import BLUE, ORANGE
from ..style import heading, label, new_figure, styled

MOST = 8  # bars of an output
LEAST = 0.01  # of the maximum: less is not drawn
COLUMNS = 3
NAMES, BARS = 1.9, 2.4  # inch of an output's panel


@styled
def ranking_figure(name: str, ranking: Mapping[str, tuple[str, Mapping[str, float]]]) -> Figure:
    """Return bars of the changes; ``ranking``: output -> unit and changes, largest first."""
    count = len(ranking)
    rows, columns = -(-count // COLUMNS) or 1, min(count, COLUMNS) or 1
    width = columns * (BARS + NAMES) + 0.2
    shape = (width, 2.6 * rows + 0.4, rows, columns)
    figure, axes = new_figure(*shape, head=1, left=NAMES, across=NAMES)
    for axis in axes[count:]:
        axis.remove()
    for axis, (output, (unit, changes)) in zip(axes, ranking.items(), strict=False):
        most = max(map(abs, changes.values()))
        shown = [(p, c) for p, c in list(changes.items())[:MOST] if abs(c) > LEAST * most]
        words, size = display_unit(most, unit)
        values = [c / size for _, c in shown]
        axis.barh(range(len(shown)), values, color=[ORANGE if c < 0.0 else BLUE for c in values])
        axis.set_yticks(range(len(shown)), [p for p, _ in shown])
        axis.set_ylim(MOST - 0.5, -0.5)
        axis.locator_params(axis="x", nbins=4)
        axis.axvline(0.0, color="black", linewidth=0.8)
        label(axis, output, f"change [{pretty_unit(words)}]", "")
    heading(figure, f"{name}: change by one percent more of a parameter")
    return figure
