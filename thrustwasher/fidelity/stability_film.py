"""Where ways to solve a cavitating film fail."""

from __future__ import annotations

from functools import partial
from typing import Any

from .stability_cells import LIES, OK, SAYS, SLOW, Cell, Group, off, table

MANY_SWEEPS, MANY_SOLVES = 100, 10
WRONG_LOAD = 0.02
NO_LOAD = 1e-12  # of a film that has a load: nothing lifts


def cavitation(*, quick: bool = False) -> Group:
    """Judge ways to solve a cavitating film by its load."""
    from ..rivals import cavitation as c

    fine = 47 if quick else 95
    hazards = {
        "thick film, no cavity": (c.slider, 31, 1.0),
        "one cavity": (c.one_wave, 31, 1.0),
        "turned round": (c.one_wave, 31, -1.0),
        "two cavities": (c.two_waves, 31, 1.0),
        "three, tilted": (c.waves_and_tilt, 31, 1.0),
        "dimple": (c.dimple, 31, 1.0),
        "two cavities, fine mesh": (c.two_waves, fine, 1.0),
        "standstill": (c.one_wave, 31, 0.0),
        "no wedge": (c.level, 31, 1.0),
    }
    methods = {
        "linear solve, negatives cut": c.cut,
        "clamp in back substitution": c.clamp,
        "projected relaxation, stop on the change": c.relax_change,
        "projected over-relaxation, stop on the residual": c.relax_rest,
        "active set, cold": c.active_set,
        "active set, nested meshes": None,
    }
    exact: dict[Any, float] = {}

    def judge(method: Any, hazard: Any) -> Cell:
        height, n, direction = hazard
        pad = partial(c.pad, height, direction=direction)
        if hazard not in exact:
            exact[hazard] = c.active_set(pad(n)).load
        film = method(pad(n)) if method else c.nested(pad, n)
        if film.status.is_failure:
            return Cell(SAYS, "", film.status.name)
        true = exact[hazard]
        error = (film.load - true) / true if true > NO_LOAD else film.load
        if abs(error) > WRONG_LOAD:
            return Cell(LIES, off(error), "load off, status OK")
        swept = method in (c.relax_change, c.relax_rest)
        slow = film.work > (MANY_SWEEPS if swept else MANY_SOLVES)
        unit = "sweep" if swept else "solve"
        done = f"{film.work} {unit}" + ("" if film.work == 1 else "s")
        return Cell(SLOW if slow else OK, done, f"load off by {100 * error:+.2g} %")

    judged = f"load off by more than {100 * WRONG_LOAD:g} %"
    return table("a cavitating film", judged, methods, hazards, judge)
