"""What happened over time in a shift: one figure per question."""

from __future__ import annotations

from matplotlib.figure import Figure

from . import contact_panels, panels
from .shift_record import Record
from .style import styled, time_figure


@styled
def speed_figure(record: Record) -> Figure:
    """Return the speeds with phases shaded and events numbered."""
    figure, (axis,) = time_figure(4.4)
    panels.draw_speeds(axis, record)
    return figure


@styled
def torque_figure(record: Record) -> Figure:
    """Return the torques; the small drag at the planets in its own panel."""
    drag = [record.series(f"{part}.friction_torque") for part in ("washer", "mesh")]
    if all(torque is None for torque in drag):
        figure, (axis,) = time_figure(4.2)
        panels.draw_torques(axis, record)
        return figure
    figure, axes = time_figure(5.8, 2, (2.4, 1.0))
    panels.draw_torques(axes[0], record)
    panels.draw_drag(axes[1], record)
    return figure


@styled
def temperature_figure(record: Record) -> Figure:
    """Return the temperatures with the limits that are near."""
    figure, (axis,) = time_figure(4.2)
    panels.draw_temperatures(axis, record)
    return figure


@styled
def film_figure(record: Record) -> Figure | None:
    """Return the film ratios over regime bands; None without any film."""
    figure, (axis,) = time_figure(4.2)
    return figure if contact_panels.draw_films(axis, record) else None


@styled
def washer_figure(record: Record) -> Figure | None:
    """Return who carries the washer's load; None if the scene has no washer."""
    load = record.series("transmission.washer_load")
    share = record.series("washer.fluid_load_share")
    if load is None or share is None:
        return None
    figure, (axis,) = time_figure(3.4)
    contact_panels.draw_washer_load(axis, record, load, share)
    return figure


@styled
def stress_figure(record: Record) -> Figure | None:
    """Return how near tooth stress comes to its limit; None if the scene has no gear mesh."""
    if record.series("mesh.stress_utilization_aisi1020") is None:
        return None
    figure, axes = time_figure(5.4, 2, (1.7, 1.0))
    contact_panels.draw_stress(axes[0], record)
    contact_panels.draw_allowable(axes[1], record)
    return figure


@styled
def friction_figure(record: Record) -> Figure | None:
    """Return friction against slip of the pack that engages; None if it is constant."""
    figure, (axis,) = time_figure(3.8)
    return figure if contact_panels.draw_friction(axis, record) else None


@styled
def judder_figure(record: Record) -> Figure | None:
    """Return shaft torque and slip while a pack slips; None if the shaft does not swing."""
    if record.judder is None:
        return None
    figure, axes = time_figure(5.4, 2, (1.3, 1.0))
    panels.draw_shaft(axes[0], record)
    panels.draw_slip(axes[1], record)
    return figure


@styled
def energy_figure(record: Record) -> Figure:
    """Return where the energy went, stacked, and the heat flows."""
    figure, axes = time_figure(6.4, 2, (1.7, 1.0))
    panels.draw_energy(axes[0], record)
    panels.draw_heat_flow(axes[1], record)
    return figure


@styled
def overview_figure(record: Record) -> Figure:
    """Return speeds, torques and film ratios below each other: the shift in one picture."""
    figure, axes = time_figure(8.6, 3, (1.15, 1.15, 1.0))
    panels.draw_speeds(axes[0], record)
    panels.draw_torques(axes[1], record)
    contact_panels.draw_films(axes[2], record)
    return figure
