"""What the report says of a shift at its top: what happened, and what a reader must not miss."""

import re
from collections.abc import Iterator, Sequence
from functools import partial
from typing import Any

from ...units import format_quantity
from .shift_record import Record, record_of
from .swing_texts import chatter_texts, judder_text
from .what_happened import pitting_safety, scuffing_safety, sentences, stress_words
from .worst_moments import least_margin

__all__ = ["sentences", "step_words", "warnings", "warnings_of", "warnings_of_all"]
say = partial(format_quantity, digits=3)
SHEARED = 0.5  # share of the torque from which on the oil carries it

QUANTITY = re.compile(r"-?\d\S*( [^\s\d.]\S*)?")  # a number, and a word behind it: mostly its unit


def warnings(r: Record) -> list[str]:
    """Return what a reader must not miss: doubts about the figures, then faults they show."""
    judder = [judder_text(r)] if r.judder and r.judder.kind != "decaying" else []
    return [
        *r.found,
        *_not_locked(r),
        *_tie_up(r),
        *judder,
        *chatter_texts(r),
        *_washers_in_distress(r),
        *_teeth_overloaded(r),
        *(f"From {e.time:.4g} s on: {e.text}." for e in r.events if "hotter" in e.text),
    ]


def warnings_of(result: Any) -> list[str]:
    """Return what a reader of a shift's or a sequence's result must not miss."""
    if result.scene.sequence:
        return [*result.found, *warnings_of_all([shift.warnings for shift in result.shifts])]
    return warnings(record_of(result))


def warnings_of_all(warnings: Sequence[Sequence[str]]) -> list[str]:
    """Return what must not be missed of several shifts, with the first one it holds for.

    Two texts say the same if they differ in numbers and units alone.
    """
    found: dict[str, tuple[str, list[str]]] = {}
    for i, texts in enumerate(warnings, 1):
        for text in texts:
            found.setdefault(QUANTITY.sub("#", text), (text, []))[1].append(str(i))
    lines = []
    for text, shifts in found.values():
        first, *others = dict.fromkeys(shifts)
        end = "" if text.endswith(".") else "."
        likewise = f"{end} Likewise shifts {', '.join(others)}." if others else ""
        lines.append(f"Shift {first}: {text}{likewise}")
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
            yield (
                f"The {r.engaging} never held: from {start:.4g} s to the end it stuck and slipped "
                "in turn."
            )
    elif r.figures["lock_time"] is None:
        yield f"The {r.engaging} did not lock: the shift is not finished at the end of the run."


def _tie_up(r: Record) -> list[str]:
    """Return what a tie-up was and where it came from; nothing where there was none."""
    lasted, most = r.figure("tie_up_duration"), r.figure("tie_up_torque")
    pack, other = r.engaging, r.releasing
    if lasted is None or most is None or lasted.value is None or most.value is None:
        return []
    begin = lasted.time or r.ramp_start
    before = r.at(f"transmission.{other}_reaction", r.ramp_start) or 0.0
    text = (
        f"Tie-up: from {begin:.4g} s on both packs worked against each other for "
        f"{say(lasted.value, 's')}. The torque of the {other} turned from {say(before, 'N.m')} to "
        f"{say(most.value, 'N.m')}, and it took up {say(r.figures.get('tie_up_heat') or 0.0, 'J')} "
        "of heat meanwhile."
    )
    oil, whole = (abs(r.at(f"{pack}.{n}_torque", begin) or 0.0) for n in ("viscous", "friction"))
    if whole and oil / whole >= SHEARED:
        text += (
            f" The {pack} closed early: {oil / whole:.0%} of its torque at {begin:.4g} s was shear "
            f"of the oil, supplied at {say(r.oil_temperature, 'K')}."
        )
    return [text]


def _washers_in_distress(r: Record) -> Iterator[str]:
    """Yield that the film was lost, and that a washer would turn in its seat."""
    distress, margin = r.figures.get("washer_distress_time") or 0.0, least_margin(r)
    if distress > 0.0:
        yield (
            f"Thermo-viscous distress: the washers' oil film was lost for {say(distress, 's')}. "
            "Torque and temperatures of that time are those of the equations; no real film "
            "survives there."
        )
    if margin and margin.value < 1.0:
        load = say(r.at("washer.load", margin.time) or 0.0, "N")
        yield (
            f"Gap 2 cannot hold the washers: at {margin.time:.4g} s, under a load of {load}, dry "
            f"friction between washer and gear can take {margin.value:.2g} times the friction "
            "torque of film 1. The washer would turn with less than the gear's speed; the model "
            "assumes that the two turn together."
        )


def _teeth_overloaded(r: Record) -> Iterator[str]:
    """Yield that stress is beyond endurance, or a safety below 1."""
    if stress := stress_words(r, over=1.0):
        yield (
            f"Tooth stress beyond endurance: {stress}. It is the stress of one straight pair of "
            "teeth that carries the whole load; hardened flanks endure more than these steels."
        )
    for words, safety in (("pitting", pitting_safety(r)), ("scuffing", scuffing_safety(r))):
        if safety is not None and safety < 1.0:
            yield (
                f"The teeth may not last: their least safety against {words} is {safety:.2f}, by "
                "formulas as standards are publicly quoted."
            )
