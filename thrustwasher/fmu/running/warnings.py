"""What the host of a running model is warned of: each once in a run, some counted for its end."""

from dataclasses import fields
from itertools import groupby
from typing import Any

from ...errors import FIRST_FAILURE, Status, figures_of
from ...model.levels import gone_level
from ...model.unread import unread
from ...tribology.holding.memory import T_ENGAGEMENT
from ...units import into_range
from ..description.interface import ADVISED, Variable

# What is said of an input outside the part's box, and outside what was verified: before it, behind.
RANGES = {
    "": "the part's box: solved all the same, but it is not what the part is meant for; change the "
    "input, or [box] in the part file",
    "OUTSIDE_VERIFIED: ": "for which the accuracy was verified; use with care",
}


MOST_UNUSED = 6  # parameters that are named one by one


def is_no_temperature(v: Variable, value: float) -> bool:
    """Tell if a value is 0 K, to which some hosts set an input that is not connected."""
    is_temperature = v.causality == "input" and v.unit == "K" and not v.relative
    return value == 0.0 and is_temperature and not v.bounds[0] <= value <= v.bounds[1]


class Warnings:
    """What a run was warned of, and what is to be said; ``core``: the ``Core`` that runs."""

    def __init__(self, core: Any) -> None:
        self._core, self._ranges = core, core.shown.ranges()
        self._beyond = [[False] * len(own) for own in self._ranges]
        self._left = [[0] * len(own) for own in self._ranges]  # how often in this run
        self._cared = dict[Status, int]()  # how often a solution began to need care
        self._engaged = dict[Status, float]()  # in which engagement that was told last
        self._warned = -1  # the status that was last told, -1: nothing yet
        self._told_long = False
        self._zeros = dict[str, str]()  # inputs at 0 K: what is still to be said
        self._advised = next((v.slot for v in core.shown.outputs if v.name == ADVISED), None)

    def note_zero(self, v: Variable, value: float) -> None:
        """Keep for ``zeros`` that an input at 0 K goes on with its last value."""
        text = f"{v.name} = 0 K, as some hosts set an input that is not connected: {value:g} K, "
        text += "its last value, stays; connect it to a constant; this is said once"
        self._zeros.setdefault(v.name, f"{self._core.here}: {text}")

    def zeros(self) -> list[str]:
        """Return what has to be said of inputs at 0 K."""
        found = [text for text in self._zeros.values() if text]
        self._zeros = dict.fromkeys(self._zeros, "")
        return found

    def long_step(self, h: float) -> str:
        """Return what is said of a step [s] that is longer than the advised one, else ""."""
        core = self._core
        advised = 0.0 if self._advised is None else core.out.item(self._advised)
        described = core.shown.experiment[1]
        if self._told_long or not 0.0 < advised < h or h <= (1.0 + 1e-6) * described:
            return ""
        self._told_long = True
        return (
            f"{core.here}: the step of {h:g} s is longer than advised_step = {advised:g} s "
            f"and than that of the description, {described:g} s; shorten the host's step; this is "
            "said once"
        )

    def advice(self) -> list[str]:
        """Return what the host has to be warned of now, the gravest first: each once in a run."""
        core = self._core
        found, begin, status = [], f"{core.here}: ", core.status
        if self._warned < 0:
            number = int(core.par.item(len(fields(core.spec.params))))
            level = list(core.spec.fidelities)[number - 1]
            told = (*gone_level(core.spec, level), *self._unused(level))
            found += [begin + text for text in told]
        unverified = any(self._is_beyond(1, i) for i in range(len(core.shown.inputs)))
        is_known = status == self._warned or (status is Status.OUTSIDE_VERIFIED and unverified)
        is_known |= status is Status.HOT and self._warned == Status.EXTRAPOLATED
        self._warned = status
        if not is_known and Status.OK < status < FIRST_FAILURE:
            self._cared[status] = self._cared.get(status, 0) + 1
            figures = figures_of(status, core.told.tolist())
            engaged = self._engaged.get(status, 0.0)
            if self._cared[status] == 1 or (figures and core.told[T_ENGAGEMENT] != engaged):
                self._engaged[status] = core.told.item(T_ENGAGEMENT) if figures else 0.0
                point = core.point(core.shown.point)
                found.append(f"{begin}{status.name}: {status.advice}; {figures}{point}")
        for k, (name, words) in reversed([*enumerate(RANGES.items())]):
            for i, v in enumerate(core.shown.inputs):
                was_beyond, self._beyond[k][i] = self._beyond[k][i], self._is_beyond(k, i)
                if was_beyond or not self._beyond[k][i]:
                    continue
                self._left[k][i] += 1
                if self._left[k][i] == 1:
                    value, unit = core.inp.item(v.slot), f" {v.unit}".removesuffix(" 1")
                    low, high = self._ranges[k][i]
                    span = f"is outside {low:g} .. {high:g}{unit}, {words}"
                    found.append(f"{begin}{name}{v.name} = {value:g}{unit} {span}")
        return found

    def counts(self) -> list[str]:
        """Return, for the end of a run, how often it was as was warned of once."""
        core = self._core
        found = [(status.name, n) for status, n in sorted(self._cared.items())]
        for k, what in ((1, "left the verified range"), (0, "left the part's box")):
            pairs = zip(core.shown.inputs, self._left[k], strict=True)
            found += [(f"{v.name} {what}", n) for v, n in pairs]
        name = core.spec.name
        return [
            f"{name}: {what} {n} times in this run; the first is told above"
            for what, n in found
            if n > 1
        ]

    def _is_beyond(self, k: int, i: int) -> bool:
        """Tell if an input is outside a range of its own: 0 the part's box, 1 what was verified."""
        core, (low, high) = self._core, self._ranges[k][i]
        return not low <= into_range(low, high, core.inp.item(core.shown.inputs[i].slot)) <= high

    def _unused(self, level: str) -> list[str]:
        """Return which parameters were set away from their starts and are not used, in a line."""
        core = self._core
        params, level = core.parameters(), core.spec.successors.get(level, level)
        lines = []
        for v in core.shown.parameters:
            failing = unread(params, v.name, level) if core.value(v) != v.start else []
            if failing:
                named = [self._setting(by) for by, _ in groupby(c.by for c in failing) if by]
                why = f": {', '.join(named)}" if named else ""
                lines.append(f"{self._setting(v.name)} is not used{why}")
        more = [f"and {len(lines) - MOST_UNUSED} more"] if len(lines) > MOST_UNUSED else []
        return ["; ".join(lines[:MOST_UNUSED] + more)] if lines else []

    def _setting(self, name: str) -> str:
        """Return name and value of a parameter in words."""
        core = self._core
        v = next(v for v in core.shown.parameters if v.name == name)
        value = core.value(v)
        if v.type_name:
            return f"{name} = {core.shown.enumerations[v.type_name][int(value) - 1].name}"
        if v.type == "Boolean":
            return f"{name} = {'true' if value else 'false'}"
        return str(core.point([v]))
