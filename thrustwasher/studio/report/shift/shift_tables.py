"""The report's tables as rows of text."""

import math
from collections.abc import Mapping
from dataclasses import fields, replace
from typing import Any

import numpy as np

from ....shift.account.shift_record import KeyFigure, Part, Record
from ....units import display_unit
from ....units import format_quantity as say
from ..html import Table
from ..palette import RPM
from ..scatter.words import BAND, band_words, varies
from .heat_split import heat_splits

LOSSES = (
    ("pump", "oil pump"),
    ("churning", "churning"),
    ("rolling", "bearings"),
    ("seal", "seals"),
)
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
        ("heat of oil pump, churning, bearings and seals", book.get("losses", 0.0)),
        *((f"of it {words}", record.figures.get(f"{name}_loss") or 0.0) for name, words in LOSSES),
        ("heat in the output shaft's damping", book.get("shaft", 0.0)),
        ("energy the output shaft's spring gained", book.get("spring", 0.0)),
        ("residual of the balance", book["residual"]),
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
    pack = record.engaging

    def at(name: str, time: float) -> float:
        return float(np.interp(time, record.time, record.signals[f"transmission.{name}"]))

    return Table.of(
        record.phases,
        {
            "phase": lambda p: str(p.name),
            "from [s]": lambda p: f"{p.start:.4g}",
            "lasts [s]": lambda p: f"{p.end - p.start:.4g}",
            f"heat in the {pack} [J]": lambda p: _joule(
                at(f"{pack}_heat", p.end) - at(f"{pack}_heat", p.start)
            ),
            "engine at its end [rpm]": lambda p: f"{RPM * at('engine_speed', p.end):.0f}",
            "output [rpm]": lambda p: f"{RPM * at('output_speed', p.end):.0f}",
        },
    )


def heat_table(record: Record) -> Table:
    """Return the heat of every part: made, stored, given to the oil, and what is left over."""
    return Table.of(
        heat_splits(record),
        {
            "": lambda s: str(s.words),
            "made [J]": lambda s: _joule(s.made[-1]),
            "stored [J]": lambda s: "" if s.stored is None else _joule(s.stored[-1]),
            "to the oil [J]": lambda s: _joule(s.to_oil[-1]),
            "rest [J]": lambda s: _joule(s.rest[-1]),
            "to the oil [%]": lambda s: _percent(s.to_oil[-1], s.made[-1]),
        },
    )


def key_table(record: Record) -> Table:
    """Return the key figures with the time they belong to; those that say something new.

    With a study of scatter also their bands.
    """

    def band(f: KeyFigure) -> str:
        found = record.band(f.name)
        return band_words(found) if found and varies(found) else ""

    shown = [f for f in record.key_figures if f.value and f.name not in SAID_TWICE]
    table = Table.of(
        shown,
        {
            "": lambda f: str(f.text),
            "value": lambda f: f.words(f.value, 6 if f.unit == "s" else 5),
            **({BAND: band} if record.scatter else {}),
            "at time [s]": lambda f: "" if f.time is None else f"{f.time:.4g}",
        },
    )
    return replace(table, figures=[f.name for f in shown])


OF_A_WASHER = (
    *("friction_power", "oil_heat", "throughflow_heat", "oil_flow", "oil_outlet_temperature"),
    *("film_temperature", "temperature_max", "stick_margin"),
)


def washer_table(record: Record) -> Table | None:
    """Return the range of a washer's heat, oil and hold over the run; None without a washer."""
    part, rows = record.part("washer"), []
    for s in part.spec.outputs if part else ():
        values = record.series(f"washer.{s.name}") if s.name in OF_A_WASHER else None
        if values is not None:
            row: list[str] = [s.help]
            unit, size = display_unit(float(np.nanmax(np.abs(values))), s.unit)
            for index in (int(np.nanargmin(values)), int(np.nanargmax(values))):
                value = float(values[index])
                words = say(value, "K") if s.unit == "K" else f"{value / size:.4g} {unit}"
                row += [words.removesuffix(" 1"), f"{record.time[index]:.4g}"]
            rows.append(row)
    heads = ("of one washer", "minimum", "at [s]", "maximum", "at [s]")
    return Table(heads, rows, numbers=(1, 2, 3, 4)) if rows else None


