"""The tables of a model as C source, and what an FMU says of its own: all the shell knows of both.

The tables are those of the model; they know no name, no start values and no version of FMI.
"""

import hashlib
import struct
import zlib
from collections.abc import Sequence
from functools import cache
from typing import Any

from ...errors import FIRST_FAILURE, Status
from ...model.registry import kernel_of
from ...model.rungs import gone_rung
from ...native.shipped import digest_now
from ..description.interface import LOG_CATEGORIES, Interface, Variable
from ..description.model_description import TYPES
from ..model_kernels import has_derivatives
from . import call_table

SIZES = ("NPAR", "NINP", "NSTATE", "NWORK", "NOUT", "NIOUT")
MOST_INPUTS = 32  # dependencies are bits of one word
# The C files of a native FMU beside the generated ones and the dispatch to the kernels.
SHELL_FILES = (
    "lifecycle.c",
    "resource.c",
    "values.c",
    "text.c",
    "messages.c",
    "state.c",
    "derivative.c",
    "fmi2.c",
    "fmi2_values.c",
    "fmi3.c",
    "fmi3_values.c",
    "fmi3_state.c",
    "fmi3_declined.c",
)
VERSIONS = (2, 3)  # of FMI, both in one library
PART, MAGIC, WORD = "part.bin", b"twpart2\0", 64  # as in shell.h


def sources(shown: Interface) -> dict[str, str]:
    """Return model.h and model.c, file name -> text."""
    header, tables = _texts(shown)
    build = build_of(shown)
    return {"model.h": header.replace("@BUILD@", build), "model.c": tables}


@cache
def _texts(shown: Interface) -> tuple[str, str]:
    lists = _lists(shown)
    return _header(shown, lists), _tables(lists)


def build_of(shown: Interface) -> str:
    """Return 16 hex digits over kernels and tables, by which a library knows its parts."""
    texts = digest_now(shown.spec.kernel), *_texts(shown)
    return hashlib.sha256("".join(texts).encode()).hexdigest()[:16]


def part_file(shown: Interface, guid: str) -> bytes:
    """Return resources/part.bin: build of the library, identifier, name, start values, ranges.

    ``guid`` is what the description calls guid (FMI 2) or instantiationToken (FMI 3).
    """
    words = (text.encode().ljust(WORD, b"\0") for text in (guid, shown.spec.name))
    starts = [v.start or 0.0 for v in shown.variables]
    ranges = shown.ranges(max(kernel_of(shown.spec).NINP, 1))
    numbers = [*starts, *(x for pairs in ranges for pair in pairs for x in pair)]
    body = b"".join(
        (MAGIC, build_of(shown).encode(), *words, struct.pack(f"<{len(numbers)}d", *numbers))
    )
    return body + struct.pack("<I", zlib.crc32(body))


def _lists(shown: Interface) -> dict[str, tuple[str, list[str]]]:
    """Return name of the table -> (C type, rows).

    Categories, types and causalities are in the order of the enums in tables.h.
    """
    names = list(shown.enumerations)
    inputs = [v.name for v in shown.inputs]
    assert len(inputs) <= MOST_INPUTS, "dependencies are bits of one word"
    return {
        "VARIABLES": ("Variable", [_variable(v, inputs, names) for v in shown.variables]),
        "ENUMERATIONS": (
            "Enumeration",
            [
                _row(_text(name), len(items), f"ITEMS_{name}")
                for name, items in shown.enumerations.items()
            ],
        ),
        "STATUSES": (
            "StatusText",
            [_row(int(s), _text(s.name), _text(s.advice)) for s in sorted(Status)],
        ),
        "SWITCHES": (
            "Switch",
            [_row(slot, *map(_text, events)) for slot, events in shown.switches],
        ),
        "COUNTS": ("Count", [_row(_text(text), place) for text, place in shown.counts]),
        "RULES": ("Rule", [_row(_text(rule.text)) for rule in shown.spec.rules]),
        "GONE_RUNGS": (
            "Item",
            [
                _row(number, _text(line))
                for number, name in enumerate(shown.spec.fidelities, 1)
                for line in gone_rung(shown.spec, name)
            ],
        ),
        "CATEGORIES": (
            "Category",
            [_row(_text(name), int(name in shown.categories)) for name in LOG_CATEGORIES],
        ),
        "TYPES": ("TypeText", [_row(*map(_text, names)) for names in TYPES.items()]),
        "ACCESS": ("Access", [_row(*modes) for modes in call_table.ACCESS.values()]),
        "MODES": (
            "ModeText",
            [
                _row(mode, _text(name), _text(leave))
                for mode, (name, leave) in call_table.MODES.items()
            ],
        ),
        "CALLS": (
            "Call",
            [
                _row(_text(f"fmi{fmi}{name}"), modes, _text(call_table.DECLINED[fmi].get(name)))
                for fmi in VERSIONS
                for name, modes in call_table.CALLS[fmi].items()
            ],
        ),
        **{
            f"ITEMS_{name}": ("Item", [_row(item.value, _text(item.name)) for item in items])
            for name, items in shown.enumerations.items()
        },
    }


def _variable(v: Variable, inputs: Sequence[str], names: Sequence[str]) -> str:
    kind, cause = v.type.upper(), v.causality.upper()
    depends = sum(1 << inputs.index(name) for name in v.depends)
    return _row(
        _text(v.name),
        _text(v.unit),
        *(float(x).hex() for x in v.bounds),
        f"0x{depends:x}u",
        v.slot,
        names.index(v.type_name) if v.type_name else -1,
        f"TYPE_{kind}",
        f"CAUSE_{cause}",
        f"STORE_{v.store.upper()}",
        int(v.relative),
        int(v.variability == "tunable"),
        f"TYPE_BIT(TYPE_{kind}) | CAUSE_BIT(CAUSE_{cause})",
    )


def _header(shown: Interface, lists: dict[str, tuple[str, list[str]]]) -> str:
    kernel = kernel_of(shown.spec)
    status = -1 if shown.status_slot is None else shown.status_slot
    numbers = {
        **{name: getattr(kernel, name) for name in SIZES},
        "IO_STATUS": status,
        "FIRST_FAILURE": FIRST_FAILURE,
        "RUNG": next(v.slot for v in shown.parameters if v.name == "fidelity"),
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


def _row(*values: Any) -> str:
    return "{" + ", ".join(map(str, values)) + "}"


def _text(value: str | None) -> str:
    """Return a C literal; whatever C might read as something else is written as octal digits."""
    if value is None:
        return "0"
    plain = set(range(0x20, 0x7F)) - set(b'"\\?')
    return '"' + "".join(chr(b) if b in plain else f"\\{b:03o}" for b in value.encode()) + '"'
