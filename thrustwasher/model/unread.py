"""Which parameters are not read, because of the value of another one.

A parameter's metadata say it. ``read_by`` holds conditions, each a parameter (or ``"fidelity"``)
and its value, or between the two one of ``RELATIONS``; one of them has to hold, of a parameter that
is read itself. One of ``SELF``: with that value it says what happens all the same. None: nothing
reads it. All conditions in ``read_with`` have to hold as well. ``only_for`` names all that a
parameter acts on where that is little. Descriptions, warnings and what FMUs check come from here.
"""

import operator
from collections.abc import Iterable, Mapping
from functools import cache
from typing import Any, NamedTuple

SELF = "self"
# In the order of the enum in the shell's tables.h.
RELATIONS = {"=": operator.eq, "!=": operator.ne, ">": operator.gt, ">=": operator.ge}


class Condition(NamedTuple):
    """What has to hold of a parameter, ``by``; without a name: never.

    ``is_required``: this one, not one of several. ``follows``: the other parameter has conditions
    itself, which do not lead back here.
    """

    by: str
    relation: str
    value: Any
    is_required: bool = False
    follows: bool = False

    def holds(self, present: Any) -> bool:
        """Tell if it holds of a value; of one that is not known it does."""
        return bool(self.by) and (present == "" or RELATIONS[self.relation](present, self.value))


Conditions = list[Condition]
NEVER = Condition("", "=", 0, is_required=True)


def conditions(metadata: Mapping[str, Any]) -> Conditions:
    """Return what lets a parameter be read, those that are required first; none if it always is."""
    if metadata.get("read_by") == ():
        return [NEVER]
    return [
        Condition(c[0], c[1] if len(c) == 3 else "=", c[-1], key == "read_with")
        for key in ("read_with", "read_by")
        for c in metadata.get(key, ())
    ]


@cache
def all_conditions(params: Any) -> dict[str, Conditions]:
    """Return the conditions of all parameters of a dataclass that have some, by name."""
    every = {n: conditions(f.metadata) for n, f in params.__dataclass_fields__.items()}
    found = {name: own for name, own in every.items() if own}
    return {
        name: [
            c._replace(by=name)
            if c.by == SELF
            else c._replace(follows=c.by in found and all(o.by != name for o in found[c.by]))
            for c in own
        ]
        for name, own in found.items()
    }


def condition_words(metadata: Mapping[str, Any]) -> str:
    """Return what a description says of the conditions of a parameter, "" if there are none."""
    found = [c for c in conditions(metadata) if c.by != SELF]
    words = f"; only for {metadata['only_for']}" if "only_for" in metadata else ""
    if NEVER in found:
        return f"{words}; not used in this model"
    one = _listed([c for c in found if not c.is_required], "or")
    all_ = _listed([c for c in found if c.is_required], "and")
    between = ", and " if " or " in one else " and "
    return f"{words}; used if {between.join(filter(None, (one, all_)))}" if found else words


def unread(params: Any, name: str, fidelity: str = "") -> Conditions:
    """Return the conditions that would let a parameter be read; none if it is read.

    ``fidelity``: the level, "" if it is not known.
    """
    return list(dict.fromkeys(_failing(params, name, fidelity)))


def _failing(params: Any, name: str, fidelity: str) -> Conditions:
    """Return the conditions that fail; for one that holds in vain those of its own parameter."""
    required: Conditions = []
    others: list[tuple[bool, Conditions]] = []  # of those of which one is enough: is it met?
    kind: Any = type(params)
    for c in all_conditions(kind).get(name, ()):
        holds, missing = c.holds(_value(params, c.by, fidelity)), [c] if c.by != name else []
        if holds:
            missing = _failing(params, c.by, fidelity) if c.follows else []
        if c.is_required:
            required += missing
        else:
            others.append((holds and not missing, missing))
    if required or any(met for met, _ in others):
        return required
    return [c for _, missing in others for c in missing]


def _value(params: object, by: str, fidelity: str) -> Any:
    return fidelity if by == "fidelity" else getattr(params, by, "")


def why_unread(params: object, failing: Iterable[Condition], fidelity: str = "") -> str:
    """Say what would read a parameter, and what there is instead."""
    wanted = [c for c in failing if c != NEVER]
    if not wanted:
        return "has no effect: this model does not use it"
    present = {c.by: _value(params, c.by, fidelity) for c in wanted}
    here = ", ".join(f"{by} is {_shown(x)}" for by, x in present.items() if x != "")
    between = "and" if wanted[0].is_required else "or"
    return f"has no effect: read by {_listed(wanted, between)} only; {here}"


def _listed(wanted: Iterable[Condition], between: str) -> str:
    """Return conditions in words, those of one parameter with each other."""
    groups: dict[str, list[str]] = {}
    for c in wanted:
        groups.setdefault(f"{c.by} {c.relation}", []).append(_shown(c.value))
    return f" {between} ".join(f"{head} {' or '.join(values)}" for head, values in groups.items())


def _shown(value: object) -> str:
    return f"{value:g}" if isinstance(value, float) else str(value)
