"""What the report says of a shift at its top: what happened, and what a reader must not miss."""

import re
from collections.abc import Iterator, Sequence
from typing import Any

from ..warning_texts import Ranked, rank_of, severest_first, warning
from .shift_record import Record, record_of
from .swing_texts import chatter_texts, judder_text
from .what_happened import pitting_safety, scuffing_safety, sentences, stress_words
from .worst_moments import least_margin

__all__ = ["sentences", "step_words", "warnings", "warnings_of", "warnings_of_all"]
SHEARED = 0.5  # share of the torque from which on the oil carries it

QUANTITY = re.compile(r"-?\d\S*( [^\s\d.]\S*)?")  # a number, and a word behind it: mostly its unit


def warnings(r: Record) -> list[str]:
    """Return what a reader must not miss, the most severe first."""
    judder = [Ranked(judder_text(r))] if r.judder and r.judder.kind != "decaying" else []
    lines: list[str] = [
        *r.found,
        *_not_locked(r),
        *_tie_up(r),
        *judder,
        *map(Ranked, chatter_texts(r)),
        *_washers_in_distress(r),
        *_teeth_overloaded(r),
        *(warning("hotter", time=e.time, text=e.text) for e in r.events if "hotter" in e.text),
    ]
    return severest_first(lines)


def warnings_of(result: Any) -> list[str]:
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


def _not_locked(r: Record) -> Iterator[str]:
    """Yield that the pack slips at the end, unless the words on judder say it."""
    if r.sticks_and_slips:
        if not (r.judder and r.judder.stick_slip):
            start = r.phases[-1].start
            yield warning("never_held", pack=r.engaging, start=start)
    elif r.figures["lock_time"] is None:
        yield warning("not_locked", pack=r.engaging)


def _tie_up(r: Record) -> list[str]:
    """Return what a tie-up was and where it came from; nothing where there was none."""
    lasted, most = r.figure("tie_up_duration"), r.figure("tie_up_torque")
    pack, other = r.engaging, r.releasing
    if lasted is None or most is None or lasted.value is None or most.value is None:
        return []
    begin = lasted.time or r.ramp_start
    before = r.at(f"transmission.{other}_reaction", r.ramp_start) or 0.0
    text = warning(
        "tie_up",
        begin=begin,
        lasted=lasted.value,
        other=other,
        before=before,
        most=most.value,
        heat=r.figures.get("tie_up_heat") or 0.0,
    )
    oil, whole = (abs(r.at(f"{pack}.{n}_torque", begin) or 0.0) for n in ("viscous", "friction"))
    if whole and oil / whole >= SHEARED:
        share, temperature = oil / whole, r.oil_temperature
        text += warning("sheared", pack=pack, share=share, begin=begin, oil=temperature)
    return [text]


def _washers_in_distress(r: Record) -> Iterator[str]:
    """Yield that the film was lost, and that a washer would turn in its seat."""
    distress, margin = r.figures.get("washer_distress_time") or 0.0, least_margin(r)
    if distress > 0.0:
        yield warning("distress", time=distress)
    if margin and margin.value < 1.0:
        load = r.at("washer.load", margin.time) or 0.0
        yield warning("gap_2", time=margin.time, load=load, margin=margin.value)


def _teeth_overloaded(r: Record) -> Iterator[str]:
    """Yield that stress is beyond endurance, or a safety below 1."""
    if stress := stress_words(r, over=1.0):
        yield warning("tooth_stress", stress=stress)
    for words, safety in (("pitting", pitting_safety(r)), ("scuffing", scuffing_safety(r))):
        if safety is not None and safety < 1.0:
            yield warning("teeth", kind=words, safety=safety)
