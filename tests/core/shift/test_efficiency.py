"""Efficiency at steady points: balance, sources against the models themselves, gears."""

import math

import numpy as np
import pytest
from scene_runs import changed, slow_without_jit

from thrustwasher import ParameterError, solve_clutch, solve_gearmesh, solve_losses
from thrustwasher.shift import load_scene, steady_points
from thrustwasher.shift.checks.steady_doubts import capacity
from thrustwasher.shift.cosim.system import ConnectedPart
from thrustwasher.shift.steady_points import SOURCES, efficiency_map
from thrustwasher.studio.report.model_plots.efficiency_plot import efficiency_figure

BARE = "[transmission]\nwashers = 0\n"


@pytest.fixture(scope="module")
def scene(tmp_path_factory):
    return changed(tmp_path_factory.mktemp("bare"), BARE)


@slow_without_jit
@pytest.mark.parametrize("gear", ["first", "second"])
def test_power_in_is_power_out_and_losses(scene, gear):
    rng = np.random.default_rng(7)
    found = efficiency_map(
        scene, rng.uniform(0.0, 400.0, 6), rng.uniform(20.0, 500.0, 6), gear=gear
    )
    c = found.columns
    assert found.balance < 1e-12
    assert c["loss"] == pytest.approx(sum(c[name] for name in SOURCES), rel=1e-9)
    out = c["output_torque"] > 0.0
    power = (c["torque"] * c["speed"])[out]
    assert c["efficiency"][out] == pytest.approx(1.0 - c["loss"][out] / power, rel=1e-12)
    assert np.isnan(c["efficiency"][~out]).all()


@slow_without_jit
def test_a_washer_is_solved_at_most_five_times_a_point_and_as_if_solved_in_each_sweep(monkeypatch):
    solved, refresh = [], ConnectedPart.refresh

    def counted(part, time):
        solved.append(part.name)
        refresh(part, time)

    scene, points = load_scene("planetary"), ([100.0, 150.0], [200.0])
    monkeypatch.setattr(ConnectedPart, "refresh", counted)
    found = efficiency_map(scene, *points)
    assert solved.count("washer") <= 10
    monkeypatch.setattr(steady_points, "NEAR", 0.0)
    each = efficiency_map(scene, *points)
    for name in ("loss", "washer_loss", "efficiency"):
        assert found.columns[name] == pytest.approx(each.columns[name], rel=1e-7)


@slow_without_jit
def test_sources_are_what_their_models_lose_there(scene):
    """First gear: the ring has 150 N m at 300 rad/s, four planets turn 4.1 times as fast."""
    at = efficiency_map(scene, [150.0], [300.0])
    c = {name: float(x[0]) for name, x in at.columns.items()}
    assert c["output_speed"] == pytest.approx(300.0 / (1.0 + 38.0 / 74.0), rel=1e-14)
    spin = 74.0 / 18.0 * (300.0 - c["output_speed"])
    oil = scene.oil_temperature
    part = scene.parts["losses"].params
    radius = 0.5 * 1.5e-3 * 74.0 / math.cos(math.radians(20.0))
    # four planets have what input, open clutch (it slips at the ring's speed) and drag leave
    left = 150.0 - (c["pump_loss"] + 0.5 * c["seal_loss"] + c["pack_loss"]) / 300.0
    left -= c["mesh_loss"] / (300.0 - c["output_speed"])
    force = left / (4.0 * radius)
    own = solve_losses(
        part,
        input_speed=300.0,
        output_speed=c["output_speed"],
        planet_speed=spin,
        tooth_force=force,
        oil_temperature=oil,
    )
    for name, source in (("pump", "pump"), ("churning", "churning"), ("seal", "seal")):
        assert c[f"{name}_loss"] == pytest.approx(getattr(own, f"{source}_power"), rel=1e-9)
    assert c["rolling_loss"] == pytest.approx(own.bearing_power, rel=5e-3)  # the force is rough
    lost = 0.0
    for name in ("mesh", "ring_mesh"):
        params = scene.parts[name].params
        quasi = type(params)(
            **{f: getattr(params, f) for f in params.__dataclass_fields__ if f != "thermal_mode"},
            thermal_mode="quasi_steady",
        )
        torque = force * 0.5 * 1.5e-3 * 18.0 / math.cos(math.radians(20.0))
        found = solve_gearmesh(quasi, power=torque * spin, speed=spin, oil_temperature=oil)
        lost += 4.0 * found.friction_power
    assert c["mesh_loss"] == pytest.approx(lost, rel=1e-2)


@slow_without_jit
def test_a_locked_set_has_no_losses_in_its_teeth(scene):
    c = efficiency_map(scene, [100.0], [200.0], gear="second").columns
    assert c["mesh_loss"] == 0.0 and c["output_speed"] == 200.0 and c["pump_loss"] > 500.0


