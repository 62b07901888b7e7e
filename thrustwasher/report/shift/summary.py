"""What the report says of a shift in sentences; they stand in ``words.jinja``."""

import math
import re
from collections.abc import Sequence
from functools import cache
from pathlib import Path
from typing import Any

from ...templates import environment
from ...units import format_quantity
from .shift_record import PACKS, Record, record_of
from .shift_tables import source_texts
from .usual import of_meshes
from .worst_moments import highest, least_margin

QUANTITY = re.compile(r"-?\d\S*( [^\s\d.]\S*)?")  # a number, and a word behind it: mostly its unit


@cache
def words() -> Any:
    """Return the template, whose macros are functions."""
    reader = environment(escape=False)
    reader.filters["f"] = lambda value, text: format(value, text)
    reader.filters["say"] = lambda value, unit, digits=3: format_quantity(
        value, unit, digits=digits
    )
    reader.globals.update(highest=highest, least_margin=least_margin, pi=math.pi,
                          pitting=of_meshes("pitting_safety"),
                          scuffing=of_meshes("scuffing_safety"))  # fmt: skip
    text = Path(__file__).with_name("words.jinja").read_text("utf-8")
    return reader.from_string(text).module


def paragraphs(name: str, *told: Any) -> list[str]:
    """Return what a macro of the template says of what it is told, a text for each paragraph."""
    said = str(getattr(words(), name)(*told))
    return [re.sub(r"[ \n]+", " ", text).strip(" ") for text in said.split("¶")[1:]]


def sentences(record: Record) -> list[str]:
    """Return the course, the heat of the engaging pack, then what sits at the planets or the book.

    Three sentences; a fourth if there are both washers and gear meshes.
    """
    return paragraphs("sentences", record)


def warnings(record: Record) -> list[str]:
    """Return what a reader must not miss: doubts about the figures, then faults they show."""
    return [*record.found, *paragraphs("warnings", record)]


def warnings_of(result: Any) -> list[str]:
    """Return what a reader of a shift's or a sequence's result must not miss."""
    if result.scene.sequence:
        return [*result.found, *warnings_of_all([record_of(shift) for shift in result.shifts])]
    return warnings(record_of(result))


def warnings_of_all(records: Sequence[Record]) -> list[str]:
    """Return what must not be missed, of the first shift that it is said of.

    Two texts say the same if they differ in numbers and units alone.
    """
    found: dict[str, tuple[str, list[str]]] = {}
    for i, record in enumerate(records, 1):
        for text in warnings(record):
            found.setdefault(QUANTITY.sub("#", text), (text, []))[1].append(str(i))
    return [_said_of(text, list(dict.fromkeys(shifts))) for text, shifts in found.values()]


def _said_of(text: str, shifts: list[str]) -> str:
    """Return a warning with the shifts that it holds for."""
    likewise = f"{'' if text.endswith('.') else '.'} Likewise shifts {', '.join(shifts[1:])}."
    return f"Shift {shifts[0]}: {text}" + (likewise if len(shifts) > 1 else "")


def step_words(result: Any) -> list[str]:
    """Return what the step errs by in the shifts of a sequence that were checked."""
    return [f"Error of the step in shift {i + 1}: {error.words()}"
            for i, error in result.step_errors.items()]  # fmt: skip


def trust_texts(record: Record) -> list[str]:
    """Return what the numbers are worth."""
    rungs = {part.parameters.get("fidelity") for part in record.parts
             if part.name in PACKS and record.presses(part.name)}  # fmt: skip
    return paragraphs("trust", record, rungs == {"field"}, source_texts(record))
