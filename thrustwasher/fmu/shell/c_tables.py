"""The tables of a model as C source, and what an FMU says of its own: all the shell knows of both.

The tables are those of the model; they know no name, no start values and no version of FMI.
"""

import hashlib
import re
import struct
import zlib
from collections.abc import Iterable, Sequence
from functools import cache
from typing import Any

import numpy as np

from ...errors import FIGURES, FIRST_FAILURE, Status
from ...model.levels import gone_level
from ...model.registry import exchange_kernel_of, kernel_of
from ...model.unread import RELATIONS, all_conditions
from ...native.digest import digest
from ...tribology.holding.memory import N_FIGURES, T_ENGAGEMENT
from ..description.interface import ADVISED, LOG_CATEGORIES, Interface, Variable
from ..description.model_description import TYPES
from ..model_kernels import has_derivatives, seed_length
from . import call_table

SIZES = ("NPAR", "NINP", "NSTATE", "NWORK", "NOUT", "NIOUT")
EXCHANGE_SIZES = ("NOWN", "NCONT", "NMODE", "NSIGN", "TIME_AT")
MOST_INPUTS = 32  # dependencies are bits of one word
# The C files of a native FMU next to the generated ones and the dispatch to the kernels.
SHELL_FILES = tuple(
    """
    lifecycle.c events.c solution.c resource.c library_file.c values.c text.c messages.c state.c
    derivative.c exchange.c exchange_solution.c exchange_derivative.c
    fmi2.c fmi2_values.c fmi2_exchange.c
    fmi3.c fmi3_values.c fmi3_state.c fmi3_exchange.c fmi3_declined.c
    """.split()
)
VERSIONS = (2, 3)  # of FMI, both in one library
PART, MAGIC, WORD = "part.bin", b"twpart3\0", 64  # as in shell.h
PART_IN_C, TABLE_IN_C = "part.c", "table.c"
PLAIN = frozenset(range(0x20, 0x7F)) - frozenset(b'"\\?')  # what a literal of C holds as it is
UNPLAIN = re.compile("[^" + re.escape("".join(map(chr, sorted(PLAIN)))) + "]")


def sources(shown: Interface) -> dict[str, str]:
    """Return model.h and model.c, file name -> text."""
    header, tables = _texts(shown)
    return {"model.h": header.replace("@BUILD@", build_of(shown)), "model.c": tables}


@cache
def _texts(shown: Interface) -> tuple[str, str]:
    lists = _lists(shown)
    return _header(shown, lists), _tables(lists)


def build_of(shown: Interface) -> str:
    """Return 16 hex digits over kernels and tables, by which a library knows its parts."""
    texts = digest(shown.spec.kernel), *_texts(shown)
    return hashlib.sha256("".join(texts).encode()).hexdigest()[:16]


def part_file(shown: Interface, guid: str) -> bytes:
    """Return resources/part.bin: build of the library, identifier, name, numbers.

    ``guid`` is what the description calls guid (FMI 2) or instantiationToken (FMI 3).
    """
    words = (text.encode().ljust(WORD, b"\0") for text in (guid, shown.spec.name))
    starts, ranges, step = _of_part(shown)
    numbers = [*starts, *(x for pairs in ranges for pair in pairs for x in pair), step]
    body = b"".join(
        (MAGIC, build_of(shown).encode(), *words, struct.pack(f"<{len(numbers)}d", *numbers))
    )
    return body + struct.pack("<I", zlib.crc32(body))


def _of_part(shown: Interface) -> tuple[list[float], tuple[list[tuple[float, float]], ...], float]:
    """Return start values of all variables, both ranges of each input, and the step [s]."""
    starts = [v.start or 0.0 for v in shown.everything]
    return starts, shown.ranges(max(kernel_of(shown.spec).NINP, 1)), shown.experiment[1]


def part_in_c(shown: Interface, guid: str) -> str:
    """Return the same as ``part_file`` as C source."""
    starts, ranges, step = _of_part(shown)
    build = ", ".join(map(repr, build_of(shown)))
    words = f'"{MAGIC[:-1].decode()}", {{{build}}}, {_text(guid)}'
    pairs = (", ".join(_floats(pair) for pair in pairs) for pairs in ranges)
    return "\n".join(
        [
            "/* Generated: what this FMU says of its own. */",
            '#include "shell.h"',
            "",
            f"const Part COMPILED_PART[] = {{{{{words}, {_text(shown.spec.name)},",
            f"    {_floats(starts)},",
            f"    {{{', '.join(f'{{{row}}}' for row in pairs)}}}, {float(step).hex()}}}}};",
            "",
        ]
    )


