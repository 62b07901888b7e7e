"""The report's tables as rows of text."""

import math
from collections.abc import Sequence
from dataclasses import fields
from typing import Any

import numpy as np

from ...units import display_unit
from ...units import format_quantity as say
from ..html import Table
from ..palette import RPM
from .heat_split import heat_splits
from .shift_record import Part, Record

SAID_TWICE = ("slip_energy_per_area",)  # the pack's own heat per area is the same


def energy_table(record: Record) -> Table:
    """Return where every joule went, in joule and percent of what came in.

    That is the engine's work or, without engine, the kinetic energy. What the scene has no part for
    is left out.
    """
    book = record.energy
    engine, kinetic = book["engine_work"], book["kinetic"]
    whole, name = (abs(engine), "engine work") if engine else (abs(kinetic), "kinetic energy")
    rows = [
        ("work of the engine", engine),
        (f"kinetic energy {'gained' if kinetic > 0.0 else 'given up'}", abs(kinetic)),
        ("work into the load", book["load_work"]),
        ("heat in the clutch", book["clutch"]),
        ("heat in the brake", book["brake"]),
        ("heat in all thrust washers", book["washers"]),
        ("heat in all gear meshes", book["meshes"]),
        ("heat in the thrust bearings of sun and ring", book.get("bearings", 0.0)),
        ("heat in the output shaft's damping", book.get("shaft", 0.0)),
        ("energy the output shaft's spring gained", book.get("spring", 0.0)),
        ("residual: what the book cannot account for", book["residual"]),
        ("coupling: clutch heat, driveline minus clutch FMU", book["coupling_difference"]),
        ("coupling: brake heat, driveline minus brake FMU", book["brake_coupling_difference"]),
    ]
    return Table(
        heads=("", "J", f"% of {name}"),
        rows=[
            (words, _joule(value), _percent(value, whole))
            for words, value in rows
            if value or words.startswith("residual")
        ],
        numbers=(1, 2),
    )


def phase_table(record: Record) -> Table:
    """Return when each phase began, how long it took and what the engaging pack took up in it."""
    heat = record.signals[f"transmission.{record.engaging}_heat"]
    rows = []
    for phase in record.phases:
        begin, end = np.interp((phase.start, phase.end), record.time, heat)
        engine, output = (
            np.interp(phase.end, record.time, record.signals[f"transmission.{name}_speed"])
            for name in ("engine", "output")
        )
        rows.append(
            (
                phase.name,
                f"{phase.start:.4g}",
                f"{phase.end - phase.start:.4g}",
                _joule(end - begin),
                f"{RPM * engine:.0f}",
                f"{RPM * output:.0f}",
            )
        )
    heads = (
        "phase",
        "from [s]",
        "lasts [s]",
        f"heat in the {record.engaging} [J]",
        "engine at its end [rpm]",
        "output [rpm]",
    )
    return Table(heads, rows, numbers=(1, 2, 3, 4, 5))


def heat_table(record: Record) -> Table:
    """Return the heat of every part: made, stored, given to the oil, and what is left over."""
    rows = [
        (
            s.words,
            _joule(s.made[-1]),
            "" if s.stored is None else _joule(s.stored[-1]),
            _joule(s.to_oil[-1]),
            _joule(s.rest[-1]),
            _percent(s.to_oil[-1], s.made[-1]),
        )
        for s in heat_splits(record)
    ]
    heads = ("", "made [J]", "stored [J]", "to the oil [J]", "rest [J]", "to the oil [%]")
    return Table(heads, rows, numbers=(1, 2, 3, 4, 5))


def key_table(record: Record) -> Table:
    """Return the key figures with the time they belong to; those that say something new."""
    rows = [
        (
            f.text,
            f"{f.value:.6g} s"
            if f.unit == "s"
            else say(f.value, f.unit, digits=5, difference=f.difference),
            "" if f.time is None else f"{f.time:.4g}",
        )
        for f in record.key_figures
        if f.value and f.name not in SAID_TWICE
    ]
    return Table(("", "value", "at time [s]"), rows, numbers=(1, 2))


OF_A_WASHER = (
    "friction_power",
    "oil_heat",
    "throughflow_heat",
    "oil_flow",
    "oil_outlet_temperature",
    "film_temperature",
    "temperature_max",
    "stick_margin",
)


def washer_table(record: Record) -> Table | None:
    """Return the range of a washer's heat, oil and hold over the run; None without a washer."""
    part = record.part("washer")
    if part is None:
        return None
    rows = []
    for s in part.spec.outputs:
        values = record.series(f"washer.{s.name}") if s.name in OF_A_WASHER else None
        if values is not None:
            row: list[str] = [s.help]
            unit, size = display_unit(float(np.nanmax(np.abs(values))), s.unit)
            for index in (int(np.nanargmin(values)), int(np.nanargmax(values))):
                value = float(values[index])
                told = say(value, "K") if s.unit == "K" else f"{value / size:.4g} {unit}"
                row += [told.removesuffix(" 1"), f"{record.time[index]:.4g}"]
            rows.append(tuple(row))
    heads = ("of one washer", "least", "at [s]", "greatest", "at [s]")
    return Table(heads, rows, numbers=(1, 2, 3, 4)) if rows else None


def judder_table(record: Record) -> Table:
    """Return the swing as measured beside the driveline's eigenvalue, and what decides on it."""
    j = record.judder
    rows = [
        ("frequency", f"{j.frequency:.4g} Hz", f"{j.mode_frequency:.4g} Hz"),
        ("growth", f"{j.growth:.4g} 1/s", f"{j.mode_growth:.4g} 1/s"),
        ("growth with this communication step", "", f"{j.mode_growth + j.step_growth:.4g} 1/s"),
        (f"change of the {j.pack}'s torque over its slip", "", say(j.slope, "N.m.s/rad")),
        ("damping of the shaft", "", say(j.damping, "N.m.s/rad")),
        ("damping below which the swing grows", "", say(j.limit_damping, "N.m.s/rad")),
        ("greatest swing of the shaft torque", say(j.amplitude, "N.m"), ""),
    ]
    return Table(("", "measured", "from the parameters"), rows, numbers=(1, 2))


