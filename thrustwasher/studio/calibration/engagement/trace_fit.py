"""Parameters of a pack fitted to recordings of its engagements."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import fields, replace
from functools import partial
from typing import Any

import numpy as np

from ....clutch.parameters import SPEC, ClutchParams
from ....errors import ParameterError, Status
from ....model.levels import level_named
from ....model.parameters import written_out
from ....model.part_file import PartFile, find_part
from ....model.point import from_box, taken_text
from ....numerics.jit import Array
from ....settings import find_place, places
from ....units import format_quantity, parse_quantity
from ...evaluators.make import part_of
from ...jobs.progress import Count, counted_runs
from ...sweep.sweep_plan import Plan
from ..fit import Asked, chosen_names
from ..identifiability import counted
from ..signs import folded, odd_pressure, too_fast
from ..traces.binned import Run, binned
from ..traces.recording import SLOW, Traces, measured_part, pieces
from ..traces.trace_problem import fit_traces, size_text
from ..traces.trace_result import TraceCalibration
from ..traces.traced import History, Traced
from .pack_history import SLIDES, slip_by_torque, starts_engaged, walk_pack
from .recorded import COLUMNS, MEASURED, NEEDED, completed, read_recordings
from .slip_scatter import slip_scatter
from .traced_pack import OF_RIG, TRACED, TracedPack, traced_pack

MOST_MEANS, ALL_MEANS, FEW_MEANS = 512, 2048, 64  # of a recording; of all; of one among many
USUAL_FIT = ("friction_scale", "permeability")
MATTERS = {  # s, Pa, N m, N m
    "fill_time": 0.02,
    "kiss_pressure": 5e4,
    "drag_torque": 10.0,
    "torque_offset": 10.0,
}
WIDE, DECADES = ("permeability",), 1e4  # their range holds 0; they are looked for by factors
LOCKED = 10.0  # times speed_smoothing: a slower slip does not tell friction,
NOISY = 2.0  # times the allowance for scatter: of many rows some lie far off
SLOWEST = 0.005  # nor one below this share of the largest
FITTED_OTHERWISE = "allowed: friction_scale in its place; torque tells the product of both"
OPTIONS = ("piston_area", "inertia", "drag_torque", "inertia_between", "torque_offset")
OF_SLIP = {"inertia", "drag_torque", "torque_offset"}
PLACES = ("pack", "hub")


def calibrate_traces(
    part: Any,
    recordings: Any,
    *,
    fit: Sequence[str] | None = None,
    errors: Mapping[str, float | str] | None = None,
    bounds: Mapping[str, tuple[float, float]] | None = None,
    at: Mapping[str, Any] | None = None,
    fidelity: str | None = None,
    confidence: float = 0.95,
    profile: bool = False,
    piston_area: float | str = 0.0,
    inertia: float | str = 0.0,
    drag_torque: float | str = 0.0,
    torque_at: str = "pack",
    inertia_between: float | str = 0.0,
    torque_offset: float | str = 0.0,
    progress: bool | Callable[[int, int | None], None] | None = None,
) -> TraceCalibration:
    """Fit parameters of a wet pack to recordings of engagements over time.

    The pack is stepped along the recorded force and slip; torque, temperature or, with
    ``inertia``, the slip that comes out are fitted to those recorded.

    Parameters
    ----------
    part : ``ClutchParams``, a part (``load_part``) or ``"clutch"``; the first guess, and what is
        not fitted
    recordings : columns [SI] of one recording by their names, a path of a file, a DataFrame (units
        in ``attrs["units"]``, time as a column or the index), an ``asammdf.MDF``, a sequence of
        these, or these by the names of the recordings. ``time`` [s]; ``load`` [N] or
        ``pressure`` [Pa]; ``speed``: slip [rad/s]; ``oil_temperature`` [K] and ``drum_speed``
        [rad/s] where they are recorded; measured ``friction_torque`` [N m] and ``temperature`` [K]
        of the interface (None: not measured). Where time goes back or leaps by more than 20 usual
        steps another recording begins; a gap of 0.1 s or less within an engagement is bridged
    fit : names of parameters of the pack, and of the test rig: ``fill_time`` [s],
        ``kiss_pressure`` [Pa], ``drag_torque`` [N m], ``inertia`` [kg m2], ``torque_offset`` [N m];
        friction_scale and permeability by default
    errors : standard deviation of a row by output (``slip`` is one with ``inertia``): a number
        [SI], or a text with a unit; "2 %" is of the largest measured value. Without: of one output
        its residuals' scatter, of several the scatter of rows against their neighbours
    bounds : narrower range by parameter [SI]
    at : parameters and inputs that all recordings share; of what is fitted, the first guess
    fidelity : level of the model, default that of the part
    confidence : probability of the intervals, above 0 and below 1
    profile : also compute profile intervals, which takes several times as long
    piston_area : [m2] that ``pressure`` acts on, above 0 where there is one
    inertia : [kg m2] that the pack stops, as its slip sees it: slip follows from the balance of
        torques while the pack is engaged and is fitted to ``speed``. Where that is not recorded but
        torque is, slip is found by the recorded torque. 0: slip is as recorded
    drag_torque : [N m] next to the pack's that slows the slip; below 0: drives it
    torque_at : "pack": the torque of the faces is measured; "hub": between them and the sensor
        ``inertia_between`` [kg m2] turns with the hub, times its acceleration
    torque_offset : [N m] that the sensor shows in addition to the true torque
    progress : as of ``calibrate``; called with recordings stepped along so far, each once for each
        iteration of the fit

    Returns
    -------
    TraceCalibration : fitted ``params``; value, interval, verdict of every parameter; ``warnings``
        of what the fit cannot follow; ``histories()`` over time

    Raises
    ------
    ParameterError : wrong columns, numbers or names
    SolveError : the pack cannot be stepped along a recording, or the fit did not converge

    Notes
    -----
    Source: derived in docs/theory/calibration.md.

    Examples
    --------
    >>> from thrustwasher import ClutchParams, engage_clutch
    >>> t = np.linspace(0.0, 0.4, 81)
    >>> way = {"load": 5e3 * np.minimum(t / 0.1, 1.0), "speed": 100.0 * (1.0 - t / 0.4)}
    >>> truth = ClutchParams(friction_scale=0.9)
    >>> torque = engage_clutch(truth, time=t, **way).friction_torque
    >>> found = calibrate_traces("clutch", {"time": t, **way, "friction_torque": torque},
    ...                          fit=["friction_scale"])
    >>> round(found.params.friction_scale, 6)
    0.9
    """
    start = part_of(part, SPEC.key)
    if torque_at not in PLACES:
        raise ParameterError(f"torque_at = {torque_at!r}, allowed: {' or '.join(PLACES)}")
    of_rig = (piston_area, inertia, drag_torque, inertia_between, torque_offset)
    given = dict(zip(OPTIONS, of_rig, strict=True))
    rig, held = _held(start.params, {n: x for n, x in given.items() if x not in (0.0, 0)}, at or {})
    if (torque_at == "hub") != (rig.inertia_between > 0.0):
        raise ParameterError(
            f"inertia_between = {rig.inertia_between:g} kg.m2 with torque_at = {torque_at!r}, "
            "allowed: above 0 with torque_at = 'hub', 0 with 'pack'"
        )
    names = chosen_names(
        fit or USUAL_FIT,
        [n for n, p in places(TRACED).items() if not p.is_input and p.kind == "real"],
        f"real parameters of {SPEC.name}, and of the test rig {', '.join(OF_RIG)}",
    )
    _check_rig(rig, names)
    rig = written_out(rig, names)
    read, remarks, written = read_recordings(recordings, rig)
    wholes = [completed(whole, start, rig, held) for whole in read]
    parts = [
        (piece, float(whole.inputs["load"].max()))
        for whole in wholes
        for piece in pieces(whole, "load")
    ]
    by_torque = bool(rig.inertia) and all(
        "slip" not in whole.outputs and "friction_torque" in whole.outputs for whole in wholes
    )
    if by_torque:
        parts = [(measured_part(piece, "friction_torque"), most) for piece, most in parts]
    most = min(MOST_MEANS, max(FEW_MEANS, ALL_MEANS // len(parts)))
    runs = tuple(binned(piece, most, "load", largest) for piece, largest in parts)
    if by_torque:
        if inner := set(names) & OF_SLIP:
            raise ParameterError(
                f"fit = {inner.pop()!r}: allowed: with a column speed; without, slip is found by it"
            )
        runs, slowed = tuple(slip_by_torque(run, rig) for run in runs), rig
        rig = replace(rig, inertia=0.0)
    points, deviation, said = _points(start, rig, runs, fidelity, held, errors or {})
    if by_torque:
        inertia = slowed.inertia - slowed.inertia_between
        points = replace(points, follows=partial(slip_scatter, inertia=inertia))
    if len(points.value) < len(names):
        raise ParameterError(
            f"recordings: {counted(len(points.value), 'value')} for "
            f"{counted(len(names), 'parameter')}, allowed: as many values as parameters, or more"
        )
    size = f"{size_text(runs, points.n_engagements)}."
    notes = [size, *remarks, *said, *_notes(rig, runs, torque_at)]
    if by_torque:
        notes.append("Slip: by the recorded torque, the drag and the inertia.")
    words = "their error" if errors else "the scatter of neighbouring rows"
    asked = Asked(names, (), (), _bounds(rig, names, bounds or {}), confidence, profile)
    with counted_runs(progress, "fit, recordings stepped along") as ran:
        points = replace(points, walk=partial(_walk_counted, ran))
        found = fit_traces(points, asked, names, deviation, words, notes)
    return replace(found, written=written)


def _walk_counted(ran: Count, rig: TracedPack, level: str, run: Run) -> History | Status:
    """Step a pack along a recording, and count that."""
    found = walk_pack(rig, level, run)
    ran()
    return found


def _held(
    pack: ClutchParams, given: Mapping[str, Any], at: Mapping[str, Any]
) -> tuple[TracedPack, dict[str, float]]:
    """Return the pack on its test rig before the fit, and inputs that are all recordings'."""
    known, changes, inputs = places(TRACED), dict[str, Any](), dict[str, float]()
    for name, value in (*given.items(), *at.items()):
        place = find_place(name.partition(" [")[0], known, TRACED)
        if place.name in changes or place.name in inputs:
            raise ParameterError(f"{place.name}: is given twice, allowed: once")
        if "[" in name:
            value = f"{value} {name.partition('[')[2].rstrip('] ')}"
        kept: dict[str, Any] = inputs if place.is_input else changes
        kept[place.name] = place.check(value)
    if "load" in inputs:
        raise ParameterError("load: allowed: as a column, it makes an engagement")
    return replace(traced_pack(pack), **changes), inputs


