"""What stands next to the figures of a shift: usual ranges, phases, heat, safeties; no
blame."""

from dataclasses import replace

import numpy as np
import pytest
import shift_stand_in

from thrustwasher.model.registry import find_spec
from thrustwasher.shift.account import summary
from thrustwasher.shift.account.shift_record import KeyFigure, Part
from thrustwasher.studio.report.shift import shift_tables
from thrustwasher.studio.report.shift.heat_split import heat_split
from thrustwasher.studio.report.shift.shift_report import shift_page
from thrustwasher.studio.report.shift.trust import trust_texts
from thrustwasher.studio.report.shift.usual import beside, ranges, usual_table


def full(pitting=1.8, jerk=24.7):
    """Return a shift with vehicle, pistons, a pack that stores heat, rated teeth and a sump."""
    made = shift_stand_in.record(washer=False, mesh=True)
    t, one = made.time, np.ones_like(made.time)
    power = made.signals["clutch.friction_power"]
    # Nine tenths are stored; the oil gets the rest, as means of the steps.
    energy = np.concatenate(([0.0], np.cumsum(0.5 * (power[1:] + power[:-1]) * np.diff(t))))
    given = np.concatenate(([0.0], 0.1 * np.diff(energy) / np.diff(t)))
    teeth = {"pitting_safety": pitting, "scuffing_safety": 7.8, "micropitting_safety": 0.4}
    teeth |= {"film_ratio_gf": 0.4, "contact_pressure_max": 976e6}
    signals = {
        **made.signals,
        "transmission.output_acceleration": np.where(t < 1.75, 12.0, 11.0),
        "transmission.clutch_piston_pressure": 1e6 * np.clip(t, 0.0, 0.7),
        "transmission.brake_piston_pressure": 0.0 * one,
        **{
            f"transmission.{pack}_{side}_speed": 100.0 * one
            for pack in ("clutch", "brake")
            for side in ("hub", "drum")
        },
        "clutch.load": 3000.0 * one,
        "clutch.energy": energy,
        "clutch.oil_heat": given,
        "clutch.stored_heat": 0.9 * energy,
        "sump.temperature": 358.15 * one,
        "mesh.speed": 400.0 * (t < 1.75),
        **{f"mesh.{name}": value * one for name, value in teeth.items()},
    }
    figures = [
        KeyFigure("peak_jerk", "jerk", "m/s3", jerk),
        KeyFigure("peak_clutch_heat_flux", "flux", "W/m2", 0.83e6),
        KeyFigure("torque_hole", "hole", "m/s2", 0.1),
        KeyFigure("maximum_slip", "slip", "rad/s", 370.0),
    ]
    parts = [p for p in made.parts if p.name != "mesh"] + [Part("mesh", find_spec("gearmesh"), {})]
    return replace(
        made, signals=signals, reach=0.1, parts=parts, key_figures=[*made.key_figures, *figures]
    )


def test_every_range_is_in_order_and_says_what_it_rests_on():
    assert len(ranges()) >= 10
    for usual in ranges().values():
        assert usual.range[0] < usual.range[1] and usual.text and usual.basis


def test_at_least_ten_figures_stand_beside_a_range():
    rows = {row[0]: row[1:] for row in usual_table(full()).rows}
    assert len(rows) >= 10
    plain = {
        words: [c.replace("\N{NO-BREAK SPACE}", " ") for c in row] for words, row in rows.items()
    }
    assert plain["jerk of the vehicle, over 10 ms"][:3] == ["24.7 m/s³", "10 .. 15 m/s³", "▲ above"]
    assert plain["highest heat per area and time"][2] == "▼ below"
    assert plain["lowest safety against pitting"][:3] == ["1.8", "1 or more", ""]
    # 3 kN on four fifths of a face of 64/85 mm.
    assert plain["highest pressure on the land while it slips"][0] == "0.381 MPa"
    assert beside(replace(full(), alone=True)) == {}  # a pack on a rig


def test_a_figure_outside_its_range_is_marked_but_no_warning():
    page = shift_page(full(jerk=99.0))
    assert page.warnings == []
    (card,) = [card for card in page.cards if card.name == "jerk"]
    assert card.note.startswith("usual: 10") and card.note.endswith("above")


def test_teeth_below_their_limit_are_a_warning_and_said_to_be_an_estimate():
    (words,) = summary.warnings(full(pitting=0.9))
    assert "against pitting is 0.90" in words and "publicly quoted" in words
    assert "estimates, no rating" in " ".join(trust_texts(full()))


def test_steels_of_the_paper_are_not_held_against_other_teeth():
    """The stand-in's margins of AISI 1020 are negative; these teeth are case-hardened."""
    assert full().figures["stress_margin_aisi1020"] < 0.0
    assert "AISI" not in " ".join([*summary.warnings(full()), *summary.sentences(full())])


def test_phases_fill_the_run_and_share_the_heat_of_the_clutch():
    rows = shift_tables.phase_table(full()).rows
    assert [row[0] for row in rows] == ["first gear", "torque phase", "inertia phase", "locked"]
    assert sum(float(row[2]) for row in rows) == pytest.approx(2.5)
    heat = sum(float(row[3].replace("\N{THIN SPACE}", "")) for row in rows)
    assert heat == pytest.approx(full().energy["clutch"], rel=1e-3)


def test_a_part_without_an_account_of_its_heat_has_made_what_its_steps_did():
    """Teeth say power, heat to the oil and what they store; powers are those of each step."""
    record = full()
    power, given = 50.0 + 30.0 * np.sin(9.0 * record.time), 20.0 + 5.0 * record.time
    kept = np.concatenate(([0.0], np.cumsum((power - given)[1:] * np.diff(record.time))))
    heats = {"friction_power": power, "oil_heat": given, "stored_heat": kept}
    signals = record.signals | {f"mesh.{name}": values for name, values in heats.items()}
    split = heat_split(replace(record, signals=signals), "mesh")
    assert split.made[-1] > 100.0 and np.max(np.abs(split.rest)) < 1e-12 * split.made[-1]