def table_in_c(file: bytes, n: int) -> str:
    """Return a table, given as its file, as C source: ``n`` numbers of its header, the others."""
    header = struct.unpack_from(f"<{n}d", file)
    numbers = np.frombuffer(file, "<f4", offset=8 * n, count=(len(file) - 8 * n - 4) // 4)
    rows = [f"{x!s}f," if "." in str(x) or "e" in str(x) else f"{x!s}.0f," for x in numbers]
    lines = ("".join(rows[k : k + 8]) for k in range(0, len(rows), 8))
    return "\n".join(
        [
            "/* Generated: the table this model looks its answers up in. */",
            '#include "shell.h"',
            "",
            f"const double COMPILED_HEADER[] = {_floats(header)};",
            "const float COMPILED_TABLE[] = {",
            *lines,
            "};",
            "",
        ]
    )


def _floats(values: Iterable[float]) -> str:
    return "{" + ", ".join(float(x).hex() for x in values) + "}"


class _Code(str):
    """A piece of C, where a plain text becomes a literal."""


def _lists(shown: Interface) -> dict[str, tuple[str, list[str]]]:
    """Return name of the table -> (C type, rows).

    Categories, types and causalities are in the order of the enums in tables.h.
    """
    calls, names = call_table.CALLS, list(shown.enumerations)
    inputs, states = ([v.name for v in found] for found in (shown.inputs, shown.continuous))
    assert max(len(inputs), len(states)) <= MOST_INPUTS, "dependencies are bits of one word"
    levels = enumerate(shown.spec.fidelities, 1)
    tables: dict[str, tuple[str, Iterable[Iterable[Any]]]] = {
        "VARIABLES": ("Variable", [_variable(v, inputs, states, names) for v in shown.everything]),
        "PLACES": ("Place", [(_bits(v), v.slot) for v in shown.everything]),
        "ENUMERATIONS": (
            "Enumeration",
            [(n, len(items), _Code(f"ITEMS_{n}")) for n, items in shown.enumerations.items()],
        ),
        "CONTINUOUS_STATES": ("ContinuousState", [_state(v) for v in shown.continuous]),
        "REQUIREMENTS": ("Requirement", _requirements(shown)),
        "CONDITIONS": ("Condition", _conditions(shown)),
        "STATUSES": ("StatusText", [(int(s), s.name, s.advice) for s in sorted(Status)]),
        "SWITCHES": ("Switch", [_switch(shown, slot, events) for slot, events in shown.switches]),
        "COUNTS": ("Count", shown.counts),
        "FIGURES": (
            "Figure",
            [(int(s), *row) for s, *row in FIGURES if hasattr(kernel_of(shown.spec), "W_TOLD")],
        ),
        "RULES": ("Rule", [(rule.text,) for rule in shown.spec.rules]),
        "GONE_LEVELS": (
            "Item",
            [(k, t) for k, name in levels for t in gone_level(shown.spec, name)],
        ),
        "CATEGORIES": ("Category", [(n, int(n in shown.categories)) for n in LOG_CATEGORIES]),
        "TYPES": ("TypeText", TYPES.items()),
        "ACCESS": ("Access", call_table.ACCESS.values()),
        "MODES": ("ModeText", [(mode, *texts) for mode, texts in call_table.MODES.items()]),
        "CALLS": (
            "Call",
            [
                (f"fmi{fmi}{name}", modes, call_table.DECLINED[fmi].get(name))
                for fmi in VERSIONS
                for name, modes in calls[fmi].items()
            ],
        ),
    }
    for name, items in shown.enumerations.items():
        tables[f"ITEMS_{name}"] = "Item", [(item.value, item.name) for item in items]
    return {name: (kind, [_row(row) for row in rows]) for name, (kind, rows) in tables.items()}


def _requirements(shown: Interface) -> list[list[Any]]:
    needed = shown.spec.exchange.requires if shown.spec.exchange else {}
    found = []
    for v in shown.parameters:
        if v.name in needed:
            items = {i.value: i.name for i in shown.enumerations.get(v.type_name or "", ())}
            value = needed[v.name]
            found.append([v.slot, float(value), v.name, items.get(int(value), str(value))])
    return found


def _state(v: Variable) -> list[Any]:
    return [v.name, _Code(float(v.nominal or 1.0).hex()), v.slot if v.store == "out" else -1]


def _variable(
    v: Variable, inputs: Sequence[str], states: Sequence[str], names: Sequence[str]
) -> list[Any]:
    depends = sum(1 << inputs.index(name) for name in {*v.depends, *v.exchange_depends})
    codes = f"TYPE_{v.type.upper()}", f"CAUSE_{v.causality.upper()}", f"STORE_{v.store.upper()}"
    return [
        v.name,
        v.unit,
        *(_Code(float(x).hex()) for x in v.bounds),
        _Code(f"0x{depends:x}u"),
        _Code(f"0x{sum(1 << states.index(name) for name in v.states):x}u"),
        v.slot,
        names.index(v.type_name) if v.type_name else -1,
        *map(_Code, codes),
        int(v.relative),
        int(v.variability == "tunable"),
        _bits(v),
    ]


def _bits(v: Variable) -> _Code:
    return _Code(f"TYPE_BIT(TYPE_{v.type.upper()}) | CAUSE_BIT(CAUSE_{v.causality.upper()})")


def _conditions(shown: Interface) -> list[list[Any]]:
    """Return what lets parameters be used; a level that is gone counts as that which runs."""
    places = {v.name: v for v in shown.parameters}
    params: Any = shown.spec.params
    gone, found = shown.spec.successors, []
    for name, own in all_conditions(params).items():
        for c in own:
            by = places.get(c.by)
            kind = (by and by.type_name) or ""
            items = {i.name: i.value for i in shown.enumerations.get(kind, ())}
            same = [old for old, new in gone.items() if new == c.value and c.by == "fidelity"]
            for value in (c.value, *same):
                number = float(items[value] if items else value)
                relation = list(RELATIONS).index(c.relation)
                row = [places[name].reference, by.reference if by else -1, relation]
                found.append([_Code(number.hex()), *row, int(c.is_required), int(c.follows)])
    return found


def _switch(shown: Interface, slot: int, events: tuple[str, str]) -> list[Any]:
    return [slot, *events, _Code(f"{{{', '.join(map(str, shown.instants(slot)))}}}")]


def _header(shown: Interface, lists: dict[str, tuple[str, list[str]]]) -> str:
    kernel = kernel_of(shown.spec)
    status = -1 if shown.status_slot is None else shown.status_slot
    exchange = exchange_kernel_of(shown.spec)
    numbers = {
        **{name: getattr(kernel, name) for name in SIZES},
        "NRATES": getattr(kernel, "NRATES", 0),
        "NSEED": seed_length(kernel),
        "RUN_START": getattr(kernel, "RUN_START", -1),
        **{name: getattr(exchange, name, 0) for name in EXCHANGE_SIZES},
        "HAS_EXCHANGE": int(exchange is not None),
        "NEEDS_STEPS": int(bool(shown.spec.exchange and shown.spec.exchange.steps)),
        "IO_STATUS": status,
        "W_TOLD": getattr(kernel, "W_TOLD", 0),
        "W_STATES": getattr(kernel, "W_STATES", 0),
        "N_TOLD": N_FIGURES,
        "TOLD_ENGAGEMENT": T_ENGAGEMENT,
        "ADVISED": next((v.slot for v in shown.outputs if v.name == ADVISED), -1),
        "FIRST_FAILURE": FIRST_FAILURE,
        "LEVEL": next(v.slot for v in shown.parameters if v.name == "fidelity"),
        **{f"STATUS_{s.name}": int(s) for s in Status},
        **{f"N_{name}": len(rows) for name, (_, rows) in lists.items() if name != "CATEGORIES"},
        **{f"TABLE_{name}": value for name, value in getattr(kernel, "TABLE", {"ROOM": 0}).items()},
        "HAS_RULES": int(hasattr(kernel, "broken_rule")),
        "HAS_SENS": int(has_derivatives(shown.spec)),
    }
    return "\n".join(
        [
            "/* Generated: what the shell knows about this model. */",
            "#ifndef THRUSTWASHER_MODEL_H",
            "#define THRUSTWASHER_MODEL_H",
            "",
            '#include "tables.h"',
            "",
            '#define BUILD "@BUILD@"',
            *(f"#define {name} {value}" for name, value in numbers.items()),
            "",
            f"/* The variables that say at which point an event happened. */\n"
            f"#define POINT {{{', '.join([*(str(v.reference) for v in shown.point), '-1'])}}}",
            "",
            "/* Places in CALLS. */",
            "enum {",
            *(f"    CALL_fmi{fmi}{name}," for fmi in VERSIONS for name in call_table.CALLS[fmi]),
            "};",
            "",
            *(f"extern const {kind} {name}[];" for name, (kind, _) in lists.items()),
            "",
            "#endif",
            "",
        ]
    )


def _tables(lists: dict[str, tuple[str, list[str]]]) -> str:
    """Return the definitions; those that others refer to stand first."""
    parts = ["/* Generated: the tables of this model. */", '#include "model.h"', ""]
    for name in reversed(lists):
        kind, rows = lists[name]
        parts += [f"const {kind} {name}[] = {{", *(f"    {row}," for row in rows or ["{0}"]), "};"]
    return "\n".join([*parts, ""])


def _row(values: Iterable[object]) -> str:
    return "{" + ", ".join(map(_text, values)) + "}"


def _text(value: object) -> str:
    """Return a value in C; in a literal all that C might read otherwise is octal digits."""
    if value is None:
        return "0"
    if isinstance(value, _Code) or not isinstance(value, str):
        return str(value)
    if UNPLAIN.search(value):
        octal = (chr(b) if b in PLAIN else f"\\{b:03o}" for b in value.encode())
        return f'"{"".join(octal)}"'
    return f'"{value}"'
