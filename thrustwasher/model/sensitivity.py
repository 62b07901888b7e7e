"""Derivatives of results over parameters, and differences where a solve is quick."""

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import fields, replace
from typing import Any, NamedTuple

from ..errors import ParameterError, suggestion
from .parameters import held_choices
from .registry import find_model
from .solutions import Asked, Late

STEP = 1e-6  # of a value, or of its range where it is 0
Table = dict[str, dict[str, float]]  # output -> parameter -> derivative
Points = tuple[tuple[float, float], ...]  # offsets and weights


class Varied(NamedTuple):
    """A parameter, and a difference over it: the sum of weight x function at value + offset."""

    name: str
    place: int  # in the parameter array
    value: float
    points: Points


class Differentiable(Late):
    """Base of results that follow from their parameters quickly and to rounding."""

    __slots__ = ()
    _request: Asked

    def request(self) -> Asked:
        """Return model, parameters and point that it is the solution of."""
        return self._request

    def sensitivities(
        self,
        outputs: Collection[str] | None = None,
        parameters: Collection[str] | None = None,
        *,
        per_percent: bool = False,
    ) -> Table:
        """Return {output: {parameter: derivative}}, SI, by central differences of 1e-6.

        Parameters
        ----------
        outputs : names of real results; by default all there are
        parameters : names; by default all real ones but those whose 0 stands for a value from
            elsewhere, and those that a rule holds where they are
        per_percent : return the change of the output for one percent of the parameter instead

        Raises
        ------
        ParameterError : a name is none of them
        SolveError : next to this point there is no solution

        Notes
        -----
        At a corner (a law that changes, another place of the path that is hottest) it is the mean
        of both sides. Error: docs/theory/sensitivity.md.
        """
        return chosen_unit(
            self._request.params, per_percent, _differences(self, outputs, parameters)
        )


def varied_parameters(params: Any, wanted: Collection[str] | None) -> list[Varied]:
    """Return the real parameters, or those of them that are requested.

    Left out are counts, choices, and those whose 0 stands for a value from elsewhere.

    Raises
    ------
    ParameterError : a name that is requested is none of them
    """
    found = [
        Varied(f.name, place, value, next(_difference(value, f.metadata)))
        for place, f in enumerate(fields(params))
        if f.metadata["kind"] == "real"
        for value in (float(getattr(params, f.name)),)
        if value != 0.0 or not (f.metadata.get("overrides") or f.metadata.get("at_zero"))
    ]
    names = _chosen("parameters", wanted, [v.name for v in found])
    return [v for v in found if v.name in names]


def wanted_outputs(wanted: Collection[str] | None, outputs: Sequence[str]) -> list[str]:
    """Return the outputs that are requested, by default all; ParameterError for an unknown one."""
    return _chosen("outputs", wanted, outputs)


def chosen_unit(params: object, per_percent: bool, found: Table) -> Table:
    """Return derivatives as they are, or as changes for one percent of each parameter."""
    if not per_percent:
        return found
    return {
        output: {name: 0.01 * getattr(params, name) * slope for name, slope in row.items()}
        for output, row in found.items()
    }


def _differences(
    result: Any, outputs: Collection[str] | None, parameters: Collection[str] | None
) -> Table:
    """Return the derivatives of a result that takes no solve to the end."""
    solve, (_, params, point) = find_model(result._request.model).solve, result._request
    real = [f.name for f in fields(result) if isinstance(getattr(result, f.name), float)]
    names = wanted_outputs(outputs, real)
    found: Table = {name: {} for name in names}
    metas = {f.name: f.metadata for f in fields(params)}
    for v in varied_parameters(params, parameters):
        refused, choices = None, held_choices(params, [v.name])
        for points in _difference(v.value, metas[v.name]):
            try:
                rows = [
                    (
                        weight,
                        solve(replace(params, **choices, **{v.name: v.value + offset}), **point),
                    )
                    for offset, weight in points
                ]
            except ParameterError as error:  # a rule between parameters
                refused = error
                continue
            for name in names:
                base = getattr(rows[0][1], name)  # what stays has no rounding
                found[name][v.name] = sum(w * (getattr(r, name) - base) for w, r in rows)
            break
        else:
            if parameters and refused:
                raise refused
    return found


def _difference(value: float, meta: Mapping[str, Any]) -> Iterator[Points]:
    """Yield offsets and weights of second order within the range: central, else to one side."""
    low, high = float(meta["min"]), float(meta["max"])
    h = STEP * (abs(value) or high - low)
    if low <= value - h and value + h <= high:
        yield ((-h, -0.5 / h), (h, 0.5 / h))
    for s in (h, -h):
        if low <= value + 2.0 * s <= high:
            yield ((0.0, -1.5 / s), (s, 2.0 / s), (2.0 * s, -0.5 / s))


def _chosen(what: str, wanted: Collection[str] | None, known: Sequence[str]) -> list[str]:
    if wanted is None:
        return list(known)
    if isinstance(wanted, str):
        wanted = (wanted,)
    for name in wanted:
        if name not in known:
            hint = suggestion(str(name), known, "did you mean {}? ")
            raise ParameterError(f"{what}: {name!r}, {hint}allowed: {', '.join(known)}")
    return [name for name in known if name in wanted]
