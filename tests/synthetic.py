"""Tables of errors made up for tests: of any levels, over any regions, with any errors."""

from thrustwasher.ladder import error_table as home
from thrustwasher.ladder.error_table import (
    Axis,
    Chart,
    Division,
    ErrorTable,
    LevelErrors,
    sources_of,
)
from thrustwasher.storage.digests import params_digest
from thrustwasher.washer.parameters import WasherParams

WHOLE = {
    "load": Axis(20.0, 2000.0, "N", "log"),
    "speed": Axis(50.0, 1400.0, "rad/s", "log"),
    "tilt": Axis(1e-3, 3e-3, "rad", "log"),
    "oil_temperature": Axis(290.0, 400.0, "K", "linear"),
}
BOX = {
    "load": (30.0, 1000.0),
    "speed": (100.0, 1000.0),
    "tilt": (2e-3, 2e-3),
    "oil_temperature": (300.0, 300.0),
}
CALLS = {"map": 2e-6, "field": 2e-4, "fine": 2e-3}


def regions(worst, kelvin=0.1):
    """Return a division into light and heavy loads by slow and fast speeds: rows of errors."""
    if not isinstance(worst, list):
        worst = [[worst] * 2] * 2
    loads, speeds = ((20.0, 200.0), (200.0, 2000.0)), ((50.0, 250.0), (250.0, 1400.0))
    return Division(
        ("load", "speed"),
        tuple(
            (*load, *speed, 75, worst[i][j], kelvin, 1e-9, 1e-3)
            for i, load in enumerate(loads)
            for j, speed in enumerate(speeds)
        ),
    )


def film_ratios(*worst):
    """Return a division by the film ratio: below 3, 3 .. 5, above 5."""
    ends = ((-1e9, 3.0), (3.0, 5.0), (5.0, 1e9))
    return Division(
        ("film_ratio",),
        tuple((*end, 30, error, 0.1, 1e-9, 1e-3) for end, error in zip(ends, worst, strict=True)),
    )


def level(
    fidelity="field", worst=5e-3, *more, box=None, beside_fold=0.0, sources=None, files=(), **charts
):
    """Return a level of the washer: one chart of ``worst``, or several by name."""
    found = charts or {"": worst}
    return LevelErrors(
        fidelity,
        sources or sources_of("washer", fidelity),
        files,
        CALLS[fidelity],
        box or WHOLE,
        tuple(
            Chart(name or None, 300, 1e-3, beside_fold, (regions(errors), *more))
            for name, errors in found.items()
        ),
    )


def table(*levels, params=None, name="default"):
    """Return a table of the washer."""
    return ErrorTable(
        "washer",
        name,
        params_digest(params or WasherParams()),
        {},
        "2026-01-01T00:00:00Z",
        "0.4.0",
        "a cpu, 2 cores",
        ("two grids extrapolated",),
        levels,
    )


def put(folder, monkeypatch, *levels, **options):
    """Put a table of the washer in the place of all others; return its file."""
    path = folder / "washer.json"
    home.write_tables([table(*levels, **options)], path)
    monkeypatch.setattr(home, "table_folders", lambda: [folder])
    home.forget()
    return path
