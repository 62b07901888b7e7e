"""The report's section on rungs: which ran, why, how far off they were and what was run again."""

from typing import Any

from ..html import Section, Table
from .shift_record import Record


def rung_sections(record: Record) -> list[Section]:
    """Return the section on rungs, if any were chosen."""
    chosen, guard = record.selection, record.guard
    if chosen is None:
        return []
    texts = [
        *chosen.words(),
        "Trial runs with cheap rungs and long steps found the inputs to choose for; they took "
        f"{1e3 * chosen.trial_seconds:.3g} ms.",
    ]
    if guard is None:
        texts.append("The choice was not checked after the run.")
        return [Section(anchor="rungs", title="Rungs", texts=texts)]
    texts.append(
        "After the run the guard compared its inputs with those that the rungs were chosen for, "
        "and solved the rung above at recorded points: those with the extremes, those after "
        "changes of regime, and others spread over the run."
    )
    again = [*guard.again, *([guard.stopped] if guard.stopped else [])]
    texts += [f"{text[0].upper()}{text[1:]}." for text in again] or ["Nothing had to run again."]
    if guard.again:
        texts.append(f"The earlier runs took {1e3 * guard.earlier_seconds:.3g} ms.")
    for check in guard.checks:
        if check.outside:
            texts.append(f"{check.part}, {check.rung}: {check.outside}.")
        texts += [f"{check.part}: {check.above} gave no solution {text}" for text in check.failed]
    tables = [_check_table(guard.checks)]
    return [Section(anchor="rungs", title="Rungs and their check", texts=texts, tables=tables)]


def _check_table(checks: list[Any]) -> Table:
    """Return a row per check, in the order they were made."""
    rows = [
        (c.part, c.rung, c.above, str(c.points), str(len(c.failed)), f"{100.0 * c.worst.share:.3g}",
         f"{100.0 * c.tolerance:.3g}", "yes" if c.holds else "no", f"{1e3 * c.seconds:.2f}")
        for c in checks
    ]  # fmt: skip
    return Table(
        heads=("", "rung", "compared with", "points", "without solution", "worst difference [%]",
               "allowed [%]", "holds", "time [ms]"),
        rows=rows,
        numbers=(3, 4, 5, 6, 8),
    )  # fmt: skip