def _check_rig(rig: TracedPack, names: Sequence[str]) -> None:
    """Refuse to fit what the recordings cannot have."""
    for name in set(names) & {"piston_area", "inertia_between"}:
        raise ParameterError(f"fit = {name!r}: {FITTED_OTHERWISE}")
    wanted = "kiss_pressure" in names or rig.kiss_pressure > 0.0
    if wanted and not rig.piston_area:
        raise ParameterError(
            "kiss_pressure: allowed: with piston_area [m2], which makes it a force"
        )
    if "drag_torque" in names and not rig.inertia:
        raise ParameterError("fit = 'drag_torque': allowed: with inertia; else slip is given")


def _bounds(
    rig: TracedPack, names: Sequence[str], given: Mapping[str, tuple[float, float]]
) -> dict[str, tuple[float, float]]:
    """Return the bounds given, and decades around the start of what may lie anywhere above 0."""
    metas = {f.name: f.metadata for f in fields(TracedPack)}
    found = dict(given)
    for name in set(names) & set(WIDE) - set(given):
        value = getattr(rig, name)
        if value > 0.0:
            found[name] = value / DECADES, min(value * DECADES, metas[name]["max"])
    return found


def _points(
    part: PartFile,
    rig: TracedPack,
    runs: tuple[Run, ...],
    fidelity: str | None,
    held: Mapping[str, float],
    errors: Mapping[str, float | str],
) -> tuple[Traced, Array | None, list[str]]:
    """Return what is fitted, its standard deviations by the rows' scatter, and what was done."""
    outputs = [n for n in (*MEASURED, "slip") if any(n in run.values for run in runs)]
    for name in errors:
        if name not in outputs:
            raise ParameterError(f"error of {name}: allowed: of {', '.join(outputs)}, as measured")
    row, output, value, count, own, said = [], [], [], [], [], list[str]()
    largest = {
        n: max(float(np.nanmax(np.abs(r.values[n]))) for r in runs if n in r.values)
        for n in outputs
    }
    first, dropped = 0, 0
    for run in runs:
        for name in outputs:
            if name not in run.values:
                continue
            known = np.isfinite(run.values[name])
            if name == "friction_torque":
                slides = _slides(run, rig)
                dropped += int(np.count_nonzero(known & ~slides))
                known &= slides
            places = np.flatnonzero(known)
            row.append(first + places)
            output += [name] * len(places)
            value.append(run.values[name][places])
            count.append(run.counts[name][places])
            own.append(run.scatter[name] / np.sqrt(run.counts[name][places]))
        first += len(run.time)
    if dropped:
        said.append(f"{counted(dropped, 'torque')} left out: the pack does not slip there.")
    sizes, deviation = np.concatenate(count), np.concatenate(own)
    spread = _spread(outputs, tuple(output), sizes, deviation, largest, errors)
    missing = [n for n in outputs if n not in errors]
    if spread is not None and missing:
        said.append(
            f"Errors of {', '.join(missing)}: the scatter of rows against their neighbours."
        )
    plan = _plan(part, rig, runs, fidelity, held)
    points = Traced(
        plan,
        np.concatenate(row),
        tuple(output),
        np.concatenate(value),
        spread,
        sizes,
        runs,
        walk_pack,
        MATTERS,
    )
    by_rows = deviation if (deviation > 0.0).all() else None
    given = spread if "friction_torque" in errors else None
    return _with_signs(points, rig, deviation, given, said), by_rows, said