def judder_table(record: Record) -> Table:
    """Return the swing as measured against the driveline's eigenvalue, and what decides on it."""
    j = record.judder
    rows = [
        ("frequency", f"{j.frequency:.4g} Hz", f"{j.mode_frequency:.4g} Hz"),
        ("growth", f"{j.growth:.4g} 1/s", f"{j.mode_growth:.4g} 1/s"),
        ("growth with this communication step", "", f"{j.mode_growth + j.step_growth:.4g} 1/s"),
        (f"change of the {j.pack}'s torque over its slip", "", say(j.slope, "N.m.s/rad")),
        ("damping of the shaft", "", say(j.damping, "N.m.s/rad")),
        ("damping below which the swing grows", "", say(j.limit_damping, "N.m.s/rad")),
        ("largest swing of the shaft torque", say(j.amplitude, "N.m"), ""),
    ]
    return Table(("", "measured", "from the parameters"), rows, numbers=(1, 2))


def published_table(record: Record) -> Table:
    """Return the source's values for comparison with this run."""

    def words(p: Mapping[str, Any], name: str) -> str:
        if p[name] is None:
            return ""
        return say(p[name], p["unit"], digits=5, difference=p["difference"])

    def off(p: Mapping[str, Any]) -> str:
        if p["run"] is None or not p["published"]:
            return ""
        share = f"{p['run'] / p['published'] - 1.0:+.2%}"
        return "0.00%" if share[1:] == "0.00%" else share

    return Table.of(
        record.published,
        {
            "": lambda p: str(p["text"]),
            "published": lambda p: words(p, "published"),
            "this run": lambda p: words(p, "run"),
            "off by": off,
        },
    )


def cost_table(record: Record) -> Table:
    """Return what each FMU took, and the rest."""
    found = Table.of(
        record.cost,
        {
            "": lambda c: str(c.part),
            "fidelity": lambda c: str(c.fidelity),
            "instantiate [ms]": lambda c: _ms(c.instantiate),
            "initialise [ms]": lambda c: _ms(c.initialize),
            "calls": lambda c: str(c.steps),
            "time [ms]": lambda c: _ms(c.wall_time),
            "per call [µs]": lambda c: f"{1e6 * c.wall_time / c.steps:.1f}" if c.steps else "",
            "share [%]": lambda c: _percent(c.wall_time, record.wall_time),
        },
        words=2,
    )
    rest = max(record.wall_time - sum(cost.wall_time for cost in record.cost), 0.0)
    more = [
        (words, "", "", "", "", _ms(taken), "", _percent(taken, record.wall_time))
        for words, taken in (("master, the rest", rest), ("together", record.wall_time))
    ]
    return replace(found, rows=[*found.rows, *more])


def check_table(record: Record) -> Table:
    """Return a row per check of a level, in the order they were made."""
    return Table.of(
        record.guard.checks,
        {
            "": lambda c: str(c.part),
            "level": lambda c: str(c.fidelity),
            "compared with": lambda c: str(c.above),
            "points": lambda c: str(c.points),
            "without solution": lambda c: str(len(c.failed)),
            "worst difference [%]": lambda c: f"{100.0 * c.worst.share:.3g}",
            "allowed [%]": lambda c: f"{100.0 * c.tolerance:.3g}",
            "holds": lambda c: "yes" if c.holds else "no",
            "time [ms]": lambda c: f"{1e3 * c.seconds:.2f}",
        },
        words=3,
    )


def parameter_table(part: Part) -> Table:
    """Return the parameters of one FMU, folded; with what the scene sets and what is default."""
    spec = part.spec
    metadata = {f.name: f.metadata for f in fields(spec.params)}
    defaults = {f.name: f.default for f in fields(spec.params)}
    rows = []
    for name, value in {**defaults, **part.parameters}.items():
        m = metadata.get(name, {"unit": "", "help": ""})  # the level has none
        origin = "default" if value == defaults.get(name, spec.default_fidelity) else "scene"
        unit = "" if m["unit"] == "1" else m["unit"]
        rows.append((name, _plain(value), unit, m["help"], origin))
    heads = ("parameter", "value", "unit", "meaning", "from")
    return Table(heads, rows, numbers=(1,), title=f"{part.name} ({spec.name})", folded=True)


def settings(record: Record) -> dict[str, str]:
    """Return what was simulated, by name: the scene, the steps, the levels, every parameter."""
    tables = [(part.name, parameter_table(part).rows) for part in record.parts]
    levels = [f"{name} {row[1]}" for name, rows in tables for row in rows if row[0] == "fidelity"]
    given = {
        "scene": f"{record.name}: {record.title}",
        "communication step": say(record.step, "s"),
        "master": record.master,
        "fidelity levels": ", ".join(levels),
        "temperature of the oil": say(record.oil_temperature, "K"),
    }
    own = {
        f"{name}: {row[3]}": " ".join(row[1:3]).strip()
        for name, rows in tables
        for row in rows
        if row[3]
    }
    return given | own


def _plain(value: object) -> str:
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
