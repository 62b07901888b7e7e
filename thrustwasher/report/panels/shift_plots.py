"""What happened over time in a shift: one figure per question."""

from collections.abc import Callable

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ..shift.heat_split import heat_split
from ..shift.shift_record import Record
from ..style import styled, time_figure
from . import contact_panels, motion_panels


@styled
def _drawn(
    record: Record, height: float, *draw: Callable[[Axes, Record], object],
    shares: tuple[float, ...] = (1.0,),
) -> Figure:  # fmt: skip
    """Return panels over each other, whose heights have the given shares."""
    figure, axes = time_figure(height, len(draw), shares)
    for draw_one, axis in zip(draw, axes, strict=True):
        draw_one(axis, record)
    return figure


def speed_figure(record: Record) -> Figure:
    """Return the speeds with phases shaded and events numbered."""
    return _drawn(record, 4.4, motion_panels.draw_speeds)


def torque_figure(record: Record) -> Figure:
    """Return the torques; the small drag at the planets in its own panel."""
    drag = [record.series(f"{part}.friction_torque") for part in ("washer", "mesh")]
    if all(torque is None for torque in drag):
        return _drawn(record, 4.2, motion_panels.draw_torques)
    return _drawn(
        record, 5.8, motion_panels.draw_torques, motion_panels.draw_drag, shares=(2.4, 1.0)
    )


def temperature_figure(record: Record) -> Figure:
    """Return the temperatures with the limits that are near."""
    return _drawn(record, 4.2, motion_panels.draw_temperatures)


def film_figure(record: Record) -> Figure | None:
    """Return the film ratios over regime bands; None without any film."""
    return _drawn(record, 4.2, contact_panels.draw_films) if contact_panels.films(record) else None


def washer_figure(record: Record) -> Figure | None:
    """Return who carries the washer's load; None if the scene has no washer."""
    if not {"transmission.washer_load", "washer.fluid_load_share"} <= set(record.signals):
        return None
    return _drawn(record, 3.4, contact_panels.draw_washer_load)


def stress_figure(record: Record) -> Figure | None:
    """Return the safeties of the teeth, by the paper's heat their stress; None without a mesh."""
    if record.rated_teeth:
        return _drawn(record, 3.8, contact_panels.draw_safeties)
    if record.series("mesh.stress_utilization_aisi1020") is None:
        return None
    return _drawn(record, 3.8, contact_panels.draw_stress)


def comfort_figure(record: Record) -> Figure | None:
    """Return acceleration and jerk of the vehicle; None without one."""
    if record.reach is None or record.series("transmission.output_acceleration") is None:
        return None
    draw = motion_panels.draw_acceleration, motion_panels.draw_jerk
    return _drawn(record, 4.8, *draw, shares=(1.3, 1.0))


def actuation_figure(record: Record) -> Figure | None:
    """Return pressures and the speeds of both sides of the packs; None without pistons."""
    pressure = record.series("transmission.clutch_piston_pressure")
    if pressure is None or not np.any(pressure):
        return None
    return _drawn(
        record, 5.2, motion_panels.draw_pressures, motion_panels.draw_pack_speeds,
        shares=(1.0, 1.0),
    )  # fmt: skip


def heat_figure(record: Record) -> Figure | None:
    """Return where the heat of the engaging pack is, and the sump; None if it is not known."""
    split = heat_split(record, record.engaging)
    if split is None:
        return None

    def draw(axis: Axes, record: Record) -> None:
        motion_panels.draw_heat_split(axis, record, split)

    if record.series("sump.temperature") is None:
        return _drawn(record, 3.4, draw)
    return _drawn(record, 5.0, draw, motion_panels.draw_sump, shares=(1.6, 1.0))


def friction_figure(record: Record) -> Figure | None:
    """Return friction against slip of the pack that engages; None if it is constant."""
    if not contact_panels.friction_changes(record):
        return None
    return _drawn(record, 3.8, contact_panels.draw_friction)


def judder_figure(record: Record) -> Figure | None:
    """Return shaft torque and slip while a pack slips; None if the shaft does not swing."""
    if record.judder is None:
        return None
    return _drawn(record, 5.4, motion_panels.draw_shaft, motion_panels.draw_slip, shares=(1.3, 1.0))


def energy_figure(record: Record) -> Figure:
    """Return where the energy went, stacked."""
    return _drawn(record, 4.2, motion_panels.draw_energy)


def overview_figure(record: Record) -> Figure:
    """Return speeds, torques and film ratios below each other: the shift in one picture."""
    draw = motion_panels.draw_speeds, motion_panels.draw_torques, contact_panels.draw_films
    return _drawn(record, 8.6, *draw, shares=(1.15, 1.15, 1.0))