def _slides(run: Run, rig: TracedPack) -> Any:
    """Return at which means the pack slips so fast that its torque is friction."""
    slip, share = np.abs(run.inputs["speed"]), SLIDES if rig.inertia else SLOWEST
    return slip > max(LOCKED * rig.speed_smoothing, share * float(slip.max()))


def _spread(
    outputs: Sequence[str],
    output: tuple[str, ...],
    sizes: Array,
    own: Array,
    largest: Mapping[str, float],
    errors: Mapping[str, float | str],
) -> Array | None:
    """Return the standard deviation of every mean; None where one output's residuals tell it."""
    if not errors and len(outputs) == 1:
        return None
    units = {s.name: s.unit for s in TRACED.outputs}
    names, found = np.array(output), np.empty(len(output))
    for name in outputs:
        mine = names == name
        if name not in errors:
            found[mine] = own[mine]
            if not (own[mine] > 0.0).all():
                raise ParameterError(
                    f"error of {name} is missing: its rows do not scatter, so that they tell none; "
                    f"give --error {name}=VALUE (errors = {{...}} in Python)"
                )
            continue
        if str(errors[name]).strip().endswith("%"):
            error = parse_quantity(errors[name], "1", f"error of {name}") * largest[name]
        else:
            error = parse_quantity(errors[name], units[name], f"error of {name}", difference=True)
        if not 0.0 < error < np.inf:
            raise ParameterError(f"error of {name} = {errors[name]}, allowed: above 0")
        found[mine] = error / np.sqrt(sizes[mine])
    return found