def published_table(record: Record) -> Table:
    """Return what the scene's source says beside this run."""
    rows = []
    for p in record.published:
        run = "" if p.run is None else say(p.run, p.unit, digits=5, difference=p.difference)
        said = say(p.published, p.unit, digits=5, difference=p.difference)
        off = "" if p.run is None or not p.published else f"{p.run / p.published - 1.0:+.2%}"
        off = off.replace("-0.00%", "0.00%").replace("+0.00%", "0.00%")
        rows.append((p.text, said, run, off))
    return Table(("", "published", "this run", "off by"), rows, numbers=(1, 2, 3))


def cost_table(record: Record) -> Table:
    """Return what each FMU took, and the rest."""
    used = sum(cost.steps for cost in record.costs)
    rest = max(record.wall_time - used, 0.0)
    rows = [
        (
            c.name,
            c.fidelity,
            _ms(c.instantiate),
            _ms(c.initialize),
            str(c.calls),
            _ms(c.steps),
            f"{1e6 * c.steps / c.calls:.1f}" if c.calls else "",
            _percent(c.steps, record.wall_time),
        )
        for c in record.costs
    ]
    parts = [("master, the rest", rest), ("together", record.wall_time)]
    rows += [
        (words, "", "", "", "", _ms(taken), "", _percent(taken, record.wall_time))
        for words, taken in parts
    ]
    return Table(
        heads=(
            "",
            "fidelity",
            "instantiate [ms]",
            "initialise [ms]",
            "calls",
            "time [ms]",
            "per call [µs]",
            "share [%]",
        ),
        rows=rows,
        numbers=(2, 3, 4, 5, 6, 7),
    )


def check_table(record: Record) -> Table:
    """Return a row per check of a rung, in the order they were made."""
    rows = [
        (
            c.part,
            c.rung,
            c.above,
            str(c.points),
            str(len(c.failed)),
            f"{100.0 * c.worst.share:.3g}",
            f"{100.0 * c.tolerance:.3g}",
            "yes" if c.holds else "no",
            f"{1e3 * c.seconds:.2f}",
        )
        for c in record.guard.checks
    ]
    return Table(
        heads=(
            "",
            "rung",
            "compared with",
            "points",
            "without solution",
            "worst difference [%]",
            "allowed [%]",
            "holds",
            "time [ms]",
        ),
        rows=rows,
        numbers=(3, 4, 5, 6, 8),
    )


def parameter_tables(record: Record) -> list[Table]:
    """Return one folded table per FMU: every parameter with unit, meaning and origin."""
    return [_parameters(part) for part in record.parts]


def _parameters(part: Part) -> Table:
    """Return the parameters of one FMU; what the scene sets is told from the defaults."""
    spec = part.spec
    rows: list[Sequence[str]] = []
    for f in fields(spec.params):
        value = part.parameters.get(f.name, f.default)
        unit = "" if f.metadata["unit"] == "1" else f.metadata["unit"]
        origin = "default" if value == f.default else "scene"
        rows.append((f.name, _plain(value), unit, f.metadata["help"], origin))
    known = {row[0] for row in rows}
    for name, value in part.parameters.items():
        if name not in known:  # the rung
            origin = "default" if value == spec.default_fidelity else "scene"
            rows.append((name, _plain(value), "", "", origin))
    heads = ("parameter", "value", "unit", "meaning", "from")
    title = f"{part.name} ({spec.name})"
    return Table(heads, rows, numbers=(1,), title=title, folded=True)


def settings(record: Record) -> dict[str, str]:
    """Return what was simulated, by name: the scene, the steps, the rungs, every parameter."""
    tables = [(part.name, _parameters(part).rows) for part in record.parts]
    rungs = [f"{name} {row[1]}" for name, rows in tables for row in rows if row[0] == "fidelity"]
    given = {
        "scene": f"{record.name}: {record.title}",
        "communication step": say(record.step, "s"),
        "master": record.master,
        "rungs": ", ".join(rungs),
        "temperature of the oil": say(record.oil_temperature, "K"),
    }
    own = {
        f"{name}: {row[3]}": " ".join(row[1:3]).strip()
        for name, rows in tables
        for row in rows
        if row[3]
    }
    return given | own


def source_texts(record: Record) -> list[str]:
    """Return where the defaults of the models in this run come from."""
    docs = {p.spec.name: (p.spec.params.__doc__ or "").replace("``", "") for p in record.parts}
    return [f"{model}. {' '.join(words.split())}" for model, words in docs.items()]


def _plain(value: Any) -> str:
    """Return a parameter's value in SI units."""
    if isinstance(value, bool) or not isinstance(value, int | float):
        return str(value)
    return f"{value:.8g}"


def _joule(value: float) -> str:
    """Return joules with a thin space between thousands; tiny values with an exponent."""
    if value != 0.0 and abs(value) < 0.01:
        return f"{value:.2e}"
    return f"{value:,.2f}".replace(",", "\u2009")


def _percent(part: float, whole: float) -> str:
    """Return a share in percent."""
    if not whole or not math.isfinite(part / whole):
        return ""
    share = 100.0 * part / whole
    return "below 0.001" if share and abs(share) < 1e-3 else f"{share:.3f}"


def _ms(seconds: float) -> str:
    """Return milliseconds."""
    return f"{1e3 * seconds:.1f}"
