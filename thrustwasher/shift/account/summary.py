"""What the report says of a shift at its top: what happened, and what a reader must not miss."""

import re
from collections.abc import Sequence
from typing import Any

from ..checks.rule_data import NUMBERS, part_rows
from ..warning_texts import Ranked, rank_of, scope_of, severest_first, warnings_of
from .shift_record import Record, record_of
from .swing_texts import chatter_texts, judder_text
from .what_happened import sentences

__all__ = ["sentences", "step_words", "warnings", "warnings_of_all", "warnings_of_result"]

QUANTITY = re.compile(r"-?\d\S*( [^\s\d.]\S*)?")  # a number, and a word behind it: mostly its unit


def warnings(r: Record) -> list[str]:
    """Return what a reader must not miss, the most severe first."""
    judder = [Ranked(judder_text(r))] if r.judder and r.judder.kind != "decaying" else []
    by_rules = warnings_of("record", scope_of(record_values(r), r.signals))
    return severest_first([*r.found, *by_rules, *judder, *map(Ranked, chatter_texts(r))])


def warnings_of_result(result: Any) -> list[str]:
    """Return what a reader of a shift's or a sequence's result must not miss."""
    if result.scene.sequence:
        of_shifts = warnings_of_all([shift.warnings for shift in result.shifts])
        return severest_first([*result.found, *of_shifts])
    return warnings(record_of(result))


def warnings_of_all(warnings: Sequence[Sequence[str]]) -> list[str]:
    """Return what must not be missed of several shifts, with the first one it holds for.

    Two texts say the same if they differ in numbers and units alone.
    """
    found: dict[str, tuple[str, list[str]]] = {}
    for i, texts in enumerate(warnings, 1):
        for text in texts:
            found.setdefault(QUANTITY.sub("#", text), (text, []))[1].append(str(i))
    lines: list[str] = []
    for text, shifts in found.values():
        first, *others = dict.fromkeys(shifts)
        end = "" if text.endswith(".") else "."
        likewise = f"{end} Likewise shifts {', '.join(others)}." if others else ""
        lines.append(Ranked(f"Shift {first}: {text}{likewise}", rank_of(text)))
    return lines


def step_words(result: Any) -> list[str]:
    """Return what the step errs by in the shifts of a sequence that were checked."""
    errors = result.step_errors.items()
    return [f"Error of the step in shift {i + 1}: {error.words()}" for i, error in errors]


def record_values(r: Record) -> dict[str, Any]:
    """Return what the rules of warnings know of a finished run."""
    stick_slip = r.sticks_and_slips and not (r.judder and r.judder.stick_slip)
    return {
        **NUMBERS,
        **part_rows({part.name: (part.spec, part.params()) for part in r.parts}),
        "time": r.time,
        "engaging": r.engaging,
        "releasing": r.releasing,
        "shift_start": r.ramp_start,
        "oil_temperature": r.oil_temperature,
        "lock_time": r.figures["lock_time"],
        "sticks": r.sticks_and_slips,
        **_tie_up(r),
        "turns_from": r.phases[-1].start if stick_slip else None,  # else the words on judder say it
    }


def _tie_up(r: Record) -> dict[str, Any]:
    """Return the figures of a tie-up, as the run has found them."""
    lasted, most = r.figure("tie_up_duration"), r.figure("tie_up_torque")
    if lasted is None or most is None or lasted.value is None:
        return {"ties": False}
    heat, begin = r.figures.get("tie_up_heat") or 0.0, lasted.time or r.ramp_start
    found = {"tie_up_duration": lasted.value, "tie_up_torque": most.value, "tie_up_heat": heat}
    return {"ties": True, "tie_up_begin": begin, **found}