@slow_without_jit
def test_the_usual_map_has_nothing_to_warn_of(scene):
    found = efficiency_map(scene, [25.0, 250.0], [105.0, 420.0])
    assert found.doubts == ((), (), (), ()) and not found.columns["warnings"].any()
    assert not [text for text in found.warnings if text.startswith("at ")]


@slow_without_jit
def test_each_point_has_its_warnings():
    """0.18.0 never warned: not of 5000 N m, which the brake cannot hold and no tooth endures."""
    scene = load_scene("planetary")
    found = efficiency_map(scene, [100.0, 1000.0, 5000.0], [300.0])
    assert found.doubts[0] == ()
    held, teeth = found.doubts[1], "; ".join(found.doubts[2])
    assert "brake: 499.2 N·m to hold, its capacity" in held[0]
    assert len(held) == 2 and "washer: temperature_max = 162.2 °C" in held[1]
    for words in ("would slip", "mesh: pitting_safety", "mesh: scuffing_safety", "washer: "):
        assert words in teeth
    assert found.columns["warnings"].tolist() == [0.0, 2.0, len(found.doubts[2])]
    lines = [text for text in found.warnings if "mesh: pitting_safety" in text]
    assert any(
        text.startswith("at 1 of 3 points, first at 5000 N·m and 300 rad/s") for text in lines
    )


@slow_without_jit
def test_bodies_too_warm_for_the_oil_are_said():
    """Washers at 204 degC are within what their model was verified for, the oil does not last."""
    found = efficiency_map(load_scene("planetary"), [2700.0], [150.0])
    assert any("washer: temperature_max" in t and "ages fast" in t for t in found.doubts[0])


@slow_without_jit
def test_the_capacity_is_that_of_the_pack_under_the_greatest_pressure():
    scene = load_scene("planetary")
    part = scene.parts["brake"]
    found = solve_clutch(part.params, load=(760e3 - 30e3) * 8e-3, speed=0.0, oil_temperature=358.15)
    assert capacity(scene, "brake") == pytest.approx(found.torque_capacity, rel=1e-12)


@slow_without_jit
def test_points_with_warnings_are_hatched():
    found = efficiency_map(load_scene("planetary"), [100.0, 1000.0, 2000.0], [200.0, 300.0])
    axis = efficiency_figure(found).axes[0]
    hatched = [p.get_xy() for p in axis.patches if p.get_hatch() == "///"]
    assert len(hatched) == 4 and min(y for _, y in hatched) == 550.0


@slow_without_jit
@pytest.mark.parametrize("gear", ["first", "second"])
def test_power_is_closed_in_all_four_quadrants(scene, gear):
    found = efficiency_map(scene, [-80.0, -3.0, 0.0, 3.0, 80.0], [-300.0, 0.0, 150.0], gear=gear)
    c = found.columns
    assert found.balance < 1e-12
    assert c["loss"] == pytest.approx(sum(c[name] for name in SOURCES), rel=1e-9, abs=1e-9)
    power, out = c["torque"] * c["speed"], c["output_torque"] * c["output_speed"]
    for given, left, found_, way in zip(power, out, c["efficiency"], found.flow, strict=True):
        if way == "input to output":
            assert found_ == left / given < 1.0
        elif way == "output to input":
            assert found_ == given / left < 1.0
        else:
            assert math.isnan(found_)


@slow_without_jit
def test_turned_both_ways_round_it_loses_the_same(scene):
    """Torque and speed of the other sign: the same gearbox in a mirror."""
    one, other = (efficiency_map(scene, [x * 60.0], [x * 250.0]).columns for x in (1.0, -1.0))
    for name in ("loss", "efficiency", *SOURCES):
        assert one[name] == pytest.approx(other[name], rel=1e-12)


@slow_without_jit
def test_the_loss_passes_through_no_torque_without_a_jump(scene):
    """Its slope over torque stays within what teeth, bearings and needles rub per torque."""
    torques = np.linspace(-20.0, 20.0, 81)
    loss = efficiency_map(scene, torques, [200.0]).columns["loss"]
    assert abs(np.diff(loss) / np.diff(torques)).max() < 0.02 * 200.0


def test_without_losses_the_map_says_what_is_left_out(tmp_path):
    found = efficiency_map(changed(tmp_path, f"losses = false\n{BARE}"), [100.0], [200.0])
    assert found.columns["pump_loss"] == 0.0
    assert any("no [losses]" in text for text in found.warnings)


@pytest.mark.parametrize(
    ("more", "words"),
    [
        ({"gear": "third"}, "gear = 'third', allowed: 'first', 'second'"),
        ({"torque": [-2e5]}, "torque = -200000.0 N.m, allowed: -100000 .. 100000"),
        ({"speed": [6e3]}, "speed = 6000.0 rad/s, allowed: -5000 .. 5000"),
        ({"speed": []}, "one value of each"),
    ],
)
def test_what_is_wrong_is_named(more, words):
    with pytest.raises(ParameterError, match=words):
        efficiency_map(load_scene("planetary"), **{"torque": [100.0], "speed": [200.0]} | more)
