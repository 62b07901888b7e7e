"""The clutch's plot: shares add up, the static value is where slip is zero."""

import io

import pytest

from thrustwasher.models.clutch import ClutchParams, boundary_friction, solve_clutch
from thrustwasher.report.clutch_plot import clutch_figure

PACK = ClutchParams()
POINT = {"load": 5898.0, "speed": -50.0, "oil_temperature": 297.15}
SLIPS = [0.0, 10.0, 20.0, 60.0]


def drawn(fidelity="stribeck"):
    sweep = [solve_clutch(PACK, load=5898.0, speed=w, fidelity=fidelity) for w in SLIPS]
    here = solve_clutch(PACK, fidelity=fidelity, **POINT)
    ploughing = boundary_friction(0.1, 0.0, PACK.plough_weight)
    figure = clutch_figure(SLIPS, sweep, here, POINT, ploughing if fidelity != "closed" else None)
    return figure, sweep, here


def panel(figure, title):
    return next(a for a in figure.axes if a.get_title(loc="left") == title)


def test_shares_of_ploughing_and_adhesion_add_up_to_the_curve():
    figure, sweep, _ = drawn()
    for title, values in (
        ("Friction coefficient", [r.friction_coefficient for r in sweep]),
        ("Torque of the pack", [r.torque_capacity for r in sweep]),
    ):
        ploughing, adhesion = panel(figure, title).collections[:2]
        top = adhesion.get_paths()[0].vertices[:, 1].max()
        assert top == pytest.approx(values[0], rel=1e-12)
        height = ploughing.get_paths()[0].vertices[:, 1].max()
        share = boundary_friction(0.1, 0.0, PACK.plough_weight) / sweep[0].friction_coefficient
        assert height == pytest.approx(share * values[0], rel=1e-12)


def test_the_shear_of_the_oil_lies_on_top_where_the_film_resists():
    figure, sweep, _ = drawn("field")
    oil = panel(figure, "Torque of the pack").collections[2].get_paths()[0].vertices
    assert oil[oil[:, 0] == 60.0][:, 1].max() == pytest.approx(sweep[-1].torque_capacity)
    assert sweep[-1].torque_capacity > 1.0001 * sweep[-1].contact_torque


def test_the_static_torque_and_the_point_are_marked():
    figure, sweep, here = drawn()
    axis = panel(figure, "Torque of the pack")
    assert any("389.2" in text.get_text() for text in axis.texts)
    marks = [line.get_xydata()[0] for line in axis.lines if line.get_marker() == "o"]
    assert marks[0] == pytest.approx((50.0, -here.friction_torque))
    assert sweep[0].torque_capacity == pytest.approx(389.2, abs=0.05)


def test_a_constant_coefficient_has_no_shares_and_no_shear_ratio():
    figure, *_ = drawn("closed")
    titles = {a.get_title(loc="left") for a in figure.axes}
    assert "Shear ratio" not in titles
    assert not panel(figure, "Friction coefficient").collections


def test_slip_is_also_given_in_rpm():
    figure, *_ = drawn()
    figure.savefig(io.BytesIO())
    above = panel(figure, "Shear ratio").child_axes[0]
    assert above.get_xlim()[1] == pytest.approx(60.0 * 9.549296585513721)
