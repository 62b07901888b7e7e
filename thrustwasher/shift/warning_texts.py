"""Texts of warnings of a shift, from ``warning_texts.toml``; the page of a scene has the same."""

import re

from ..model.toml_tables import table_beside
from ..units import format_quantity

TEXTS: dict[str, str] = table_beside(__file__, "warning_texts.toml")
FIELD = re.compile(r"{(\w+)(?::([^}]*))?}")
NUMBER = re.compile(r"(\.\d+)?[gf%]")  # a format of Python's; any other is a unit, and digits


def warning(key: str, /, **values: object) -> str:
    """Return the text of that key with values in SI units.

    >>> warning("why_numerical", every=1.5)
    'a lock-up every 1.5 steps, which is numerical: their number follows the step'
    """

    def filled(found: re.Match[str]) -> str:
        value, form = values[found[1]], found[2]
        if not form:
            return str(value)
        if NUMBER.fullmatch(form):
            return format(value, form)
        unit, _, digits = form.partition(",")
        return format_quantity(float(value), unit, digits=int(digits or 4))  # type: ignore[arg-type]

    return FIELD.sub(filled, TEXTS[key])
