"""The report's section on rungs: which ran when, why, and what the guard saw."""

from __future__ import annotations

from matplotlib.figure import Figure

from .html import Plot, Section, Table
from .palette import BLUE, GREEN, GREY, ORANGE, PURPLE, SKY
from .rungs import Rungs
from .style import beside, label, styled, time_figure

COLOURS = {"closed": GREY, "boundary": PURPLE, "stribeck": GREEN, "map": SKY, "field": BLUE,
           "fine": ORANGE}  # fmt: skip
REASONS = {
    "outside": "not verified at the coming inputs",
    "difference": "too far from the rung above",
    "calm": "ten looks running without a difference",
}


def rung_sections(rungs: Rungs | None, wall_time: float) -> list[Section]:
    """Return the section on rungs, if any were chosen or watched."""
    if rungs is None:
        return []
    texts = list(rungs.reasons)
    if rungs.scout_seconds:
        texts.append(
            f"Two scout runs with cheap rungs and long steps found the inputs to choose for; "
            f"they took {1e3 * rungs.scout_seconds:.3g} ms."
        )
    if not rungs.watched:
        texts.append("No guard: the choice was not watched while the shift ran.")
        return [Section(anchor="rungs", title="Rungs", texts=texts)]
    texts.append(f"{rungs.closing}.")
    plot = Plot(
        file="rungs", figure=rung_figure(rungs),
        caption="Which rung served when. It changes at a communication point, and in the step that "
        "follows the outputs of both are mixed.",
    )  # fmt: skip
    tables = [_watched_table(rungs, wall_time)]
    if rungs.changes:
        tables.append(_change_table(rungs))
    return [Section(anchor="rungs", title="Rungs and their guard", texts=texts, plots=[plot],
                    tables=tables)]  # fmt: skip


@styled
def rung_figure(rungs: Rungs) -> Figure:
    """Return a bar per part, coloured by the rung that served."""
    parts = [w.part for w in rungs.watched]
    figure, (axis,) = time_figure(0.9 + 0.4 * len(parts))
    named: set[str] = set()
    for s in rungs.stretches:
        name = None if s.rung in named else s.rung
        named.add(s.rung)
        colour = COLOURS.get(s.rung, GREY)
        axis.barh(parts.index(s.part), s.end - s.start, left=s.start, height=0.6, color=colour,
                  label=name)  # fmt: skip
    axis.set_yticks(range(len(parts)), parts)
    axis.set_ylim(len(parts) - 0.5, -0.5)
    axis.set_xlim(min(s.start for s in rungs.stretches), max(s.end for s in rungs.stretches))
    label(axis, "The rung that served", "", "")
    beside(axis)
    return figure


def _watched_table(rungs: Rungs, wall_time: float) -> Table:
    rows = [
        (w.part, w.base, w.above, str(w.checks), f"{100.0 * w.worst:.3g}",
         f"{100.0 * w.tolerance:.3g}", f"{1e3 * w.seconds:.2f}",
         f"{100.0 * w.seconds / wall_time:.1f}")
        for w in rungs.watched
    ]  # fmt: skip
    return Table(
        heads=("", "chosen", "compared with", "looks", "worst difference [%]", "allowed [%]",
               "time of looks [ms]", "of the run [%]"),
        rows=rows,
        numbers=(3, 4, 5, 6, 7),
    )  # fmt: skip


def _change_table(rungs: Rungs) -> Table:
    rows = [
        (f"{c.time:.4g}", c.part, c.before, c.after, REASONS.get(c.reason, c.reason), c.output,
         f"{c.served:.6g}", f"{c.other:.6g}")
        for c in rungs.changes
    ]  # fmt: skip
    return Table(
        heads=("at time [s]", "part", "from", "to", "why", "output", "in the rung before",
               "in the other"),
        rows=rows,
        numbers=(0, 6, 7),
    )  # fmt: skip