def _with_signs(
    points: Traced, rig: TracedPack, deviation: Array, given: Array | None, said: list[str]
) -> Traced:
    """Return the points with torque of the sign of the slip.

    Of an open pack a torque of either sign is an offset of the sensor; of one that is pressed it
    may be as far on the wrong side as this offset, the scatter of its rows or the standard
    deviation ``given`` say.
    """
    # a hub that is slowed may have torque against the slip
    if rig.inertia_between or "friction_torque" not in points.names:
        return points
    own, value = points.of("friction_torque"), points.value.copy()
    allowed = NOISY * deviation if given is None else np.maximum(NOISY * deviation, given)
    loose = own & points.is_open
    offset = abs(float(np.median(value[loose]))) if loose.any() else 0.0
    allowed = np.where(points.is_open, np.inf, np.maximum(allowed, offset))
    value[own], text = folded(
        "friction_torque",
        value[own],
        points.input("speed")[own],
        allowed[own],
        points.row[own].tolist(),
        odd=True,
    )
    said += [f"{text}."] * bool(text)
    return replace(points, value=value)


def _plan(
    part: PartFile,
    rig: TracedPack,
    runs: tuple[Run, ...],
    fidelity: str | None,
    held: Mapping[str, float],
) -> Plan:
    """Return the rows of all runs, one line each, and what is doubtful about them."""
    names = [s.name for s in TRACED.inputs]
    inputs = np.column_stack([np.concatenate([run.inputs[n] for run in runs]) for n in names])
    plain = find_part(SPEC.key).starts
    box, usual = dict[str, float](), dict[str, float]()
    for name in ("oil_temperature", "drum_speed"):
        value = part.starts[name]
        if name not in held and np.ptp(inputs[:, names.index(name)]) == 0.0:
            if inputs[0, names.index(name)] == value:
                (box if from_box(part, name, value, plain[name]) else usual)[name] = value
    starts = np.cumsum([0, *(len(run.time) for run in runs)])
    doubts = [
        too_fast(inputs[:, names.index("speed")], rig.friction_radius),
        odd_pressure(inputs[:, names.index("load")], rig.face.area),
    ]
    for run in runs:
        lasts = float(run.time[-1] - run.time[0])
        if lasts > SLOW:
            doubts.append(
                f"{run.name} lasts {lasts:.4g} s: if time is in ms, name the column time [ms]"
            )
        if starts_engaged(run, run.inputs["load"]) and not rig.starts_pressed:
            force = format_quantity(float(run.inputs["load"][0]), "N", digits=3)
            doubts.append(
                f"{run.name}: a recording starts under load ({force} at {run.time[0]:.6g} s): film "
                "and heat of before are not known, it starts settled and as warm as the oil or the "
                "first temperature; leave it out, or record from before the load rises"
            )
    return Plan(
        spec=TRACED,
        fidelity=level_named(SPEC, fidelity or part.fidelity),
        columns={name: inputs[:, i] for i, name in enumerate(names)},
        shown={name: inputs[:, i] for i, name in enumerate(names)},
        units={s.name: s.unit for s in TRACED.inputs},
        starts=starts,
        params=(rig,),
        params_of=np.zeros(len(runs), np.int64),
        taken=taken_text(box, usual, SPEC.inputs),
        warnings=tuple(filter(None, doubts)),
    )


def _notes(rig: TracedPack, runs: tuple[Run, ...], torque_at: str) -> Iterator[str]:
    """Yield how slip came about, where torque is measured, and what it can tell."""
    if rig.inertia:
        yield (
            f"Slip: from the balance of torques at {format_quantity(rig.inertia, 'kg.m2')} and a "
            f"drag of {format_quantity(rig.drag_torque, 'N.m')} while the pack is engaged."
        )
    if any("friction_torque" in run.values for run in runs):
        place = "of the faces (pack)"
        if torque_at == "hub":
            between = format_quantity(rig.inertia_between, "kg.m2")
            place = (
                f"at the hub, {between} times its acceleration, in addition to that of the faces"
            )
        yield f"Torque: {place}."
    yield (
        "Torque tells one product of friction, force and radius: an error of 1 % in force, piston "
        "area or radius is one of 1 % in friction."
    )


TRACES = Traces(
    columns=COLUMNS, measured=MEASURED, needed=NEEDED, spec=TRACED, fit=calibrate_traces
)
