"""Cards made up for tests: of any rung, over any cells, with any errors."""

import dataclasses

from thrustwasher.clutch.parameters import ClutchParams
from thrustwasher.gearmesh.parameters import GearMeshParams
from thrustwasher.ladder import card_parts as part
from thrustwasher.ladder.card import Card, files_of
from thrustwasher.storage.digests import kernel_digest, params_digest
from thrustwasher.washer.parameters import WasherParams

PARAMS = {"washer": WasherParams, "clutch": ClutchParams, "gearmesh": GearMeshParams}
ENVELOPE = {
    "load": part.Axis(20.0, 2000.0, "N", "log"),
    "speed": part.Axis(50.0, 1400.0, "rad/s", "log"),
    "tilt": part.Axis(1e-3, 3e-3, "rad", "log"),
    "oil_temperature": part.Axis(290.0, 400.0, "K", "linear"),
}
EDGES = ((20.0, 200.0, 2000.0), (50.0, 250.0, 1400.0))
BOX = {"load": (30.0, 1000.0), "speed": (100.0, 1000.0), "tilt": (2e-3, 2e-3),
       "oil_temperature": (300.0, 300.0)}  # fmt: skip


RUNGS = ("map", "coarse", "field", "fine")


def table(value, shape=(2, 2)):
    """Return a value for all cells, or the rows given."""
    if isinstance(value, list | tuple):
        return tuple(tuple(row) for row in value)
    return tuple((value,) * shape[1] for _ in range(shape[0]))


def errors(worst, n=75, kind="relative"):
    unit, floor = (None, 1e-3) if kind == "relative" else ("K", None)
    worst = table(worst)
    counts = table(n, (len(worst), len(worst[0])))
    return part.Errors(kind, unit, floor, worst, counts)


def card(fidelity="field", worst=5e-3, median=2e-4, *, model="washer", n=75, iqr=None, first=0.2,
         build=0.0, built=False, chart=None, branch=None, envelope=None, edges=EDGES, outside=0,
         uncertainty=1e-5, kelvin=0.1, fold=None, params=None, name="default",
         **changed):  # fmt: skip
    """Return a card; what is not given is usual."""
    params = params or PARAMS[model]()
    files = files_of(model, "field" if fidelity == "coarse" else fidelity)
    iqr = 0.05 * median if iqr is None else iqr
    shape = (len(edges[0]) - 1, len(edges[1]) - 1)
    made = Card(
        schema=2, model=model, fidelity=fidelity, chart=chart, branch=branch, fold=fold,
        params=part.ParameterSet(name, params_digest(params), {}),
        kernels=part.Sources((*files, *(("maps/x.twm",) if built else ())), kernel_digest(files)),
        package={"version": "0.4.0", "commit": None, "dirty": None}, made="2026-01-01T00:00:00Z",
        envelope=envelope or ENVELOPE,
        errors={
            "friction_torque": errors(table(worst, shape), n),
            "temperature": errors(table(kelvin, shape), n, "absolute"),
        },
        cells=part.Cells(("load", "speed"), edges, table(outside, shape)), by_film_ratio=None,
        held_out=part.HeldOut(300, 0, 0, 7),
        reference=part.Reference("reference", None, ("two grids extrapolated",),
                                 {"friction_torque": uncertainty, "temperature": 1e-4}),
        cost=part.Cost(median, iqr, first, build),
        machine={"cpu": "a cpu", "cores": 2},
    )  # fmt: skip
    return dataclasses.replace(made, **changed)
